"""A batch on a Dask cluster: models go out, reports come back; the client alone touches files.

So workers need Trunnion of the same version and nothing else, no shared folder.  Dask gives the
decks of a worker that is lost to others; one at which several workers died is reported.  Where no
worker is left, or none comes, Dask would wait for ever: here it is said, and has an end.
"""

from collections.abc import Callable, Generator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from time import monotonic, sleep
from typing import TYPE_CHECKING, Any

from trunnion.errors import BatchError, DeckError, ModelError
from trunnion.many.onedeck import (
    Settings,
    broken,
    read_deck,
    refused,
    solve_model,
    write_deck,
)
from trunnion.many.records import INTERNAL, Entry, fingerprints, settings_of
from trunnion.model import Model

if TYPE_CHECKING:
    from distributed import Client, Future

TICK = 0.05  # between two looks at what is done [s]
ANSWERS = "10s"  # a scheduler that does not within is not there
LOOK = 1.0  # between two looks at who is there [s]
PATIENCE = 300.0  # without any worker [s]; a cluster that grows takes minutes to start one

Sent = tuple[Path, dict[str, str]]


def solve_there(
    todo: Sequence[Path],
    folder: Path,
    settings: Settings,
    address: str,
    tick: Callable[[], None] | None,
    warned: Callable[[str], None] | None = None,
) -> Generator[Entry, None, None]:
    """Give the entries of decks as they come; leaving early cancels what is not done."""
    client = _connect(address)
    sent: dict[Future, Sent] = {}
    try:
        for deck in todo:
            try:
                model, sources = read_deck(deck, settings)
                marks = fingerprints(sources, deck)
            except (DeckError, ModelError) as error:
                yield refused(deck, error)
                continue
            except Exception as error:
                yield broken(deck, folder, error)
                continue
            future = client.submit(solve_remote, model, deck.name, dict(settings), pure=False)
            sent[future] = deck, marks
        crew = _Crew(client, address, warned)
        while sent:
            lack = crew.lack(len(sent))
            if lack:
                for deck, _ in sent.values():
                    yield _unsolved(deck, lack)
                break
            for future in _ready(sent, tick):
                entry = _take(future, *sent[future], folder, settings)
                if entry is not None:
                    del sent[future]
                    yield entry
                    future.release()
    finally:
        client.cancel(list(sent), force=True)
        client.close(timeout=2)


def solve_remote(model: Model, deck: str, settings: Settings) -> tuple[Entry, dict[str, bytes]]:
    """Solve a model on a worker; what the program refuses is an entry without reports."""
    theirs, ours = settings["version"], settings_of()["version"]
    if theirs != ours:
        raise RuntimeError(f"this worker has Trunnion {ours}, the batch is of {theirs}")
    try:
        return solve_model(model, Path(deck), settings)
    except (DeckError, ModelError) as error:
        return refused(Path(deck), error), {}


def _connect(address: str) -> "Client":
    try:
        from distributed import Client
    except ImportError as error:
        raise BatchError(
            "--scheduler needs the package distributed: pip install 'trunnion[dask]'"
        ) from error
    try:
        return Client(address, timeout=ANSWERS, set_as_default=False)
    except (TimeoutError, OSError, ValueError) as error:
        raise BatchError(f"no Dask scheduler answers at {address}: {error}") from error


@dataclass(slots=True)
class _Crew:
    """Who is there to solve, looked at now and then."""

    client: "Client"
    address: str
    warned: Callable[[str], None] | None
    looked: float = field(default_factory=monotonic)
    seen: float = field(default_factory=monotonic)  # a worker, for the last time
    alone: bool = False

    def lack(self, left: int) -> str:
        """Why nobody will solve what is left any more; empty while somebody may."""
        if self.client.status not in ("running", "connecting"):
            return "the scheduler went away"
        now = monotonic()
        if now - self.looked < LOOK:
            return ""
        self.looked = now
        try:
            some = self.client.status == "running" and bool(self.client.nthreads())
        except (OSError, TimeoutError):  # the scheduler does not answer: it is looked at again
            some = False
        if some:
            self.seen = now
        elif not self.alone and self.warned is not None:
            self.warned(
                f"no worker at {self.address}: {left} decks wait, for {PATIENCE:g} s at the most"
            )
        self.alone = not some
        return f"no worker for {PATIENCE:g} s" if now - self.seen > PATIENCE else ""


def _ready(sent: "dict[Future, Sent]", tick: Callable[[], None] | None) -> "list[Future]":
    """Wait a moment for futures that are done."""
    sleep(TICK)
    if tick is not None:
        tick()
    return [future for future in sent if future.done()]


def _unsolved(deck: Path, cause: str) -> Entry:
    return Entry(deck.stem, deck.name, INTERNAL, causes=(f"on the cluster: {cause}",))


def _take(
    future: "Future", deck: Path, marks: dict[str, str], folder: Path, settings: Settings
) -> Entry | None:
    """Write what came back, or say why nothing did; None while the answer is made once more.

    An answer that died with its worker is `lost` until another worker has made it.
    """
    status = future.status
    if status in ("lost", "pending"):
        return None
    if status != "finished":
        error: Any = future.exception() if status == "error" else None
        lost = f"{status}: the scheduler went away or gave it up"
        cause = f"{type(error).__name__}: {error}" if error is not None else lost
        return _unsolved(deck, cause)
    try:
        answer: tuple[Entry, dict[str, bytes]] = future.result()
        entry, reports = answer
        if reports:
            write_deck(entry, reports, marks, folder, settings)
        return entry
    except Exception as error:
        return broken(deck, folder, error)
