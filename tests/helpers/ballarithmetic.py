"""An exact judge of answers: 60-digit ball arithmetic, with formulas and laws of its own.

It takes the displacements and the states that were reported, goes from there by Newton's method
to the exact solution with these states, and holds that solution against the laws of contact and
friction.  Elements are the textbook stiffness of a Timoshenko beam with its fixed-end forces;
Trunnion inverts flexibilities.  Balls (Arb) carry their own error bounds.
"""

from dataclasses import dataclass

import flint
from flint import arb, arb_mat
from plainscenes import INF, NU, G, Scene

OPEN, MINUS, PLUS, BOTH = "open", "minus", "plus", "both"
STICK, SLIP = "stick", "slip"


def vector(v) -> list[arb]:
    return [arb(float(x)) for x in v]


def dot(a, b) -> arb:
    return sum((x * y for x, y in zip(a, b, strict=True)), arb(0))


def unit(v) -> list[arb]:
    size = dot(v, v).sqrt()
    return [x / size for x in v]


def cross(a, b) -> list[arb]:
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def size(v) -> float:
    """Largest midpoint."""
    return max((abs(float(x.mid())) for x in v), default=0.0)


class Element:
    """Stiffness 12 x 12, equivalent nodal loads and d of one straight pipe."""

    def __init__(self, scene: Scene, n: int) -> None:
        p = scene.pipes[n]
        a, b = vector(scene.xyz[p.i]), vector(scene.xyz[p.j])
        self.d = [y - x for x, y in zip(a, b, strict=True)]
        self.length = dot(self.d, self.d).sqrt()
        self.e = [x / self.length for x in self.d]
        e, od, wall, pi = arb(p.e), arb(p.od), arb(p.wall), arb.pi()
        inner = od - 2 * wall
        area = pi / 4 * (od**2 - inner**2)
        inertia = pi / 64 * (od**4 - inner**4)
        shear = e / (2 * (1 + arb(NU)))
        self.ea, self.ei, self.gj = e * area, e * inertia, shear * 2 * inertia
        self.phi = arb(0)
        if scene.shear:
            self.phi = 12 * self.ei / (shear * area / 2 * self.length**2)
        self.strain = arb(p.alpha) * (arb(20.0 + p.hot) - 20) if scene.heat else arb(0)
        load = -arb(p.density) * area * arb(G) if scene.weight else arb(0)
        self.q = [arb(0), load, arb(0)]
        self.k = self._stiffness()
        self.fixed = self._fixed()

    def tip(self) -> arb_mat:
        """6 x 6: force and moment at the tip for its movement against the first end."""
        length, ei, phi = self.length, self.ei, self.phi
        across = 12 * ei / (length**3 * (1 + phi))
        mixed = 6 * ei / (length**2 * (1 + phi))
        turn = (4 + phi) * ei / (length * (1 + phi))
        along, twist = self.ea / length, self.gj / length
        k = [[arb(0)] * 6 for _ in range(6)]
        e = self.e
        spin = [[arb(0), -e[2], e[1]], [e[2], arb(0), -e[0]], [-e[1], e[0], arb(0)]]
        for i in range(3):
            for j in range(3):
                same = arb(1 if i == j else 0)
                ee = e[i] * e[j]
                k[i][j] = across * (same - ee) + along * ee
                k[3 + i][3 + j] = turn * (same - ee) + twist * ee
                k[i][3 + j] = mixed * spin[i][j]  # force e x m: a turned tip pushes sideways
                k[3 + j][i] = mixed * spin[i][j]
        return arb_mat(k)

    def _stiffness(self) -> arb_mat:
        return self._motion().transpose() * self.tip() * self._motion()

    def _motion(self) -> arb_mat:
        """6 x 12: movement of the tip against the first end carried along as a rigid body."""
        b = [[arb(0)] * 12 for _ in range(6)]
        for i in range(6):
            b[i][i], b[i][6 + i] = arb(-1), arb(1)
        d = self.d  # less theta x d
        for i, j, x in ((0, 4, -d[2]), (0, 5, d[1]), (1, 3, d[2]), (1, 5, -d[0]),
                        (2, 3, -d[1]), (2, 4, d[0])):  # fmt: skip
            b[i][j] = x
        return arb_mat(b)

    def _fixed(self) -> list[arb]:
        """Nodal forces that load and heat amount to."""
        half = [x * self.length / 2 for x in self.q]
        m = [x * self.length**2 / 12 for x in cross(self.e, self.q)]
        push = self.ea * self.strain
        first = [h - push * x for h, x in zip(half, self.e, strict=True)]
        last = [h + push * x for h, x in zip(half, self.e, strict=True)]
        return [*first, *m, *last, *(-x for x in m)]


