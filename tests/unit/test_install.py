"""Meson installs only what is listed: a file nobody listed does not exist for the user."""

from importlib.resources import files
from pathlib import Path

SOURCE = Path(__file__).parents[2] / "python" / "trunnion"


def test_every_file_of_the_package_is_installed():
    installed = files("trunnion")
    forgotten = [
        str(name)
        for path in sorted(SOURCE.rglob("*"))
        if path.is_file() and path.name != "meson.build" and "__pycache__" not in path.parts
        for name in [path.relative_to(SOURCE)]
        if not installed.joinpath(*name.parts).is_file()
    ]
    assert forgotten == []
