"""Files whole or not at all: written beside their place under another name, then renamed."""

import os
import signal
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from errno import EISDIR
from pathlib import Path

_WAIT = {signal.SIGINT, signal.SIGTERM}


def write_files(files: Mapping[Path, bytes]) -> None:
    """Write every file, or leave every one as it was.

    The temporary files stand in the same directories, so that a rename never crosses a file
    system.  An interruption before the renames removes them; during the renames it waits.
    """
    for path in files:
        if path.is_dir():  # found out at its rename, others would be there already
            raise IsADirectoryError(EISDIR, "a folder is in the way", str(path))
    temporary: dict[Path, Path] = {}
    try:
        for path, content in files.items():
            path.parent.mkdir(parents=True, exist_ok=True)
            temporary[path] = path.with_name(f".{path.name}.{os.getpid()}.tmp")
            with _naming(path):
                _write(temporary[path], content)
        blocked = signal.pthread_sigmask(signal.SIG_BLOCK, _WAIT)
        try:
            for path, hidden in temporary.items():
                with _naming(path):
                    hidden.replace(path)
        finally:
            signal.pthread_sigmask(signal.SIG_SETMASK, blocked)
    finally:
        for hidden in temporary.values():
            with suppress(OSError):  # what went wrong before is what the user must know
                hidden.unlink()


@contextmanager
def _naming(path: Path) -> Iterator[None]:
    """Let errors name the file that the user knows, not the one beside it."""
    try:
        yield
    except OSError as error:
        error.filename, error.filename2 = str(path), None
        raise


def _write(path: Path, content: bytes) -> None:
    """Write one new file and wait until the disk has it."""
    with path.open("wb") as file:
        file.write(content)
        file.flush()
        os.fsync(file.fileno())