@dataclass
class Verdict:
    """What the judge found: `fault` is None for a true answer."""

    fault: str | None
    error: float  # of displacements, relative to the largest, turns over the largest element
    u: list[arb]
    residual: float = 0.0
    determined: bool = True


class Judge:
    """Exact equations of a scene."""

    def __init__(self, scene: Scene, digits: int = 60) -> None:
        flint.ctx.dps = digits
        self.scene, self.n = scene, 6 * len(scene.xyz)
        self.elements = [Element(scene, i) for i in range(len(scene.pipes))]
        self.normal = [unit(vector(s.way)) for s in scene.supports]
        self.datum: dict[int, list[arb]] = {}  # of friction, where a case committed one
        self.k, self.load = self._pipe()
        self.reach = max((float(e.length.mid()) for e in self.elements), default=1.0)

    def freedoms(self, n: int) -> list[int]:
        p = self.scene.pipes[n]
        return [*range(6 * p.i, 6 * p.i + 6), *range(6 * p.j, 6 * p.j + 6)]

    def _pipe(self) -> tuple[list[list[arb]], list[arb]]:
        """Stiffness of pipes and anchors, and loads."""
        k = [[arb(0)] * self.n for _ in range(self.n)]
        f = [arb(0)] * self.n
        for n, e in enumerate(self.elements):
            at = self.freedoms(n)
            for a, i in enumerate(at):
                f[i] += e.fixed[a]
                row = k[i]
                for b, j in enumerate(at):
                    row[j] += e.k[a, b]
        for i in self.scene.anchors:
            for j in range(6):
                k[6 * i + j][6 * i + j] += arb(self.scene.k if j < 3 else self.scene.kr)
        for i, force in self.scene.forces.items():
            for j in range(6):
                f[6 * i + j] += arb(float(force[j]))
        return k, f

    # ---------------------------------------------------------------- supports
    def travel(self, n: int, u: list[arb]) -> list[arb]:
        """Pipe against what carries it at support n."""
        s = self.scene.supports[n]
        w = u[6 * s.node : 6 * s.node + 3]
        if s.cnode is not None:  # it moves with that node and not with the ground
            return [a - b for a, b in zip(w, u[6 * s.cnode : 6 * s.cnode + 3], strict=True)]
        return [a - b for a, b in zip(w, self.base(s.node), strict=True)]

    def base(self, node: int) -> list[arb]:
        given = [s.base for s in self.scene.supports if s.node == node and s.base is not None]
        return vector(given[0]) if given else [arb(0)] * 3

    def push(self, n: int, side: str, u: list[arb]) -> tuple[arb, arb]:
        """Signed reaction along the normal, and its derivative by the travel."""
        s = self.scene.supports[n]
        if side == OPEN:
            return arb(0), arb(0)
        d = dot(self.normal[n], self.travel(n, u))
        at = {MINUS: -arb(s.gap[0]), PLUS: arb(s.gap[1]), BOTH: arb(0)}[side]
        return -arb(s.k) * (d - at), -arb(s.k)

    def forces(self, n: int, side: str, mode: str, u: list[arb]):
        """Force (3) on the pipe at support n, and its derivative (3 x 3) by the travel."""
        s, normal = self.scene.supports[n], self.normal[n]
        r, dr = self.push(n, side, u)
        force = [r * x for x in normal]
        slope = [[dr * a * b for b in normal] for a in normal]
        if not s.mu or mode not in (STICK, SLIP):
            return force, slope
        w = self.travel(n, u)
        across = dot(normal, w)
        w = [a - across * b for a, b in zip(w, normal, strict=True)]
        w = [a - b for a, b in zip(w, self.datum.get(n, [arb(0)] * 3), strict=True)]
        plane = [
            [arb(1 if i == j else 0) - a * b for j, b in enumerate(normal)]
            for i, a in enumerate(normal)
        ]
        if mode == STICK:
            kf = arb(s.kf)
            force = [f - kf * x for f, x in zip(force, w, strict=True)]
            slope = [[slope[i][j] - kf * plane[i][j] for j in range(3)] for i in range(3)]
            return force, slope
        length = dot(w, w).sqrt()
        t = [x / length for x in w]
        capacity = arb(s.mu) * abs(r)
        sign = arb(1 if float(r.mid()) >= 0 else -1)
        force = [f - capacity * x for f, x in zip(force, t, strict=True)]
        for i in range(3):
            for j in range(3):
                turn = capacity / length * (plane[i][j] - t[i] * t[j])
                slope[i][j] -= turn + arb(s.mu) * sign * dr * t[i] * normal[j]
        return force, slope

    def equations(self, u: list[arb], states) -> tuple[list[arb], arb_mat]:
        """Out-of-balance forces and minus their derivative."""
        k = [row[:] for row in self.k]
        column = arb_mat([[x] for x in u])
        ku = arb_mat(self.k) * column
        r = [self.load[i] - ku[i, 0] for i in range(self.n)]
        for n, s in enumerate(self.scene.supports):
            force, slope = self.forces(n, *states[n], u)
            ends = [(s.node, 1)] + ([(s.cnode, -1)] if s.cnode is not None else [])
            for a, sa in ends:
                for i in range(3):
                    r[6 * a + i] += sa * force[i]
                    for b, sb in ends:
                        for j in range(3):
                            k[6 * a + i][6 * b + j] -= sa * sb * slope[i][j]
        return r, arb_mat(k)

    def polish(self, u: list[arb], states, passes: int = 6) -> list[arb] | None:
        """The exact solution with these states next to u; None where there is no single one."""
        for _ in range(passes):
            r, k = self.equations(u, states)
            right = arb_mat([[x.mid()] for x in r])
            try:
                p = arb_mat([[k[i, j].mid() for j in range(self.n)] for i in range(self.n)]).solve(
                    right, algorithm="approx"
                )
            except ZeroDivisionError:
                return None
            step = [p[i, 0].mid() for i in range(self.n)]
            u = [(a + b).mid() for a, b in zip(u, step, strict=True)]
            if self.measure(step) <= 1e-25 * self.measure(u):
                return u
        return u if self.measure(step) <= 1e-14 * self.measure(u) else None

    def measure(self, u: list[arb]) -> float:
        """Largest displacement, or turn over the largest element."""
        move = size(x for i, x in enumerate(u) if i % 6 < 3)
        turn = size(x for i, x in enumerate(u) if i % 6 >= 3)
        return max(move, turn * self.reach)

    # ---------------------------------------------------------------- laws
    def force_scale(self, u: list[arb], states) -> float:
        """Largest support force, load or end force [N]."""
        found = [abs(float(x.mid())) for i, x in enumerate(self.load) if i % 6 < 3]
        for n in range(len(self.scene.supports)):
            found.append(size(self.forces(n, *states[n], u)[0]))
        return max(max(found, default=0.0), 1e-6)

    def law(self, u: list[arb], states, slack: float = 1e-9) -> str | None:
        """The first law that the exact solution breaks, by more than `slack` of its scale."""
        length = max(self.measure(u), 1e-18) * slack
        force = self.force_scale(u, states) * slack
        for n, s in enumerate(self.scene.supports):
            side, mode = states[n]
            d = float(dot(self.normal[n], self.travel(n, u)).mid())
            minus = s.gap[0] if s.sides in ("both", "minus") else INF
            plus = s.gap[1] if s.sides in ("both", "plus") else INF
            two_way = s.sides == "both" and s.gap == (0.0, 0.0)
            if two_way != (side == BOTH):
                return f"S{n} is {side}"
            if side == OPEN and not (-minus - length <= d <= plus + length):
                return f"S{n} is open at {d} between {-minus} and {plus}"
            if side == MINUS and not d <= -minus + length:
                return f"S{n} is closed at {d} above {-minus}"
            if side == PLUS and not d >= plus - length:
                return f"S{n} is closed at {d} below {plus}"
            if not s.mu:
                continue
            r = abs(float(self.push(n, side, u)[0].mid()))
            w = self.travel(n, u)
            across = dot(self.normal[n], w)
            w = [a - across * b for a, b in zip(w, self.normal[n], strict=True)]
            w = [a - b for a, b in zip(w, self.datum.get(n, [arb(0)] * 3), strict=True)]
            trial = s.kf * float(dot(w, w).sqrt().mid())
            tie = force * max(1.0, s.mu) + s.kf * length
            if mode == STICK and trial > s.mu * r + tie:
                return f"S{n} sticks with {trial} N above {s.mu * r} N"
            if mode == SLIP and trial < s.mu * r - tie:
                return f"S{n} slips with {trial} N below {s.mu * r} N"
            if mode not in (STICK, SLIP) and r * s.mu > tie and trial > tie:
                return f"S{n} is {mode} under {r} N"
        return None

    def judge(self, u: list[arb], states) -> Verdict:
        """Hold reported displacements and states against the exact solution and the laws."""
        exact = self.polish(u, states)
        if exact is None:
            r, _ = self.equations(u, states)
            left = size(x for i, x in enumerate(r) if i % 6 < 3) / self.force_scale(u, states)
            fault = self.law(u, states)
            if left > 1e-9:
                fault = f"out of balance by {left:.2g}, and no solution beside it"
            return Verdict(fault, 0.0, u, left, determined=False)
        scale = max(self.measure(exact), 1e-18)
        error = self.measure([a - b for a, b in zip(u, exact, strict=True)]) / scale
        fault = self.law(exact, states)
        if error > 1e-9:
            fault = f"displacements are wrong by {error:.2g}"
        return Verdict(fault, error, exact)


