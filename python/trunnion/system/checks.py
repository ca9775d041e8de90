"""Checks of a model that need no geometry: values in range, names that exist."""

from math import inf, isfinite

from trunnion.errors import ModelError, Problem
from trunnion.model import Joint, Material, Model, Pipe, Place, Reducer, Section
from trunnion.system.bends import pipe_name
from trunnion.system.vectors import dot, size

MOST_TAPER = 10.0  # ratio of diameters up to which the quadrature of reducers is exact
STEEPEST = 0.5  # cosine between a reducer's axis and its run


def check_model(model: Model) -> list[Problem]:
    """List what is wrong with the records of a model, in the deck's order by kind."""
    problems: list[Problem] = []
    if not (model.pipes or model.springs or model.supports):
        problems.append(Problem("model", "there is no pipe, spring or support"))
    for material in model.materials.values():
        problems += [Problem(material.place, text) for text in _material(material)]
    for section in model.sections.values():
        problems += [Problem(section.place, text) for text in _section(section)]
    _pipes(model, problems)
    _springs_and_masses(model, problems)
    _supports(model, problems)
    stiffen = model.settings.stiffen
    given = {name for pipe in model.pipes for name in pipe.operation.p}
    chosen = given if stiffen == "MAX" else given & {stiffen[1:]}
    if model.bends and stiffen != "OFF" and not chosen:
        text = f"DEFAULT: STIFFEN={stiffen}: nothing in the model gives that pressure"
        problems.append(Problem("model", text))
    known = known_labels(model)
    for label, place, name in standing(model):
        if label not in known:
            problems.append(Problem(place, f"{name}: node {label} is not defined"))
    return problems


def refuse(problems: list[Problem]) -> None:
    """Raise the problems of a phase, if any, by file and line."""
    if problems:
        raise ModelError(sorted(problems, key=_position))


def _position(problem: Problem) -> tuple[str, int]:
    return getattr(problem.place, "file", ""), getattr(problem.place, "line", 0)


def known_labels(model: Model) -> set[str]:
    """Labels that have a place: of pipes, springs, NODE cards, bends.

    What only CNODE= of a known node names is known if a support or an imposed displacement
    stands there.  A model without pipes and springs starts at its first support.
    """
    known = {pipe.start for pipe in model.pipes}
    known.update(pipe.end for pipe in model.pipes)
    known |= {x for s in model.springs for x in (s.start, s.end)}
    known |= {node.label for node in model.nodes}
    known |= {bend.node + point for bend in model.bends for point in "NMF"}
    if not (model.pipes or model.springs) and model.supports:
        known.add(model.supports[0].node)
    held = {s.node for s in model.supports} | {d.node for d in model.displacements}
    ties = [(s.node, s.cnode) for s in model.supports if s.cnode in held]
    found = True
    while found:
        new = {b for a, b in ties if b is not None and a in known and b not in known}
        known |= new
        found = bool(new)
    return known


def standing(model: Model) -> list[tuple[str, Place, str]]:
    """List labels that something stands on, where that was written, and its name."""
    users: list[tuple[str, Place, str]] = []
    for s in model.supports:
        name = f"{s.kind.upper()} {s.node}"
        users.append((s.node, s.place, name))
        if s.cnode is not None:
            users.append((s.cnode, s.place, f"{name}: CNODE"))
    users += [(m.node, m.place, f"MASS {m.node}") for m in model.masses]
    users += [(f.node, f.place, f"FORCE {f.node}") for f in model.forces]
    users += [(d.node, d.place, f"DISPLACEMENT {d.node}") for d in model.displacements]
    return users


def _material(m: Material) -> list[str]:
    name = f"MATERIAL {m.name}"
    checks = {
        "E must be positive": 0.0 < m.e < inf,
        "NU must lie between -1 and 0.5": -1.0 < m.nu <= 0.5,
        "ALPHA must be finite": isfinite(m.alpha),
        "DENSITY is negative": 0.0 <= m.density < inf,
        "E of the table must be positive": all(p.e is None or p.e > 0.0 for p in m.table),
        "the table must rise in temperature": all(
            a.t < b.t for a, b in zip(m.table, m.table[1:], strict=False)
        ),
    }
    return [f"{name}: {text}" for text, fine in checks.items() if not fine]


def _section(s: Section) -> list[str]:
    bore = s.od - 2.0 * s.wall
    checks = {
        "OD must be positive": 0.0 < s.od < inf,
        "WALL must be positive": 0.0 < s.wall < inf,
        "WALL is more than half of OD": bore >= -1e-12 * abs(s.od),
        "LINING fills more than the bore": s.lining <= 0.5 * bore + 1e-12 * abs(s.od),
    }
    for key in ("fluid", "lining", "lining_density", "insulation", "insulation_density"):
        checks[f"{key.upper()} is negative"] = 0.0 <= getattr(s, key) < inf
    checks["WEIGHT must be finite"] = isfinite(s.weight)
    return [f"SECTION {s.name}: {text}" for text, fine in checks.items() if not fine]


