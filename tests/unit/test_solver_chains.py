"""Chains of elements condensed to their ends give the answer of the whole structure."""

import numpy as np
import pytest

import trunnion
from trunnion.deck.reader import read_text
from trunnion.loads import case_loads, load_sets
from trunnion.solver.chains import LONGEST, find_chains
from trunnion.solver.ledger import Ledger
from trunnion.solver.quantities import Point
from trunnion.solver.structure import Structure
from trunnion.system import build_system

HEAD = """\
MATERIAL S E=203e9 NU=0.3 ALPHA=12e-6 DENSITY=7850
SECTION  P OD=0.2191 WALL=0.00818
OPERATE  T1=120 P1=1e6 TREF=20
ANCHOR 10
"""
LINE = """\
PIPE 10 20 DX=2
PIPE 20 30 DX=3 DY=0.5
PIPE 40 30 DX=-1 DZ=-4
PIPE 40 50 DX=2
BEND 40 R=0.4
PIPE 60 50 DY=3
FORCE 30 F1 FX=1000 FY=-2000 MZ=300
FORCE 50 F1 FZ=700
"""
DECKS = {
    "line with elements against its sense": LINE + "ANCHOR 60\n",
    "free end": LINE,
    "tree": LINE
    + "ANCHOR 60\nPIPE 30 70 DZ=-2\nPIPE 70 80 DX=1\nPIPE 30 90 DY=-1\nPIPE 90 95 DX=1\n",
    "ring on a stem": LINE + "PIPE 60 70 DX=1\nPIPE 70 80 DY=1\nPIPE 80 90 DX=-2\nPIPE 90 60\n",
    "two ways": LINE + "ANCHOR 60\nPIPE 20 70 DZ=5\nPIPE 70 60\n",
    "1 mm beside 1 km": "PIPE 10 20 DX=1000 DZ=300\nPIPE 20 30 DY=0.001\nPIPE 30 40 DX=0.001\n"
    "PIPE 40 50 DX=1000\nANCHOR 50\nFORCE 30 F1 FY=100\n",
    "rest, guide and spring": LINE.replace("FORCE 30", "SUPPORT 30 +Y MU=0.3\nFORCE 30")
    + "SUPPORT 60 +Y GUIDE\nSUPPORT 10 X\nSUPPORT 50 Y K=1e6\n",
}


def read(deck):
    case = "CASE A = W + T1 + P1" + (" + F1" if "FORCE" in deck else "")
    return read_text(f"{HEAD}{deck}{case}\n", "deck.inp")


def built(deck):
    model = read(deck)
    system = build_system(model)
    return system, case_loads(model, system, model.cases[0], load_sets(model, system))


def answer(structure, loads):
    """Displacements of all nodes and end forces with every contact closed, refined."""
    forcing, point = structure.forcing(loads), Point.zero(structure.n_node)
    law = structure.frictionless()
    assert structure.factorise(structure.closed_tangent, 0.0 * structure.stuck_tangent)
    bias = structure.unbiased()
    for _ in range(4):
        r, every, end, _ = structure.exact(point, law, forcing, bias)
        point.move(structure.solve(r))
    return every.u + every.low, end


@pytest.mark.parametrize("name", DECKS)
def test_the_answer_is_that_of_the_whole_structure(name):
    system, loads = built(DECKS[name])
    chained, whole = Structure(system, Ledger()), Structure(system, Ledger(), whole=True)
    assert chained.n_node < whole.n_node
    (u, force), (u_whole, force_whole) = answer(chained, loads), answer(whole, loads)
    near = 1e-10 if "1 mm" in name else 1e-11
    for part in (slice(0, 3), slice(3, 6)):
        size = near * np.abs(u_whole[:, part]).max()
        assert u[:, part] == pytest.approx(u_whole[:, part], rel=0, abs=size)
        # the whole structure's forces of a 1 mm element are its stiffness, up to 1e18 times that of
        # the line, times a rounded deformation; those of the chain follow from statics
        sharp = 1e-6 if "1 mm" in name else 1e-11
        size = sharp * np.abs(force_whole[..., part]).max()
        assert force[..., part] == pytest.approx(force_whole[..., part], rel=0, abs=size)


