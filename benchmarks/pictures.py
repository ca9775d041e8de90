"""Pictures of a run: error against time, time and memory against size, sweeps, time spent."""

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import Any

from experiment import CASES, PEERS, Row
from tables import TITLES, sizes
from targets import Tables, find

LOOK: dict[str, dict[str, Any]] = {
    "floor": {"color": "0.55", "marker": "_", "linestyle": ":"},
    "newton": {"color": "#0b5fa5", "marker": "o"},
    "status": {"color": "#58a4dc", "marker": "s"},
    "opensees": {"color": "#c8501e", "marker": "^"},
    "opensees_norm": {"color": "#e8a25c", "marker": "v"},
    "pynite": {"color": "#3c8a4e", "marker": "D"},
    "calculix": {"color": "#8a5aa8", "marker": "P"},
}
WHAT = {
    "lin": "lin: two-way supports",
    "gap": "gap: lift-off and gaps",
    "fric1": "fric1: friction, one step",
    "fric10": "fric10: friction, ten steps",
}
ROUND = 1e-18  # m; what is exact to the last bit is drawn here
SPENT = 8  # parts drawn apart, the rest in one


def _figure(rows: int, columns: int, width: float = 9.6, height: float = 3.4) -> tuple[Any, Any]:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    plt.rcParams.update(
        {
            "font.size": 9, "axes.grid": True, "grid.alpha": 0.25, "grid.linewidth": 0.6,
            "axes.spines.top": False, "axes.spines.right": False, "axes.titlesize": 10,
            "axes.titleweight": "bold", "axes.titlelocation": "left", "legend.frameon": False,
            "svg.hashsalt": "trunnion",
        }
    )  # fmt: skip
    figure, axes = plt.subplots(
        rows, columns, figsize=(width, height * rows), squeeze=False, layout="constrained"
    )
    return figure, axes


def _save(figure: Any, path: Path) -> None:
    import matplotlib.pyplot as plt

    figure.savefig(path, dpi=110, metadata={"Software": None})
    plt.close(figure)


def _legend(figure: Any, axes: Any, columns: int = 4) -> None:
    """One legend for all panels, below them."""
    found: dict[str, Any] = {}
    for axis in axes.ravel():
        for handle, label in zip(*axis.get_legend_handles_labels(), strict=True):
            found.setdefault(label, handle)
    figure.legend(found.values(), found.keys(), loc="outside lower center", ncols=columns)


def _good(row: Row) -> bool:
    return row["verdict"] in ("right", "floor", "other model")


def _of(rows: list[Row], case: str, program: str) -> list[Row]:
    return [row for row in rows if (row["case"], row["program"]) == (case, program)]


def rack_time(tables: Tables, path: Path) -> None:
    """Time against size, a panel a case; what fails or is wrong is a cross."""
    figure, axes = _figure(2, 2)
    for axis, case in zip(axes.ravel(), CASES, strict=True):
        for program, look in LOOK.items():
            mine = [row for row in _of(tables["racks"], case, program) if "seconds" in row]
            good = [row for row in mine if _good(row)]
            bad = [row for row in mine if not _good(row)]
            label = TITLES[program]
            if good:
                xs, ys = [r["n"] for r in good], [r["seconds"] for r in good]
                axis.plot(xs, ys, label=label, ms=5, lw=1.4, **look)
            if bad:
                xs, ys = [r["n"] for r in bad], [r["seconds"] for r in bad]
                axis.plot(xs, ys, "x", color=look["color"], ms=8, mew=2)
        axis.plot([], [], "x", color="0.3", ms=8, mew=2, label="fails or wrong (its colour)")
        axis.set(xscale="log", yscale="log", title=WHAT[case], xlabel="nodes", ylabel="seconds")
    _legend(figure, axes)
    _save(figure, path)