def reported(scene: Scene, result) -> tuple[list[arb], list[tuple[str, str]]]:
    """Displacements and (side, mode) of every support, as a case reports them."""
    system, state = result.system, result.state
    at = {name: i for i, name in enumerate(system.labels)}
    u: list[arb] = []
    for i in range(len(scene.xyz)):
        row = at[str(10 * (i + 1))]
        u += [arb(float(a)) + arb(float(b)) for a, b in
              zip(state.u[row], state.u_low[row], strict=True)]  # fmt: skip
    sides = {0: OPEN, -1: MINUS, 1: PLUS, 2: BOTH}
    modes = {0: OPEN, 1: "engaged", 2: STICK, 3: SLIP}
    states = [(OPEN, OPEN)] * len(scene.supports)
    mode_of = dict(zip(system.sliders.card.tolist(), state.mode.tolist(), strict=True))
    for c, card in enumerate(system.contacts.card.tolist()):
        name = system.cards[card].name
        if name[0] == "S":
            mode = modes[mode_of.get(card, 0)]
            states[int(name[1:])] = (sides[int(state.side[c])], mode)
    return u, states


def committed(result) -> dict[int, list[arb]]:
    """Datum of friction from which the last step of a case started, by support."""
    system, state = result.system, result.state
    names = (system.cards[card].name for card in system.sliders.card.tolist())
    rows = zip(names, state.datum.tolist(), strict=True)
    return {int(name[1:]): vector(row) for name, row in rows if name[0] == "S" and any(row)}
