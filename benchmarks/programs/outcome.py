"""What every program gives back."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray


@dataclass(slots=True, eq=False, repr=False)
class Outcome:
    """One run: seconds in the solver, displacements (n, 6) [m, rad] or why there are none.

    A program that says that it has failed has a `failure`; whether an answer is right is not its
    own to say.  `facts` are further numbers for the tables.
    """

    seconds: float
    u: NDArray[np.float64] | None
    failure: str | None = None
    facts: dict[str, float | str] = field(default_factory=dict)