def rack_error(tables: Tables, path: Path) -> None:
    """Error against time, a panel a case, a larger mark for more nodes."""
    figure, axes = _figure(2, 2)
    largest = max(sizes(tables["racks"]), default=1)
    for axis, case in zip(axes.ravel(), CASES, strict=True):
        for program, look in LOOK.items():
            rows = _of(tables["racks"], case, program)
            mine = [row for row in rows if "error" in row and "seconds" in row]
            if not mine:
                continue
            size = [18 + 110 * (row["n"] / largest) ** 0.35 for row in mine]
            xs, ys = [r["seconds"] for r in mine], [max(r["error"], ROUND) for r in mine]
            axis.plot(xs, ys, color=look["color"], lw=0.6, alpha=0.5)
            kind = {"color": look["color"], "marker": look["marker"], "alpha": 0.8}
            axis.scatter(xs, ys, s=size, label=TITLES[program], **kind)
        failed = {
            (program, row["n"])
            for program in PEERS
            for row in _of(tables["racks"], case, program)
            if row["verdict"] in ("fails", "cannot")
        }
        if failed:
            names = sorted({TITLES[p].split(",")[0] for p, _ in failed})
            text = f"no answer at some sizes: {', '.join(names)}"
            axis.text(0.02, 0.97, text, transform=axis.transAxes, fontsize=7.5, va="top")
        axis.axhline(1e-9, color="0.4", lw=0.8, ls="--")
        axis.set(xscale="log", yscale="log", ylim=(ROUND / 3, 100), title=WHAT[case])
        axis.set(xlabel="seconds in the solver", ylabel="error [m]")
    _legend(figure, axes)
    _save(figure, path)


def rack_memory(tables: Tables, path: Path) -> None:
    """Memory against size."""
    figure, axes = _figure(1, 2)
    for axis, case in zip(axes.ravel(), ("lin", "fric1"), strict=True):
        for program, look in LOOK.items():
            mine = [r for r in _of(tables["racks"], case, program) if "peak_mb" in r and _good(r)]
            if mine and program != "floor":
                xs, ys = [r["n"] for r in mine], [r["peak_mb"] for r in mine]
                axis.plot(xs, ys, label=TITLES[program], ms=5, lw=1.4, **look)
        axis.set(xscale="log", yscale="log", title=WHAT[case], xlabel="nodes")
        axis.set(ylabel="peak of the process [MB]")
    _legend(figure, axes)
    _save(figure, path)


def rack_floors(tables: Tables, path: Path) -> None:
    """Ratio to the floor against size."""
    figure, axes = _figure(1, 1, width=7.0, height=3.8)
    axis = axes[0, 0]
    colours = {"lin": "#3c8a4e", "gap": "#c8501e", "fric1": "#0b5fa5", "fric10": "#8a5aa8"}
    for case in CASES:
        mine = [row for row in _of(tables["racks"], case, "newton") if "floors" in row]
        xs, ys = [row["n"] for row in mine], [row["floors"] for row in mine]
        axis.plot(xs, ys, "o-", color=colours[case], label=WHAT[case], ms=5, lw=1.4)
    axis.set(xscale="log", yscale="log", xlabel="nodes", ylabel="time over the floor")
    axis.legend()
    _save(figure, path)


def passes(tables: Tables, path: Path) -> None:
    """Error against time inside a run, with the points that are accepted."""
    rows, points = tables["passes"], tables["tolerances"]
    figure, axes = _figure(1, max(1, len(sizes(rows))), width=11.0, height=4.0)
    for axis, n in zip(axes.ravel(), sizes(rows), strict=False):
        for name in ("newton", "status"):
            mine = [row for row in rows if (row["n"], row["iteration"]) == (n, name)]
            xs = [row["seconds"] for row in mine]
            ys = [max(row["error"], ROUND) for row in mine]
            colour = LOOK[name]["color"]
            axis.plot(xs, ys, "-", color=colour, lw=1.2, label=f"{name}, pass by pass")
            for rule, mark, label in (
                ("its own", "o", "accepts by its own rule"),
                ("last change", "x", "a test of the last change would accept"),
            ):
                some = [
                    r
                    for r in points
                    if (r["n"], r["iteration"], r.get("rule")) == (n, name, rule) and "error" in r
                ]
                xs, ys = [r["seconds"] for r in some], [max(r["error"], ROUND) for r in some]
                axis.plot(xs, ys, mark, color=colour, ms=6, mew=1.6, label=f"{name} {label}")
        axis.set(xscale="log", yscale="log", title=f"rack of {n} nodes, fric1")
        axis.set(xlabel="seconds in the solver", ylabel="error at the supports [m]")
    _legend(figure, axes, columns=3)
    _save(figure, path)


