"""Load cases as arrays: weight, temperature, pressure, movements, forces, occasional loads."""

from collections.abc import Mapping
from dataclasses import field, replace

import numpy as np

from trunnion.arrays import F8, Loads, System, no_loads
from trunnion.errors import Problem
from trunnion.frozen import frozen
from trunnion.loads.components import cold_spring, joint_weights, thrusts, uniform_loads
from trunnion.loads.movements import bases, idle, node_numbers
from trunnion.loads.strains import pressure_effects, pressures, strains
from trunnion.loads.weights import line_weights, skews
from trunnion.loads.wind import snow_load, wind_loads, wind_problems, wind_remarks
from trunnion.model import Case, Model, Term
from trunnion.system.checks import refuse

SHARED = ("dist", "strain", "curvature", "nodal", "base", "preload", "pressure", "vary")


@frozen(eq=False)
class LoadSets:
    """Every load set of a model with factor 1, on its numbered system.

    still : no loads.
    weight : W, WNC, WW -> (n_elem,) weight per length of axis [N/m].
    skew : W, WNC, WW -> (n_elem, 2) how the weight of reducers varies; see `arrays.Loads`.
    lump : W, WNC, WW -> (n_node,) weight of concentrated masses and of expansion joints [N].
    strain : T set -> (n_elem,) free strain.
    pressure : P set -> (n_elem,) [Pa].
    elongation, opening : (n_elem,) free strain and curvature [1/m] by pressure, times EA/P.
    force : F set -> (n_node, 6) [N, N m].
    base : D set -> (n_card, 6) [m, rad].
    preload : (n_card,) cold load of hangers [N].
    acceleration : U set -> (3,) [g].
    spread : WIND1 ... WIND9, S (snow) and Q1 ... Q9 (uniform) -> (n_elem, 3) [N/m].
    thrust : P set -> (n_node, 6) of expansion joints [N].
    cut : (n_elem,) free strain of cold spring, set CS; None where nothing is cut.
    """

    still: Loads
    up: F8
    weight: Mapping[str, F8]
    skew: Mapping[str, F8]
    lump: Mapping[str, F8]
    strain: Mapping[str, F8]
    pressure: Mapping[str, F8]
    elongation: F8
    opening: F8
    force: Mapping[str, F8]
    base: Mapping[str, F8]
    preload: F8
    acceleration: Mapping[str, F8]
    bare: Mapping[str, int] = field(default_factory=dict)  # T set -> pipes without it
    hangers: int = 0
    idle: Mapping[str, tuple[str, ...]] = field(default_factory=dict)  # D set -> moves nothing
    spread: Mapping[str, F8] = field(default_factory=dict)
    remarks: Mapping[str, tuple[str, ...]] = field(default_factory=dict)  # WIND1 ... -> remarks
    thrust: Mapping[str, F8] = field(default_factory=dict)
    cut: F8 | None = None


def load_sets(model: Model, system: System) -> LoadSets:
    """Evaluate all load sets once; raise what the cases ask for and is not there."""
    problems: list[Problem] = []
    strain, bare = strains(model, system, problems)
    elongation, opening = pressure_effects(model, system)
    refuse(wind_problems(model.winds))
    winds = wind_loads(model, system)
    spread = {name: found.load for name, found in winds.items()}
    if model.snows:
        spread["S"] = snow_load(model, system)
    weight = line_weights(model, system)
    spread |= uniform_loads(model, system, weight["W"])
    still = no_loads(system)
    for name in SHARED:
        getattr(still, name).setflags(write=False)  # cases that have none of it share it
    sets = LoadSets(
        still=still,
        up=system.up,
        weight=weight,
        skew=skews(model, system),
        lump=_lumps(model, system),
        strain=strain,
        pressure=pressures(model, system),
        elongation=elongation,
        opening=opening,
        force=_forces(model, system),
        base=bases(model, system),
        preload=_preloads(model, system),
        acceleration=_accelerations(model),
        bare=bare,
        hangers=sum(s.kind == "hanger" for s in model.supports),
        idle=idle(model, system),
        spread=spread,
        remarks={name: wind_remarks(system, found) for name, found in winds.items()},
        thrust=thrusts(model, system),
        cut=cold_spring(model, system),
    )
    for case in model.cases:
        if isinstance(case, Case):
            problems += missing_sets(sets, case)
    refuse(problems)
    return sets


def case_loads(model: Model, system: System, case: Case, sets: LoadSets | None = None) -> Loads:
    """Sum the sets of one case.

    `system` is the hot one where the case asks for E=HOT: strain by pressure follows its modulus.
    """
    sets = load_sets(model, system) if sets is None else sets
    problems = missing_sets(sets, case)
    refuse(problems)
    total = _Sums(sets.still)
    for term in case.terms:
        _add_term(total, sets, term)
    if "pressure" in total:
        ea = system.rigidity[:, 0]
        per_ea = total["pressure"] / np.where(ea > 0.0, ea, 1.0)
        total["strain"] += sets.elongation * per_ea
        total["curvature"] += sets.opening * per_ea
    return replace(sets.still, mux=case.mux, **total)


