"""Many decks: `trunnion.batch(decks, folder)`; what is finished already is not solved again."""

import fcntl
import os
from collections.abc import Callable, Generator, Iterator, Sequence
from contextlib import closing, contextmanager
from dataclasses import replace
from pathlib import Path
from time import monotonic, sleep
from typing import TYPE_CHECKING

from trunnion.errors import BatchError
from trunnion.frozen import frozen
from trunnion.many.forked import run_forked
from trunnion.many.onedeck import solve_deck
from trunnion.many.records import FOLDER, INTERNAL, Entry, finished, settings_of
from trunnion.report.atomic import write_files
from trunnion.report.outputs import SUFFIXES

if TYPE_CHECKING:
    from trunnion.formats.options import Options

SUMMARY = "batch-summary"
PATIENCE = 5.0  # for the children of a killed run to let go of the folder [s]

Told = Callable[[Entry], None]


@frozen
class Batch:
    """The decks of a batch in the order given."""

    entries: tuple[Entry, ...]

    @property
    def code(self) -> int:
        """Exit code of the worst deck: 0, 1 a case failed, 2 a bad deck, 3 internal error."""
        return max((entry.code for entry in self.entries), default=0)

    def __getitem__(self, stem: str) -> Entry:
        """Return the entry of a deck by the stem of its name."""
        return next(entry for entry in self.entries if entry.stem == stem)


def batch(
    decks: Sequence[str | os.PathLike[str]],
    folder: str | os.PathLike[str] = ".",
    *,
    jobs: int | None = None,
    also: Sequence[str] = (),
    permissive: bool = False,
    options: "Options | None" = None,
    scheduler: str | None = None,
    redo: bool = False,
    told: Told | None = None,
    tick: Callable[[], None] | None = None,
    warned: Callable[[str], None] | None = None,
) -> Batch:
    """Solve many decks, each in a process of its own; write their reports and a summary.

    Parameters
    ----------
    folder : where <stem>.out, <stem>.json and the summary go.
    jobs : processes at a time; None is one a core.
    also : further reports of every deck, names of `report.outputs.OUTPUTS`: html, xlsx, csv ...
    permissive : leave out what the model cannot represent of files of other programs.
    options : side table, tolerance and anchors for the files whose format has a use for them.
    scheduler : address of a Dask scheduler whose workers solve instead of own processes.
    redo : solve finished decks again.
    told : called with every entry as it comes; tick : called now and then.
    warned : called with what holds a batch up: a cluster without workers.

    Raises
    ------
    BatchError
        Two decks of one stem, a name that a report would overwrite, a folder in use.
    """
    paths, place = [Path(deck) for deck in decks], Path(folder)
    _refuse_names(paths)
    settings = settings_of(also=also, permissive=permissive, options=options)
    with _alone(place):
        _sweep(place, paths)
        found: dict[str, Entry] = {}
        for deck in paths:
            entry = None if redo else finished(place, deck, settings)
            if entry is not None:
                found[deck.stem] = entry
                if told is not None:
                    told(entry)
        todo = [deck for deck in paths if deck.stem not in found]
        if scheduler is None:
            ends = _solve_here(todo, place, settings, jobs or _cores(), tick)
        else:
            from trunnion.many.cluster import solve_there

            ends = solve_there(todo, place, settings, scheduler, tick, warned)
        with closing(ends):
            for entry in ends:
                found[entry.stem] = entry
                if told is not None:
                    told(entry)
        done = Batch(tuple(found[deck.stem] for deck in paths))
        _write_summary(done, place)
    return done


def _solve_here(
    todo: Sequence[Path],
    place: Path,
    settings: dict[str, object],
    jobs: int,
    tick: Callable[[], None] | None,
) -> Generator[Entry, None, None]:
    """Solve decks in forked processes."""
    if todo:
        _load()
    ends = run_forked(
        todo,
        lambda deck: solve_deck(deck, place, settings),
        jobs,
        tick=tick,
        swept=lambda pid: _sweep(place, (), pid),
    )
    for end in ends:
        if end.result is not None:
            died = tuple(f"solved at the second try: {death}" for death in end.deaths)
            yield replace(end.result, notes=died)
            continue
        deck = todo[end.index]
        yield Entry(deck.stem, deck.name, INTERNAL, causes=end.deaths)


def _load() -> None:
    """Import once, before forking, what every child needs."""
    import trunnion.cases.analysis
    import trunnion.deck.reader
    import trunnion.report.json
    import trunnion.report.text  # noqa: F401


def _cores() -> int:
    return len(os.sched_getaffinity(0))


def _refuse_names(decks: Sequence[Path]) -> None:
    """Refuse decks whose reports would overwrite each other, a deck or the summary."""
    problems: list[str] = []
    by_stem: dict[str, list[Path]] = {}
    for deck in decks:
        by_stem.setdefault(deck.stem, []).append(deck)
        if deck.suffix.lower() in SUFFIXES:
            problems.append(f"{deck}: a deck must not be called *{deck.suffix}, as the reports are")
    for stem, same in by_stem.items():
        if len(same) > 1:
            names = " and ".join(map(str, same))
            problems.append(f"{names} would both write {stem}.out: rename one, or use two folders")
        if stem == SUMMARY:
            problems.append(f"{same[0]}: {SUMMARY}.json is the summary of the batch")
    if problems:
        raise BatchError("\n".join([*problems, "nothing was solved"]))


@contextmanager
def _alone(folder: Path) -> Iterator[None]:
    """Hold a folder so that two batches never write into it at once.

    Children inherit the lock: after a killed run it is free when the last of them has ended.
    """
    (folder / FOLDER).mkdir(parents=True, exist_ok=True)
    with (folder / FOLDER / "lock").open("w") as file:
        until = monotonic() + PATIENCE
        while True:
            try:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
                break
            except BlockingIOError:
                if monotonic() > until:
                    raise BatchError(f"another batch is at work in {folder}") from None
                sleep(0.05)
        yield


def _sweep(folder: Path, decks: Sequence[Path], pid: int | None = None) -> None:
    """Remove temporary files of processes that died: of one, or all of these decks."""
    stems = {deck.stem for deck in decks}
    left = f".*.{'*' if pid is None else pid}.tmp"
    for place in (folder, folder / FOLDER):
        for path in place.glob(left):
            if pid is not None or any(path.name[1:].startswith(f"{stem}.") for stem in stems):
                path.unlink(missing_ok=True)
    for path in folder.glob(f"*_*/{left}"):  # reports of many files have a folder of their own
        if pid is not None or path.parent.name.rsplit("_", 1)[0] in stems:
            path.unlink(missing_ok=True)


def _write_summary(done: Batch, folder: Path) -> None:
    from trunnion.report.batch import summary_csv, summary_json

    write_files(
        {
            folder / f"{SUMMARY}.json": summary_json(done.entries),
            folder / f"{SUMMARY}.csv": summary_csv(done.entries),
        }
    )
