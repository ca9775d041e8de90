"""Combinations of results, component by component."""

import dataclasses
from functools import partial

import numpy as np
import pytest

from trunnion.arrays import (
    CaseResult,
    Certificate,
    Contacts,
    Gathered,
    Item,
    Loads,
    Sliders,
    State,
    System,
    no_contacts,
    no_sliders,
)
from trunnion.model import Comb
from trunnion.results.combine import combine, evaluate, is_linear, parents
from trunnion.results.supports import gathered

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
        rigid=partial(np.copy, rng.normal(size=(3, 6))),
        penalty_effect={"u": 100 * worst, "R": 0.1},
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


def sizes(system, *numbers):
    """Cases whose every number is one of `numbers`."""
    found = {}
    for i, x in enumerate(numbers):
        found[f"C{i}"] = case(system, f"C{i}", 7)
        state = found[f"C{i}"].state
        state.u[:], state.u_low[:] = x, 0.0
        for array in (state.end_force, state.reaction, state.friction):
            array[:] = x
    return found


@pytest.mark.parametrize(
    ("word", "numbers", "expected"),
    [
        ("srss", (3.0, -4.0), 5.0),
        ("srss", (2.0, 3.0, 6.0), 7.0),
        ("srss", (-1e200, 0.0), 1e200),
        ("max", (3.0, -4.0), 4.0),
        ("min", (3.0, -4.0), 3.0),
        ("signmax", (3.0, -4.0), -4.0),
        ("signmax", (4.0, -4.0), 4.0),
        ("signmax", (-4.0, 4.0), 4.0),
        ("scalar", (3.0, -4.0, 2.0), 1.0),
    ],
)
def test_words_of_many_operands(system, word, numbers, expected):
    results = sizes(system, *numbers)
    comb = combine(Comb("C", (word, *(("case", name) for name in results)), ""), results)
    for array in (comb.state.u, comb.state.end_force, comb.state.reaction):
        assert np.allclose(array, expected, rtol=1e-15, atol=0)
    assert comb.linear == (word == "scalar")


@pytest.mark.parametrize("seed", range(5))
def test_algebra_of_random_results(system, seed):
    results = {name: case(system, name, 10 * seed + i) for i, name in enumerate("ABC")}
    a, b, c = (("case", name) for name in "ABC")

    def row(*expression):
        state = combine(Comb("X", expression, ""), results).state
        return [state.u, state.u_low, state.end_force, state.reaction, state.friction]

    def same(left, right, rtol=0.0):
        return all(np.allclose(x, y, rtol=rtol, atol=0) for x, y in zip(left, right, strict=True))

    assert not any(array.any() for array in row("-", a, a))
    assert same(row("srss", a)[:1], row("abs", a)[:1])
    assert same(row("srss", a)[2:], row("abs", a)[2:])
    for word in ("max", "min", "signmax"):
        assert same(row(word, a, b, c), row(word, c, a, b))
    assert same(row("srss", a, b, c)[::2], row("srss", c, b, a)[::2], 1e-15)
    twice = row("*", 2.0, ("-", a, b))
    assert same(twice[2:], row("-", ("*", 2.0, a), ("*", 2.0, b))[2:], 1e-14)


def test_card_force_of_a_size_is_the_size_of_the_card_force(system):
    ope = case(system, "OPE", 1)
    card = gathered(ope).card_force
    assert np.array_equal(card[0, :3], ope.state.reaction.sum(axis=0) + ope.state.friction[0])
    comb = combine(Comb("C", ("abs", OPE), ""), {"OPE": ope})
    assert np.array_equal(gathered(comb).card_force, np.abs(card))
    assert np.array_equal(gathered(comb).card_load, np.abs(card))


def test_a_load_on_a_restraint_opposes_the_pipe_unless_it_is_a_size(system):
    results = {"OPE": case(system, "OPE", 1), "EQ": case(system, "EQ", 2)}
    mixed = ("+", OPE, ("srss", ("case", "EQ")))
    found = gathered(combine(Comb("C", mixed, ""), results))
    assert np.array_equal(found.card_load, -found.card_force)
    size = np.abs(gathered(results["EQ"]).card_force)
    assert found.card_force == pytest.approx(gathered(results["OPE"]).card_force + size)
    lone = gathered(combine(Comb("C", ("srss", OPE, ("case", "EQ")), ""), results))
    assert np.array_equal(lone.card_load, lone.card_force)


def test_cases_on_other_contacts_combine_by_card(system):
    locked = dataclasses.replace(system, contacts=no_contacts(), sliders=no_sliders())
    ope, eqx = case(system, "OPE", 1), case(system, "EQX", 2)
    eqx.system = locked
    eqx.state = dataclasses.replace(
        eqx.state, side=np.zeros(0, I4), reaction=np.zeros((0, 3)), friction=np.zeros((0, 3))
    )
    eqx.gathered = Gathered(np.full((1, 6), 5.0), np.full((1, 3), 5.0), np.zeros((1, 3)))
    comb = combine(Comb("C", ("+", OPE, ("case", "EQX")), ""), {"OPE": ope, "EQX": eqx})
    assert np.array_equal(gathered(comb).card_force, gathered(ope).card_force + 5.0)
    assert comb.linear
    assert not len(comb.system.contacts.k)


def test_a_result_without_loads_adds_none(system):
    ope, shock = case(system, "OPE", 1), case(system, "RSX", 2)
    shock.loads, shock.linear = None, False
    comb = combine(Comb("C", ("+", OPE, ("case", "RSX")), ""), {"OPE": ope, "RSX": shock})
    assert np.array_equal(comb.loads.pressure, ope.loads.pressure)
    assert not comb.linear
