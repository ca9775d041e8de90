"""Random scenes against the exact solution: 60-digit ball arithmetic, with formulas of its own.

Where `test_stress` holds answers against the laws, the judge here goes on to the exact solution
with the reported contact states, so that a displacement is known to be right, not only lawful.
"""

import pytest
from ballarithmetic import Judge, committed, reported
from invent import invented
from plainscenes import model

import trunnion
from trunnion.errors import ModelError

CHUNK = 60
RIGHT = 1e-9  # error of a displacement, relative to the largest
TRUST = 2.5  # decades by which the estimate of lost digits may fall short of the true error


def fault(seed: int) -> str | None:
    """What is wrong with the end of a scene; the empty text is a refusal with a cause."""
    scene = invented(seed)
    try:
        case = trunnion.solve(model(scene))["C"]
    except ModelError as error:
        return "" if "no restraint holds it" in str(error) else str(error)
    if not case.converged:
        return "" if case.cause else "refused without a cause"
    judge = Judge(scene)
    judge.datum = committed(case)
    if judge.datum and not any("sub-steps" in text for text in case.warnings):
        return "a datum from nowhere"
    found = judge.judge(*reported(scene, case))
    assert case.digits is not None
    if RIGHT < found.error <= 10.0 ** (TRUST - case.digits[0]):
        return None  # fewer digits than nine, and said so
    return found.fault


@pytest.mark.parametrize("first", range(0, 600, CHUNK))
def test_a_certified_answer_is_the_exact_one(first):
    seeds = range(first, first + CHUNK)
    ends = {seed: fault(seed) for seed in seeds}
    wrong = {seed: text for seed, text in ends.items() if text}
    assert not wrong, wrong
    assert sum(text is None for text in ends.values()) >= 0.7 * CHUNK
