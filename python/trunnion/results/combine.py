"""Combinations of results: COMB expressions evaluated component by component.

A combination has no state of its own: where its parents' contacts are open or slide means nothing
in a sum, so sides, modes, normal forces and slides are left at zero.  Its certificate is its
parents' worst.  Parents may stand on different contacts (a locked case beside an operating one):
what they share are nodes, elements and support cards.
"""

from collections.abc import Callable, Mapping
from dataclasses import fields, replace
from functools import partial
from typing import Any

import numpy as np

from trunnion.arrays import (
    F8,
    CaseResult,
    Certificate,
    Gathered,
    Item,
    Loads,
    State,
    System,
    no_contacts,
    no_loads,
    no_sliders,
)
from trunnion.certificate.deformation import two_difference
from trunnion.frozen import frozen
from trunnion.model import Comb, Expression
from trunnion.results.balance import local_end_forces, section_forces
from trunnion.results.supports import gathered

_LOADS = [field.name for field in fields(Loads) if field.name != "mux"]
_CARDS = ("card_force", "card_normal", "card_friction")
_LINEAR = frozenset(("case", "+", "-", "*", "neg", "scalar"))


@frozen(eq=False)
class Numbers:
    """All numbers of one result in a row, as unevaluated sums high + low."""

    high: F8
    low: F8


def _sum(*terms: Numbers) -> Numbers:
    total = terms[0]
    for b in terms[1:]:
        high, error = two_difference(total.high, -b.high)
        total = Numbers(high, error + total.low + b.low)
    return total


def _times(n: float, a: Numbers) -> Numbers:
    return Numbers(n * a.high, n * a.low)


def _size(a: Numbers) -> Numbers:
    sign = np.where(np.signbit(a.high + a.low), -1.0, 1.0)
    return Numbers(sign * a.high, sign * a.low)


def _root_of_squares(*terms: Numbers) -> Numbers:
    sizes = [_size(a) for a in terms]
    largest = np.maximum.reduce([a.high for a in sizes])
    scale = np.where(largest > 0.0, largest, 1.0)
    parts = [a.high / scale for a in sizes]
    root = np.sqrt(np.sum([part**2 for part in parts], axis=0))
    low = np.sum([part * a.low for part, a in zip(parts, sizes, strict=True)], axis=0)
    return Numbers(root * scale, low / np.where(root > 0.0, root, 1.0))


def _larger(a: Numbers, b: Numbers) -> Numbers:
    """Take the larger of each pair."""
    first = OPERATIONS["-"](a, b)
    takes = first.high + first.low >= 0.0
    return Numbers(np.where(takes, a.high, b.high), np.where(takes, a.low, b.low))


def _largest_size(*terms: Numbers) -> Numbers:
    found = _size(terms[0])
    for b in terms[1:]:
        found = _larger(found, _size(b))
    return found


def _smallest_size(*terms: Numbers) -> Numbers:
    found = _times(-1.0, _size(terms[0]))
    for b in terms[1:]:
        found = _larger(found, _times(-1.0, _size(b)))
    return _times(-1.0, found)


def _signed_largest(*terms: Numbers) -> Numbers:
    """Take the term of largest size with its sign; of two that differ in sign only, the plus."""
    highest, lowest = terms[0], _times(-1.0, terms[0])
    for b in terms[1:]:
        highest, lowest = _larger(highest, b), _larger(lowest, _times(-1.0, b))
    difference = _sum(highest, _times(-1.0, lowest))
    up = difference.high + difference.low >= 0.0
    return Numbers(np.where(up, highest.high, -lowest.high), np.where(up, highest.low, -lowest.low))


# What each word of an expression does with its evaluated operands.
OPERATIONS: dict[str, Callable[..., Numbers]] = {
    "+": _sum,
    "-": lambda a, b: _sum(a, _times(-1.0, b)),
    "*": _times,
    "neg": lambda a: _times(-1.0, a),
    "abs": _size,
    "srss": _root_of_squares,
    "max": _largest_size,
    "min": _smallest_size,
    "signmax": _signed_largest,
    "scalar": _sum,
}


def evaluate(expression: Expression, numbers: Mapping[str, Numbers]) -> Numbers:
    """Evaluate an expression of case names on the numbers of those cases."""
    word, *parts = expression
    if word == "case":
        return numbers[str(parts[0])]
    operands = [evaluate(p, numbers) if isinstance(p, tuple) else p for p in parts]
    return OPERATIONS[str(word)](*operands)


def parents(expression: Expression) -> list[str]:
    """Names of the cases in an expression, each once, in order."""
    if expression[0] == "case":
        return [str(expression[1])]
    inner = [name for part in expression[1:] if isinstance(part, tuple) for name in parents(part)]
    return list(dict.fromkeys(inner))


def is_linear(expression: Expression) -> bool:
    """Whether the expression is a weighted sum: then it has interior points as a case has."""
    if expression[0] == "case":
        return True
    inner = all(is_linear(part) for part in expression[1:] if isinstance(part, tuple))
    return expression[0] in _LINEAR and inner


