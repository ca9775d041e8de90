"""Natural modes: shift-invert Lanczos on the factor of the statics, proven by a Sturm count."""

from dataclasses import dataclass

import numpy as np

from trunnion.arrays import F8, ModeSet
from trunnion.errors import ModelError, Problem
from trunnion.solver.eigen import correct, few, many, separate
from trunnion.solver.mesh import Mesh, whole_mesh
from trunnion.solver.pencil import DENSE, Pencil
from trunnion.threads import one_thread

SPARE = 3  # modes beyond those asked for, to find a gap behind them
ROUNDS = 8
RIGID = 1e-6  # of the shift: an eigenvalue that is zero
GAP = 1e-5  # relative, between modes that a Sturm count can tell apart
FREEDOMS = ("X", "Y", "Z", "RX", "RY", "RZ")


@one_thread()
def natural_modes(
    pencil: Pencil,
    n: int,
    *,
    fmax: float | None = None,
    mesh: Mesh | None = None,
    place: object = "modes",
) -> ModeSet:
    """Find the lowest n modes of a frozen structure, of those up to fmax [Hz].

    Parameters
    ----------
    mesh : how the structure's elements came from the model's.
    place : of the MODES card, for errors.

    Raises
    ------
    ModelError
        More modes than the mass matrix has rank, or a motion without stiffness and mass.
    """
    structure = pencil.structure
    rank = mass_rank(pencil)
    if n > rank:
        text = (
            f"MODES {n}: the mass matrix has rank {rank} on the freedoms that can move, so there "
            f"are only {rank} modes"
        )
        raise ModelError([Problem(place, text)])
    found = _proven(pencil, n, place)
    x, low = found.x[:n], found.low[:n]
    frequency = np.sqrt(np.maximum(found.w2[:n], 0.0)) / (2.0 * np.pi)
    if fmax is not None:
        m = int((frequency <= fmax).sum())
        x, low, frequency = x[:m], low[:m], frequency[:m]
    m = len(frequency)
    known = np.append(found.w2[m : m + 1], found.counted).min()  # what lies behind is not listed
    shape = (m, structure.n_node, 6)
    unit = np.tile(np.eye(6)[:3], structure.n_node)
    carried = pencil.mass_product(unit)
    participation = x @ carried.T
    mesh = mesh or whole_mesh(structure.system)
    return ModeSet(
        system=structure.system,
        frequency=frequency,
        shape=x.reshape(shape),
        shape_low=low.reshape(shape),
        participation=participation,
        effective_mass=participation**2,
        total_mass=np.einsum("ij,ij->i", unit, carried),
        residual=found.residual[:m],
        rigid=min(found.rigid, m),
        added=mesh.added,
        part_of=mesh.part_of,
        last=mesh.last,
        proven=found.proven,
        counted=float(np.sqrt(max(known, 0.0)) / (2.0 * np.pi)),
    )


def mass_rank(pencil: Pencil) -> int:
    """Number of freedoms that have mass and are not held by rigid supports."""
    heavy = pencil.heavy.reshape(-1, 6)
    c = pencil.structure.contacts
    groups: dict[tuple[int, int, bool], list[F8]] = {}
    for i in np.flatnonzero(c.penalty & c.two_way & (c.k > 0.0)):
        groups.setdefault((int(c.node[i]), int(c.cnode[i]), bool(c.rotational[i])), []).append(
            c.normal[i, : c.dim[i]]
        )
    held = 0
    for (node, _, rotational), normals in groups.items():
        part = slice(3, 6) if rotational else slice(0, 3)
        held += int(np.linalg.matrix_rank(np.vstack(normals)[:, heavy[node, part]], tol=1e-9))
    return pencil.rank - held


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Found:
    """Eigenpairs in rising order: w2 (k,), x + low (k, n_dof); and what is known of them."""

    w2: F8
    x: F8
    low: F8
    residual: F8
    rigid: int
    proven: bool
    counted: float


