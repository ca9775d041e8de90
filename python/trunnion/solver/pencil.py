"""The pencil K - w2 M of a frozen structure: its matrices, products, factors and inertia."""

from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from trunnion import kernels
from trunnion.arrays import F8, I4
from trunnion.errors import NotPositiveDefiniteError
from trunnion.loads.masses import Masses
from trunnion.solver.newton import TINY_PIVOT
from trunnion.solver.pattern import Pattern
from trunnion.solver.quantities import Point
from trunnion.solver.structure import Structure

if TYPE_CHECKING:
    from collections.abc import Sequence


ROUND_OFF_PIVOT = 1e-17  # rcond of a factor with a pivot that is nothing but round-off
DENSE = 240  # freedoms with mass up to which M is looked at as a whole
NO_MASS = 1e-10  # eigenvalue of M, scaled to a unit diagonal, that is zero


def add_masses(
    structure: Structure, masses: Masses, lumped: bool, ends: I4, pattern: Pattern, val: F8
) -> None:
    """Add the masses of a structure's elements, between the nodes `ends`, to a matrix."""
    s = structure.system
    kernels.assemble_mass(
        s.kind,
        structure.members.form,
        s.rigidity,
        s.flex,
        structure.members.k,
        s.axes,
        np.ascontiguousarray(masses.line),
        np.ascontiguousarray(masses.inertia),
        lumped,
        ends,
        pattern.element_rank,
        pattern.colptr,
        val,
    )


class Pencil:
    """Stiffness and mass of a structure whose contacts are all two-way springs.

    Vectors are rows (m, n_dof).  K is formed from deformations where digits matter.

    Parameters
    ----------
    lumped : half of every element's mass at its ends, else consistent with its static shapes.
    rotary : with the sections' rotary inertia.  Without it lumped masses only translate;
        consistent ones keep the inertia about the pipe's axis, without which it has no torsion.
    """

    def __init__(
        self, structure: Structure, masses: Masses, *, lumped: bool, rotary: bool = True
    ) -> None:
        structure = structure.full
        p, s = structure.pattern, structure.system
        assert s.contacts.two_way.all()
        assert not len(s.sliders.node)
        if not rotary:
            masses = masses.without_rotary(torsion=not lumped)
        self.structure, self.masses, self.lumped = structure, masses, lumped
        self.mass = np.zeros(len(p.row))
        if len(structure.members.ends):
            add_masses(structure, masses, lumped, structure.members.ends, p, self.mass)
        translations = p.diagonal.reshape(-1, 6)[:, :3]
        self.mass[translations] += masses.lump[:, None]
        structure.ledger.add(mass=1)
        self.heavy = self.mass[p.diagonal] > 0.0
        self.val = structure.val
        loose = structure.absent.ravel() & self.heavy  # the unit there stands for no stiffness
        if loose.any():
            self.val = self.val.copy()
            self.val[p.diagonal[loose]] = 0.0
        self.shift = 0.0

    # ------------------------------------------------------------------ products
    @cached_property
    def mass_matrix(self) -> Any:
        """M as a sparse matrix of SciPy, both triangles."""
        from scipy.sparse import csc_matrix, diags

        p = self.structure.pattern
        n = len(p.diagonal)
        low = csc_matrix((self.mass, p.row, p.colptr), shape=(n, n), copy=True)
        low.eliminate_zeros()
        return (low + low.T - diags(self.mass[p.diagonal])).tocsr()

    @cached_property
    def mass_root(self) -> tuple[NDArray[np.int64], F8]:
        """Freedoms with mass, and a root B of M among them, M = B B', dense."""
        heavy = np.flatnonzero(self.heavy)
        mass = self.mass_matrix[heavy][:, heavy].toarray()
        size = np.sqrt(np.diag(mass))
        value, turn = np.linalg.eigh(mass / size / size[:, None])
        some = value > NO_MASS
        return heavy, size[:, None] * turn[:, some] * np.sqrt(value[some])

    @cached_property
    def rank(self) -> int:
        """Rank of M; of large models without a look at the directions in which nodes turn."""
        if int(self.heavy.sum()) > DENSE:
            return int(self.heavy.sum())
        return self.mass_root[1].shape[1] if self.heavy.any() else 0

    def mass_product(self, x: F8) -> F8:
        """M x."""
        product: F8 = np.ascontiguousarray((self.mass_matrix @ x.T).T)
        return product

    def stiffness_product(self, points: "Sequence[Point]") -> F8:
        """K x, from deformations, in double-double as far as they go."""
        structure = self.structure
        law = structure.frictionless()
        rows = [structure.residual(point, law, structure.still)[0].ravel() for point in points]
        return -np.stack(rows)

    # ------------------------------------------------------------------ factors
    def factorise(self, shift: float) -> bool:
        """Factor K + shift M; tell whether it is positive definite, and clearly so if it is K."""
        structure = self.structure
        box = structure.box
        if box.spd is None:
            box.spd = kernels.SpdFactor(structure.pattern.colptr, structure.pattern.row)
        box.owner, box.held = None, None
        self.shift = shift
        try:
            rcond = box.spd.factorise(self.val + shift * self.mass)
        except NotPositiveDefiniteError as error:
            self.stuck = error.where
            return False
        finally:
            structure.ledger.follow(box, box.spd.work)
        if shift > 0.0 and rcond < ROUND_OFF_PIVOT:  # its largest motion tells where
            probe = np.random.default_rng(1).normal(size=(1, len(self.heavy)))
            self.stuck = int(np.abs(box.spd.solve(probe)).argmax())
            return False
        return shift > 0.0 or rcond > TINY_PIVOT

    def solve(self, b: F8) -> F8:
        """Solve (K + shift M) x = b; rows."""
        box = self.structure.box
        assert box.spd is not None
        assert box.owner is None
        x = box.spd.solve(b)
        self.structure.ledger.follow(box, box.spd.work)
        return x

    # ------------------------------------------------------------------ Sturm
    def count_below(self, w2: float, x: F8, gap: float) -> int | None:
        """Count the eigenvalues below w2; None when the factor cannot be believed.

        Its backward error E, in the scale of K's diagonal, is sampled with random signs, which
        shows its Frobenius norm; x' E x must stay well below `gap`.

        Parameters
        ----------
        x : (m, n_dof) mass-normalised modes nearest to w2.
        gap : distance from w2 to their eigenvalues.
        """
        box = self.structure.box
        assert box.spd is not None
        diagonal = self.val[self.structure.pattern.diagonal]
        scale = np.sqrt(np.where(diagonal > 0.0, diagonal, 1.0))
        signs = np.random.default_rng(1).integers(0, 2, len(scale)) * 2.0 - 1.0
        try:
            negative, r = box.spd.inertia(self.val - w2 * self.mass, signs / scale)
        except NotPositiveDefiniteError:
            return None
        finally:
            self.structure.ledger.follow(box, box.spd.work)
        size = float(np.linalg.norm(r / scale))
        error = size * float(((scale * x) ** 2).sum(axis=1).max(initial=0.0))
        return negative if size < SOUND and error < SOUND_SHARE * gap else None


SOUND = 1e-7  # relative backward error of a factor that may be believed
SOUND_SHARE = 0.1  # of the distance to the nearest mode
