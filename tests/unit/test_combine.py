"""Combinations of results, component by component."""

import dataclasses

import numpy as np
import pytest

from trunnion.algebra import evaluate, is_linear, parents
from trunnion.arrays import CaseResult, Certificate, Contacts, Item, Loads, Sliders, State, System
from trunnion.combine import combine
from trunnion.model import Comb

I4 = np.int32


@pytest.fixture(scope="module")
def system():
    contacts = Contacts(
        np.zeros(2, I4), np.full(2, -1, I4), np.zeros(2, I4), np.zeros(2, bool), np.ones(2, I4),
        np.zeros((2, 2, 3)), np.zeros((2, 2)), np.full(2, 1e12), np.ones(2, bool),
        np.ones(2, bool), ("X", "Y"),
    )  # fmt: skip
    one = np.zeros(1, I4)
    sliders = Sliders(
        one, one - 1, one, np.zeros((1, 2, 3)), np.ones(1), np.ones(1), np.array([0, 1], I4), one
    )
    return System(
        ("10", "20", "30"), {}, np.zeros((3, 3)), np.array([[0, 1], [1, 2]], I4), np.zeros(2, I4),
        np.zeros((2, 3, 3)), np.ones(2), np.zeros(2), np.zeros(2), np.ones((2, 4)), np.ones(2),
        np.zeros((2, 6)), np.ones(2), np.ones(2), (), contacts, sliders, ("card",),
        np.array([0.0, 1, 0]), np.zeros(2, I4), {},
    )  # fmt: skip


def case(system, name, seed, worst=1e-12):
    rng = np.random.default_rng(seed)
    u = rng.normal(size=(3, 6))
    state = State(
        u, 1e-17 * rng.normal(size=(3, 6)), rng.normal(size=(2, 2, 6)), np.ones(2, I4),
        rng.normal(size=(2, 3)), rng.normal(size=(1, 3)), np.ones(1, I4), np.ones(1),
        np.ones((1, 3)), np.ones((1, 3)), np.ones((1, 3)),
    )  # fmt: skip
    loads = Loads(
        rng.normal(size=(2, 3)), rng.normal(size=2), rng.normal(size=2), rng.normal(size=(3, 6)),
        rng.normal(size=(1, 6)), rng.normal(size=1), rng.normal(size=2), 0.5,
    )  # fmt: skip
    certificate = Certificate(worst <= 1e-9, worst, "slide at x", (Item("slide", worst, "x"),))
    return CaseResult(
        name, "case", name, system, loads, state, True, certificate=certificate,
        penalty_u=rng.normal(size=(3, 6)), penalty_effect={"u": 100 * worst, "R": 0.1},
    )  # fmt: skip


OPE, SUS = ("case", "OPE"), ("case", "SUS")


def test_difference_is_componentwise(system):
    ope, sus = case(system, "OPE", 1), case(system, "SUS", 2)
    exp = combine(Comb("EXP", ("-", OPE, SUS), "OPE - SUS"), {"OPE": ope, "SUS": sus})
    for name in ("end_force", "reaction", "friction"):
        want = getattr(ope.state, name) - getattr(sus.state, name)
        assert np.array_equal(getattr(exp.state, name), want)
    for name in ("dist", "strain", "curvature", "nodal", "base", "preload", "pressure"):
        want = getattr(ope.loads, name) - getattr(sus.loads, name)
        assert np.array_equal(getattr(exp.loads, name), want)
    assert np.array_equal(exp.penalty_u, ope.penalty_u - sus.penalty_u)
    assert (exp.kind, exp.text, exp.converged, exp.linear) == ("comb", "OPE - SUS", True, True)


def test_displacements_keep_their_double_double(system):
    ope, sus = case(system, "OPE", 1), case(system, "SUS", 2)
    sus.state.u[:] = ope.state.u  # what is left are the low parts alone
    exp = combine(Comb("EXP", ("-", OPE, SUS), ""), {"OPE": ope, "SUS": sus})
    want = ope.state.u_low - sus.state.u_low
    assert np.allclose(exp.state.u + exp.state.u_low, want, rtol=1e-12, atol=0)


