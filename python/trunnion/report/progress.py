"""Progress of what lasts, on stderr, from two seconds on; nothing of it is in any file.

`Counter` counts decks or variants: a bar on a terminal, plain lines where stderr goes elsewhere.
`shown` tells what a single run is at, on a terminal only.
"""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from time import monotonic
from typing import TYPE_CHECKING

from trunnion.watch import Watch

if TYPE_CHECKING:
    from threading import Event

    from rich.progress import Progress, TaskID

LASTS = 2.0  # seconds before anything is shown
FRAME = 0.1  # seconds between two looks at a run


def is_lively() -> bool:
    """Whether stderr is a terminal on which a line can be written over."""
    return sys.stderr.isatty() and os.environ.get("TERM") != "dumb"


# ------------------------------------------------------------------ many decks or variants
@dataclass(slots=True)
class Counter:
    """Counts what is done of `total`; `tick` may be called at any time."""

    what: str
    total: int
    begun: float = field(default_factory=monotonic)
    done: int = 0
    bar: "tuple[Progress, TaskID] | None" = None

    def step(self, text: str, n: int = 1) -> None:
        """Count n more; `text` says what."""
        self.done += n
        if self._shows() and not is_lively():
            print(f"{self.done}/{self.total} {text}", file=sys.stderr, flush=True)
        self.tick()

    def tick(self) -> None:
        """Move the bar."""
        if not self._shows() or not is_lively():
            return
        if self.bar is None:
            self.bar = _bar(self.what, self.total)
        progress, task = self.bar
        progress.update(task, completed=self.done, refresh=True)

    def say(self, text: str) -> None:
        """Say what the user must know at once; it stays above the bar."""
        if self.bar is None:
            print(text, file=sys.stderr, flush=True)
        else:
            self.bar[0].console.print(text, markup=False, highlight=False)

    def _shows(self) -> bool:
        return monotonic() - self.begun > LASTS

    def close(self) -> None:
        """Take the bar away."""
        if self.bar is not None:
            self.bar[0].stop()


@contextmanager
def progress(what: str, total: int) -> Iterator[Counter]:
    """Count something from here on; the bar is gone afterwards."""
    counter = Counter(what, total)
    try:
        yield counter
    finally:
        counter.close()


def _bar(what: str, total: int) -> "tuple[Progress, TaskID]":
    """A bar that is drawn when it moves: a thread that draws would not survive forks."""
    from rich.console import Console
    from rich.progress import (
        BarColumn,
        MofNCompleteColumn,
        Progress,
        TextColumn,
        TimeRemainingColumn,
    )

    bar = Progress(
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeRemainingColumn(),
        console=Console(stderr=True),
        auto_refresh=False,
        transient=True,
    )
    task = bar.add_task(what, total=total)
    bar.start()
    return bar, task


# ------------------------------------------------------------------ one run
@contextmanager
def shown(doing: str) -> Iterator[Watch | None]:
    """Show what is done from here on where it lasts; nobody watches where there is no terminal.

    A thread looks at the watch, so that the work need not know of screens and clocks.
    """
    if not is_lively():
        yield None
        return
    from threading import Event, Thread

    watch, over = Watch(doing), Event()
    screen = Thread(target=_draw, args=(watch, over), daemon=True)
    screen.start()
    try:
        yield watch
    finally:
        over.set()
        screen.join()


def _draw(watch: Watch, over: "Event") -> None:
    """Draw one line until the work is over, and take it away."""
    begun = monotonic()
    if over.wait(LASTS):
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, SpinnerColumn, TextColumn
    from rich.table import Column

    line = Progress(
        SpinnerColumn(),
        TextColumn("{task.fields[elapsed]}", justify="right"),
        BarColumn(bar_width=12),
        TextColumn("{task.description}", markup=False, table_column=Column(
            no_wrap=True, overflow="ellipsis", ratio=1)),
        console=Console(stderr=True),
        expand=True,
        auto_refresh=False,
        transient=True,
        redirect_stdout=False,
        redirect_stderr=False,
    )  # fmt: skip
    task = line.add_task(str(watch), total=None, elapsed=_clock(monotonic() - begun))
    with line:
        while not over.wait(FRAME):
            line.update(
                task,
                description=str(watch),
                total=watch.total or None,
                completed=watch.done,
                elapsed=_clock(monotonic() - begun),
                refresh=True,
            )


def _clock(seconds: float) -> str:
    minutes, rest = divmod(int(seconds), 60)
    return f"{minutes}:{rest:02d}"
