"""The work ledger: exact counts of what a solve did, the same on every machine."""

from weakref import WeakKeyDictionary

from trunnion.kernels import SpdWork
from trunnion.watch import Watch


class Ledger:
    """Counts by name; those of the factor are read off the C shim, where the calls are made.

    analyse, factorise, solve : CHOLMOD calls (a solve is one right-hand side).
    refine : solves of the final refinement and certificate, a share of `solve` kept apart.
    elements : element evaluations; assemble : assemblies of K; iterations : passes.
    `watch` tells whoever looks at it what the work is at; it counts nothing.
    Counts of natural modes stand there only once there are any: mass (assemblies of M),
    inertia (factorisations that count eigenvalues).
    """

    NAMES = ("analyse", "factorise", "solve", "refine", "elements", "assemble", "iterations")

    def __init__(self, watch: Watch | None = None) -> None:
        self.watch = watch or Watch()
        self.count = dict.fromkeys(self.NAMES, 0)
        self._seen: WeakKeyDictionary[object, SpdWork] = WeakKeyDictionary()
        self.refining = False

    def add(self, **more: int) -> None:
        """Add to named counts."""
        for name, n in more.items():
            self.count[name] = self.count.get(name, 0) + n

    def begin(self, owner: object, work: SpdWork) -> None:
        """Do not count what a factor has done before this ledger was opened."""
        self._seen[owner] = work

    def follow(self, owner: object, work: SpdWork) -> None:
        """Take over what the factor of `owner` has done since last time."""
        seen = self._seen.get(owner, SpdWork(0, 0, 0, 0))
        self.count["analyse"] += work.analyse - seen.analyse
        self.count["factorise"] += work.factorise - seen.factorise
        self.count["refine" if self.refining else "solve"] += work.solve - seen.solve
        if work.inertia > seen.inertia:
            self.add(inertia=work.inertia - seen.inertia)
        self._seen[owner] = work

    def snapshot(self) -> dict[str, int]:
        """Copy of the counts."""
        return dict(self.count)

    def since(self, before: dict[str, int]) -> dict[str, int]:
        """Counts since a snapshot."""
        return {name: n - before.get(name, 0) for name, n in self.count.items()}
