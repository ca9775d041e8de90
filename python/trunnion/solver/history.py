"""The convergence story of one case, an entry an iteration."""

import numpy as np

from trunnion.arrays import System
from trunnion.solver.ledger import Ledger
from trunnion.solver.structure import Response

NAMED = 12  # supports named in one entry; the rest are counted


class History:
    """Collects iterations: which supports changed state, residual and step length."""

    def __init__(self, system: System, ledger: Ledger) -> None:
        self.system, self.ledger = system, ledger
        self.records: list[dict[str, object]] = []
        self.reversals = np.zeros(len(system.cards), np.int32)

    def add(
        self, what: str, residual: float, step: float, before: Response, after: Response
    ) -> None:
        """Note one pass; `residual` is that before it."""
        contacts, sliders = self.system.contacts, self.system.sliders
        n, m = len(contacts.node), len(sliders.node)
        turned = contacts.card[(before.side != after.side)[:n]]
        switched = sliders.card[(before.mode != after.mode)[:m]]
        changed = np.unique(np.concatenate((turned, switched)))
        self.reversals[changed] += 1
        self.ledger.add(iterations=1)
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
