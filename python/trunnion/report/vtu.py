"""VTU files for ParaView: the pipes and the restraints of every case, and a collection of them.

<stem>.pvd opens all that is in <stem>_vtu: one time a case, in the deck's order.  Pipes are
polylines through interior points, so bends are round and spans sag as they do; restraints are
points with their forces as vectors.  Everything is SI and global, forces act on the pipe, as in
the JSON.
"""

from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from numpy.typing import NDArray

from trunnion.arrays import F8, TAPER, CaseResult, Results
from trunnion.model import Model
from trunnion.report.centreline import along, cut
from trunnion.results.stresses import RIGID as BODIES
from trunnion.results.stresses import pipe_elements, pipe_stresses
from trunnion.results.supports import (
    card_forces,
    card_friction,
    card_levels,
    card_nodes,
    card_normals,
    is_good,
    solved,
)

RIGID, REDUCER = 3, 4  # kinds of cells; 0, 1, 2 are those of System.kind
NO_STATE = -1  # of a restraint in a combination

Data = dict[str, NDArray[np.generic] | tuple[F8, ...]]
_COLLECTION = """\
<?xml version="1.0"?>
<VTKFile type="Collection" version="0.1" byte_order="LittleEndian">
  <Collection>
{rows}  </Collection>
</VTKFile>
"""
_ROW = '    <DataSet timestep="{time}" part="{part}" name="{case}" file="{file}"/>\n'


def files(results: Results, model: Model, stem: str) -> dict[str, bytes]:
    """Write the files of all certified cases, by their names."""
    found: dict[str, bytes] = {}
    rows = ""
    for time, case in enumerate(c for c in results.cases.values() if is_good(c)):
        for part, (what, content) in enumerate(_grids(case).items()):
            name = f"{stem}_vtu/{case.name}_{what}.vtu"
            found[name] = content
            rows += _ROW.format(time=time, part=part, case=case.name, file=_escaped(name))
    found[f"{stem}.pvd"] = _COLLECTION.format(rows=rows).encode()
    return found


def _escaped(name: str) -> str:
    """Write the name of a file, which comes from the user, in an attribute."""
    from xml.sax.saxutils import quoteattr

    return quoteattr(name, {'"': "&quot;"})[1:-1]


def _grids(case: CaseResult) -> dict[str, bytes]:
    """Grids of one case; a part that is empty is left out."""
    system, found = case.system, {}
    if len(system.kind):
        found["pipes"] = _pipes(case)
    if system.cards:
        found["restraints"] = _restraints(case)
    return found


def _pipes(case: CaseResult) -> bytes:
    """Elements as polylines."""
    system, state, lines = case.system, solved(case), cut(case.system)
    where, move, section = along(case, lines)
    od, wall = system.od[lines.element], system.wall[lines.element]
    stress = np.full(len(od), np.nan)
    piped = np.isin(lines.element, pipe_elements(system))
    pressure = np.zeros(len(system.kind)) if case.loads is None else case.loads.pressure
    stress[piped] = pipe_stresses(
        od[piped], wall[piped], section[piped], pressure[lines.element][piped]
    ).von_mises
    names = ("axial_force", "shear_y", "shear_z", "torsion", "bending_y", "bending_z")
    data: Data = {
        "displacement": _vector(move[:, :3]),
        "rotation": _vector(move[:, 3:]),
        **{name: np.ascontiguousarray(section[:, i]) for i, name in enumerate(names)},
        "von_mises": stress,
        "radius": 0.5 * od,
        "fraction": lines.fraction,
    }
    rigid = np.array([part.type in BODIES for part in system.parts])
    taper = system.kind == TAPER
    force = state.end_force
    cells: Data = {
        "element": np.arange(len(system.kind), dtype=np.int32),
        "kind": np.where(rigid, RIGID, np.where(taper, REDUCER, system.kind)).astype(np.int32),
        "force_from": _vector(force[:, 0, :3]),
        "moment_from": _vector(force[:, 0, 3:]),
        "force_to": _vector(force[:, 1, :3]),
        "moment_to": _vector(force[:, 1, 3:]),
        "outside_diameter": system.od,
        "wall": system.wall,
    }
    return _grid(where, lines.first[1:], cells, data)


def _restraints(case: CaseResult) -> bytes:
    """Restraints as points, with what they do to the pipe."""
    system, node = case.system, card_nodes(case.system)
    force, n = card_forces(case), len(case.system.cards)
    none = np.full(n, NO_STATE, np.int32)
    state = none if case.gathered is not None else card_levels(case).astype(np.int32)
    u = (solved(case).u + solved(case).u_low)[node]
    data: Data = {
        "displacement": _vector(u[:, :3]),
        "force": _vector(force[:, :3]),
        "moment": _vector(force[:, 3:]),
        "friction": _vector(card_friction(case)),
        "normal": card_normals(case),
        "state": state,
        "line": np.array([card.line for card in system.cards], np.int32),
    }
    return _grid(system.xyz[node], np.arange(1, n + 1), {"restraint": np.arange(n)}, data)


def _vector(rows: F8) -> tuple[F8, ...]:
    """(n, 3) as three arrays."""
    return tuple(np.ascontiguousarray(rows[:, i]) for i in range(3))


def _grid(where: F8, stops: NDArray[np.integer], cells: Data, data: Data) -> bytes:
    """Write an unstructured grid whose cells are runs of points: polylines, or single points."""
    from pyevtk.hl import unstructuredGridToVTK
    from pyevtk.vtk import VtkPolyLine, VtkVertex

    single = len(stops) == len(where)
    kind = np.full(len(stops), (VtkVertex if single else VtkPolyLine).tid, np.uint8)
    with TemporaryDirectory() as folder:  # the package writes by name only
        path = unstructuredGridToVTK(
            str(Path(folder) / "grid"),
            *_vector(where),
            connectivity=np.arange(len(where), dtype=np.int64),
            offsets=np.asarray(stops, np.int64),
            cell_types=kind,
            cellData=cells,
            pointData=data,
        )
        return Path(path).read_bytes()
