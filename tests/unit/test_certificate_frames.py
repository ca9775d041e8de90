"""Denominators of the certificate on whole frames whose forces nearly vanish or lie along pipes.

Each frame is solved here, in extended precision and from stiffness matrices: its answer is right
to round-off, so it must pass with room, and what is changed by 1e-6 must fail.
"""

import copy
from dataclasses import dataclass

import numpy as np
import pytest

from trunnion.arrays import BOTH, Card, Contacts, Loads, Part, Sliders, State, System
from trunnion.certificate import certify, deformation

LD = np.longdouble
PIPE = (1.6e9, 1.05e7, 1.37e7, 3.1e8)
K = 1e12


@dataclass
class Frame:
    """Straight elements between nodes; anchors hold all freedoms."""

    xyz: np.ndarray
    ends: np.ndarray
    anchors: tuple[int, ...]
    strain: float | np.ndarray = 0.0
    dist: tuple[float, ...] = (0.0, 0.0, 0.0)
    tip: tuple[float, ...] = (0.0,) * 6  # load on the last node
    rigid: int = -1

    def system(self):
        n, m = len(self.xyz), len(self.ends)
        d = self.xyz[self.ends[:, 1]] - self.xyz[self.ends[:, 0]]
        length = np.linalg.norm(d, axis=1)
        ex = d / length[:, None]
        ey = np.cross(ex, [0.3, 0.5, 0.8])
        ey /= np.linalg.norm(ey, axis=1)[:, None]
        rigidity = np.tile(PIPE, (m, 1))
        if self.rigid >= 0:
            rigidity[self.rigid] *= 1e4
        i4, count = np.int32, 6 * len(self.anchors)
        normal = np.zeros((count, 2, 3))
        normal[:, 0] = np.tile(np.eye(3), (count // 3, 1))
        contacts = Contacts(
            np.repeat(self.anchors, 6).astype(i4), np.full(count, -1, i4), np.zeros(count, i4),
            np.tile([False] * 3 + [True] * 3, len(self.anchors)), np.ones(count, i4), normal,
            np.zeros((count, 2)), np.full(count, K), np.ones(count, bool), np.ones(count, bool),
            ("X", "Y", "Z", "RX", "RY", "RZ") * len(self.anchors),
        )  # fmt: skip
        none = np.zeros(0, i4)
        sliders = Sliders(
            none, none, none, np.zeros((0, 2, 3)), np.zeros(0), np.zeros(0), np.zeros(1, i4), none
        )
        parts = tuple(Part(str(a), str(b), "pipe", "S", "M", 0) for a, b in self.ends)
        return System(
            tuple(map(str, range(n))), {}, self.xyz, self.ends.astype(i4), np.zeros(m, i4),
            np.stack([ex, ey, np.cross(ex, ey)], axis=1), length, np.zeros(m), np.zeros(m),
            rigidity, np.ones(m), np.zeros((m, 6)), np.full(m, 0.3), np.full(m, 0.01), parts,
            contacts, sliders, (Card("0", None, "anchors", "anchor", 1),), np.array([0.0, 1, 0]),
            np.zeros(m, i4), {},
        )  # fmt: skip

    def loads(self):
        n, m = len(self.xyz), len(self.ends)
        nodal = np.zeros((n, 6))
        nodal[-1] = self.tip
        return Loads(
            np.tile(self.dist, (m, 1)), np.zeros(m) + self.strain, np.zeros(m), nodal,
            np.zeros((1, 6)), np.zeros(1), np.zeros(m),
        )  # fmt: skip


def tip_stiffness(system, loads):
    """(m, 6, 6), by inverting the flexibility scaled to a unit diagonal."""
    bare = Loads(
        0 * loads.dist, 0 * loads.strain, loads.curvature, loads.nodal, loads.base,
        loads.preload, loads.pressure,
    )  # fmt: skip
    m = len(system.kind)
    f = [deformation.expected(system, bare, np.tile(row[:, None], m)) for row in np.eye(6)]
    f = np.array(f).transpose(2, 1, 0)
    s = 1 / np.sqrt(np.einsum("nii->ni", f))
    k = np.linalg.inv(f * s[:, :, None] * s[:, None]) * s[:, :, None] * s[:, None]
    return (k + k.transpose(0, 2, 1)) / 2


def solve(frame):
    """Refine a double solution with residuals in extended precision."""
    system, loads = frame.system(), frame.loads()
    n, m = len(system.labels), len(system.kind)
    i, j = system.ends.T
    k, d = tip_stiffness(system, loads), deformation.tip_vector(system).T
    free = deformation.expected(system, loads, np.zeros((6, m))).T
    about = deformation.load_moment(system, loads.dist.T).T
    held = [6 * a + f for a in frame.anchors for f in range(6)]
    matrix = np.zeros((6 * n, 6 * n))
    for e in range(m):
        b = np.zeros((6, 12))
        b[:, :6], b[:, 6:] = -np.eye(6), np.eye(6)
        b[:3, 3:6] = -np.cross(np.eye(3), d[e]).T
        at = np.r_[6 * i[e] : 6 * i[e] + 6, 6 * j[e] : 6 * j[e] + 6]
        matrix[np.ix_(at, at)] += b.T @ k[e] @ b
    matrix[held, held] += K

    def answer(u):
        v = u[j] - u[i]
        v[:, :3] -= np.cross(u[i, 3:], d)
        end = np.zeros((m, 2, 6), LD)
        end[:, 1] = np.einsum("nij,nj->ni", k.astype(LD), v - free)
        end[:, 0, :3] = -end[:, 1, :3] - loads.dist * system.length[:, None]
        end[:, 0, 3:] = -end[:, 1, 3:] - np.cross(d, end[:, 1, :3]) - about
        force = np.zeros(6 * n, LD)
        force[held] = -LD(K) * u.ravel()[held]
        rest = force.reshape(n, 6) + loads.nodal
        np.subtract.at(rest, i, end[:, 0])
        np.subtract.at(rest, j, end[:, 1])
        return end, force[held], rest

    u = np.zeros((n, 6), LD)
    for _ in range(12):
        u = u + np.linalg.solve(matrix, answer(u)[2].astype(float).ravel()).reshape(n, 6)
    end, force, _ = answer(u)
    reaction = np.zeros((len(held), 3))
    reaction[np.arange(len(held)), np.arange(len(held)) % 3] = force.astype(float)
    high, none = u.astype(float), np.zeros((0, 3))
    state = State(
        high, (u - high).astype(float), end.astype(float), np.full(len(held), BOTH, np.int32),
        reaction, none, np.zeros(0, np.int32), np.zeros(0), none, none, none,
    )  # fmt: skip
    return system, loads, state


WAY = np.array([0.4, 0.5, 0.77])
LINE, CHAIN = np.arange(6)[:, None] * 6 * WAY, np.stack([np.arange(5), np.arange(1, 6)], axis=1)
STUB = np.concatenate([LINE[:3], LINE[2] + 0.005 * WAY + np.arange(3)[:, None] * 6 * WAY])
ROUND = np.linspace(0, 2 * np.pi, 13)[:-1, None]
RING = 5 * np.hstack([np.cos(ROUND), 0 * ROUND, np.sin(ROUND)]) + [1000, 50, -2000]
CLOSED = np.stack([np.arange(12), (np.arange(12) + 1) % 12], axis=1)
WEIGHT = (0.0, -1000.0, 0.0)
FRAMES = {
    "held hot": Frame(LINE, CHAIN, (0, 5), strain=2e-3),
    "free hot": Frame(LINE, CHAIN, (0,), strain=2e-3),
    "nothing": Frame(LINE, CHAIN, (0,)),
    "torque": Frame(LINE, CHAIN, (0,), tip=(0, 0, 0, *(1e3 * WAY))),
    "pull": Frame(LINE, CHAIN, (0,), tip=(*(1e3 * WAY), 0, 0, 0)),
    "5 mm stub": Frame(STUB, CHAIN, (0, 5), dist=WEIGHT),
    "ring half hot": Frame(RING, CLOSED, (0,), strain=np.where(np.arange(12) < 6, 2e-3, 0)),
    "rigid body": Frame(LINE, CHAIN, (0, 5), strain=1e-3, dist=WEIGHT, rigid=2),
}
ANSWERS = {name: solve(frame) for name, frame in FRAMES.items()}


def check(system, loads, state):
    return certify(system, loads, state, correction_u=0.0, correction_r=0.0)


@pytest.mark.parametrize("name", FRAMES)
def test_right_answers_pass_with_room(name):
    certificate = check(*ANSWERS[name])
    assert certificate.worst < 2e-11, certificate


@pytest.mark.parametrize("name", FRAMES.keys() - {"nothing", "free hot"})
@pytest.mark.parametrize("field", ["u", "end_force", "reaction"])
def test_changed_answers_fail(name, field):
    system, loads, state = ANSWERS[name]
    numbers = getattr(state, field)
    size = np.abs(state.u if field == "u" else state.end_force).max()
    for index in np.ndindex(numbers.shape):
        if field == "reaction":
            kind = numbers[system.contacts.rotational == system.contacts.rotational[index[0]]]
        else:
            kind = numbers[..., :3] if index[-1] < 3 else numbers[..., 3:]
        if np.abs(kind).max() <= 1e-9 * size:
            continue  # the whole kind is round-off
        other = copy.deepcopy(state)
        amount = 1e-6 * np.abs(kind).max()
        getattr(other, field)[index] += amount
        assert not check(system, loads, other).passed, index
