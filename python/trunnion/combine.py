"""Combinations of results: COMB expressions evaluated component by component.

A combination has no state of its own: where its parents' contacts are open or slide means nothing
in a sum, so sides, modes, normal forces and slides are left at zero.  Its certificate is its
parents' worst.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields

import numpy as np

from trunnion.arrays import F8, CaseResult, Certificate, Item, Loads, State, System
from trunnion.deformation import two_difference
from trunnion.model import Comb, Expression

_LINEAR = frozenset(("case", "+", "-", "*", "neg"))


@dataclass(frozen=True, slots=True)
class Numbers:
    """All numbers of one result in a row, as unevaluated sums high + low."""

    high: F8
    low: F8


def _sum(a: Numbers, b: Numbers) -> Numbers:
    high, error = two_difference(a.high, -b.high)
    return Numbers(high, error + a.low + b.low)


def _times(n: float, a: Numbers) -> Numbers:
    return Numbers(n * a.high, n * a.low)


def _size(a: Numbers) -> Numbers:
    sign = np.where(np.signbit(a.high + a.low), -1.0, 1.0)
    return Numbers(sign * a.high, sign * a.low)


# What each word of an expression does with its evaluated operands.  A further word (SRSS, MAX,
# MIN, SIGNMAX, SCALAR) is a function of any number of results and one line here.
OPERATIONS: dict[str, Callable[..., Numbers]] = {
    "+": _sum,
    "-": lambda a, b: _sum(a, _times(-1.0, b)),
    "*": _times,
    "neg": lambda a: _times(-1.0, a),
    "abs": _size,
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
    system = cases[0].system
    answer = CaseResult(comb.name, "comb", comb.text, system, None, None, converged=False)
    same = all(case.linear and case.system is system for case in cases)  # a hot one has its own E
    answer.linear = same and is_linear(comb.expression)
    without = [case.name for case in cases if case.state is None]
    if without:
        answer.cause = f"no numbers in {', '.join(without)}"
        return answer
    answer.converged = all(case.converged for case in cases)
    answer.certificate = inherit(cases)
    row = evaluate(comb.expression, {case.name: _numbers(case) for case in cases})
    answer.state, answer.loads = _unfold(system, row)
    if answer.linear:
        answer.penalty_u = _corrections(comb.expression, {c.name: c.penalty_u for c in cases})
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


def _numbers(case: CaseResult) -> Numbers:
    """Put displacements, forces and loads of one case in a row."""
    state, loads = case.state, case.loads
    assert state is not None
    assert loads is not None
    rest = [state.end_force, state.reaction, state.friction]
    rest += [getattr(loads, name) for name in _arrays(loads)]
    tail = np.concatenate([array.ravel() for array in rest])
    return Numbers(
        np.concatenate([state.u.ravel(), tail]),
        np.concatenate([state.u_low.ravel(), np.zeros_like(tail)]),
    )


def _corrections(expression: Expression, arrays: Mapping[str, F8 | None]) -> F8 | None:
    """Combine first-order corrections; None when a parent has none."""
    given = {name: Numbers(a, np.zeros_like(a)) for name, a in arrays.items() if a is not None}
    return evaluate(expression, given).high if len(given) == len(arrays) else None


def _arrays(loads: Loads) -> list[str]:
    """Fields of loads that are arrays, in the order in which `_unfold` takes them."""
    return [field.name for field in fields(loads) if field.name != "mux"]


def _unfold(system: System, row: Numbers) -> tuple[State, Loads]:
    """Cut a row into the arrays of a result; what a combination does not have is zero."""
    n_node, n_elem, n_card = len(system.labels), len(system.kind), len(system.cards)
    n_contact, n_slider = len(system.contacts.k), len(system.sliders.mu)
    at = 0

    def take(*shape: int) -> F8:
        nonlocal at
        start, at = at, at + int(np.prod(shape))
        part: F8 = (row.high[start:at] + row.low[start:at]).reshape(shape)
        return part

    u = take(n_node, 6)
    low = (row.high[:at] - u.ravel()) + row.low[:at]
    end_force, reaction, friction = take(n_elem, 2, 6), take(n_contact, 3), take(n_slider, 3)
    state = State(
        u=u,
        u_low=low.reshape(u.shape),
        end_force=end_force,
        side=np.zeros(n_contact, np.int32),
        reaction=reaction,
        friction=friction,
        mode=np.zeros(n_slider, np.int32),
        normal=np.zeros(n_slider),
        slide=np.zeros((n_slider, 3)),
        datum=np.zeros((n_slider, 3)),
        datum_end=np.zeros((n_slider, 3)),
    )
    loads = Loads(
        dist=take(n_elem, 3),
        strain=take(n_elem),
        curvature=take(n_elem),
        nodal=take(n_node, 6),
        base=take(n_card, 6),
        preload=take(n_card),
        pressure=take(n_elem),
    )
    return state, loads
