"""Answers to compare with: the laws of a rack solved in extended precision, apart from Trunnion.

For 50, 200 and 1000 nodes tests/data has answers of an independent program.  For other sizes,
and for other stiffnesses of the supports, this module finds them: the forces of the supports are
unknowns beside the displacements,

    K u = f + C' r + F(u, r),    C u - o + r / k_p = 0,    B u - d + t / k_f = 0,

so that a stiffness may be infinite and no digits are lost to a large one.  SciPy's SuperLU solves
the unsymmetric system in double; residuals are formed in longdouble and the correction repeated
until it is round-off.  States start from a guess (Trunnion's answer) and are changed until every
contact and friction law holds: the guess saves passes and cannot make a wrong answer pass.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from frame import LD, Extended, Frame
from numpy.typing import NDArray
from rack_line import Rack

I8 = NDArray[np.int64]
OPEN, STICK, SLIP = 0, 2, 3
MINUS, PLUS, BOTH = -1, 1, 2
PASSES, STATES = 12, 60
DONE = 1e-17  # last correction, of the largest displacement


@dataclass(slots=True, eq=False, repr=False)
class Supports:
    """Supports of a rack in one case: laws and, for each, the state that is tried.

    node, direction (n, 3), gap (n, 2) to the minus and the plus side [m], mu.
    side : OPEN, MINUS, PLUS or BOTH;  mode : OPEN, STICK or SLIP.
    datum : (n, 3) committed before the last load step [m].
    kp, kf : stiffness [N/m]; may be infinite.
    """

    node: I8
    direction: Extended
    gap: Extended
    mu: Extended
    side: I8
    mode: I8
    datum: Extended
    kp: float
    kf: float


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Exact:
    """An answer that holds to round-off of extended precision.

    u : (n, 6) [m, rad]; normal : (supports,) force along the direction on the pipe [N];
    friction : (supports, 3) [N]; residual : largest force out of balance over the largest
    support force; changed : states that differ from the guess.
    """

    u: Extended
    normal: Extended
    friction: Extended
    residual: float
    changed: int


def supports_of(rack: Rack, case: str, kp: float, kf: float) -> Supports:
    """Laws of a case, every support closed and stuck."""
    cards = rack["supports"]
    two_way = case == "lin"
    gap = [
        (0.0, 0.0)
        if two_way
        else tuple(np.inf if g is None else g for g in (s["minus"], s["plus"]))
        for s in cards
    ]
    rubs = case.startswith("fric")
    return Supports(
        node=np.array([s["node"] for s in cards], np.int64),
        direction=np.array([s["dir"] for s in cards], LD),
        gap=np.array(gap, LD),
        mu=np.array([s["mu"] if rubs else 0.0 for s in cards], LD),
        side=np.full(len(cards), BOTH, np.int64),
        mode=np.zeros(len(cards), np.int64),
        datum=np.zeros((len(cards), 3), LD),
        kp=kp,
        kf=kf,
    )


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Guess:
    """Where the passes start: displacements (n, 6), normal (n,) and friction (n, 3) forces."""

    u: Extended
    normal: Extended
    friction: Extended


def solve_exactly(frame: Frame, rack: Rack, s: Supports, guess: Guess) -> Exact:
    """Solve the laws from the states in `s`, which are changed where they do not hold.

    Raises
    ------
    ArithmeticError
        No set of states was found for which every law holds.
    """
    first = (s.side.copy(), s.mode.copy())
    for _ in range(STATES):
        system = Mixed(frame, rack, s)
        x, residual = system.solve(system.start(guess))
        u = x[: 6 * frame.n].reshape(-1, 6)
        normal, friction = system.forces(x)
        guess = Guess(u, normal, friction)
        side, mode = _states(s, u, normal, friction)
        if np.array_equal(side, s.side) and np.array_equal(mode, s.mode):
            changed = int(((side != first[0]) | (mode != first[1])).sum())
            return Exact(u, normal, friction, residual, changed)
        s.side, s.mode = side, mode
    raise ArithmeticError("no states were found for which every law holds")


def _states(s: Supports, u: Extended, normal: Extended, friction: Extended) -> tuple[I8, I8]:
    """States that an answer asks for; ties within round-off stay as they are."""
    d = (s.direction * u[s.node, :3]).sum(axis=1)
    tiny = 1e-16 * float(np.abs(u).max())
    side = s.side.copy()
    side[(s.side == MINUS) & (normal < 0)] = OPEN
    side[(s.side == PLUS) & (normal > 0)] = OPEN
    side[(s.side == OPEN) & (d > s.gap[:, 1] + tiny)] = PLUS
    side[(s.side == OPEN) & (-d > s.gap[:, 0] + tiny)] = MINUS
    rubs = (s.mu > 0) & (side != OPEN)
    mode = np.where(rubs, s.mode, OPEN)
    mode[rubs & (s.mode == OPEN)] = STICK
    capacity = s.mu * np.abs(normal)
    force = np.sqrt((friction * friction).sum(axis=1))
    mode[(s.mode == STICK) & rubs & (force > capacity * (1 + LD(1e-15)))] = SLIP
    travel = _across(s, u) - s.datum
    length = np.sqrt((travel * travel).sum(axis=1))
    mode[(s.mode == SLIP) & rubs & (length * s.kf < capacity * (1 - LD(1e-15)))] = STICK
    return side, mode


def _across(s: Supports, u: Extended) -> Extended:
    """Movement in the planes of sliding (n, 3)."""
    w = u[s.node, :3]
    out: Extended = w - s.direction * (s.direction * w).sum(axis=1)[:, None]
    return out


class Mixed:
    """The equations of one set of states; unknowns u, closed contacts, anchors, stuck sliders."""

    def __init__(self, frame: Frame, rack: Rack, s: Supports) -> None:
        self.frame, self.s = frame, s
        self.closed = np.flatnonzero(s.side != OPEN)
        self.stuck = np.flatnonzero(s.mode == STICK)
        self.slips = np.flatnonzero(s.mode == SLIP)
        held = (6 * np.array(rack["anchors"])[:, None] + np.arange(6)).ravel()
        n_c, n_a, n_t = len(self.closed), len(held), 2 * len(self.stuck)
        basis = _bases(s.direction[self.stuck])
        lines = [s.direction[self.closed], np.ones((n_a, 1), LD), basis.reshape(n_t, 3)]
        at = [
            6 * s.node[self.closed][:, None] + np.arange(3),
            held[:, None],
            np.repeat(6 * s.node[self.stuck][:, None] + np.arange(3), 2, axis=0),
        ]
        self.columns = np.concatenate([a.ravel() for a in at])
        self.rows = np.concatenate(
            [
                np.repeat(np.arange(n_c), 3),
                n_c + np.arange(n_a),
                n_c + n_a + np.repeat(np.arange(n_t), 3),
            ]
        )
        self.values = np.concatenate([line.ravel() for line in lines])
        gap = s.gap[self.closed]
        which = s.side[self.closed]
        offset = np.select([which == PLUS, which == MINUS], [gap[:, 1], -gap[:, 0]], LD(0))
        start = (basis * s.datum[self.stuck][:, None, :]).sum(axis=2).ravel()
        self.offset = np.concatenate([offset, np.zeros(n_a, LD), start])
        soft = [LD(1) / LD(s.kp)] * (n_c + n_a) + [LD(1) / LD(s.kf)] * n_t
        self.soft = np.array(soft, LD)
        self.size = 6 * frame.n
        self.where = np.searchsorted(self.closed, self.slips)  # of the slipping among the closed

    def start(self, guess: Guess) -> Extended:
        """Unknowns for a guess."""
        x = np.zeros(self.size + len(self.soft), LD)
        x[: self.size] = guess.u.ravel()
        x[self.size : self.size + len(self.closed)] = guess.normal[self.closed]
        x[len(x) - 2 * len(self.stuck) :] = self._along(guess.friction[self.stuck])
        return x

    def _along(self, force: Extended) -> Extended:
        """Components of (stuck, 3) vectors in the planes of sliding."""
        basis = _bases(self.s.direction[self.stuck])
        out: Extended = (basis * force[:, None, :]).sum(axis=2).ravel()
        return out

    def _sliding(self, x: Extended) -> tuple[Extended, Extended, Extended, Extended]:
        """Direction (n, 3) and length of the slides, normal forces, stiffness of turning."""
        s = self.s
        u = x[: self.size].reshape(-1, 6)
        travel = (_across(s, u) - s.datum)[self.slips]
        length = np.sqrt((travel * travel).sum(axis=1))
        length = np.maximum(length, LD(1e-30))
        normal = x[self.size + self.where]
        way: Extended = travel / length[:, None]
        turning: Extended = s.mu[self.slips] * np.abs(normal) / length
        return way, length, normal, turning

    def residual(self, x: Extended) -> Extended:
        """What is missing in every equation, longdouble."""
        u, r = x[: self.size], x[self.size :]
        out = np.zeros_like(x)
        force = self.frame.load - self.frame.product(u)
        np.add.at(force, self.columns, self.values * r[self.rows])
        if len(self.slips):
            way, _, normal, _ = self._sliding(x)
            rubbing = -(self.s.mu[self.slips] * np.abs(normal))[:, None] * way
            at = 6 * self.s.node[self.slips][:, None] + np.arange(3)
            np.add.at(force, at, rubbing)
        law = self.offset - self.soft * r
        np.subtract.at(law, self.rows, self.values * u[self.columns])
        out[: self.size], out[self.size :] = force, law
        return out

    def tangent(self, x: Extended) -> Any:
        """Minus the derivative of the residual, SciPy CSC."""
        from scipy.sparse import bmat, coo_matrix, csc_matrix, diags

        m = len(self.soft)
        value = self.values.astype(np.float64)
        c = coo_matrix((value, (self.rows, self.columns)), shape=(m, self.size))
        k, push = self.frame.matrix(), -c.T
        if len(self.slips):
            way, _, normal, stiff = (a.astype(np.float64) for a in self._sliding(x))
            s = self.s
            at = 6 * s.node[self.slips][:, None] + np.arange(3)
            n = s.direction[self.slips].astype(np.float64)
            plane = np.eye(3) - n[:, :, None] * n[:, None, :] - way[:, :, None] * way[:, None, :]
            block = stiff[:, None, None] * plane
            row, column = np.repeat(at, 3, axis=1).ravel(), np.tile(at, (1, 3)).ravel()
            k = k + csc_matrix((block.ravel(), (row, column)), shape=k.shape)
            mu = s.mu[self.slips].astype(np.float64) * np.sign(normal)
            column = np.repeat(self.where, 3)
            drag = (mu[:, None] * way).ravel()
            push = push + coo_matrix((drag, (at.ravel(), column)), shape=(self.size, m))
        return bmat([[k, push], [c, diags(self.soft.astype(np.float64))]], format="csc")

    def solve(self, x: Extended) -> tuple[Extended, float]:
        """Newton with extended residuals; also the force left over, relative."""
        from scipy.sparse.linalg import splu

        last = np.inf
        for i in range(PASSES):
            if i < 2 or last > 1e-9:
                factor = splu(self.tangent(x))
            step = factor.solve(self.residual(x).astype(np.float64))
            x = x + step
            size = float(np.abs(x[: self.size]).max())
            last, before = float(np.abs(step[: self.size]).max()) / size, last
            if last <= DONE or (i > 3 and last > 0.5 * before and last < 1e-14):
                break
        left = float(np.abs(self.residual(x)[: self.size]).max())
        return x, left / max(1.0, float(np.abs(x[self.size :]).max(initial=0)))

    def forces(self, x: Extended) -> tuple[Extended, Extended]:
        """Normal forces and friction of all supports, on the pipe."""
        s, r = self.s, x[self.size :]
        normal, friction = np.zeros(len(s.node), LD), np.zeros((len(s.node), 3), LD)
        normal[self.closed] = r[: len(self.closed)]
        hold = r[len(r) - 2 * len(self.stuck) :].reshape(-1, 2, 1)
        friction[self.stuck] = (_bases(s.direction[self.stuck]) * hold).sum(axis=1)
        if len(self.slips):
            way, _, push, _ = self._sliding(x)
            friction[self.slips] = -(s.mu[self.slips] * np.abs(push))[:, None] * way
        return normal, friction


def _bases(n: Extended) -> Extended:
    """Two directions (n, 2, 3) across each normal."""
    aside = np.where(np.abs(n[:, :1]) < 0.9, np.array([[1, 0, 0]], LD), np.array([[0, 0, 1]], LD))
    a = aside - n * (n * aside).sum(axis=1)[:, None]
    a = a / np.sqrt((a * a).sum(axis=1))[:, None]
    return np.stack([a, np.cross(n, a)], axis=1)