def _pipes(model: Model, problems: list[Problem]) -> None:
    sections, materials = model.sections, model.materials
    for pipe in model.pipes:
        bad: list[str] = []
        if pipe.start == pipe.end:
            bad.append("starts and ends at the same node")
        if pipe.section not in sections:
            bad.append(f"section {pipe.section!r} is not defined")
        if pipe.material not in materials:
            bad.append(f"material {pipe.material!r} is not defined")
        least = -1.0 if pipe.joint else 0.0  # an expansion joint may have no length
        if pipe.delta is not None and not least < size(pipe.delta) < inf:
            bad.append("has no length")
        if pipe.reducer is not None:
            bad += _reducer(model, pipe, pipe.reducer)
        if pipe.joint is not None:
            bad += _joint(pipe, pipe.joint)
        if not 0.0 <= pipe.weight < inf:
            bad.append("the weight is negative")
        if bad:
            name = f"{pipe.card} {pipe_name(pipe)}"
            problems += [Problem(pipe.place, f"{name}: {text}") for text in bad]


def _reducer(model: Model, pipe: Pipe, reducer: Reducer) -> list[str]:
    if reducer.section not in model.sections:
        return [f"section {reducer.section!r} is not defined"]
    ends = [
        model.sections[name] for name in (pipe.section, reducer.section) if name in model.sections
    ]
    bad = []
    if max(s.od for s in ends) > MOST_TAPER * min(s.od for s in ends):
        bad.append(f"the diameters differ by more than {MOST_TAPER:g} to 1; use two reducers")
    axis = reducer.axis
    if axis is not None and not 0.0 < size(axis) < inf:
        bad.append("AXIS has no direction")
    elif (
        axis is not None
        and pipe.delta is not None
        and not dot(axis, pipe.delta) > STEEPEST * size(axis) * size(pipe.delta)
    ):
        bad.append("AXIS is more than 60 degrees from the run of the reducer")
    return bad


def _joint(pipe: Pipe, joint: Joint) -> list[str]:
    bad = []
    rates = (joint.axial, joint.lateral, joint.bending, joint.torsion, joint.area)
    if not all(k is None or 0.0 <= k < inf for k in rates):
        bad.append("a rate is negative")
    if joint.axis is not None and not 0.0 < size(joint.axis) < inf:
        bad.append("AXIS has no direction")
    return bad


def _springs_and_masses(model: Model, problems: list[Problem]) -> None:
    for spring in model.springs:
        name = f"SPRING {spring.start}-{spring.end}"
        if spring.start == spring.end:
            problems.append(Problem(spring.place, f"{name}: starts and ends at the same node"))
        if not all(0.0 <= k < inf for k in spring.k):
            problems.append(Problem(spring.place, f"{name}: a stiffness is negative"))
        if spring.axis is not None and not 0.0 < size(spring.axis) < inf:
            problems.append(Problem(spring.place, f"{name}: AXIS has no direction"))
    for mass in model.masses:
        if not 0.0 <= mass.mass < inf:
            problems.append(Problem(mass.place, f"MASS {mass.node}: the mass is negative"))
    moved: set[tuple[str, str, int]] = set()
    for d in model.displacements:
        for i in (i for i, value in enumerate(d.d) if value is not None):
            if (d.node, d.set, i) in moved:
                word = ("DX", "DY", "DZ", "RX", "RY", "RZ")[i]
                text = f"DISPLACEMENT {d.node}: D{d.set} {word} is given twice"
                problems.append(Problem(d.place, text))
            moved.add((d.node, d.set, i))


def _supports(model: Model, problems: list[Problem]) -> None:
    fine: set[int] = set()  # identities: most supports of a large model share theirs
    for s in model.supports:
        bad: list[str] = []
        if s.cnode == s.node:
            bad.append("CNODE is the node itself")
        own = (s.k, s.kr) if s.ks is None else (s.k, s.kr, *s.ks)
        if own != (None, None) and any(k is not None and not 0.0 <= k < inf for k in own):
            bad.append("a stiffness is negative")
        if s.axis is not None and not 0.0 < size(s.axis) < inf:
            bad.append("AXIS has no direction")
        if s.kind == "support" and not s.directions:
            bad.append("no direction is given")
        for d in s.directions:
            if id(d) in fine:
                continue
            found = len(bad)
            if not all(g >= 0.0 for g in d.gap):
                bad.append(f"{d.word}: a gap is negative")
            if any(k is not None and not 0.0 < k < inf for k in (d.k, d.kf)):
                bad.append(f"{d.word}: the stiffness must be positive")
            if d.mu is not None and not 0.0 <= d.mu < inf:
                bad.append(f"{d.word}: MU is negative")
            if d.vector is not None and not 0.0 < size(d.vector) < inf:
                bad.append(f"{d.word}: is no direction")
            if len(bad) == found:
                fine.add(id(d))
        problems += [Problem(s.place, f"{s.kind.upper()} {s.node}: {text}") for text in bad]
