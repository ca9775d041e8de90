"""Program-designed spring hangers: hot load, travel, and a spring from a table.

1. Weight: rigid vertical supports stand where hangers are to be designed, anchors that FREE=
   names are let go vertically; W (and H of hangers that are given) gives each its hot load.
2. Operation: those supports are replaced by constant forces of the hot load; the operating case
   gives the travel of each from where the weight left it.
3. Selection: a rigid rod where the travel is small; else the first spring of the table (series by
   series, the smallest load first) that carries hot and cold load inside its range and whose
   load changes by no more than the limit, |rate x travel| / hot load (MSS SP-58: 25 %); else a
   constant support.

The selected hangers stand in the model that all cases of the deck are solved on.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from trunnion.arrays import F8, CaseResult, HangerChoice, Results
from trunnion.cases.default_cases import is_operating, with_cases
from trunnion.cases.freed import freed
from trunnion.errors import ModelError, Problem
from trunnion.loads.movements import node_numbers
from trunnion.model import Case, Direction, HangerDesign, Model, SpringSize, Support, Term

WEIGHT = "HANGER.WEIGHT"


def to_design(model: Model) -> list[int]:
    """Numbers of the supports that are hangers to be designed."""
    return [i for i, s in enumerate(model.supports) if s.design is not None]


def designed(model: Model) -> tuple[Model, tuple[HangerChoice, ...]]:
    """Select the hangers of a model; returns the model with them, and what was selected.

    Raises
    ------
    ModelError
        There is no operating case, or the weight or operating case of the design has no answer.
    """
    at = to_design(model)
    if not at:
        return model, ()
    model = with_cases(model)
    others = any(s.kind == "hanger" and s.design is None for s in model.supports)
    terms = (Term(1.0, "W"), *((Term(1.0, "H"),) if others else ()))
    up = f"{model.settings.up}"
    rigid = {i: _rod(model.supports[i], up) for i in at}
    weight = _solve(freed(model), rigid, Case(WEIGHT, terms))
    hot = {i: float(weight.supports.values[i] @ _up_row(weight)) for i in at}
    constant = {i: _hanger(model.supports[i], 0.0, max(hot[i], 0.0)) for i in at}
    travel: dict[int, float] = {}
    for name in dict.fromkeys(_operating(model, i) for i in at):
        case = next(c for c in model.cases if c.name == name)
        assert isinstance(case, Case)
        loads = [t for t in case.terms if t.name != "H"]
        acting = replace(case, terms=(*loads, Term(1.0, "H")), start=None, steps=1)
        moved = _solve(model, constant, acting)
        for i in (i for i in at if _operating(model, i) == name):
            travel[i] = _lift(moved, model.supports[i]) - _lift(weight, model.supports[i])
    choices = tuple(
        select(model.supports[i], hot[i], travel[i], springs_for(model, model.supports[i]))
        for i in at
    )
    supports = list(model.supports)
    for i, choice in zip(at, choices, strict=True):
        s = supports[i]
        supports[i] = rigid[i] if choice.kind == "rod" else _hanger(s, choice.rate, choice.cold)
    return replace(model, supports=supports), choices


def select(
    support: Support, hot: float, travel: float, table: Sequence[SpringSize]
) -> HangerChoice:
    """Select one hanger.

    Parameters
    ----------
    hot : load of the weight case on all springs of the hanger together [N].
    travel : from the cold to the operating position, upwards [m].
    """
    wanted = support.design
    assert wanted is not None
    none = HangerChoice(
        support.node,
        support.name,
        "constant",
        "",
        "",
        wanted.number,
        hot,
        hot,
        0.0,
        travel,
        0.0,
        "",
    )
    if not hot > 0.0:
        why = "the weight does not rest on it: no hanger is needed here"
        return replace(none, kind="none", hot=0.0, cold=0.0, reason=why)
    if abs(travel) <= wanted.rod:
        why = f"travel below {1e3 * wanted.rod:g} mm"
        return replace(none, kind="rod", reason=why)
    if wanted.most is not None and abs(travel) > wanted.most:
        return replace(none, reason=f"travel above {1e3 * wanted.most:g} mm")
    fits = [s for s in table if wanted.series in (None, s.series)]
    best = "no size carries the load"
    for series in dict.fromkeys(size.series for size in fits):
        for size in sorted((s for s in fits if s.series == series), key=lambda s: s.most):
            found = _on_spring(none, size, hot, travel, wanted)
            low, high = sorted((found.hot / wanted.number, found.cold / wanted.number))
            if not (size.least <= low and high <= size.most):
                continue
            if found.variation <= wanted.variation:
                return found
            best = f"the load changes by more than {100 * wanted.variation:g} %"
    return replace(none, reason=best)


def _on_spring(
    none: HangerChoice, size: SpringSize, load: float, travel: float, wanted: HangerDesign
) -> HangerChoice:
    """Loads of a hanger on springs of one size; a pipe that rises takes load off them.

    Hot load design balances the weight in operation, cold load design in the cold.
    """
    rate = wanted.number * size.rate
    change = rate * travel
    hot, cold = (load, load + change) if wanted.method == "HOT" else (load - change, load)
    variation = abs(change) / hot if hot > 0.0 else np.inf
    return replace(
        none,
        kind="spring",
        series=size.series,
        size=size.name,
        hot=hot,
        cold=cold,
        rate=rate,
        variation=variation,
    )


def _operating(model: Model, i: int) -> str:
    """Name of the operating case of a hanger: OPERATING=, or the first with weight and heat."""
    support = model.supports[i]
    assert support.design is not None
    if support.design.operating:
        return support.design.operating
    for case in model.cases:
        if isinstance(case, Case) and is_operating(case):
            return case.name
    text = f"HANGER {support.node} DESIGN: no case has weight and temperature; say OPERATING="
    raise ModelError([Problem(support.place, text)])


def _solve(model: Model, supports: dict[int, Support], case: Case) -> CaseResult:
    """Solve one case with other supports."""
    from trunnion.cases.analysis import solve

    own = [supports.get(i, s) for i, s in enumerate(model.supports)]
    asked = replace(model, supports=own, cases=[case], cycles=[], modal=None)
    results: Results = solve(asked)
    result = results[case.name]
    if result.state is None or not result.converged:
        first = model.supports[next(iter(supports))]
        what = "weight" if case.name == WEIGHT else f"operating ({case.name})"
        text = f"HANGER {first.node} DESIGN: the {what} case of the design: {result.cause}"
        raise ModelError([Problem(first.place, text)])
    return result


def _rod(s: Support, up: str) -> Support:
    """Rigid rod: both ways, without friction."""
    return Support(s.node, "support", (Direction(up, mu=0.0),), s.cnode, s.name, place=s.place)


def _hanger(s: Support, rate: float, cold: float) -> Support:
    return replace(s, k=rate, load=cold, design=None)


def _up_row(result: CaseResult) -> F8:
    """Take the upward force from a row of the supports' table."""
    row = np.zeros(result.supports.values.shape[1])
    row[:3] = result.system.up
    return row


def _lift(result: CaseResult, s: Support) -> float:
    """Upward movement of a hanger's node against what it hangs on [m]."""
    assert result.state is not None
    node, u = node_numbers(result.system), result.state.u[:, :3] @ result.system.up
    ground = 0.0 if s.cnode is None else u[node[s.cnode]]
    return float(u[node[s.node]] - ground)


def springs_for(model: Model, support: Support) -> Sequence[SpringSize]:
    """Table from which a hanger is selected: SPRINGSIZE cards, or one of the library."""
    if model.spring_sizes:
        return model.spring_sizes
    from trunnion.library.springs import spring_table

    assert support.design is not None
    return spring_table(support.design.table)
