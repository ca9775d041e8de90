"""The convergence story of one case, an entry an iteration."""

from trunnion.arrays import System
from trunnion.solver.ledger import Ledger
from trunnion.solver.quantities import Response

NAMED = 12  # supports named in one entry; the rest are counted


class History:
    """Collects iterations: which supports changed state, residual and step length."""

    def __init__(self, system: System, ledger: Ledger) -> None:
        self.system, self.ledger = system, ledger
        self.records: list[dict[str, object]] = []
        self.jumps = 0  # Aitken jumps of the status iteration
        self.frozen: list[str] = []
        self.notes: list[str] = []  # warnings about how the case was solved

    def add(
        self, what: str, residual: float, step: float, before: Response, after: Response
    ) -> None:
        """Note one pass; `residual` is that before it."""
        contacts, sliders = self.system.contacts, self.system.sliders
        n, m = len(contacts.node), len(sliders.node)
        turned = contacts.card[(before.side != after.side)[:n]].tolist()
        switched = sliders.card[(before.mode != after.mode)[:m]].tolist()
        changed = sorted({*turned, *switched})
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

    def freeze(self, card: int) -> None:
        """Note that a support is held engaged from now on."""
        name = self.system.cards[card].name
        if name not in self.frozen:
            self.frozen.append(name)
            self.notes.append(
                f"SUPPORT {name} reversed more than 5 times and is held engaged; "
                "the certificate judges it by the true law"
            )
