"""The convergence story of one case, an entry an iteration."""

import numpy as np

from trunnion.arrays import Pass, System
from trunnion.solver.ledger import Ledger
from trunnion.solver.quantities import Response

NAMED = 12  # supports named in one entry; the rest are counted
KEPT = 1_000_000  # numbers of supports kept of one case for reports that tell its story


class History:
    """Collects iterations: which supports changed state, residual and step length."""

    def __init__(self, system: System, ledger: Ledger) -> None:
        self.system, self.ledger = system, ledger
        self.records: list[dict[str, object]] = []
        self.passes: list[Pass] = []
        self.room = KEPT
        self.last: Response | None = None  # after the iteration before
        self.jumps = 0  # Aitken jumps of the status iteration
        self.frozen: list[str] = []
        self.notes: list[str] = []  # warnings about how the case was solved

    def add(
        self, what: str, residual: float, step: float, before: Response, after: Response
    ) -> None:
        """Note one pass; `residual` is that before it.

        Changed is what has another state than after the pass before: where the law of friction
        becomes another one (no friction, stick springs, given capacities), `before` follows the
        new law already.
        """
        contacts, sliders = self.system.contacts, self.system.sliders
        n, m = len(contacts.node), len(sliders.node)
        old = before if self.last is None else self.last
        self.last = after
        turned = contacts.card[(old.side != after.side)[:n]].tolist()
        switched = sliders.card[(old.mode != after.mode)[:m]].tolist()
        changed = sorted({*turned, *switched})
        self.ledger.add(iterations=1)
        self.ledger.watch.note(residual)
        if len(self.records) == 0:
            self._keep(before)
        self._keep(after)
        self.records.append(
            {
                "iteration": len(self.records) + 1,
                "what": what,
                "residual": residual,
                "step": step,
                "n_changed": len(changed),
                "changed": [self.system.cards[i].name for i in changed[:NAMED]],
            }
        )

    def _keep(self, after: Response) -> None:
        """Keep what the supports answered, as long as there is room: nothing is computed for it."""
        n, m = len(self.system.contacts.node), len(self.system.sliders.node)
        self.room -= 4 * n + 4 * m
        if self.room >= 0:
            single = np.float32
            self.passes.append(
                Pass(
                    after.side[:n].astype(np.int8),
                    after.reaction[:n].astype(single),
                    after.mode[:m].astype(np.int8),
                    after.friction[:m].astype(single),
                    after.normal[:m].astype(single),
                )
            )

    def freeze(self, card: int) -> None:
        """Note that a support is held engaged from now on."""
        name = self.system.cards[card].name
        if name not in self.frozen:
            self.frozen.append(name)
            self.notes.append(
                f"SUPPORT {name} reversed more than 5 times and is held engaged; "
                "the certificate judges it by the true law"
            )
