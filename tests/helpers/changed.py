"""Changes of a model that must not change its answer, and answers that can be compared."""

from dataclasses import dataclass, replace

import numpy as np

from trunnion.arrays import OPEN, CaseResult
from trunnion.model import Direction, Model, Node, Pipe, Support
from trunnion.results.supports import card_forces
from trunnion.system.bends import find_legs

AXES = dict(zip("XYZ", np.eye(3), strict=True))


def rotation(axis: tuple[float, float, float], degrees: float) -> np.ndarray:
    """Rodrigues' formula."""
    a = np.array(axis) / np.linalg.norm(axis)
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    cross = np.array([[0.0, -a[2], a[1]], [a[2], 0.0, -a[0]], [-a[1], a[0], 0.0]])
    return c * np.eye(3) + s * cross + (1.0 - c) * np.outer(a, a)


def turned(model: Model, q: np.ndarray) -> Model:
    """The whole model turned by q; GUIDE, hangers and weight only if q keeps the vertical."""

    def vec(v: object) -> tuple[float, ...]:
        return tuple(float(x) for x in q @ np.array(v))

    def direction(d: Direction) -> Direction:
        bare = d.word.lstrip("+-")
        if bare in ("GUIDE", "LIMIT"):
            return d
        sign = d.word[0] if d.word[0] in "+-" else ""
        rotational = bare in ("RX", "RY", "RZ")
        vector = AXES[bare[-1]] if d.vector is None else np.array(d.vector)
        assert not rotational, "a rotation about a skewed axis has no word"
        out = vec(vector)
        return replace(d, word="{}({:.17g},{:.17g},{:.17g})".format(sign, *out), vector=out)

    def support(s: Support) -> Support:
        return replace(s, directions=tuple(direction(d) for d in s.directions))

    return replace(
        model,
        nodes=[replace(n, xyz=vec(n.xyz)) for n in model.nodes],
        pipes=[replace(p, delta=vec(p.delta)) for p in model.pipes],
        supports=[support(s) for s in model.supports],
        forces=[replace(f, f=vec(f.f[:3]) + vec(f.f[3:])) for f in model.forces],
        displacements=[
            replace(d, d=vec([x or 0.0 for x in d.d[:3]]) + tuple(d.d[3:]))
            for d in model.displacements
        ],
    )


def moved(model: Model, by: tuple[float, float, float]) -> Model:
    """The whole model elsewhere in space."""
    shift = np.array(by)
    nodes = [replace(n, xyz=tuple(float(x) for x in np.array(n.xyz) + shift)) for n in model.nodes]
    if not nodes:
        nodes = [Node(model.pipes[0].start, by)]
    return replace(model, nodes=nodes)


def relabelled(model: Model, name: dict[str, str]) -> Model:
    """Other node labels."""

    def new(label: str | None) -> str | None:
        if label is None:
            return None
        if label in name:
            return name[label]
        return name[label[:-1]] + label[-1]  # 30M

    def along(d: Direction) -> Direction:
        if d.along is None:
            return d
        return replace(d, along="-".join(str(new(x)) for x in d.along.split("-")))

    return replace(
        model,
        nodes=[replace(n, label=new(n.label)) for n in model.nodes],
        pipes=[replace(p, start=new(p.start), end=new(p.end)) for p in model.pipes],
        bends=[replace(b, node=new(b.node)) for b in model.bends],
        springs=[replace(s, start=new(s.start), end=new(s.end)) for s in model.springs],
        masses=[replace(m, node=new(m.node)) for m in model.masses],
        supports=[
            replace(
                s,
                node=new(s.node),
                cnode=new(s.cnode),
                directions=tuple(along(d) for d in s.directions),
            )
            for s in model.supports
        ],
        displacements=[replace(d, node=new(d.node)) for d in model.displacements],
        forces=[replace(f, node=new(f.node)) for f in model.forces],
    )


def labels(model: Model) -> list[str]:
    """Labels of the ends of pipes and springs, in the deck's order."""
    ends = [x for p in [*model.pipes, *model.springs] for x in (p.start, p.end)]
    return list(dict.fromkeys(ends))


def shuffled(model: Model, rng: np.random.Generator) -> Model:
    """Cards in another order; the start of the path keeps its place in space."""

    def mix(items: list) -> list:
        return [items[i] for i in rng.permutation(len(items))]

    start = Node(model.pipes[0].start, (0.0, 0.0, 0.0))
    return _same_points(
        model,
        replace(
            model,
            nodes=mix(model.nodes) or [start],
            pipes=mix(model.pipes),
            bends=mix(model.bends),
            supports=mix(model.supports),
            forces=mix(model.forces),
        ),
    )