def test_every_operation(system):
    ope, sus = case(system, "OPE", 1), case(system, "SUS", 2)
    expression = ("+", ("neg", OPE), ("*", 3.0, ("abs", ("-", SUS, ("*", 0.5, OPE)))))
    comb = combine(Comb("C", expression, ""), {"OPE": ope, "SUS": sus})
    a, b = ope.state.reaction, sus.state.reaction
    assert np.allclose(comb.state.reaction, -a + 3 * abs(b - 0.5 * a), rtol=1e-15)
    a, b = ope.state.u, sus.state.u
    assert np.allclose(comb.state.u, -a + 3 * abs(b - 0.5 * a), rtol=1e-14)
    assert not comb.linear
    assert comb.penalty_u is None


def test_what_a_sum_does_not_have_is_neutral(system):
    state = combine(Comb("C", ("*", 2.0, OPE), ""), {"OPE": case(system, "OPE", 1)}).state
    for name in ("side", "mode", "normal", "slide", "datum", "datum_end"):
        assert not getattr(state, name).any()
        assert getattr(state, name).shape == getattr(case(system, "A", 3).state, name).shape


def test_certificate_is_the_parents_worst(system):
    results = {"OPE": case(system, "OPE", 1, 3e-11), "SUS": case(system, "SUS", 2, 2e-12)}
    comb = combine(Comb("C", ("+", SUS, OPE), ""), results)
    certificate = comb.certificate
    assert certificate.inherited
    assert certificate.passed
    assert certificate.worst == 3e-11
    assert certificate.where == "OPE: slide at x"
    assert certificate.items == (Item("slide", 3e-11, "OPE: x"),)
    assert comb.penalty_effect == {"u": 3e-9, "R": 0.1}


def test_parent_without_certificate_fails(system):
    results = {"OPE": case(system, "OPE", 1)}
    results["OPE"].certificate = None
    certificate = combine(Comb("C", ("neg", OPE), ""), results).certificate
    assert not certificate.passed
    assert certificate.where == "OPE: no certificate"


def test_parent_without_numbers_is_named(system):
    sus = CaseResult("SUS", "case", "W", system, None, None, False, cause="mechanism")
    comb = combine(Comb("C", ("-", OPE, SUS), ""), {"OPE": case(system, "OPE", 1), "SUS": sus})
    assert comb.state is None
    assert not comb.converged
    assert comb.cause == "no numbers in SUS"


def test_combination_of_combinations(system):
    results = {"OPE": case(system, "OPE", 1), "SUS": case(system, "SUS", 2)}
    results["EXP"] = combine(Comb("EXP", ("-", OPE, SUS), ""), results)
    back = combine(Comb("B", ("+", ("case", "EXP"), SUS), ""), results)
    assert np.allclose(back.state.u, results["OPE"].state.u, rtol=1e-15)
    results["MAG"] = combine(Comb("MAG", ("abs", OPE), ""), results)
    assert not combine(Comb("B", ("+", ("case", "MAG"), SUS), ""), results).linear


def test_cases_of_other_moduli_have_no_common_interior(system):
    hot = dataclasses.replace(system, rigidity=0.9 * system.rigidity)
    results = {"OPE": case(hot, "OPE", 1), "SUS": case(system, "SUS", 2)}
    comb = combine(Comb("C", ("-", OPE, SUS), ""), results)
    assert not comb.linear
    assert comb.converged


def test_parents_are_named_once():
    expression = ("+", ("abs", OPE), ("-", SUS, OPE))
    assert parents(expression) == ["OPE", "SUS"]
    assert not is_linear(expression)


def test_unknown_word_is_an_error():
    with pytest.raises(KeyError, match="mean"):
        evaluate(("mean", OPE), {"OPE": None})