def tolerance(tables: Tables, path: Path) -> None:
    """Error of the accepted point against the tolerance asked for."""
    rows = tables["tolerances"]
    figure, axes = _figure(1, max(1, len(sizes(rows))), width=11.0, height=3.6)
    for axis, n in zip(axes.ravel(), sizes(rows), strict=False):
        for rule, style in (("last change", "x--"), ("its own", "o-")):
            for name in ("newton", "status"):
                mine = [
                    row
                    for row in rows
                    if (row["n"], row["iteration"], row.get("rule")) == (n, name, rule)
                    and "error" in row
                    and "tolerance" in row
                ]
                if mine:
                    xs, ys = [r["tolerance"] for r in mine], [r["error"] for r in mine]
                    label = f"{name}, {'test of the last change' if 'x' in style else 'own rule'}"
                    axis.plot(xs, ys, style, color=LOOK[name]["color"], label=label, ms=5)
        axis.set(xscale="log", yscale="log", title=f"rack of {n} nodes, fric1")
        axis.set(xlabel="tolerance, relative", ylabel="error of the accepted point [m]")
    _legend(figure, axes)
    _save(figure, path)


def stiffness(name: str, tables: Tables, path: Path) -> None:
    """A sweep of a stiffness: errors of displacements and of forces, and time."""
    column, default = {"sweep_kp": ("k_p", 1e12), "sweep_kf": ("k_f", 1e8)}[name]
    cases = list(dict.fromkeys(row["case"] for row in tables[name]))
    figure, axes = _figure(1, 3, width=11.0, height=3.6)
    panels = (
        (("penalty", "round_off"), "displacements", "error [m]", ROUND),
        (("penalty_force", "round_off_force"), "normal forces", "error, relative", 1e-17),
        (("seconds",), "time", "seconds", 0.0),
    )
    names = {"penalty": "penalty error", "round_off": "round-off"}
    for axis, (keys, title, label, least) in zip(axes.ravel(), panels, strict=True):
        for case, colour in zip(cases, ("#0b5fa5", "#c8501e"), strict=False):
            for key, style in zip(keys, ("o-", "s--"), strict=False):
                mine = [r for r in tables[name] if r["case"] == case and key in r and column in r]
                xs, ys = [r[column] for r in mine], [max(r[key], least) for r in mine]
                what = f"{case}, {names[key]}" if key in ("penalty", "round_off") else None
                axis.plot(xs, ys, style, color=colour, label=what, ms=4, lw=1.2)
        axis.axvline(default, color="0.4", lw=0.8, ls=":")
        axis.set(xscale="log", title=title, xlabel=f"{column} [N/m]", ylabel=label)
        if least:
            axis.set(yscale="log")
        else:
            axis.set_ylim(bottom=0)
    _legend(figure, axes, columns=6)
    _save(figure, path)


def steps(tables: Tables, path: Path) -> None:
    """Load steps: distances of the answer, and time."""
    rows = [row for row in tables["sweep_steps"] if "steps" in row]
    figure, axes = _figure(1, 3, width=11.0, height=3.4)
    panels: tuple[tuple[tuple[tuple[str, str], ...], str, str], ...] = (
        (
            (("u_to_one_step", "to one step"), ("u_to_limit", "to the ramp's limit")),
            "displacements", "distance [m]",
        ),
        (
            (("normal_to_limit", "normal force"), ("friction_to_limit", "friction")),
            "forces, to the ramp's limit", "distance [N]",
        ),
        ((("seconds", "time"),), "time", "seconds"),
    )  # fmt: skip
    for axis, (keys, title, label) in zip(axes.ravel(), panels, strict=True):
        for (key, name), style in zip(keys, ("o-", "s--"), strict=False):
            mine = [row for row in rows if row.get(key, 0.0) > 0.0]
            axis.plot([r["steps"] for r in mine], [r[key] for r in mine], style, label=name, ms=4)
        axis.set(xscale="log", yscale="log", title=title, xlabel="load steps", ylabel=label)
        axis.set_xticks([1, 2, 4, 8, 16, 32, 64], ["1", "2", "4", "8", "16", "32", "64"])
        axis.minorticks_off()
        axis.legend()
    _save(figure, path)


