"""What a run is at: set where the work is done, read by who shows it; nothing is printed here."""

import math
from dataclasses import dataclass


@dataclass(slots=True)
class Watch:
    """Where the work stands.

    doing : "reading line.inp", "solving", "writing line.json".
    case, part : what is solved now, and at which part of it: "certificate".
    done, total : cases.
    passes, residual : iterations of this case so far and what the last one started from [N].
    force : unit in which this is told, and newtons of one.
    """

    doing: str = ""
    case: str = ""
    part: str = ""
    done: int = 0
    total: int = 0
    passes: int = 0
    residual: float = math.nan
    force: tuple[str, float] = ("N", 1.0)

    def turn(self, doing: str) -> None:
        """Go on to other work."""
        self.doing, self.case, self.part = doing, "", ""
        self.passes, self.done, self.total = 0, 0, 0

    def begin(self, case: str) -> None:
        """Begin a case, or another part of the work that has a name."""
        self.case, self.part = case, ""
        self.passes, self.residual = 0, math.nan

    def note(self, residual: float) -> None:
        """Count one iteration that started from an out-of-balance force [N]."""
        self.passes += 1
        self.residual, self.part = residual, ""

    def __str__(self) -> str:
        text = " ".join(filter(None, (self.doing, self.case)))
        if self.case and self.total > 1:
            text += f" ({min(self.done + 1, self.total)} of {self.total})"
        if self.part:
            return f"{text}: {self.part}"
        if self.passes:
            text += f": iteration {self.passes}"
            if math.isfinite(self.residual):
                unit, one = self.force
                text += f", residual {self.residual / one:.1e} {unit}"
        return text