def _proven(pencil: Pencil, n: int, place: object) -> Found:
    """Eigenpairs, more until a count shows that none is missing."""
    everything = pencil.rank
    _choose_shift(pencil, place)
    k = min(n + SPARE, everything)
    known = np.zeros((0, len(pencil.heavy)))
    found = None
    for _ in range(ROUNDS):
        found = _pairs(pencil, k, everything, known, place)
        j, w2 = _gap(found, n, everything)
        if j == 0:  # one cluster as far as the eye reaches
            k = min(k + 2 * SPARE, everything)
            continue
        count = _count(pencil, found, j, w2)
        proven = count == j
        found = Found(
            found.w2, found.x, found.low, found.residual, found.rigid, proven, w2 if proven else 0.0
        )
        if count is None or count <= j:
            return found
        known = found.x
        k = min(k + count - j, everything)
    assert found is not None
    return found


def _choose_shift(pencil: Pencil, place: object) -> None:
    """Factor K, or K and a little of M where parts of the structure are free."""
    if pencil.factorise(0.0):
        return
    d = pencil.structure.pattern.diagonal
    heavy = pencil.heavy & (pencil.val[d] > 0.0)
    if not heavy.any():
        heavy = pencil.heavy
    ratio = pencil.val[d[heavy]] / pencil.mass[d[heavy]]
    _shift(pencil, 1e-6 * float(np.median(ratio)) or 1.0, place)


def _shift(pencil: Pencil, shift: float, place: object) -> None:
    if not pencil.factorise(shift):
        node, freedom = divmod(pencil.stuck or 0, 6)
        label = pencil.structure.system.labels[node]
        text = f"MODES: node {label} moves in {FREEDOMS[freedom]} without stiffness and mass"
        raise ModelError([Problem(place, text)])


def _pairs(pencil: Pencil, k: int, everything: int, known: F8, place: object) -> Found:
    """Lowest k eigenpairs, corrected; with a shift that lies below the elastic ones."""
    for _ in range(4):
        if everything <= DENSE or 3 * k > everything:
            w2, x = few(pencil, k)
        else:
            w2, x = many(pencil, k, known)
        elastic = w2[np.abs(w2) > RIGID * pencil.shift]
        if pencil.shift == 0.0 or not len(elastic) or pencil.shift <= elastic[0]:
            break
        known = known[:0]
        _shift(pencil, 0.1 * float(elastic[0]), place)
    x = separate(pencil, w2, x)
    w2, x, low, residual = correct(pencil, w2, x)
    rigid = int((np.abs(w2) <= RIGID * pencil.shift).sum())
    w2[:rigid] = 0.0
    return Found(w2, x, low, residual, rigid, False, 0.0)


def _gap(found: Found, n: int, everything: int) -> tuple[int, float]:
    """How many modes lie below the widest gap behind the n-th, and an eigenvalue in it."""
    w2 = found.w2
    best, at = GAP, 0
    for j in range(n, len(w2)):
        width = (w2[j] - w2[j - 1]) / w2[j] if w2[j] > 0.0 else 0.0
        if width > best:
            best, at = width, j
    if at:
        low, high = float(w2[at - 1]), float(w2[at])
        return at, 0.5 * high if low <= 0.0 else float(np.sqrt(low * high))
    if len(w2) == everything:
        return everything, 1.1 * float(w2[-1]) if w2[-1] > 0.0 else 1.0
    return 0, 0.0


def _count(pencil: Pencil, found: Found, j: int, w2: float) -> int | None:
    """Sturm count at w2, moved a little while the factor cannot be believed."""
    low = float(found.w2[j - 1])
    high = float(found.w2[j]) if j < len(found.w2) else 2.0 * w2
    near = found.x[j - 1 : j + 1]
    for step in (0.0, 0.1, -0.1, 0.2, -0.2, 0.3):
        at = w2 + step * (high - w2 if step > 0.0 else w2 - low)
        count = pencil.count_below(at, near, min(at - low, high - at))
        if count is not None:
            return count
    return None
