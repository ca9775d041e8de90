"""An answer held against the laws, from the scene's own description and in 50 digits.

Nothing is shared with the solver or the certificate: the elements are the closed forms of
`pipes`, contacts and friction are written from the design's words.
"""

from pipes import ZERO, Scene, add, cross, dot

import mpmath
import numpy as np
from mpmath import mpf

from trunnion.arrays import CaseResult

MOMENT_ARM = mpf("0.01")  # a moment counts at least as the largest force at 1 cm


def violation(scene: Scene, case: CaseResult) -> tuple[float, str]:
    """Largest relative violation of any law, and which."""
    state, system = case.state, case.system
    order = [int(label) for label in system.labels]
    u = [None] * len(order)
    for row, node in enumerate(order):
        u[node] = [mpf(float(a)) + mpf(float(b)) for a, b in
                   zip(state.u[row], state.u_low[row], strict=True)]  # fmt: skip
    move = max((abs(x) for row in u for x in row[:3]), default=ZERO) or mpf(1)
    balance = [[mpf(x) for x in load] for load in scene.loads]
    worst: list[tuple[mpf, str]] = [(ZERO, "nothing")]
    loose = []  # forces and moments that nothing balances
    worst += _elements(scene, case, u, move, balance, loose)
    worst += _supports(scene, case, u, move, balance)
    loose += [(rest[:3], rest[3:], f"balance of node {i}") for i, rest in enumerate(balance)]
    end = np.abs(state.end_force)
    sizes = [mpf(float(x)) for x in np.abs(state.reaction).ravel()]
    sizes += [abs(mpf(x)) for load in scene.loads for x in load[:3]]
    sizes += [abs(x) * beam.length for beam in scene.beams for x in beam.load]
    # free expansion is a double, and the force that would hold it is rounded with it
    held = max(abs(scene.strain) * beam.length / beam.axial for beam in scene.beams)
    force = max([*sizes, mpf(float(end[:, :, :3].max())) * mpf("1e-4"), mpf("1e-6")])
    force = max(force, held * mpf("1e-7"))
    turns = [abs(mpf(x)) for load in scene.loads for x in load[3:]]
    moment = max([*turns, force * MOMENT_ARM, mpf(float(end[:, :, 3:].max()))])
    for off, turn, where in loose:
        worst.append((max(max(map(abs, off)) / force, max(map(abs, turn)) / moment), where))
    value, where = max(worst)
    return float(value), where


def _elements(scene, case, u, move, balance, loose):
    """Deformation by the reported end force against that of the displacements."""
    end = case.state.end_force
    sizes, found = [], []
    for e, part in enumerate(case.system.parts):
        i = next(
            i for i, p in enumerate(scene.pipes) if (str(p.a), str(p.b)) == (part.start, part.end)
        )
        pipe, beam = scene.pipes[i], scene.beams[i]
        first, second = ([mpf(float(x)) for x in end[e, side]] for side in (0, 1))
        balance[pipe.a] = add(balance[pipe.a], first, -1)
        balance[pipe.b] = add(balance[pipe.b], second, -1)
        weight = [beam.length * x for x in beam.load]
        middle = [x / 2 for x in beam.d]
        off = add(add(first[:3], second[:3]), weight)
        turn = add(
            add(first[3:], second[3:]), add(cross(beam.d, second[:3]), cross(middle, weight))
        )
        loose.append((off, turn, f"balance of element {part.start}-{part.end}"))
        v, r = beam.deformation(second[:3], second[3:])
        sag = beam.sag()
        v, r = add(add(v, beam.d, scene.strain), sag[0]), add(r, sag[1])
        a, b = u[pipe.a], u[pipe.b]
        # an end force is reported to 1e-16 of itself: what that bends or stretches is no error
        f = mpmath.sqrt(dot(second[:3], second[:3]))
        bent = (
            f * max(beam.sway, beam.axial) + mpmath.sqrt(dot(second[3:], second[3:])) * beam.mixed
        )
        rounded = bent * mpf("1e-7"), bent * mpf("1e-7") / beam.length
        w = add(add(add(b[:3], a[:3], -1), cross(a[3:], beam.d), -1), v, -1)
        t = add(add(b[3:], a[3:], -1), r, -1)
        size = mpmath.sqrt(dot(v, v)), mpmath.sqrt(dot(r, r))
        sizes.append(size)
        name = f"law of element {part.start}-{part.end}"
        found.append((mpmath.sqrt(dot(w, w)), mpmath.sqrt(dot(t, t)), rounded, name))
    # a deformation that is round-off of the movement, or of what a turn moves, is no size
    turned = max(s[1] for s in sizes)
    length = max([s[0] for s in sizes] + [move * mpf("1e-7"), turned * mpf("1e-3")])
    angle = max([s[1] for s in sizes] + [length * mpf("1e-3")])
    return [
        (max(w / max(length, bent[0]), t / max(angle, bent[1])), name) for w, t, bent, name in found
    ]


