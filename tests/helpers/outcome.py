"""What became of a scene: one word a scene, from the exact judge."""

import re
from dataclasses import dataclass

from exact import Judge, reported
from invent import invented
from manufacture import manufactured
from scenes import model

import trunnion
from trunnion.arrays import CaseResult
from trunnion.errors import DeckError, ModelError

RIGHT = 1e-9  # error of a displacement, relative to the largest
TRUST = 1.5  # decades by which the estimate of lost digits may be short of the true error
NUMBER = re.compile(r"[-+]?\d[\d.]*(e[-+]?\d+)?")
GOOD = ("certified", "given back", "another valid answer")


@dataclass
class Outcome:
    """`what` is the row of the table; a `fault` is what must never happen."""

    seed: int
    what: str
    fault: str = ""
    error: float = 0.0
    digits: float = 0.0


def solved(scene) -> CaseResult | str:
    """The case of a scene, or the refusal in the words of the program."""
    try:
        case = trunnion.solve(model(scene))["C"]
    except (ModelError, DeckError) as error:
        text = str(error)
        held = "no restraint holds it" in text
        return "the structure moves freely" if held else named(text.split("\n")[0])
    return case if case.converged else named(case.cause or "")


def named(cause: str) -> str:
    """A cause without its numbers and names; nothing is no cause."""
    if not cause:
        return ""
    if "no restraint holds it" in cause or "without bound" in cause:
        return "the pipe moves away: nothing holds it under this load"
    if "to hold, its capacity" in cause:
        return "friction is too small to hold the pipe"
    if cause.startswith("certificate:"):
        return f"not certified: {cause.split()[1]}"
    return NUMBER.sub("#", cause.split(";")[0])


def judged(scene, case: CaseResult, seed: int) -> Outcome:
    """Hold a certified case against exact arithmetic."""
    digits = case.digits[0] if case.digits else 0.0
    found = Judge(scene).judge(*reported(scene, case))
    if found.fault and RIGHT < found.error <= 10.0 ** (TRUST - digits):
        return Outcome(seed, "certified, fewer digits than 9 and said so", "", found.error, digits)
    if found.fault:
        return Outcome(seed, "WRONG", found.fault, found.error, digits)
    what = "certified" if found.determined else "certified, a motion left open and said so"
    return Outcome(seed, what, "", found.error, digits)


def of_invented(seed: int) -> Outcome:
    """The end of a random scene: certified and right, or refused by name."""
    scene = invented(seed)
    case = solved(scene)
    if isinstance(case, str):
        return Outcome(seed, f"refused: {case}", "" if case else "refused without a cause")
    return judged(scene, case, seed)


def of_manufactured(seed: int) -> Outcome:
    """The end of a scene whose answer was chosen."""
    made = manufactured(seed)
    case = solved(made.scene)
    if isinstance(case, str):
        return Outcome(seed, f"refused: {case}", "" if case else "refused without a cause")
    judge = Judge(made.scene)
    u, _ = reported(made.scene, case)
    away = judge.measure([a - b for a, b in zip(u, made.u, strict=True)])
    error = away / judge.measure(made.u)
    digits = case.digits[0] if case.digits else 0.0
    if error <= RIGHT:
        return Outcome(seed, "given back", "", error, digits)
    found = judged(made.scene, case, seed)
    if found.what.startswith("certified") and any(s.mu for s in made.scene.supports):
        if found.error <= RIGHT:
            # friction: the law may hold elsewhere too; exact arithmetic says that it does
            return Outcome(seed, "another valid answer", "", found.error, digits)
        return found
    if found.fault or error <= 10.0 ** (TRUST - digits):
        return found
    return Outcome(seed, "WRONG", f"not the chosen displacements: {error:.2g}", error, digits)
