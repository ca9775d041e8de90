"""What a MODES card asks for, on a frozen system: mesh, lateral springs, modes."""

from dataclasses import replace

import numpy as np

from trunnion.arrays import I4, Contacts, ModeSet, State, System
from trunnion.loads.masses import Masses
from trunnion.model import Modes
from trunnion.solver.ledger import Ledger
from trunnion.solver.locked import joined
from trunnion.solver.mesh import Mesh, refine_system, whole_mesh
from trunnion.solver.modes import natural_modes
from trunnion.solver.pencil import Pencil
from trunnion.solver.structure import Structure

FIRST_CUT = 33.0  # Hz, the mesh where the card states no FMAX: the end of earthquakes
MESHES = 5


def modes_of(
    frozen: System,
    masses: Masses,
    card: Modes,
    ledger: Ledger,
    parent: Structure | None = None,
    keep: I4 | None = None,
) -> tuple[ModeSet, Pencil]:
    """Natural modes of a system whose contacts are two-way springs, and their K and M.

    Without FMAX the mesh follows the highest frequency found.

    Parameters
    ----------
    parent, keep : structure to share elements and analysis with where no node is added, see
        `Structure`.
    """
    cut = card.fmax or FIRST_CUT
    for _ in range(MESHES):
        mesh, pencil = pencil_of(frozen, masses, card, ledger, cut, parent, keep)
        found = natural_modes(pencil, card.n, fmax=card.fmax, mesh=mesh, place=card.place)
        found = replace(found, cut=cut)
        highest = float(found.frequency.max(initial=0.0))
        if card.fmax is not None or highest <= cut or card.mesh == "NONE":
            break
        cut = 1.2 * highest
        if _mesh(frozen, masses, card, cut).added == mesh.added:
            break
    return found, pencil


def pencil_of(
    frozen: System,
    masses: Masses,
    card: Modes,
    ledger: Ledger,
    cut: float,
    parent: Structure | None = None,
    keep: I4 | None = None,
) -> tuple[Mesh, Pencil]:
    """Mesh for a cut-off [Hz], and K and M on it; other parameters as of `modes_of`."""
    mesh = _mesh(frozen, masses, card, cut)
    if mesh.added:
        structure = Structure(mesh.system, ledger, whole=True)
    else:
        above = None if parent is None else parent.full
        structure = Structure(frozen, ledger, above, keep, whole=True)
    inner = masses.parted(mesh.part_of, len(mesh.system.labels))
    return mesh, Pencil(structure, inner, lumped=card.mass == "LUMPED", rotary=card.rotary)


def _mesh(frozen: System, masses: Masses, card: Modes, cut: float) -> Mesh:
    return whole_mesh(frozen) if card.mesh == "NONE" else refine_system(frozen, masses.line, cut)


def with_friction(
    system: System, state: State, frozen: System, keep: I4, factor: float, mux: float = 1.0
) -> tuple[System, I4]:
    """Lateral springs factor mu N where supports press (FRICTION=), in their sliding plane.

    Parameters
    ----------
    system, state : the operating case whose contacts were frozen.
    frozen, keep : of `frozen_system`; both come back longer.
    factor : stiffness of a force mu N of friction [1/m].
    """
    s = system.sliders
    k = factor * mux * s.mu * state.normal
    slider, axis = np.nonzero((k > 0.0)[:, None] & (np.abs(s.basis).max(axis=2) > 0.0))
    if not len(slider):
        return frozen, keep
    normal = np.zeros((len(slider), 2, 3))
    normal[:, 0] = s.basis[slider, axis]
    springs = Contacts(
        node=s.node[slider],
        cnode=s.cnode[slider],
        card=s.card[slider],
        rotational=np.zeros(len(slider), np.bool_),
        dim=np.ones(len(slider), np.int32),
        normal=normal,
        gap=np.zeros((len(slider), 2)),
        k=k[slider],
        penalty=np.zeros(len(slider), np.bool_),
        two_way=np.ones(len(slider), np.bool_),
        word=("FRICTION",) * len(slider),
    )
    own = s.contact[s.first[slider]]  # stands between the same nodes
    return replace(frozen, contacts=joined(frozen.contacts, springs)), np.concatenate((keep, own))