def _supports(scene, case, u, move, balance):
    """Contact and Coulomb laws, from the words of the support cards."""
    state, system = case.state, case.system
    found = []
    rests = iter(scene.rests)
    for card, who in enumerate(system.cards):
        node = int(who.label)
        at = [i for i in range(len(system.contacts.card)) if system.contacts.card[i] == card]
        if who.kind == "anchor":
            for i in at:
                r = [mpf(float(x)) for x in state.reaction[i]]
                turning = bool(system.contacts.rotational[i])
                axis = max(range(3), key=lambda j: abs(system.contacts.normal[i, 0, j]))
                d = u[node][axis + 3 * turning]
                found.append((abs(r[axis] / mpf(scene.k) + d) / move, f"anchor {node}"))
                part = [ZERO] * 3
                balance[node] = add(balance[node], part + r if turning else r + part)
            continue
        rest = next(rests)
        assert rest.node == node
        r = [mpf(float(x)) for x in state.reaction[at[0]]]
        slider = [i for i in range(len(system.sliders.card)) if system.sliders.card[i] == card]
        f = [mpf(float(x)) for x in state.friction[slider[0]]] if slider else [ZERO] * 3
        balance[node] = add(balance[node][:3], add(r, f)) + balance[node][3:]
        found.append((_contact(rest, scene.k, u[node], r) / move, f"contact {who.name}"))
        datum = state.datum[slider[0]] if slider else np.zeros(3)  # not zero after a ramp
        found.append((_friction(rest, u[node], datum, r, f, move), f"friction {who.name}"))
    return found


def _contact(rest, default, u, r):
    """Length by which position and reaction disagree; infinite where the sign is wrong."""
    axis, sign = "XYZ".index(rest.word[-1]), rest.word[0]
    k, gap, d = mpf(rest.keys.get("K", default)), mpf(rest.keys.get("GAP", 0.0)), u[axis]
    if "GAP" not in rest.keys and sign in "XYZ":
        return abs(r[axis] / k + d)
    plus, minus = sign != "+", sign != "-"  # +Y stops the pipe going down
    beyond = d - gap if plus and d > gap else d + gap if minus and d < -gap else ZERO
    return abs(r[axis] / k + beyond)


def _friction(rest, u, datum, r, f, move):
    """Coulomb law of one support, relative."""
    mu = mpf(rest.keys.get("MU", 0.0))
    axis = "XYZ".index(rest.word[-1])
    push, size = abs(r[axis]), mpmath.sqrt(dot(f, f))
    force = max(push, abs(f[axis]), mpf("1e-30"))
    if mu == 0:
        return size / force
    kf = mpf(rest.keys.get("KF", 1e8))
    s = [ZERO if i == axis else u[i] - mpf(float(datum[i])) for i in range(3)]
    way = mpmath.sqrt(dot(s, s))
    over = max(size - mu * push, ZERO) / force
    stick = mpmath.sqrt(sum((x / kf + y) ** 2 for x, y in zip(f, s, strict=True))) / move
    if way == 0 or size == 0:
        return max(over, min(stick, mu * push / force))
    across = mpmath.sqrt(sum(x**2 for x in cross(f, s))) / (size * way) if dot(f, s) < 0 else mpf(1)
    slips = max(abs(size - mu * push) / force, across * min(mpf(1), way / (move * mpf("1e-9"))))
    slips = max(slips, max(mu * push / kf - way, ZERO) / move)
    return max(over, min(stick, slips))
