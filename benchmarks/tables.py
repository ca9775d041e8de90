"""The tables that people read, made from the rows of a run."""

from collections.abc import Callable
from functools import partial
from pathlib import Path

from experiment import CASES, OURS, PEERS, Row
from store import duration, length, load, markdown, nodes, times
from targets import Tables, find, targets

FILES = (
    "racks", "million", "tolerances", "passes", "sweep_kp", "sweep_kf", "sweep_steps", "many",
    "variants", "whole", "reading", "time_spent",
)  # fmt: skip
TITLES = {
    "floor": "floor",
    "newton": "Trunnion",
    "status": "Trunnion, status iteration",
    "opensees": "OpenSees, balance test",
    "opensees_norm": "OpenSees, displacement test and line search",
    "pynite": "PyNite",
    "calculix": "CalculiX (solid elements)",
}


def read(folder: Path) -> Tables:
    """Rows of every file of a run; no rows where it was not measured."""
    return {name: load(folder / f"{name}.csv") for name in FILES}


def sizes(rows: list[Row]) -> list[int]:
    """Sizes that occur."""
    return sorted({int(row["n"]) for row in rows})


def machine_table(note: dict[str, str]) -> str:
    """Machine and versions."""
    return markdown(("", ""), note.items())


def rack_table(case: str, tables: Tables) -> str:
    """Time in the solver of every program at every size, or what became of it."""
    rows = [row for row in tables["racks"] if row["case"] == case]
    n_all = sizes(rows)
    body = [
        [TITLES[program], *(_time_cell(find(rows, n=n, program=program)) for n in n_all)]
        for program in ("floor", *OURS, *PEERS)
        if any(row["program"] == program for row in rows)
    ]
    return markdown(("program", *(nodes(n) for n in n_all)), body)


def _time_cell(row: Row) -> str:
    verdict, taken = row.get("verdict"), duration(row.get("seconds"))
    remark = str(row.get("remark", "")).replace("|", "/")
    if verdict == "floor":
        return taken
    if verdict == "right":
        return f"{taken} ({times(row.get('floors'))})"
    if verdict in ("wrong", "other model"):
        return f"**{remark}** ({taken})"
    if verdict == "fails":
        return f"**fails**: {_short(remark)}" + (f" ({taken})" if taken else "")
    if verdict in ("cannot", "not tried", "not installed"):
        return f"{verdict}" if verdict == "not installed" else f"{verdict}: {remark}"
    return ""


def _short(text: str) -> str:
    return text if len(text) <= 70 else text[:67] + "..."


def error_table(tables: Tables) -> str:
    """Distance to the reference, certificate and work of Trunnion."""
    body = [
        [
            nodes(row["n"]),
            f"`{row['case']}`",
            row.get("factorise", ""),
            row.get("solve", ""),
            times(row.get("floors")),
            length(row.get("error")),
            f"{row['worst']:.0e}" if "worst" in row else "",
            f"{row['peak_mb']:.0f}" if "peak_mb" in row else "",
            row["reference"],
        ]
        for row in tables["racks"]
        if row["program"] == "newton"
    ]
    head = (
        "nodes", "case", "factorisations", "solves", "floors", "distance to the reference",
        "worst certificate item", "MB", "reference",
    )  # fmt: skip
    return markdown(head, body)


def peer_errors(tables: Tables) -> str:
    """Distance to the reference of every program that gave an answer."""
    rows = tables["racks"]
    body = []
    for case in CASES:
        for program in (*OURS, *PEERS):
            mine = [r for r in rows if (r["case"], r["program"]) == (case, program)]
            cells = [length(find(mine, n=n).get("error")) for n in sizes(rows)]
            if any(cells):
                body.append([f"`{case}`", TITLES[program], *cells])
    return markdown(("case", "program", *(nodes(n) for n in sizes(rows))), body)


def target_table(tables: Tables) -> str:
    """Targets with verdicts."""
    head = ("target", "wanted", "measured", "verdict")
    return markdown(head, [[row[name] for name in head] for row in targets(tables)])


def million_table(tables: Tables) -> str:
    """The million nodes and the thousand beside them."""
    body = [
        [
            nodes(row["n"]), TITLES[row["program"]], duration(row.get("seconds")),
            times(row.get("floors")), row.get("factorise", ""),
            f"{row['worst']:.0e}" if "worst" in row else "",
            f"{row['peak_mb']:.0f}" if "peak_mb" in row else "",
            row.get("remark") or row["verdict"],
        ]
        for row in tables["million"]
    ]  # fmt: skip
    head = (
        "nodes", "program", "time", "floors", "factorisations", "worst certificate item", "MB",
        "outcome",
    )  # fmt: skip
    return markdown(head, body)


def tolerance_table(tables: Tables) -> str:
    """Error at the accepted point by iteration, rule and tolerance."""
    body = [
        [
            nodes(row["n"]), row["iteration"], row.get("rule", ""),
            f"{row['tolerance']:g}" if "tolerance" in row else "",
            row.get("passes", ""), duration(row.get("seconds")), length(row.get("error")),
            row["outcome"],
        ]
        for row in tables["tolerances"]
    ]  # fmt: skip
    head = ("nodes", "iteration", "rule", "tolerance", "passes", "time", "error", "then")
    return markdown(head, body)


