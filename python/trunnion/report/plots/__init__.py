"""PNG pictures of a run: isometric, displaced shapes, support states, convergence and more.

`view` says where points fall on paper, `paint` draws solids from the farthest to the nearest,
`pipe` and `glyphs` make pipes and supports of them, `labels` finds places for text; a module each
makes one kind of picture.
"""

from collections.abc import Iterator

import numpy as np
from matplotlib.figure import Figure

from trunnion.arrays import F8, Results
from trunnion.model import Comb, Model
from trunnion.report.counts import counted
from trunnion.report.plots.answers import answers
from trunnion.report.plots.convergence import convergence
from trunnion.report.plots.cycles import cycle_loads
from trunnion.report.plots.displaced import displaced
from trunnion.report.plots.failed import failed
from trunnion.report.plots.isometric import isometric
from trunnion.report.plots.modes import mode_shapes
from trunnion.report.plots.names import safe
from trunnion.report.plots.page import png, style
from trunnion.report.plots.scene import subject
from trunnion.report.plots.supportstates import support_states
from trunnion.report.units import report_units
from trunnion.results.combine import is_linear, parents
from trunnion.results.supports import is_good


def files(results: Results, model: Model, stem: str) -> dict[str, bytes]:
    """Draw all pictures, by their file names."""
    with style():
        return {f"{stem}.{name}.png": png(figure) for name, figure in figures(results, model, stem)}


def figures(results: Results, model: Model, stem: str) -> Iterator[tuple[str, Figure]]:
    """Make the pictures one after the other, by the middle of their file names.

    Call it within `page.style`.
    """
    if results.base is None and not results.cases:
        return
    units, title = report_units(model.units), results.title or stem
    one = subject(results.system, north_of(model), caution_of(model))
    yield "isometric", isometric(one, units, title)
    for case in results.cases.values():
        name = safe(case.name)
        if not is_good(case):
            yield f"{name}.displaced", failed(one, case, units, title)
            yield f"{name}.supports", failed(one, case, units, title)
            continue
        shaped = has_shape(case.name, results, model)
        yield f"{name}.displaced", displaced(one, case, units, title, has_shape=shaped)
        yield f"{name}.supports", support_states(one, case, units, title)
    for spread in results.spreads.values():
        if len(spread.starts.answers) > 1:
            yield f"{safe(spread.case)}.answers", answers(one, spread, units, title)
    for cycle in results.cycles.values():
        yield f"{safe(cycle.name)}.cycle", cycle_loads(one, cycle, units, title)
    if results.modes is not None:
        yield "modes", mode_shapes(one, results.modes, title)
    if results.cases:
        yield "convergence", convergence(one, results, units, title)


def has_shape(name: str, results: Results, model: Model) -> bool:
    """Tell whether the displacements of a case occur together, as those of its parents do.

    Those of a response spectrum, and of ABS, SRSS, MAX and their like, do not.
    """
    case = results.cases[name]
    if case.kind != "comb":
        return case.kind == "case"
    comb = next((c for c in model.cases if isinstance(c, Comb) and c.name == name), None)
    if comb is None:
        return case.linear
    known = [p for p in parents(comb.expression) if p in results.cases]
    return is_linear(comb.expression) and all(has_shape(p, results, model) for p in known)


def caution_of(model: Model) -> str:
    """Say that the model does not have all of the file that it came from."""
    if model.origin is None or not model.origin.left_out:
        return ""
    n = len(model.origin.left_out)
    return f"LEFT OUT: {counted(n, 'feature')} of {model.origin.file}, see the text report"


def north_of(model: Model) -> F8 | None:
    """North, where the file that the model came from says which way it is."""
    if model.origin is not None and "PCF" in model.origin.format:
        return np.array([0.0, 1.0, 0.0])
    return None
