"""Progress of what lasts: a bar on a terminal, plain lines where stderr goes elsewhere."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from time import monotonic
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.progress import Progress, TaskID

LASTS = 2.0  # seconds before anything is shown


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
        if self._shows() and not sys.stderr.isatty():
            print(f"{self.done}/{self.total} {text}", file=sys.stderr, flush=True)
        self.tick()

    def tick(self) -> None:
        """Move the bar."""
        if not self._shows() or not sys.stderr.isatty():
            return
        if self.bar is None:
            self.bar = _bar(self.what, self.total)
        progress, task = self.bar
        progress.update(task, completed=self.done, refresh=True)

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