def combine(comb: Comb, results: Mapping[str, CaseResult]) -> CaseResult:
    """Combine solved cases (and earlier combinations) by the expression of `comb`.

    Without numbers in a parent there are none here either, and `cause` names the parent.
    """
    cases = [results[name] for name in parents(comb.expression)]
    system, touching = _common(cases)
    answer = CaseResult(comb.name, "comb", comb.text, system, None, None, converged=False)
    elastic = all(case.system.rigidity is system.rigidity for case in cases)  # hot: its own E
    answer.linear = elastic and all(case.linear for case in cases) and is_linear(comb.expression)
    without = [case.name for case in cases if case.state is None]
    if without:
        answer.cause = f"no numbers in {', '.join(without)}"
        return answer
    answer.converged = all(case.converged for case in cases)
    answer.certificate = inherit(cases)
    rows = {case.name: _numbers(case, answer.linear, touching) for case in cases}
    shapes = {name: array.shape for name, array in rows[cases[0].name].items()}
    row = evaluate(comb.expression, {case.name: _in_a_row(rows[case.name], case) for case in cases})
    _unfold(answer, _cut(row, shapes))
    if answer.linear:
        answer.rigid = partial(_rigid, comb.expression, tuple(cases))
        if touching:
            answer.penalty_r = _corrections(comb.expression, {c.name: c.penalty_r for c in cases})
    answer.penalty_effect = {
        key: max(case.penalty_effect.get(key, 0.0) for case in cases)
        for key in dict.fromkeys(key for case in cases for key in case.penalty_effect)
    }
    answer.frozen = tuple(dict.fromkeys(text for case in cases for text in case.frozen))
    return answer


def inherit(cases: list[CaseResult]) -> Certificate:
    """Worst of every item among the parents' certificates; a parent without one fails it."""
    found: dict[str, Item] = {}
    passed, worst, where = True, -1.0, ""
    for case in cases:
        certificate = case.certificate
        if certificate is None:
            certificate = Certificate(False, np.inf, "no certificate", ())
        passed &= certificate.passed
        if certificate.worst > worst:
            worst, where = certificate.worst, f"{case.name}: {certificate.where}"
        for item in certificate.items:
            if item.name not in found or item.value > found[item.name].value:
                text = f"{case.name}: {item.where}" if item.where else case.name
                found[item.name] = Item(item.name, item.value, text)
    return Certificate(passed, worst, where, tuple(found.values()), inherited=True)


def _common(cases: list[CaseResult]) -> tuple[System, bool]:
    """Give the system of a combination, and whether its parents stand on the same contacts."""
    system = cases[0].system
    if all(case.system.contacts is system.contacts for case in cases):
        return system, True
    free = replace(system, contacts=no_contacts(), sliders=no_sliders(), snubbers=no_contacts())
    return free, False


def _numbers(case: CaseResult, linear: bool, touching: bool) -> dict[str, F8]:
    """Name all numbers of one case that a combination has; the displacements come first."""
    state, loads = case.state, case.loads or no_loads(case.system)
    assert state is not None
    cards = gathered(case)
    found = {"u": state.u, "end_force": state.end_force}
    found |= {name: getattr(cards, name) for name in _CARDS}
    if touching:
        found |= {"reaction": state.reaction, "friction": state.friction}
    if not linear:
        found["card_load"] = cards.card_force * -1.0 if cards.card_load is None else cards.card_load
        found["local_force"] = local_end_forces(case)
        found["section_force"] = section_forces(case)
    return found | {name: getattr(loads, name) for name in _LOADS}


def _in_a_row(arrays: Mapping[str, F8], case: CaseResult) -> Numbers:
    """Put the numbers of one case in a row; the displacements have low parts."""
    assert case.state is not None
    high = np.concatenate([array.ravel() for array in arrays.values()])
    low = np.zeros_like(high)
    low[: case.state.u.size] = case.state.u_low.ravel()
    return Numbers(high, low)


def _rigid(expression: Expression, cases: tuple[CaseResult, ...]) -> F8 | None:
    """What rigid supports would add to the displacements."""
    return _corrections(expression, {case.name: case.penalty_u for case in cases})


def _corrections(expression: Expression, arrays: Mapping[str, F8 | None]) -> F8 | None:
    """Combine first-order corrections; None when a parent has none."""
    given = {name: Numbers(a, np.zeros_like(a)) for name, a in arrays.items() if a is not None}
    return evaluate(expression, given).high if len(given) == len(arrays) else None


def _cut(row: Numbers, shapes: Mapping[str, tuple[int, ...]]) -> dict[str, F8]:
    """Cut a row into named arrays; the low parts of displacements become one of them."""
    found: dict[str, F8] = {}
    at, whole = 0, row.high + row.low
    for name, shape in shapes.items():
        n = int(np.prod(shape))
        found[name] = whole[at : at + n].reshape(shape)
        at += n
    n = found["u"].size
    low = (row.high[:n] - whole[:n]) + row.low[:n]
    return found | {"u_low": low.reshape(found["u"].shape)}


def _unfold(answer: CaseResult, found: dict[str, F8]) -> None:
    """Give a combination its arrays; what it does not have is zero.

    A load that comes out the same from the forces on the pipe and from those on the restraint is
    a size; any other is the opposite of the force on the pipe.
    """
    if "card_load" in found:
        force = found["card_force"]
        found["card_load"] = np.where(found["card_load"] == force, force, -force)
    n_contact, n_slider = len(answer.system.contacts.k), len(answer.system.sliders.mu)
    answer.state = State(
        u=found["u"],
        u_low=found["u_low"],
        end_force=found["end_force"],
        side=np.zeros(n_contact, np.int32),
        reaction=found.get("reaction", np.zeros((n_contact, 3))),
        friction=found.get("friction", np.zeros((n_slider, 3))),
        mode=np.zeros(n_slider, np.int32),
        normal=np.zeros(n_slider),
        slide=np.zeros((n_slider, 3)),
        datum=np.zeros((n_slider, 3)),
        datum_end=np.zeros((n_slider, 3)),
    )
    loads: dict[str, Any] = {name: found[name] for name in _LOADS}
    answer.loads = Loads(**loads)
    names = (*_CARDS, "card_load", "local_force", "section_force")
    answer.gathered = Gathered(**{name: found[name] for name in names if name in found})
