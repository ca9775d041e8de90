"""Many linear cases of few load sets: sums of answers, certified as sums.

Random frames on two-way supports: bends, rigid bodies, hangers, anchors that move, skew pipes.
"""

from dataclasses import replace

import numpy as np
import pytest
from frames import frame

import trunnion
from trunnion.certificate import certify
from trunnion.certificate.scales import measure, measure_each
from trunnion.certificate.sums import certify_sums
from trunnion.deck.reader import read_text
from trunnion.model import Case, Term
from trunnion.solver import superpose as module

SEEDS = range(40)
SAME = 1e-12  # answers are refined to 1e-13 of themselves, and some parts are ten times their sum
HEAD = """\
MATERIAL S E=203e9 NU=0.3 ALPHA=12e-6 DENSITY=7850
SECTION  P OD=0.2191 WALL=0.00818
OPERATE  T1=120 T2=120.0000001 P1=1e6 TREF=20
PIPE 10 20 DX=5
PIPE 20 30 DX=5
PIPE 30 40 DZ=4
ANCHOR 10
SUPPORT 40 Y X
"""


def linear_frame(seed, n_case=9):
    """A frame whose supports hold both ways, and cases of random factors."""
    model = frame(seed)
    rng = np.random.default_rng(seed)
    labels = [s.node for s in model.supports if s.kind == "support"]
    model.supports = [s for s in model.supports if s.kind != "support"]
    for label in dict.fromkeys(labels):
        words = (("Y",), ("X", "Z"), ("Y", "RX"))[rng.integers(3)]
        model.support(label, *((word, {"MU": 0.0} if len(word) == 1 else {}) for word in words))
    names = ["W", "P1", "T1", "F1"]
    if any(d.set == "1" for d in model.displacements):
        names.append("D1")
    model.cases = [
        Case(f"C{i}", tuple(Term(float(rng.normal()), name) for name in rng.permutation(names)[:3]))
        for i in range(max(n_case, 2 * len(names)))
    ]
    return model


def is_sum(case):
    return case.certificate.items[0].name == "sum"


@pytest.mark.parametrize("seed", SEEDS)
def test_a_sum_is_the_answer(seed):
    model = linear_frame(seed)
    together = trunnion.solve(model)
    for case in model.cases:
        alone = trunnion.solve(replace(model, cases=[case]))[case.name]
        found = together[case.name]
        assert not is_sum(alone)
        for name in ("u", "end_force", "reaction"):
            a, b = getattr(alone.state, name), getattr(found.state, name)
            assert np.abs(a - b).max() <= SAME * np.abs(a).max(), (seed, case.name, name)
        low = (found.state.u - alone.state.u) + (found.state.u_low - alone.state.u_low)
        assert np.abs(low).max() <= SAME * np.abs(alone.state.u).max()
        for name in ("dist", "strain", "curvature", "nodal", "base", "preload", "pressure"):
            assert np.array_equal(getattr(alone.loads, name), getattr(found.loads, name))
        assert np.allclose(alone.penalty_u, found.penalty_u, rtol=1e-6, atol=1e-12)
        assert np.allclose(alone.penalty_r, found.penalty_r, rtol=1e-6, atol=1e-5)
        assert alone.penalty_effect == pytest.approx(found.penalty_effect, rel=1e-6, abs=1e-12)
        # a sum knows a bound of its last correction, an answer stops at one below 1e-13, which may
        # be three digits above the rounding that its own sets stopped at
        assert 12.0 <= found.digits[0] <= alone.digits[0] + 3.0
        assert alone.warnings == found.warnings
    assert any(is_sum(case) for case in together.cases.values())


@pytest.mark.parametrize("seed", SEEDS)
def test_the_certificate_of_a_sum_is_never_less_than_that_of_its_numbers(seed):
    sums = [case for case in trunnion.solve(linear_frame(seed)).cases.values() if is_sum(case)]
    assert sums
    for case in sums:
        bound = {item.name: item.value for item in case.certificate.items}
        own = certify(
            case.system,
            case.loads,
            case.state,
            correction_u=bound["correction_u"],
            correction_r=bound["correction_r"],
        )
        for item in own.items:
            assert item.value <= bound[item.name], (seed, case.name, item.name)
        assert case.certificate.worst <= 1e-11


def test_most_cases_of_random_frames_are_sums():
    found = [case for seed in SEEDS for case in trunnion.solve(linear_frame(seed)).cases.values()]
    assert all(case.converged for case in found)
    assert sum(map(is_sum, found)) >= 0.85 * len(found)


def test_sums_take_the_work_of_their_sets():
    cases = "".join(f"CASE C{i} = {1 + 0.1 * i}*W + {i}*T1\n" for i in range(30))
    few = trunnion.solve(read_text(HEAD + "CASE A = W\nCASE B = T1\n", "deck.inp")).work
    many = trunnion.solve(read_text(HEAD + cases, "deck.inp")).work
    assert many == few


