"""A terminal for tests: a command on a pty, what it sent, and the screen that a user sees."""

import os
import pty
import select
import signal
import struct
import subprocess
import sys
import termios
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fcntl import ioctl
from pathlib import Path

import pyte

KEYS_OF_COLOUR = ("NO_COLOR", "FORCE_COLOR", "CLICOLOR", "COLORTERM", "COLUMNS", "LINES")


@dataclass
class Session:
    """What became of a command: its exit code, all that it sent, the screen in the end."""

    code: int
    sent: str
    screen: list[str]
    painted: set[str]  # colours of the characters on the screen


def on_terminal(
    arguments: Sequence[object],
    *,
    size: tuple[int, int] = (80, 24),
    env: Mapping[str, str] | None = None,
    cwd: Path | None = None,
    stdout: bool = True,
    script: str = "from trunnion.cli import main\nmain()",
    meanwhile: Callable[[subprocess.Popen, str], None] | None = None,
    patience: float = 120.0,
) -> Session:
    """Run `trunnion ARGUMENTS` on a terminal of columns x lines.

    Parameters
    ----------
    stdout : whether stdout is the terminal as well; else a pipe, whose text comes first in `sent`.
    script : what the interpreter runs; sys.argv has the arguments.
    meanwhile : called with process and all that was sent, whenever something comes.
    """
    columns, lines = size
    mother, child = pty.openpty()
    ioctl(child, termios.TIOCSWINSZ, struct.pack("HHHH", lines, columns, 0, 0))
    own = {key: x for key, x in os.environ.items() if key not in KEYS_OF_COLOUR}
    own |= {"TERM": "xterm-256color", **(env or {})}
    process = subprocess.Popen(
        [sys.executable, "-c", script, *map(str, arguments)],
        stdin=child, stderr=child, stdout=child if stdout else subprocess.PIPE,
        env=own, cwd=cwd, start_new_session=True, preexec_fn=_interruptible,
    )  # fmt: skip
    os.close(child)
    sent = b""
    while True:
        ready, _, _ = select.select([mother], [], [], patience)
        if not ready:
            process.kill()
            raise TimeoutError(sent.decode(errors="replace"))
        try:
            piece = os.read(mother, 65536)
        except OSError:  # the other end is closed
            break
        sent += piece
        if meanwhile is not None:
            meanwhile(process, sent.decode(errors="replace"))
    os.close(mother)
    piped = b"" if process.stdout is None else process.stdout.read()
    if process.stdout is not None:
        process.stdout.close()
    code = process.wait(timeout=patience)
    screen = pyte.Screen(columns, max(lines, 400))
    stream = pyte.ByteStream(screen)
    stream.feed(sent)
    painted = {char.fg for row in screen.buffer.values() for char in row.values()}
    shown = [line.rstrip() for line in screen.display]
    while shown and not shown[-1]:
        shown.pop()
    return Session(code, (piped + sent).decode(errors="replace"), shown, painted)


def _interruptible() -> None:
    signal.signal(signal.SIGINT, signal.default_int_handler)
