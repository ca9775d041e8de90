"""Many cases where no contact can change: weighted sums of the answers to a few load sets.

A sum costs a look at every number, an answer about twenty.  Displacements are summed in
double-double, so a sum has as many digits as an answer.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from trunnion import kernels
from trunnion.arrays import F8, CaseResult, Certificate, Loads, State
from trunnion.certificate import examine
from trunnion.certificate.sums import Part, certify_sums, part
from trunnion.solver.answer import Question, accept, refuse_mechanisms, unanswered
from trunnion.solver.digits import Scattered, digits_left, travel
from trunnion.solver.linear import solve_linear
from trunnion.solver.members import expand
from trunnion.solver.structure import Structure
from trunnion.solver.verdict import Reported, Sizes, Terms, report_numbers

STRICT = 1e-11  # bound of the worst item of a sum; answers have about 1e-14


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Base:
    """A certified answer of which sums are made."""

    reported: Reported
    part: Part


def solve_bases(structure: Structure, loads: Sequence[Loads]) -> list[Base] | None:
    """Answer load sets one by one; None where that needs more than one factor and its solves."""
    forcings = [structure.forcing(own) for own in loads]
    if any((structure.absent & (forcing.nodal != 0.0)).any() for forcing in forcings):
        return None
    solutions = solve_linear(structure, forcings)
    refuse_mechanisms(structure)
    bases = []
    for own, ready in zip(loads, solutions, strict=True):
        reported = report_numbers(structure, ready.point, ready.solved.sliding, ready.forcing)
        corrections = reported.correction_u, reported.correction_r
        examined = examine(structure.system, own, reported.state, corrections)
        good = examined[0].passed and not reported.broken
        if not good or reported.blind or reported.singular:
            return None
        sizes = reported.terms.sizes(structure)
        bases.append(Base(reported, part(structure.system, own, reported.state, examined, sizes)))
    return bases


def superpose(
    structure: Structure, questions: Sequence[Question], bases: Sequence[Base], weights: F8
) -> list[CaseResult | None]:
    """Answer cases as sums; None for each whose certificate is poorer than an answer's would be.

    Parameters
    ----------
    weights : (n_case, n_base) what every case has of every load set.
    """
    states = _states(bases, weights)
    terms = _terms(structure, bases, weights)
    sizes = [own.sizes(structure) for own in terms]
    certificates = certify_sums(
        structure.system,
        [question.loads for question in questions],
        states,
        weights,
        [base.part for base in bases],
        sizes,
    )
    return [
        _result(structure, *own)
        for own in zip(questions, states, terms, sizes, certificates, strict=True)
    ]


def _result(
    structure: Structure,
    question: Question,
    state: State,
    terms: Terms,
    sizes: Sizes,
    certificate: Certificate,
) -> CaseResult | None:
    """One case with its sum; None where the sum is not good enough."""
    found = {item.name: item.value for item in certificate.items}
    correction = found["correction_u"]
    reached, where, blind = digits_left(structure, sizes.travel, terms.scattered, correction)
    if blind or not certificate.worst <= STRICT:
        return None
    moves = kernels.largest_moves(state.u)
    reported = Reported(
        state,
        correction,
        found["correction_r"],
        partial(expand, structure.members, structure.system, terms.rigid_u),
        terms.rigid_r[: len(state.reaction)],
        moves,
        terms.penalty_effect(structure, sizes, moves),
        (reached, where),
        blind=False,
        singular=False,
        broken=None,
        terms=terms,
    )
    result = unanswered(structure, question)
    result.certificate = certificate
    accept(structure, result, reported)
    result.work = {"aitken": 0}
    return result


def _states(bases: Sequence[Base], weights: F8) -> list[State]:
    """Numbers of the sums."""
    first, given = bases[0].reported.state, [base.reported.state for base in bases]
    rows = [np.stack([getattr(s, name).ravel() for s in given]) for name in ("u", "u_low")]
    shape = len(weights), *first.u.shape
    u, low = (a.reshape(shape) for a in kernels.weighted_sums_dd(weights, *rows))
    ends = _sums(weights, [state.end_force for state in given])
    reactions = _sums(weights, [state.reaction for state in given])
    return [
        replace(first, u=own[0], u_low=own[1], end_force=own[2], reaction=own[3])
        for own in zip(u, low, ends, reactions, strict=True)
    ]


def _terms(structure: Structure, bases: Sequence[Base], weights: F8) -> list[Terms]:
    """What else is linear of the sums."""
    given = [base.reported.terms for base in bases]
    scattered = _sums(weights, [own.scattered.p for own in given])
    untrue = np.abs(weights) @ [
        own.scattered.loss * travel(structure, own.scattered.p) for own in given
    ]
    losses = [
        Scattered(p, float(lost) / max(travel(structure, p), 1e-300))
        for p, lost in zip(scattered, untrue, strict=True)
    ]
    rows = [
        _sums(weights, [getattr(own, name) for own in given])
        for name in ("u", "rigid_u", "reaction", "rigid_r")
    ]
    return [Terms(*own) for own in zip(*rows, losses, strict=True)]


def _sums(weights: F8, arrays: Sequence[F8]) -> F8:
    """(n_sum, ...) weighted sums of arrays of one shape."""
    shape = len(weights), *arrays[0].shape
    if not arrays[0].size:
        return np.zeros(shape)
    return kernels.weighted_sums(weights, np.stack([a.ravel() for a in arrays])).reshape(shape)
