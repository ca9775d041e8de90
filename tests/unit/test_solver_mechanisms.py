"""Structures and cases that move freely are named; long flexible lines are not mechanisms."""

import numpy as np
import pytest

import trunnion
from trunnion.cli import main
from trunnion.commands.shared import BAD_INPUT, FAILED, SOLVED
from trunnion.deck.reader import read_text
from trunnion.errors import ModelError

HEAD = """\
MATERIAL S E=203e9 NU=0.3 ALPHA=12e-6 DENSITY=7850
SECTION  P OD=0.2191 WALL=0.00818
OPERATE  T1=120 TREF=20
"""
STRAIGHT = "PIPE 10 20 DX=3\nPIPE 20 30 DX=3\n"
LOOSE = {
    "unrestrained": (
        "PIPE 10 20 DX=3\nPIPE 20 30 DY=2\nCASE A = W\n",
        ["line 10-30 moves freely in all six ways"],
    ),
    "about its axis": (
        STRAIGHT + "SUPPORT 10 X Y Z\nSUPPORT 30 Y Z\nCASE A = W\n",
        ["line 10-30 turns about X: no restraint holds it"],
    ),
    "about a skewed axis": (
        "PIPE 10 20 DX=3 DZ=3\nPIPE 20 30 DX=3 DZ=3\n"
        "SUPPORT 10 X Y Z\nSUPPORT 30 X Y Z\nCASE A = W\n",
        ["line 10-30 turns about (0.707,0,0.707): no restraint holds it"],
    ),
    "along its axis": (
        STRAIGHT + "SUPPORT 10 Y Z RX\nSUPPORT 30 Y Z\nCASE A = W\n",
        ["line 10-30 moves along X: no restraint holds it"],
    ),
    "on one hinge": (
        "PIPE 10 20 DX=3\nSUPPORT 10 X Y Z RX RY\nCASE A = W\n",
        ["line 10-20 turns about Z: no restraint holds it"],
    ),
    "on a spring in two directions": (
        "ANCHOR 5\nPIPE 5 6 DX=1\nPIPE 10 20 DX=2\nNODE 10 X=1 Y=0 Z=0\nNODE 5 X=0 Y=0 Z=0\n"
        "SPRING 6 10 KX=1e5 KY=1e5 KRX=1e5 KRY=1e5 KRZ=1e5\nCASE A = W\n",
        ["line 10-20 moves along Z: no restraint holds it"],
    ),
    "one line of two": (
        "ANCHOR 5\nPIPE 5 6 DX=3\nNODE 5 X=0 Y=0 Z=0\nNODE 50 X=0 Y=5 Z=0\n"
        "PIPE 50 60 DX=3\nPIPE 60 70 DZ=3\nSUPPORT 50 X Y Z\nCASE A = W\n",
        ["line 50-70 turns about X", "line 50-70 turns about Y"],
    ),
    "a loaded freedom without stiffness": (
        "ANCHOR 10\nPIPE 10 20 DX=3\nSPRING 20 90 KX=1e5 KY=1e5\nFORCE 90 F1 FZ=10 MX=3\n"
        "CASE A = F1\n",
        [
            "CASE A: node 90 is loaded in Z, where nothing resists",
            "CASE A: node 90 is loaded in RX, where nothing resists",
        ],
    ),
}


def run(command, deck, tmp_path):
    path = tmp_path / "deck.inp"
    path.write_text(HEAD + deck)
    extra = ["-o", str(tmp_path)] if command == "run" else []
    with pytest.raises(SystemExit) as end:
        main([command, str(path), *extra])
    return end.value.code


@pytest.mark.parametrize("name", LOOSE)
def test_loose_structures_are_named(name):
    deck, texts = LOOSE[name]
    with pytest.raises(ModelError) as error:
        trunnion.solve(read_text(HEAD + deck, "deck.inp"))
    for text in texts:
        assert text in str(error.value)
    count = {"one line of two": 3}.get(name, len(texts))
    assert len(error.value.problems) == count