def spent(tables: Tables, path: Path) -> None:
    """Shares of the time by part."""
    rows = [row for row in tables["time_spent"] if "share" in row]
    bars = list(dict.fromkeys((row["n"], row["case"]) for row in rows))
    total: dict[str, float] = {}
    for row in rows:
        total[row["part"]] = total.get(row["part"], 0.0) + row["share"]
    parts = sorted(total, key=lambda part: -total[part])[:SPENT]
    figure, axes = _figure(1, 1, width=9.6, height=0.42 * len(bars) + 1.6)
    _stack(
        axes[0, 0],
        [f"{n} nodes, {case}" for n, case in bars],
        parts,
        lambda bar, part: (
            100 * find(rows, n=bars[bar][0], case=bars[bar][1], part=part).get("share", 0.0)
        ),
        rest=100.0,
    )
    axes[0, 0].set(xlabel="share of the time in the solver [%]", xlim=(0, 100))
    _legend(figure, axes, columns=3)
    _save(figure, path)


def whole(tables: Tables, path: Path) -> None:
    """Whole processes in parts."""
    rows = [row for row in tables["whole"] if "read" in row]
    figure, axes = _figure(1, 1, width=9.6, height=0.42 * len(rows) + 1.5)
    names = ("start_up", "read", "solve", "write")
    _stack(
        axes[0, 0],
        [row["deck"] for row in rows],
        names,
        lambda bar, part: 1e3 * float(rows[bar].get(part, 0.0)),
    )
    axes[0, 0].set(xlabel="milliseconds of `trunnion run`, whole process")
    _legend(figure, axes)
    _save(figure, path)


def _stack(
    axis: Any,
    labels: Sequence[str],
    parts: Sequence[str],
    value: Callable[[int, str], float],
    rest: float | None = None,
) -> None:
    """Bars of parts side by side; `rest` is what a whole bar is, where parts are left out."""
    import matplotlib.pyplot as plt

    left = [0.0] * len(labels)
    colours = plt.get_cmap("tab20").colors  # type: ignore[attr-defined]
    for i, part in enumerate(parts):
        width = [value(bar, part) for bar in range(len(labels))]
        axis.barh(labels, width, left=left, color=colours[i], label=part.replace("_", "-"))
        left = [a + b for a, b in zip(left, width, strict=True)]
    if rest is not None:
        width = [rest - a for a in left]
        axis.barh(labels, width, left=left, color="0.85", label="other parts")
    axis.invert_yaxis()
    axis.grid(axis="y", visible=False)


PICTURES: dict[str, tuple[str, Callable[[Tables, Path], None]]] = {  # name -> its table, function
    "racks_time": ("racks", rack_time),
    "racks_error": ("racks", rack_error),
    "racks_memory": ("racks", rack_memory),
    "racks_floors": ("racks", rack_floors),
    "passes": ("passes", passes),
    "tolerances": ("tolerances", tolerance),
    "sweep_kp": ("sweep_kp", partial(stiffness, "sweep_kp")),
    "sweep_kf": ("sweep_kf", partial(stiffness, "sweep_kf")),
    "sweep_steps": ("sweep_steps", steps),
    "time_spent": ("time_spent", spent),
    "whole": ("whole", whole),
}


def draw(folder: Path, tables: Tables) -> None:
    """Draw everything that was measured."""
    for name, (needs, function) in PICTURES.items():
        if tables[needs]:
            function(tables, folder / f"{name}.png")
