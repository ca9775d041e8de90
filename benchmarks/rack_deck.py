"""Write a neutral pipe rack model (schema piperack-1) as a deck.

    benchmarks/rack_deck.py tests/data/rack_50.json.gz > models/rack_50.inp

Node labels are the model's node numbers; corners are mitred, so there are no BEND cards.
"""

import sys
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from rack import Rack, read_rack

HEAD = """\
! {title}: {nodes} nodes on a pipe rack, with U loops, rests, guides and axial stops.
!
! Source    model family piperack-1, size {nodes}, written by benchmarks/rack_deck.py; reference
!           answers in tests/data/rack_{nodes}.npz, by an independent program to 3e-16 of the
!           largest force.
! Expected  largest movement   GAP {gap:.6f} m, FRIC1 {fric1:.6f} m, FRIC10 {fric10:.6f} m
!           rests that slip    FRIC1 {slip1} of {rests}, FRIC10 {slip10} of {rests}
!           every displacement within 1e-9 m of the reference (tests/verification/test_racks.py).
! Choices   Euler-Bernoulli, mitred corners; rests mu 0.3 every 6 m, guides with 3 mm and stops
!           with 25 mm to each side; 273.1 x 9.27 mm pipe full of water, +150 K.

TITLE    Pipe rack line, {nodes} nodes
UNITS    mm N MPa C
DEFAULT  SHEAR=OFF G=9.81

MATERIAL STEEL   E={e:g} NU={nu:g} ALPHA={alpha:g} DENSITY={density:g}
SECTION  PIPE    OD={od:g} WALL={wall:g} FLUID={fluid:g}
OPERATE  T1={t:g} TREF=0
"""

TAIL = """
CASE GAP    = W + T1    MUX=0
CASE FRIC1  = W + T1
CASE FRIC10 = W + T1    STEPS=10
"""


def head(rack: Rack, reference: dict[str, np.ndarray]) -> str:
    """Comments and properties."""
    pipe, nodes = rack["pipe"], len(rack["nodes"])
    largest = {
        case: float(np.abs(reference[f"{case}_u"][:, :3]).max())
        for case in ("gap", "fric1", "fric10")
    }
    slip = {
        case: int(sum("slip" in status for status in reference[f"{case}_status"]))
        for case in ("fric1", "fric10")
    }
    return HEAD.format(
        title=rack["name"], nodes=nodes, **largest, slip1=slip["fric1"], slip10=slip["fric10"],
        rests=sum(s["type"] == "rest" for s in rack["supports"]),
        e=pipe["E"] / 1e6, nu=pipe["nu"], alpha=pipe["alpha"], density=pipe["rho_pipe"],
        od=1e3 * pipe["od"], wall=1e3 * pipe["t"], fluid=pipe["rho_fluid"], t=pipe["dT"],
    )  # fmt: skip


def lines(rack: Rack) -> Iterator[str]:
    """Cards of the line in the order of its nodes."""
    xyz = 1e3 * np.array(rack["nodes"])
    last = len(xyz) - 1
    at: dict[int, list[str]] = {}
    for support in rack["supports"]:
        at.setdefault(support["node"], []).append(_words(support))
    yield f"\nANCHOR   {rack['anchors'][0]}"
    for i, j in rack["elements"]:
        step = (f"{k}={d:g}" for k, d in zip(("DX", "DY", "DZ"), xyz[j] - xyz[i], strict=True) if d)
        yield f"PIPE     {i:<4d} {j:<4d} {' '.join(step)}"
        if j in at:
            yield f"SUPPORT  {j:<9d} {'  '.join(at[j])}"
    yield f"ANCHOR   {last}"


def _words(support: Rack) -> str:
    """Direction word and keys of one support."""
    axis = "XYZ"[int(np.argmax(np.abs(support["dir"])))]
    if support["type"] == "rest":
        return f"+{axis} MU={support['mu']:g}"
    return f"{axis} GAP={1e3 * support['plus']:g}"


def main(path: Path) -> None:
    """Print the deck of one model."""
    rack = read_rack(path)
    reference = dict(np.load(path.with_name(f"{rack['name']}.npz")))
    print(head(rack, reference) + "\n".join(lines(rack)) + "\n" + TAIL, end="")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