def stiffness_table(name: str, tables: Tables) -> str:
    """A sweep of k_p or k_f."""
    column = {"sweep_kp": "k_p", "sweep_kf": "k_f"}[name]
    body = [
        [
            f"`{row['case']}`", f"{row[column]:.0e}" if column in row else "",
            *(length(row.get(key)) for key in ("penalty", "round_off")),
            *(
                f"{row[key]:.0e}" if key in row else ""
                for key in ("penalty_force", "round_off_force", "penalty_effect", "worst")
            ),
            row.get("factorise", ""), duration(row.get("seconds")), row["outcome"],
        ]
        for row in tables[name]
    ]  # fmt: skip
    head = (
        "case", f"{column} [N/m]", "penalty error", "round-off", "penalty error of forces",
        "round-off of forces", "penalty effect reported", "worst certificate item",
        "factorisations", "time", "outcome",
    )  # fmt: skip
    return markdown(head, body)


def step_table(tables: Tables) -> str:
    """The sweep of load steps."""
    body = [
        [
            row.get("steps", ""),
            *(length(row.get(key)) for key in ("u_to_one_step", "u_to_limit")),
            *(
                f"{row[key]:.0f} N" if key in row else ""
                for key in ("normal_to_limit", "friction_to_limit")
            ),
            row.get("factorise", ""), duration(row.get("seconds")), row["outcome"],
        ]
        for row in tables["sweep_steps"]
    ]  # fmt: skip
    head = (
        "steps", "distance to one step", "distance to the ramp's limit", "normal force to limit",
        "friction to limit", "factorisations", "time", "outcome",
    )  # fmt: skip
    return markdown(head, body)


def many_table(tables: Tables) -> str:
    """Many linear cases."""
    names = ("one_case", "seconds", "each_more", "one_factor", "one_solve", "allowed")
    body = [
        [
            nodes(row["n"]), row["cases"], *(duration(row.get(name)) for name in names),
            row.get("factorise", row.get("failure", "")), row.get("solve", ""),
            row.get("refine", ""),
        ]
        for row in tables["many"]
    ]  # fmt: skip
    head = (
        "nodes", "cases", "one case", "all cases", "each case more", "one factorisation (floor)",
        "one solve (floor)", "target for all", "factorisations", "solves", "of refinement",
    )  # fmt: skip
    return markdown(head, body)


def variant_table(tables: Tables) -> str:
    """A study of many variants."""
    body = [
        [
            row["deck"], row.get("jobs", ""), row.get("variants", row.get("failure", "")),
            row.get("certified", ""), f"{row['worst']:.0e}" if "worst" in row else "",
            duration(row.get("seconds")), row.get("analyse", ""), row.get("factorise", ""),
        ]
        for row in tables["variants"]
    ]  # fmt: skip
    head = (
        "deck", "processes", "variants", "certified", "worst certificate item", "time", "analyses",
        "factorisations",
    )  # fmt: skip
    return markdown(head, body)


def whole_table(tables: Tables) -> str:
    """Whole processes."""
    names = ("whole", "start_up", "read", "solve", "write")
    body = [
        [row["deck"], row.get("cards", ""), *(duration(row.get(name)) for name in names)]
        for row in tables["whole"]
    ]
    head = ("deck", "lines", "whole process", "start-up and end", "read", "solve", "write")
    return markdown(head, body)


def reading_table(tables: Tables) -> str:
    """Long decks."""
    body = [
        [
            nodes(row["nodes"]), row.get("cards", row.get("failure", "")),
            *(duration(row.get(name)) for name in ("read", "build")),
            f"{row['cards_a_second']:.0f}" if "cards_a_second" in row else "",
        ]
        for row in tables["reading"]
    ]  # fmt: skip
    return markdown(("nodes", "cards", "reading", "building", "cards a second"), body)


def spent_table(tables: Tables) -> str:
    """Calls, cost of a call and share of the whole, for every size and case."""
    body = [
        [
            nodes(row["n"]), f"`{row['case']}`", row["part"], row.get("calls", ""),
            duration(row.get("each")), duration(row.get("seconds")),
            f"{100 * row['share']:.0f} %" if "share" in row else "",
        ]
        for row in tables["time_spent"]
        if row.get("share", 1.0) >= 0.005
    ]  # fmt: skip
    return markdown(("nodes", "case", "part", "calls", "each", "together", "share"), body)


TABLES: dict[str, Callable[[Tables], str]] = {
    "targets": target_table,
    **{f"racks_{case}": partial(rack_table, case) for case in CASES},
    "errors": error_table,
    "peer_errors": peer_errors,
    "million": million_table,
    "tolerances": tolerance_table,
    "sweep_kp": partial(stiffness_table, "sweep_kp"),
    "sweep_kf": partial(stiffness_table, "sweep_kf"),
    "sweep_steps": step_table,
    "many": many_table,
    "variants": variant_table,
    "whole": whole_table,
    "reading": reading_table,
    "time_spent": spent_table,
}


def write(folder: Path, tables: Tables, note: dict[str, str]) -> None:
    """Markdown beside the CSV."""
    (folder / "machine.md").write_text(machine_table(note))
    for name, make in TABLES.items():
        (folder / f"{name}.md").write_text(make(tables))
