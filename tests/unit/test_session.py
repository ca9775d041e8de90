"""What a session keeps from one solve to the next, counted in the work ledger."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import trunnion
from trunnion.deck.reader import read_text
from trunnion.errors import ModelError

MODELS = Path(__file__).parents[2] / "models"
HEAD = """\
MATERIAL S E=203e9 NU=0.3 ALPHA=12e-6 DENSITY=7850
SECTION  P OD=0.2191 WALL=0.00818
OPERATE  T1=120 P1=1e6 TREF=20
PIPE 10 20 DX=5
PIPE 20 30 DX=5
PIPE 30 40 DZ=4
ANCHOR 10
"""
LINEAR = HEAD + "SUPPORT 40 Y\nCASE A = W\nCASE B = W + T1\n"
FRICTION = HEAD + "SUPPORT 30 +Y MU=0.3\nSUPPORT 40 +Y MU=0.3\nCASE A = W\nCASE B = W + T1\n"
WORK = ("analyse", "factorise", "solve", "refine", "assemble", "elements")


def read(text):
    return read_text(text, "deck.inp")


def work(results):
    return {name: results.work[name] for name in WORK}


def same(a, b):
    assert list(a.cases) == list(b.cases)
    for name, case in a.cases.items():
        assert np.array_equal(case.state.u, b[name].state.u)
        assert np.array_equal(case.state.end_force, b[name].state.end_force)
        assert case.certificate == b[name].certificate


@pytest.mark.parametrize("deck", [LINEAR, FRICTION])
def test_an_unchanged_model_takes_no_work(deck):
    session, model = trunnion.Session(), read(deck)
    first = session.solve(model)
    again = session.solve(read(deck))
    same(first, again)
    assert again.work == dict.fromkeys(first.work, 0)
    assert first.work["factorise"] > 0


@pytest.mark.parametrize("name", ["snubber_line", "cycle_line", "wind_crossing", "b313_s302"])
def test_an_unchanged_model_of_every_kind_takes_no_work(name):
    session = trunnion.Session()
    first = session.solve(trunnion.read(MODELS / f"{name}.inp"))
    again = session.solve(trunnion.read(MODELS / f"{name}.inp"))
    assert set(again.work.values()) == {0}
    assert again.modes is first.modes
    assert list(again.cases) == list(first.cases)


def test_another_load_takes_no_assembly_and_no_factorisation():
    session = trunnion.Session()
    session.solve(read(LINEAR))
    hotter = session.solve(read(LINEAR.replace("T1=120", "T1=150")))
    same(hotter, trunnion.solve(read(LINEAR.replace("T1=120", "T1=150"))))
    assert work(hotter) | {"elements": 0, "refine": 0} == {
        "analyse": 0,
        "factorise": 0,
        "solve": 1,  # CASE A = W is known
        "refine": 0,
        "assemble": 0,
        "elements": 0,
    }


def test_other_friction_and_gaps_take_no_assembly_and_no_analysis():
    session = trunnion.Session()
    session.solve(read(FRICTION))
    for text in (FRICTION.replace("MU=0.3", "MU=0.1"), FRICTION.replace("30 +Y", "30 +Y GAP=0.01")):
        found = session.solve(read(text))
        assert found.work["analyse"] == found.work["assemble"] == 0
        assert found.work["factorise"] > 0
        same(found, trunnion.solve(read(text)))


def test_another_pipe_or_place_of_a_support_is_found_out():
    for old, new in (
        ("WALL=0.00818", "WALL=0.009"),
        ("DZ=4", "DZ=5"),
        ("SUPPORT 40", "SUPPORT 20"),
    ):
        session = trunnion.Session()
        session.solve(read(LINEAR))
        found = session.solve(read(LINEAR.replace(old, new)))
        assert found.work["analyse"] == found.work["factorise"] == 1
        same(found, trunnion.solve(read(LINEAR.replace(old, new))))


def test_one_changed_case_leaves_the_others():
    session = trunnion.Session()
    first = session.solve(read(FRICTION))
    found = session.solve(read(FRICTION.replace("B = W + T1", "B = W + T1 + P1")))
    assert found["A"].work["factorise"] == 0
    assert found["A"].state is first["A"].state
    assert found["B"].work["factorise"] > 0


def test_a_renamed_node_is_found_out():
    """What an answer says of node 20 or 30 is not said of node 25 or 35."""
    long = HEAD.replace("DX=5", "DX=80") + "SUPPORT 40 +Y MU=0.3\nSUPPORT 40 RX RZ\nCASE A = W\n"
    session = trunnion.Session()
    session.solve(read(long))
    renamed = long.replace(" 20 ", " 25 ").replace(" 30 ", " 35 ")
    found, fresh = session.solve(read(renamed)), trunnion.solve(read(renamed))
    same(found, fresh)
    assert found["A"].digits == fresh["A"].digits
    assert found["A"].warnings == fresh["A"].warnings
    assert any("5 turns by" in text for text in found["A"].warnings)


def test_another_warning_of_a_case_is_found_out():
    session = trunnion.Session()
    session.solve(read(LINEAR))
    found = session.solve(read(LINEAR.replace("A = W", "A = W + H")))
    assert found["A"].warnings == ("H: there are no hangers",)


def test_a_mechanism_is_refused_as_often_as_it_is_solved():
    loose = LINEAR.replace("ANCHOR 10", "SUPPORT 10 X Y")
    session = trunnion.Session()
    for _ in range(2):
        with pytest.raises(ModelError, match="no restraint holds it"):
            session.solve(read(loose))


def test_many_solves_leave_one_structure_behind():
    """Other supports stand on the first structure, not on the last, which is let go."""
    session = trunnion.Session()
    for mu in (0.1, 0.2, 0.3, 0.4):
        session.solve(read(FRICTION.replace("30 +Y MU=0.3", f"30 +Y MU={mu}")))
    (structure,) = session.structures.values()
    assert structure.parent is not None
    assert structure.parent.parent is None


def test_a_model_changed_in_code_is_found_out():
    session, model = trunnion.Session(), read(LINEAR)
    session.solve(model)
    model.cases[1] = replace(model.cases[1], terms=model.cases[0].terms)
    found = session.solve(model)
    assert np.array_equal(found["A"].state.u, found["B"].state.u)


def test_without_a_session_nothing_is_kept():
    model = read(LINEAR)
    assert trunnion.solve(model).work == trunnion.solve(model).work