def reversed_pipes(model: Model, which: list[bool]) -> Model:
    """Chosen pipes written from their other end, with what follows the path put right."""

    def back(p: Pipe) -> Pipe:
        return replace(p, start=p.end, end=p.start, delta=tuple(-x for x in p.delta))

    pairs = zip(model.pipes, which, strict=True)
    names = {f"{p.start}-{p.end}": f"{p.end}-{p.start}" for p, turn in pairs if turn}

    def support(s: Support) -> Support:
        given = tuple(replace(d, along=names.get(d.along, d.along)) for d in s.directions)
        return replace(s, directions=given)

    start = Node(model.pipes[0].start, (0.0, 0.0, 0.0))
    pairs = zip(model.pipes, which, strict=True)
    other = replace(
        model,
        nodes=model.nodes or [start],
        pipes=[back(p) if turn else p for p, turn in pairs],
        supports=[support(s) for s in model.supports],
    )
    return _same_points(model, other)


def _same_points(model: Model, other: Model) -> Model:
    """Supports and forces on 30, 30N, 30F keep their place where the path runs the other way."""

    def near(m: Model) -> dict[str, frozenset[str]]:
        return {
            label: frozenset((m.pipes[legs.near].start, m.pipes[legs.near].end))
            for label, legs in find_legs(m, []).items()
        }

    one, two = near(model), near(other)
    swap = {}
    for label in (x for x in one if one[x] != two[x]):
        swap |= {label: label + "N", label + "F": label + "N", label + "N": label + "F"}
    return replace(
        other,
        supports=[replace(s, node=swap.get(s.node, s.node)) for s in other.supports],
        forces=[replace(f, node=swap.get(f.node, f.node)) for f in other.forces],
    )


@dataclass
class Numbers:
    """The answer of one case, in an order of its own: by places, elements' ends and cards."""

    u: np.ndarray
    end_force: np.ndarray
    cards: np.ndarray
    states: list[tuple[int, ...]]


def numbers(result: CaseResult, q: np.ndarray | None = None, shift: object = 0.0) -> Numbers:
    """Displacements by place, forces by element and card, turned back by q."""
    assert result.converged, result.cause
    assert result.certificate.worst <= 1e-9
    q = np.eye(3) if q is None else q
    system, state = result.system, result.state
    xyz = (system.xyz - np.array(shift)) @ q

    def back(a: np.ndarray) -> np.ndarray:
        return (a.reshape(*a.shape[:-1], 2, 3) @ q).reshape(a.shape)

    rank = _order(xyz)
    middle = xyz[system.ends].mean(axis=1)
    end = back(state.end_force)
    # an element's ends in the order of their places
    first = np.argsort(np.argsort(rank)[system.ends], axis=1)
    end = np.take_along_axis(end, first[:, :, None], axis=1)
    forces = back(card_forces(result))
    pressed = state.normal > 1e-9 * state.normal.max(initial=0.0)  # a trace has no mode
    mode = np.where(pressed, state.mode, OPEN)
    push = np.abs(state.reaction).max(axis=1, initial=0.0)
    closed = (state.side != OPEN) & ~system.contacts.two_way
    closed &= push > 1e-9 * push.max(initial=0.0)
    keys, states = [], []
    for i, card in enumerate(system.cards):
        node = system.alias.get(card.label)
        node = system.labels.index(card.label) if node is None else node
        mine = system.contacts.card == i
        kind = ("anchor", "support", "hanger", "spring", "displacement").index(card.kind)
        keys.append([*xyz[node], kind, mine.sum()])
        states.append(
            (
                int(closed[mine].sum()),
                *sorted(mode[system.sliders.card == i].tolist()),
            )
        )
    by = _order(np.array(keys).reshape(len(keys), -1))
    return Numbers(
        back(state.u + state.u_low)[rank],
        end[_order(middle)],
        forces[by],
        [states[i] for i in by],
    )


def _order(keys: np.ndarray) -> np.ndarray:
    """Stable order of rows by their values to 1e-6."""
    return np.lexsort(np.round(keys + 0.123456e-6, 5).T[::-1])


def worst(one: Numbers, two: Numbers) -> float:
    """Largest difference, relative to the largest of its kind (forces and moments apart)."""
    assert one.states == two.states
    out = 0.0
    for name in ("u", "end_force", "cards"):
        a, b = getattr(one, name), getattr(two, name)
        for half in (slice(0, 3), slice(3, 6)):
            size = max(1e-300, np.abs(a[..., half]).max())
            # a rotation moves what is a metre away; forces below 1 N are none
            size = max(size, 1e-3 * np.abs(a).max() if name == "u" else 1.0)
            out = max(out, float(np.abs(a[..., half] - b[..., half]).max()) / size)
    return out
