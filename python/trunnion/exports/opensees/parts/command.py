"""The command line of an exported script."""

import argparse
import json
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from trunnion.exports.agreement import (
    TOLERANCE,
    agrees,
    differences,
    laws,
    table,
    tried,
    unanswered,
)
from trunnion.exports.opensees.parts.answer import solve

FORCES = ("FX", "FY", "FZ", "MX", "MY", "MZ")
MOVEMENTS = ("UX", "UY", "UZ", "RX", "RY", "RZ")


def main(job: Mapping[str, Any], arguments: Sequence[str] | None = None) -> int:
    """Solve the cases, print and write them; compare with a JSON report of Trunnion if asked."""
    place = Path(sys.argv[0]).resolve()
    parser = argparse.ArgumentParser(description="Solve an exported piping job with OpenSees.")
    parser.add_argument("--case", action="append", choices=list(job["cases"]), help="only this")
    parser.add_argument("--compare", type=Path, metavar="LINE.json", help="report of trunnion run")
    parser.add_argument("--allow", type=float, default=TOLERANCE, help="of the largest")
    parser.add_argument("-o", type=Path, default=place.with_suffix(".json"), help="answer")
    chosen = parser.parse_args(arguments)
    import openseespy.opensees as ops

    ops.logFile("/dev/null" if sys.platform != "win32" else "NUL", "-noEcho")
    cases = {name: solve(job, name) for name in chosen.case or job["cases"]}
    ops.wipe()
    found = {"program": f"OpenSees {ops.version()}", "deck": job["deck"], "cases": cases}
    chosen.o.write_text(json.dumps(found, indent=1) + "\n")
    for name, case in cases.items():
        print(f"\n{name} = {job['cases'][name]['text']}")
        print_case(case)
    print(f"\nwrote {chosen.o}")
    if chosen.compare is None:
        return int(not all(case["converged"] for case in cases.values()))
    own = json.loads(chosen.compare.read_text())
    rows = differences(own, found)
    print("\n" + table(rows, "OpenSees", chosen.allow))
    for name, (value, _) in laws(found).items():
        print(f"{name}: laws of the held contacts hold to {value:.1e}")
    for name, what in tried(found, chosen.allow).items():
        print(f"{name}: friction elements of OpenSees {what}")
    for name, why in unanswered(own, found).items():
        print(f"{name}: not compared: {why}")
    good = agrees(rows, laws(found), chosen.allow) and not unanswered(own, found)
    print("they agree" if good else "they DIFFER")
    return int(not good)


def print_case(case: Mapping[str, Any]) -> None:
    """Print the support loads and the movements of a case."""
    if not case["converged"]:
        print(f"  not solved: {case['cause']}")
        return
    print(f"  {'on the pipe [N, N m]':24}" + "".join(f"{x:>14}" for x in FORCES))
    for row in case["supports"]:
        numbers = "".join(f"{x:14.6g}" for x in (*row["force"], *row["moment"]))
        print(f"  {row['name'][:24]:24}{numbers}")
    print(f"  {'movement [m, rad]':24}" + "".join(f"{x:>14}" for x in MOVEMENTS))
    for label, six in case["nodes"].items():
        print(f"  {label[:24]:24}" + "".join(f"{x:14.6g}" for x in six))