class _Sums(dict[str, F8]):
    """Arrays of a case by name; those that nothing is added to are those of no loads."""

    def __init__(self, still: Loads) -> None:
        self.still = still

    def __missing__(self, name: str) -> F8:
        fresh: F8 = getattr(self.still, name).copy()
        return fresh


def _add_term(total: _Sums, sets: LoadSets, term: Term) -> None:
    f, name, which = term.factor, term.name, term.name[1:]
    if name in sets.weight:
        _add_weight(total, sets, name, -f * sets.up)
    elif name in sets.spread:
        total["dist"] += f * sets.spread[name]
    elif name == "H":
        total["preload"] += f * sets.preload
    elif name == "CS":
        total["strain"] += f * (0.0 if sets.cut is None else sets.cut)
    elif name[0] == "T":
        total["strain"] += f * sets.strain[which]
    elif name[0] == "P":
        total["pressure"] += f * sets.pressure[which]
        if which in sets.thrust:
            total["nodal"] += f * sets.thrust[which]
    elif name[0] == "D":
        total["base"] += f * sets.base[which]
    elif name[0] == "F":
        total["nodal"] += f * sets.force[which]
    else:
        _add_weight(total, sets, "W", f * _acceleration(sets, term))


def _add_weight(total: _Sums, sets: LoadSets, name: str, way: F8) -> None:
    """Add the weights of a set along a vector, in multiples of g."""
    weights = [("dist", sets.weight[name]), ("nodal", sets.lump[name])]
    for array, weight in weights:
        if weight.any():
            rows = total[array]
            for i in np.flatnonzero(way):
                rows[:, i] += way[i] * weight
            total[array] = rows
    if sets.skew[name].size:
        total["vary"] += sets.skew[name][:, :, None] * way


def case_warnings(sets: LoadSets, case: Case) -> tuple[str, ...]:
    """List what is legal in a case but seldom meant; who prints it names the case."""
    names = {term.name for term in case.terms}
    heavy = sorted(names & {"W", "WNC", "WW"})
    found: list[str] = []
    if heavy and sets.hangers and "H" not in names:
        count = f"{sets.hangers} hanger{'s' if sets.hangers > 1 else ''}"
        found.append(f"{heavy[0]} without H: the cold load of {count} is left out")
    if "H" in names and not sets.hangers:
        found.append("H: there are no hangers")
    for name in sorted(n for n in names if n[0] == "T" and sets.bare.get(n[1:])):
        bare = sets.bare[name[1:]]
        pipes = "1 pipe" if bare == 1 else f"{bare} pipes"
        found.append(f"{name} is not given on {pipes}")
    for name in sorted(n for n in names if n[0] == "D"):
        found += sets.idle.get(name[1:], ())
    for name in sorted(names):
        found += sets.remarks.get(name, ())
    return tuple(found)


def missing_sets(sets: LoadSets, case: Case) -> list[Problem]:
    """List terms of a case that nothing in the model gives."""
    homes: dict[str, Mapping[str, F8]] = {
        "T": sets.strain,
        "P": sets.pressure,
        "D": sets.base,
        "F": sets.force,
        "U": sets.acceleration,
    }
    problems: list[Problem] = []
    for term in case.terms:
        name = term.name
        if name in sets.weight or name in sets.spread or name == "H":
            continue
        if name == "U" and term.vector is not None:
            continue
        if name == "CS" and sets.cut is not None:
            continue
        known = name in ("S", "CS") or name[:4] == "WIND" or name[:1] == "Q"
        if not known and (name[:1] not in homes or not name[1:]):
            problems.append(Problem(case.place, f"CASE {case.name}: {name} is not a load set"))
        elif known or name[1:] not in homes[name[0]]:
            text = f"CASE {case.name}: nothing in the model gives {name}"
            problems.append(Problem(case.place, text))
    return problems


def _acceleration(sets: LoadSets, term: Term) -> F8:
    if term.vector is not None:
        return np.array(term.vector)
    return sets.acceleration[term.name[1:]]


def _lumps(model: Model, system: System) -> dict[str, F8]:
    lump = np.zeros(len(system.xyz))
    node = node_numbers(system)
    for mass in model.masses:
        lump[node[mass.node]] += model.settings.g * mass.mass
    return {name: lump + weight for name, weight in joint_weights(model, system).items()}


def _forces(model: Model, system: System) -> dict[str, F8]:
    node = node_numbers(system)
    force: dict[str, F8] = {}
    for f in model.forces:
        force.setdefault(f.set, np.zeros((len(system.xyz), 6)))[node[f.node]] += f.f
    return force


def _preloads(model: Model, system: System) -> F8:
    """Cold loads: the cards of supports lead System.cards in the model's order."""
    preload = np.zeros(len(system.cards))
    for i, s in enumerate(model.supports):
        if s.kind == "hanger":
            preload[i] = s.load
    return preload


def _accelerations(model: Model) -> dict[str, F8]:
    sums: dict[str, F8] = {}
    for a in model.accelerations:
        sums[a.set] = sums.get(a.set, np.zeros(3)) + np.array(a.a)
    return sums
