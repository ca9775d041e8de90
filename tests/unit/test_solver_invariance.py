"""What must not change an answer: turning, moving, labels, order, directions and units.

Random frames with friction, gaps, guides, bends and heat; every number is compared within 1e-9
of the largest of its kind, and the states of all supports are the same.
"""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from changed import labels, moved, numbers, relabelled, reversed_pipes, rotation, shuffled, turned
from changed import worst as difference
from frames import frame

import trunnion
from trunnion.deck.reader import read_text
from trunnion.model import Model, Units

SEEDS = (4, 9, 20, 61, 75, 109)  # both friction laws, flat and in space, one to 14 sliders
WITHIN = 1e-9
TURNS = ((0, 1, 0), (1, 0, 0), (1, 2, -0.5), (-0.3, 0.1, 1))


@cache
def base(seed: int) -> Model:
    """Return a frame without rotational supports: turned ones have no word."""
    model = frame(seed)

    def words(support):
        return tuple(d for d in support.directions if d.word != "RX")

    return replace(model, supports=[replace(s, directions=words(s)) for s in model.supports])


@cache
def free(seed: int) -> Model:
    """Return a frame that knows no vertical: no weight, guides or hangers; loads at nodes."""
    model = base(seed)
    kept = [
        replace(s, directions=tuple(d for d in s.directions if d.word != "GUIDE"))
        for s in model.supports
        if s.kind != "hanger"
    ]
    loaded = replace(
        model,
        supports=[s for s in kept if s.directions or s.kind != "support"],
        forces=list(model.forces),
        cases=[],
        carried=None,
    )
    for label in labels(model):
        loaded.force(label, "F1", FY=-4000.0)
    loaded.case("COLD", "F1")
    loaded.case("HOT", "F1 + T1", FROM="COLD")
    return loaded


@cache
def answers(model: int, seed: int):
    results = trunnion.solve((base, free)[model](seed))
    return {name: numbers(case) for name, case in results.cases.items()}


def compare(changed: Model, seed: int, kind: int = 0, q=None, shift=0.0):
    results = trunnion.solve(changed)
    for name, want in answers(kind, seed).items():
        assert difference(want, numbers(results[name], q, shift)) <= WITHIN, (seed, name)


@pytest.mark.parametrize("axis", TURNS)
@pytest.mark.parametrize("seed", SEEDS)
def test_turning_in_space(seed, axis):
    q = rotation(axis, 10.0 + 50.0 * seed)
    compare(turned(free(seed), q), seed, 1, q)


@pytest.mark.parametrize("angle", [37.0, 90.0, 201.3])
@pytest.mark.parametrize("seed", SEEDS)
def test_turning_in_plan_with_guides_and_weight(seed, angle):
    q = rotation((0, 1, 0), angle)
    compare(turned(base(seed), q), seed, 0, q)


@pytest.mark.parametrize("by", [(3.0, -2.0, 0.1), (1e5, 1e5, -1e5)])
@pytest.mark.parametrize("seed", SEEDS)
def test_moving(seed, by):
    compare(moved(base(seed), by), seed, 0, None, by)


@pytest.mark.parametrize("seed", SEEDS)
def test_other_labels(seed):
    names = labels(base(seed))
    order = np.random.default_rng(seed).permutation(len(names))
    new = {label: f"N{i}X" for label, i in zip(names, order, strict=True)}
    compare(relabelled(base(seed), new), seed)


@pytest.mark.parametrize("seed", SEEDS)
def test_cards_in_another_order(seed):
    compare(shuffled(base(seed), np.random.default_rng(seed)), seed)


@pytest.mark.parametrize("which", ["all", "some"])
@pytest.mark.parametrize("seed", SEEDS)
def test_pipes_and_bends_written_from_the_other_end(seed, which):
    rng = np.random.default_rng(seed)
    turn = [which == "all" or bool(rng.integers(2)) for _ in base(seed).pipes]
    compare(reversed_pipes(base(seed), turn), seed)


@pytest.mark.parametrize(
    "units",
    [Units("mm", "kN", "bar", "C"), Units("in", "lbf", "psi", "F"), Units("cm", "kgf", "MPa", "K")],
    ids=lambda u: u.length,
)
@pytest.mark.parametrize("seed", SEEDS)
def test_other_units(seed, units):
    text = replace(base(seed), units=units).deck()
    assert f"UNITS    {units.length}" in text
    compare(read_text(text, "units.inp"), seed)


@pytest.mark.parametrize("seed", SEEDS)
def test_up_may_be_z(seed):
    q = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
    model = turned(base(seed), q)
    compare(replace(model, settings=replace(model.settings, up="Z")), seed, 0, q)
