"""The command line: trunnion run DECK, trunnion check DECK.

Exit 0: solved and certified.  1: a case did not converge or failed its certificate; the files
hold the good cases.  2: bad input, nothing written.  3: internal error, a log file tells.
130: interrupted, nothing half written.
"""

import os
import signal
import sys
from collections.abc import Sequence
from importlib import import_module
from pathlib import Path
from typing import NoReturn

import click

from trunnion.commands import COMMANDS
from trunnion.commands.shared import BAD_INPUT, INTERNAL, INTERRUPTED, TERMINATED, InputError


class LateGroup(click.Group):
    """A group whose commands are imported when they are called for: help needs none of them."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Names in alphabetical order."""
        return sorted(COMMANDS)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """Import a command by its name."""
        if cmd_name not in COMMANDS:
            return None
        module = import_module(f"trunnion.commands.{cmd_name}")
        command: click.Command = getattr(module, cmd_name)
        return command

    def format_commands(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """List the commands with their lines of help."""
        with formatter.section("Commands"):
            formatter.write_dl([(name, COMMANDS[name]) for name in self.list_commands(ctx)])


@click.group(cls=LateGroup, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(package_name="trunnion")
@click.pass_context
def cli(context: click.Context) -> None:
    """Solve piping whose supports lift off, close gaps and slide with friction."""
    if os.environ.get("NO_COLOR") or os.environ.get("TERM") == "dumb":
        context.color = False


def main(arguments: Sequence[str] | None = None) -> NoReturn:
    """Run one command and leave with its exit code."""
    # threads of numpy's BLAS cost more to start than they ever give here, and change last digits
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(TERMINATED))
    sys.exit(_guarded(arguments))


def _guarded(arguments: Sequence[str] | None) -> int:
    """Turn every end of a command into an exit code and a message without a traceback."""
    from trunnion.errors import BatchError, DeckError, ModelError

    try:
        code = cli.main(arguments, prog_name="trunnion", standalone_mode=False)
        return int(code or 0)
    except click.ClickException as error:
        error.show()
        return BAD_INPUT
    except (BatchError, DeckError, ModelError, InputError) as error:
        click.echo("\n".join([*getattr(error, "__notes__", ()), str(error)]), err=True)
        return BAD_INPUT
    except (click.Abort, KeyboardInterrupt):
        before = signal.signal(signal.SIGINT, signal.SIG_IGN)  # one line, however impatient
        click.echo("interrupted: nothing is half written", err=True)
        signal.signal(signal.SIGINT, before)
        return INTERRUPTED
    except OSError as error:
        name = f"{error.filename}: " if error.filename else ""
        click.echo(f"{name}{error.strerror or error}", err=True)
        return INTERNAL
    except Exception as error:
        click.echo(_internal(error), err=True)
        return INTERNAL


def _internal(error: Exception) -> str:
    """Keep the traceback of an internal error in a file and say where."""
    import tempfile
    import traceback

    said = f"internal error, nothing was written: {type(error).__name__}: {error}"
    text = "".join([f"{sys.argv}\n", *traceback.format_exception(error)])
    for folder in (Path(), Path(tempfile.gettempdir())):
        log = folder / f"trunnion-error-{os.getpid()}.log"
        try:
            log.write_text(text)
        except OSError:
            continue
        return f"{said}\nPlease report it with the deck and {log.resolve()}"
    return said
