"""Random small piping frames, built through the Python API from a seed."""

import numpy as np

from trunnion.model import Model

STEEL = {"E": 203e9, "NU": 0.3, "ALPHA": 11.7e-6, "DENSITY": 7850}
SIZES = ((0.1143, 0.00602), (0.2191, 0.00818), (0.2731, 0.00927), (0.4064, 0.00953))
AXES = np.vstack((np.eye(3), -np.eye(3)))


def frame(seed: int) -> Model:
    """A tree of 3 to 15 pipes with bends, rests, gaps, guides, limits, friction, heat."""
    rng = np.random.default_rng(seed)
    model = Model(title=f"Random frame, seed {seed}")
    model.default(
        MU=float(rng.choice([0.0, 0.1, 0.3, 0.6])),
        FRICTION=str(rng.choice(["CONTACT", "CONTACT", "RESULTANT"])),
        SHEAR=str(rng.choice(["ON", "OFF"])),
    )
    model.material("STEEL", **STEEL)
    od, wall = SIZES[rng.integers(len(SIZES))]
    model.section("PIPE", OD=od, WALL=wall, FLUID=float(rng.choice([0.0, 900.0])))
    model.operate(T1=float(rng.uniform(20.0, 300.0)), P1=float(rng.uniform(0, 4e6)), TREF=20)
    flat = bool(rng.integers(2))
    n = int(rng.integers(3, 16))
    come: dict[int, np.ndarray] = {}
    for i in range(n):
        start = 10 * (i + 1)
        if i > 2 and rng.random() < 0.15:
            start = 10 * int(rng.integers(1, i + 1))
        way = _direction(rng, flat, come.get(start))
        length = float(rng.choice([1.0, 2.5, 4.0, 6.0, 9.0]) * rng.uniform(0.8, 1.2))
        end = 10 * (i + 2)
        if rng.random() < 0.07:
            model.rigid(start, end, WEIGHT=2000.0, **_delta(way * length))
        else:
            model.pipe(start, end, **_delta(way * length))
        come[end] = way
    _bends(model, rng, n, come, od)
    _supports(model, rng, n)
    for i in rng.choice(n + 1, 2, replace=False):
        push = rng.normal(size=3) * rng.choice([500.0, 5000.0])
        model.force(10 * (int(i) + 1), "F1", FX=push[0], FY=push[1], FZ=push[2])
    model.case("SUS", "W + P1")
    model.case("OPE", "W + P1 + T1" + (" + F1" if rng.random() < 0.5 else ""))
    model.case("COLD", "W + P1", FROM="OPE")
    return model


def _delta(d: np.ndarray) -> dict[str, float]:
    return {key: float(x) for key, x in zip(("DX", "DY", "DZ"), d, strict=True) if x != 0.0}


def _direction(rng: np.random.Generator, flat: bool, before: np.ndarray | None) -> np.ndarray:
    """A unit vector that does not turn back on the pipe before it."""
    while True:
        way = AXES[rng.integers(6)] if rng.random() < 0.8 else rng.normal(size=3)
        if flat:
            way = way * (1.0, rng.random() < 0.3, 1.0) if rng.random() < 0.5 else way * (1, 1, 0)
        size = float(np.linalg.norm(way))
        if size < 1e-3:
            continue
        way = way / size
        if before is None or way @ before > -0.6:
            return way


def _bends(
    model: Model, rng: np.random.Generator, n: int, come: dict[int, np.ndarray], od: float
) -> None:
    """Bends at some corners that two pipes of enough length make."""
    meeting: dict[str, list[np.ndarray]] = {}
    rigid = {x for p in model.pipes if p.rigid for x in (p.start, p.end)}
    for pipe in model.pipes:
        meeting.setdefault(pipe.end, []).append(np.array(pipe.delta))
        meeting.setdefault(pipe.start, []).append(np.array(pipe.delta))
    for label, ways in meeting.items():
        if len(ways) != 2 or label in rigid or label == "10":
            continue
        a, b = (w / np.linalg.norm(w) for w in ways)
        short = min(np.linalg.norm(w) for w in ways)
        tangent = 1.5 * od * np.sqrt((1 - a @ b) / max(1e-9, 1 + a @ b))
        if a @ b < 0.95 and tangent < 0.45 * short and rng.random() < 0.6:
            model.bend(label, R=1.5 * od)


def _supports(model: Model, rng: np.random.Generator, n: int) -> None:
    """An anchor at the start, sometimes at the end, and supports of all kinds between."""
    bent = {bend.node for bend in model.bends}
    model.anchor(10)
    if rng.random() < 0.5:
        model.anchor(10 * (n + 1))
        model.displacement(10, "D1", DY=0.01)
    for i in range(1, n + (rng.random() < 0.5)):
        label = str(10 * (i + 1))
        at = label + "M" if label in bent and rng.random() < 0.3 else label
        if rng.random() < 0.75:
            words = _words(model, rng, at, label in bent)
            if words:
                model.support(at, *words)
    if rng.random() < 0.3:
        model.hanger(10 * int(rng.integers(2, n + 2)), RATE=2e4, LOAD=3000.0)


def _words(model: Model, rng: np.random.Generator, label: str, corner: bool) -> list[object]:
    gap = {"GAP": float(rng.choice([0.0, 0.001, 0.003, 0.01]))}
    skew = tuple(float(x) for x in rng.normal(size=3) + np.array((0.0, 1.5, 0.0)))
    menu: list[list[object]] = [
        ["+Y"],
        ["+Y"],
        ["+Y"],
        ["+Y", ("Z", gap)],
        ["+Y", ("X", gap)],
        [("+Y", {"K": 1e7})],
        ["Y"],
        [("+(a)", skew)],
        [("-X", gap)],
        [("X", gap), ("Z", gap)],
        [("RX", {}), "+Y"],
    ]
    if not corner:
        lines = {p.start: p for p in model.pipes} | {p.end: p for p in model.pipes}
        pipe = lines[label]
        along = {"ALONG": f"{pipe.start}-{pipe.end}"}
        menu += [["+Y", ("GUIDE", gap | along)], [("LIMIT", gap | along)]]
        menu += [["+Y", ("GUIDE", gap | along), ("LIMIT", gap | along)]]
    chosen = menu[rng.integers(len(menu))]
    out: list[object] = []
    for word in chosen:
        if isinstance(word, tuple) and word[0] == "+(a)":
            out.append("+({:.6f},{:.6f},{:.6f})".format(*skew))
        else:
            out.append(word)
    return out