@pytest.mark.parametrize("command", ["run", "check"])
@pytest.mark.parametrize("name", [n for n in LOOSE if n != "a loaded freedom without stiffness"])
def test_loose_structures_leave_with_exit_2_and_no_file(name, command, tmp_path, capsys):
    deck, texts = LOOSE[name]
    assert run(command, deck, tmp_path) == BAD_INPUT
    assert texts[0] in capsys.readouterr().err
    assert [p.name for p in tmp_path.iterdir()] == ["deck.inp"]


def test_a_node_on_two_springs_is_no_mechanism_where_it_is_not_loaded():
    deck = "ANCHOR 10\nPIPE 10 20 DX=3\nSPRING 20 90 KX=1e5 KY=1e5\nMASS 90 M=10\nCASE A = W\n"
    case = trunnion.solve(read_text(HEAD + deck, "deck.inp"))["A"]
    assert case.certificate.passed
    sag = case.state.u[2, 1] - case.state.u[1, 1]
    assert sag == pytest.approx(-10 * 9.80665 / 1e5, rel=1e-9)


@pytest.mark.parametrize(
    "supports", ["", "SUPPORT {} +Y GUIDE\n"], ids=["cantilever", "on 100 rests"]
)
def test_a_kilometre_is_no_mechanism(supports, tmp_path):
    """A cantilever of 1 km has a reciprocal condition number near 1e-16."""
    n = 100
    deck = "ANCHOR 10\n" + "".join(
        f"PIPE {10 * i} {10 * i + 10} DX={1000 // n}\n" + supports.format(10 * i + 10)
        for i in range(1, n + 1)
    )
    model = read_text(HEAD + deck + "CASE A = W + T1\n", "deck.inp")
    case = trunnion.solve(model)["A"]
    assert case.certificate.passed
    assert not [w for w in case.warnings if "undetermined" in w]
    if not supports:
        w = -case.loads.dist[0, 1]
        ei, gas = case.system.rigidity[0, 2:]
        tip = w * 1e12 / (8 * ei) + w * 1e6 / (2 * gas)
        tip += w * 1e6 / 2 * 1000.0 / 1e12 + w * 1e3 / 1e12  # anchor of 1e12
        assert case.state.u[-1, 1] == pytest.approx(-tip, rel=1e-9)
    assert run("check", deck + "CASE A = W + T1\n", tmp_path) == SOLVED


def test_a_case_that_makes_a_mechanism_is_refused_and_the_others_stand(tmp_path, capsys):
    deck = STRAIGHT + (
        "SUPPORT 10 +Y RX RY RZ X Z\nSUPPORT 30 +Y\nFORCE 20 F1 FY=1e3\n"
        "CASE DOWN = W\nCASE UP = F1\n"
    )
    assert run("run", deck, tmp_path) == FAILED
    assert "line 10-30 moves along Y: no restraint holds it" in capsys.readouterr().out
    results = trunnion.solve(read_text(HEAD + deck, "deck.inp"))
    assert results["DOWN"].certificate.passed
    assert results["UP"].state is None
    assert len(results["UP"].history) < 50
    assert run("check", deck, tmp_path) == SOLVED


def test_undetermined_motion_is_a_warning_by_name(tmp_path):
    """Lifted off its axial stops by nothing: a line on frictionless rests may lie anywhere."""
    deck = STRAIGHT + ("SUPPORT 10 +Y Z RX\nSUPPORT 30 +Y Z X GAP=0.01\nCASE A = W\n")
    case = trunnion.solve(read_text(HEAD + deck, "deck.inp"))["A"]
    assert case.certificate.passed
    assert "undetermined: line 10-30 moves along X" in case.warnings
    assert np.abs(case.state.u[:, 0]).max() < 1e-9
