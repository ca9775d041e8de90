"""Run `python -m trunnion` as the command `trunnion`."""

from trunnion.cli import main

main()