@pytest.mark.parametrize("name", DECKS)
def test_cases_on_chains_are_certified(name):
    assert trunnion.solve(read(DECKS[name]))["A"].certificate.worst < 1e-12


def test_every_element_is_in_one_chain_and_runs_on_from_the_one_before():
    for deck in DECKS.values():
        system, _ = built(deck)
        chains = find_chains(system)
        assert sorted(chains.element) == list(range(len(system.kind)))
        for c, base in enumerate(chains.base):
            node = base
            for j in range(chains.first[c], chains.first[c + 1]):
                ends = list(system.ends[chains.element[j]])
                assert ends[chains.flip[j]] == node
                node = chains.far[j]
                assert ends[1 - chains.flip[j]] == node
                inside = j + 1 < chains.first[c + 1]
                assert (chains.place[node] < 0) == inside
            assert base != node


def test_long_runs_are_cut():
    n = 3 * LONGEST + 5
    pipes = "".join(f"PIPE {i + 10} {i + 11} DX=0.5\n" for i in range(n))
    system, _ = built(pipes + f"ANCHOR {n + 10}\n")
    assert np.diff(find_chains(system).first).tolist() == [LONGEST] * 3 + [5]


def test_a_ring_without_any_support_is_two_chains():
    ring = "PIPE 15 20 DX=1\nPIPE 20 30 DX=1\nPIPE 30 40 DZ=1\nPIPE 40 50 DX=-1\nPIPE 50 20\n"
    system, _ = built("PIPE 10 15 DX=1\n" + ring)
    chains = find_chains(system)
    assert np.diff(chains.first).tolist() == [2, 2, 2]


def test_supports_branches_and_ends_stay():
    system, _ = built(DECKS["tree"] + "SUPPORT 70 Y CNODE=95\nSNUBBER 90 Z\n")
    kept = {system.labels[i] for i in find_chains(system).kept}
    assert kept == {"10", "30", "60", "70", "80", "90", "95"}


def test_springs_are_never_inside():
    """A spring may have no stiffness in some ways: a chain through it has no flexibility."""
    system, _ = built(
        "PIPE 10 20 DX=1\nNODE 30 X=1\nSPRING 20 30 KX=1e6\nPIPE 30 40 DX=1\nANCHOR 40\n"
    )
    assert len(find_chains(system).kept) == len(system.labels)


def test_loads_that_cancel_inside_a_chain_leave_the_rest_exact():
    """A pair of 6e11 N stretches one pipe; its neighbour carries 100 N to the last digit."""
    deck = """\
DEFAULT SHEAR=OFF
MATERIAL S E=2e11 NU=0.3 ALPHA=12e-6 DENSITY=7850
SECTION THIN OD=0.33 WALL=0.0016
SECTION FAT OD=1.4 WALL=0.48
PIPE 10 20 DX=2 DZ=5 SECTION=THIN
PIPE 20 30 DX=40 DY=-150 DZ=30 SECTION=FAT
ANCHOR 10
FORCE 30 F1 FX=10 FZ=100
FORCE 20 F2 FX=-1.6e11 FY=6e11 FZ=-1.2e11
FORCE 30 F2 FX=1.6e11 FY=-6e11 FZ=1.2e11
CASE A = F1
CASE B = F1 + F2
"""
    found = trunnion.solve(read_text(deck, "deck.inp"))
    a, b = (found[name].state for name in "AB")
    at = found["A"].system.labels.index("20")
    # refinement ends where the next correction is below 1e-13
    assert np.abs(b.u[at] - a.u[at]).max() <= 1e-12 * np.abs(a.u[at]).max()
    assert found["B"].certificate.worst < 1e-10
