"""Combinations of results: COMB expressions evaluated component by component.

A combination has no state of its own: where its parents' contacts are open or slide means nothing
in a sum, so sides, modes, normal forces and slides are left at zero.  Its certificate is its
parents' worst.

Support loads and end forces in the elements' own axes do not follow from combined numbers where
the expression is no weighted sum, and are combined on their own (`CaseResult.envelope`).
"""

from collections.abc import Mapping
from dataclasses import fields

import numpy as np

from trunnion.algebra import Numbers, evaluate, exact, is_linear, parents
from trunnion.arrays import F8, CaseResult, Certificate, Envelope, Item, Loads, State, System
from trunnion.balance import case_local_forces
from trunnion.frames import Frame, common_frame
from trunnion.model import Comb, Expression
from trunnion.supports import card_forces


def combine(comb: Comb, results: Mapping[str, CaseResult]) -> CaseResult:
    """Combine solved cases (and earlier combinations) by the expression of `comb`.

    Without numbers in a parent there are none here either, and `cause` names the parent.
    """
    cases = [results[name] for name in parents(comb.expression)]
    frame = common_frame([case.system for case in cases])
    answer = CaseResult(comb.name, "comb", comb.text, frame.system, None, None, converged=False)
    weighted = is_linear(comb.expression)
    answer.linear = frame.alike and weighted and all(case.linear for case in cases)
    without = [case.name for case in cases if case.state is None]
    if without:
        answer.cause = f"no numbers in {', '.join(without)}"
        return answer
    answer.converged = all(case.converged for case in cases)
    answer.certificate = inherit(cases)
    row = evaluate(comb.expression, {case.name: _numbers(case, frame) for case in cases})
    answer.state, answer.loads = _unfold(frame.system, row)
    if not weighted or any(case.envelope for case in cases):
        answer.envelope = _envelope(comb.expression, cases)
    if answer.linear:
        expression = comb.expression
        answer.penalty_u = _corrections(expression, {c.name: c.penalty_u for c in cases})
        held = {
            c.name: None if c.penalty_r is None else frame.spread(c.system, c.penalty_r)
            for c in cases
        }
        answer.penalty_r = _corrections(expression, held)
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


def _numbers(case: CaseResult, frame: Frame) -> Numbers:
    """Put displacements, forces and loads of one case in a row; what it does not have is 0."""
    state, loads = case.state, case.loads
    assert state is not None
    assert loads is not None
    friction = np.zeros((len(frame.system.sliders.mu), 3))
    friction[: len(state.friction)] = state.friction
    rest = [state.end_force, frame.spread(case.system, state.reaction), friction]
    rest += [getattr(loads, name) for name in _arrays(loads)]
    tail = np.concatenate([array.ravel() for array in rest])
    return Numbers(
        np.concatenate([state.u.ravel(), tail]),
        np.concatenate([state.u_low.ravel(), np.zeros_like(tail)]),
    )


def _envelope(expression: Expression, cases: list[CaseResult]) -> Envelope:
    """Combine support loads, and end forces in the elements' own axes."""
    local = {case.name: case_local_forces(case) for case in cases}
    card = {case.name: card_forces(case) for case in cases}
    found = [
        evaluate(expression, {name: exact(a) for name, a in arrays.items()}).total
        for arrays in (local, card)
    ]
    return Envelope(found[0].reshape(-1, 2, 6), found[1].reshape(-1, 6))


def _corrections(expression: Expression, arrays: Mapping[str, F8 | None]) -> F8 | None:
    """Combine first-order corrections; None when a parent has none."""
    given = {name: exact(a) for name, a in arrays.items() if a is not None}
    if len(given) < len(arrays):
        return None
    shape = next(a.shape for a in arrays.values() if a is not None)
    return evaluate(expression, given).high.reshape(shape)


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
