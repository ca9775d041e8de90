"""Inertia forces inside elements whose mass is consistent with their shapes."""

import numpy as np

from trunnion.arrays import F8, no_contacts, no_sliders
from trunnion.solver.pattern import build_pattern
from trunnion.solver.pencil import Pencil, add_masses

TWELVE = 12


def element_inertia(pencil: Pencil, x: F8) -> F8:
    """Forces (m, n_elem, 2, 6) at the ends of elements for accelerations x (m, n_node, 6).

    Lumped masses stand at the nodes: no element carries their inertia.
    """
    structure = pencil.structure
    ends, m = structure.members.ends, len(x)
    n = len(ends)
    if pencil.lumped or n == 0:
        return np.zeros((m, n, 2, 6))
    moved = x[:, ends].reshape(m, n, TWELVE)
    force: F8 = np.einsum("eij,mej->mei", element_masses(pencil), moved)
    return force.reshape(m, n, 2, 6)


def element_masses(pencil: Pencil) -> F8:
    """(n_elem, 12, 12) consistent mass of each element, global.

    The elements are taken apart, so that the assembled lower triangle, by columns, holds one
    whole triangle an element after the other.
    """
    structure, n = pencil.structure, len(pencil.structure.members.ends)
    apart = np.arange(2 * n, dtype=np.int32).reshape(n, 2)
    pattern = build_pattern(2 * n, apart, no_contacts(), no_sliders(), no_contacts())
    packed = np.zeros(len(pattern.row))
    add_masses(structure, pencil.masses, pencil.lumped, apart, pattern, packed)
    column, row = np.triu_indices(TWELVE)
    whole = np.zeros((n, TWELVE, TWELVE))
    whole[:, row, column] = whole[:, column, row] = packed.reshape(n, -1)
    return whole