def test_few_cases_are_not_sums():
    text = HEAD + "CASE A = W + T1\nCASE B = W\nCASE C = W + P1\n"
    assert not any(is_sum(c) for c in trunnion.solve(read_text(text, "deck.inp")).cases.values())


def test_sets_that_nearly_cancel_are_solved_by_themselves():
    text = HEAD + "".join(f"CASE C{i} = {i + 1}*T1 - {i + 1}*T2\n" for i in range(4))
    text += "".join(f"CASE E{i} = {i + 1}*T1 + {i + 1}*T2\n" for i in range(4))
    found = trunnion.solve(read_text(text, "deck.inp"))
    assert {name: is_sum(case) for name, case in found.cases.items()} == {
        **{f"C{i}": False for i in range(4)},
        **{f"E{i}": True for i in range(4)},
    }
    assert all(case.certificate.worst <= 1e-11 for case in found.cases.values())


def test_a_case_that_others_go_on_from_is_solved_by_itself():
    cases = "".join(f"CASE C{i} = {i + 1}*W + T1\n" for i in range(6))
    found = trunnion.solve(read_text(HEAD + cases + "CASE E = W FROM=C2\n", "deck.inp"))
    sums = {name for name, case in found.cases.items() if is_sum(case)}
    assert sums == {f"C{i}" for i in (0, 1, 3, 4, 5)}
    assert found["E"].converged


def test_a_session_that_kept_a_sum_can_still_go_on_from_it():
    cases = "".join(f"CASE C{i} = {i + 1}*W + T1\n" for i in range(6))
    session = trunnion.Session()
    first = session.solve(read_text(HEAD + cases, "deck.inp"))
    then = session.solve(read_text(HEAD + cases + "CASE E = W FROM=C2\n", "deck.inp"))
    assert is_sum(first["C2"])
    assert then["E"].converged
    assert {name: case.work["solve"] for name, case in then.cases.items() if name != "C2"} == {
        **{f"C{i}": 0 for i in (0, 1, 3, 4, 5)},
        "E": 0,
    }


@pytest.mark.parametrize("name", ["u", "end_force", "reaction"])
def test_a_number_that_is_not_the_sum_fails(name, monkeypatch):
    seen = []

    def tampered(system, loads, states, *rest):
        array = getattr(states[1], name)
        worst = np.unravel_index(np.abs(array).argmax(), array.shape)
        array[worst] *= 1.0 + 1e-6
        seen.append(certify_sums(system, loads, states, *rest))
        return seen[-1]

    monkeypatch.setattr(module, "certify_sums", tampered)
    cases = "".join(f"CASE C{i} = {i + 1}*W + T1\n" for i in range(6))
    found = trunnion.solve(read_text(HEAD + cases, "deck.inp"))
    assert [c.passed for c in seen[0]] == [True, False, True, True, True, True]
    assert [is_sum(case) for case in found.cases.values()] == [True, False, True, True, True, True]
    assert found["C1"].converged


def test_a_load_that_is_not_the_sum_fails(monkeypatch):
    """A load set that did not follow its factor would be certified by linearity alone."""
    passed = []

    def tampered(system, loads, *rest):
        loads = [replace(loads[0], dist=loads[0].dist * (1.0 + 1e-6)), *loads[1:]]
        found = certify_sums(system, loads, *rest)
        passed.extend(c.passed for c in found)
        return found

    monkeypatch.setattr(module, "certify_sums", tampered)
    cases = "".join(f"CASE C{i} = {i + 1}*W + T1\n" for i in range(6))
    trunnion.solve(read_text(HEAD + cases, "deck.inp"))
    assert passed == [False, True, True, True, True, True]


def test_many_cases_of_a_model_without_elements_are_solved_one_by_one():
    deck = "DEFAULT MU=0\nNODE 10 X=0 Y=0 Z=0\nANCHOR 10\nFORCE 10 F1 FX=10\n"
    deck += "".join(f"CASE C{i} = {i + 1}*F1\n" for i in range(4))
    found = trunnion.solve(read_text(deck, "deck.inp"))
    assert all(case.converged for case in found.cases.values())


def test_what_cases_share_cannot_be_written_to():
    found = trunnion.solve(read_text(HEAD + "CASE A = T1\nCASE B = W\n", "deck.inp"))
    with pytest.raises(ValueError, match="read-only"):
        found["A"].loads.nodal[0] += 1.0


@pytest.mark.parametrize("seed", SEEDS[:8])
def test_sizes_of_many_answers_are_those_of_each(seed):
    model = linear_frame(seed)
    results = trunnion.solve(replace(model, cases=model.cases[:5]))
    cases = [case for case in results.cases.values() if not len(case.state.friction)]
    assert cases
    found = measure_each(cases[0].system, [c.loads for c in cases], [c.state for c in cases])
    assert list(found) == [measure(c.system, c.loads, c.state) for c in cases]
