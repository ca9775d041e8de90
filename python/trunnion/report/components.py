"""Echo of reducers, expansion joints, cold spring and uniform loads."""

import numpy as np

from trunnion.arrays import SPRING, TAPER, System
from trunnion.model import Model
from trunnion.report.columns import integers, numbers, plain, section, table, words
from trunnion.report.units import ReportUnits


def component_echo(model: Model, system: System, units: ReportUnits) -> str:
    """Print what makes pipes into components, as the solver took it."""
    return "".join(
        (
            _reducers(system, units),
            _joints(model, system, units),
            _cuts(model, units),
            _offsets(model, units),
            _uniform(model, units),
        )
    )


def _reducers(system: System, units: ReportUnits) -> str:
    at = np.flatnonzero(system.kind == TAPER)
    if not at.size:
        return ""
    parts = [system.parts[i] for i in at.tolist()]
    od2, wall2, offset = system.taper[at].T
    columns = [
        words("FROM", [p.start for p in parts]),
        words("TO", [p.end for p in parts]),
        numbers("OD 1", system.od[at], units.wall, 10),
        numbers("WALL 1", system.wall[at], units.wall, 9),
        numbers("OD 2", od2, units.wall, 10),
        numbers("WALL 2", wall2, units.wall, 9),
        numbers("LENGTH", system.length[at], units.length, 12),
        numbers("OFFSET", offset, units.wall, 9),
        integers("LINE", [p.line for p in parts]),
    ]
    return section("REDUCERS", "length along the axis, offset across it") + table(columns)


def _joints(model: Model, system: System, units: ReportUnits) -> str:
    named = np.array([part.type == "joint" for part in system.parts], bool)
    at = np.flatnonzero((system.kind == SPRING) & named)
    if not at.size:
        return ""
    parts = [system.parts[i] for i in at.tolist()]
    pipes = [model.pipes[i] for i in system.source[at].tolist()]
    rates = system.spring[at]
    columns = [
        words("FROM", [p.start for p in parts]),
        words("TO", [p.end for p in parts]),
        numbers("AXIAL", rates[:, 0], units.stiffness),
        numbers("LATERAL", rates[:, 1], units.stiffness),
        numbers("BENDING", rates[:, 4], units.rotational_stiffness),
        numbers("TORSION", rates[:, 3], units.rotational_stiffness),
        plain("AREA", [1e4 * p.joint.area if p.joint else 0.0 for p in pipes], 2, 10, "[cm2]"),
        numbers("WEIGHT", [p.weight for p in pipes], units.force),
        integers("LINE", [p.line for p in parts]),
    ]
    return section("EXPANSION JOINTS", "rates at the middle of the length") + table(columns)


def _cuts(model: Model, units: ReportUnits) -> str:
    cut = [pipe for pipe in model.pipes if pipe.cut]
    if not cut:
        return ""
    columns = [
        words("FROM", [p.start for p in cut]),
        words("TO", [p.end for p in cut]),
        numbers("CUT", [p.cut for p in cut], units.movement),
    ]
    return section("COLD SPRING", "set CS; cut short > 0, long < 0") + table(columns)


def _offsets(model: Model, units: ReportUnits) -> str:
    rows = [(p, i, arm) for p in model.pipes for i, arm in enumerate(p.offsets, 1) if arm]
    if not rows:
        return ""
    columns = [
        words("FROM", [p.start for p, _, _ in rows]),
        words("TO", [p.end for p, _, _ in rows]),
        integers("END", [i for _, i, _ in rows]),
        *(numbers(a, [arm[k] for _, _, arm in rows], units.wall) for k, a in enumerate("XYZ")),
    ]
    return section("OFFSETS", "rigid arms from the node to the end of the pipe") + table(columns)


def _uniform(model: Model, units: ReportUnits) -> str:
    rows = [(pipe, q) for pipe in model.pipes for q in pipe.uniform]
    text = ""
    for in_g in (False, True):
        some = [(pipe, q) for pipe, q in rows if q.in_g == in_g]
        if not some:
            continue
        columns = [
            words("FROM", [p.start for p, _ in some]),
            words("TO", [p.end for p, _ in some]),
            words("SET", [f"Q{q.set}" for _, q in some]),
        ]
        for i, axis in enumerate("XYZ"):
            values = [q.load[i] for _, q in some]
            columns.append(
                plain(axis, values, 4, 11, "[g]")
                if in_g
                else numbers(axis, values, units.line_load)
            )
        text += section("UNIFORM LOADS") + table(columns)
    return text
