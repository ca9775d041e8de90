"""What happens where one plain step does not do: each way out by the smallest deck found."""

from pathlib import Path

import numpy as np
import pytest

import trunnion
from trunnion.arrays import OPEN, SLIP, STICK
from trunnion.cli import main
from trunnion.commands.shared import FAILED, SOLVED
from trunnion.deck.reader import read_text

DECKS = Path(__file__).parents[1] / "decks"
HEAD = """\
DEFAULT  SHEAR=OFF
MATERIAL STEEL E=203e9 NU=0.3 ALPHA=12e-6
SECTION  P OD=0.2731 WALL=0.00927
OPERATE  T1=120 TREF=20
"""


def solve(text):
    return trunnion.solve(read_text(HEAD + text, "deck.inp"))


def exit_code(deck, folder):
    with pytest.raises(SystemExit) as end:
        main(["run", str(deck), "-o", str(folder)])
    return end.value.code


def close(a, b, within=1e-9):
    """Both answers agree to a part of the largest number of each kind."""
    for name in ("u", "end_force", "reaction", "friction"):
        x, y = getattr(a.state, name), getattr(b.state, name)
        assert np.abs(x - y).max(initial=0.0) <= within * max(1e-9, np.abs(y).max(initial=0.0)), (
            name
        )
    assert np.array_equal(a.state.side, b.state.side)
    assert np.array_equal(a.state.mode, b.state.mode)


# --- ramping, freezing, refusal


def test_ramping_is_reported_and_certified(tmp_path):
    deck = DECKS / "ramping.inp"
    case = trunnion.solve(trunnion.read(deck))["COLD"]
    assert case.certificate.passed
    note = "sub-steps because one step did not settle"
    assert [w for w in case.warnings if note in w]
    assert exit_code(deck, tmp_path) == SOLVED
    assert note in (tmp_path / "ramping.out").read_text()


def test_a_frozen_contact_that_presses_is_certified_and_named():
    case = trunnion.solve(trunnion.read(DECKS / "freezing_kept.inp"))["PUSH"]
    assert case.certificate.passed
    assert case.frozen == ("20 +Y",)
    assert any("SUPPORT 20 +Y reversed more than 5 times" in w for w in case.warnings)
    model = trunnion.read(DECKS / "freezing_kept.inp")
    text = model.deck().replace("ITERATION=STATUS", "")
    close(case, trunnion.solve(read_text(text, "newton.inp"))["PUSH"], 1e-8)


def test_a_frozen_contact_that_would_pull_is_refused(tmp_path, capsys):
    deck = DECKS / "freezing_refused.inp"
    case = trunnion.solve(trunnion.read(deck))["PUSH"]
    assert not case.converged
    assert case.state is None
    assert case.frozen == ("20 +Y X",)
    assert "contact_state at support 20 +Y" in case.cause
    assert exit_code(deck, tmp_path) == FAILED
    assert "support 20" in capsys.readouterr().out
    text = deck.read_text().replace("ITERATION=STATUS", "")
    newton = trunnion.solve(read_text(text, "newton.inp"))["PUSH"]
    assert newton.certificate.passed
    assert newton.state.side[list(newton.system.contacts.word).index("+Y", 1)] == OPEN


def test_no_answer_is_refused_with_support_need_and_capacity(tmp_path, capsys):
    text = HEAD + (
        "PIPE 10 20 DX=3\nSUPPORT 10 RX +Y MU=0.3\nSUPPORT 20 +Y MU=0.3\n"
        "FORCE 10 F1 FY=-2000\nFORCE 20 F1 FY=-3000 FX=1600\nCASE PUSH = F1\n"
        "CASE BACK = F1 FROM=PUSH\n"
    )
    deck = tmp_path / "sled.inp"
    deck.write_text(text)
    assert exit_code(deck, tmp_path) == FAILED
    said = capsys.readouterr().out
    assert "support 10 RX +Y needs a friction force of" in said
    assert "its capacity mu N is 600 N" in said
    results = trunnion.solve(trunnion.read(deck))
    assert "mechanism under this load" in results["PUSH"].cause
    assert results["BACK"].cause == "it starts from PUSH, which has no answer"


# --- FROM, STEPS, EVENTS, MUX, E=HOT

BAR = """\
PIPE     10 20 DX=300
ANCHOR   10
SUPPORT  20 +Y MU=0.3
FORCE    20 F1 FY=-50000
FORCE    20 F2 FX={push}
CASE PUSH = F1 + F2
CASE BACK = F1  FROM=PUSH
"""


@pytest.mark.parametrize(("push", "mode"), [(20e3, STICK), (60e3, SLIP)])
def test_history_of_a_bar_on_a_rest(push, mode):
    """Push a bar over its rest and let go: what stays is held by the committed datum.

    k = 1/(L/EA + 1/k_p); PUSH: k u = P - mu N.  BACK: the spring k_f pulls towards
    d = u - mu N/k_f, or slips the other way.
    """
    results = solve(BAR.format(push=push))
    one, two = results["PUSH"], results["BACK"]
    assert one.certificate.passed
    assert two.certificate.passed
    ea = one.system.rigidity[0, 0]
    k, kf = 1.0 / (300.0 / ea + 1e-12), 1e8
    capacity = 0.3 * one.state.normal[0]
    u = (push - capacity) / k
    assert one.state.u[1, 0] == pytest.approx(u, rel=1e-9)
    assert one.state.mode[0] == SLIP
    datum = u - capacity / kf
    assert one.state.datum_end[0, 0] == pytest.approx(datum, rel=1e-9)
    back = kf * datum / (k + kf) if mode == STICK else capacity / k
    assert two.state.mode[0] == mode
    assert two.state.u[1, 0] == pytest.approx(back, rel=1e-8)
    assert two.state.datum[0, 0] == pytest.approx(datum, rel=1e-9)


LINE = """\
PIPE     10 20 DX=6
PIPE     20 30 DX=4
PIPE     30 40 DZ=3
ANCHOR   10
SUPPORT  20 +Y MU=0.3
SUPPORT  30 +Y MU=0.3
SUPPORT  40 +Y MU=0.3 Z GAP=0.002 MU=0.4
FORCE    20 F1 FY=-9000
FORCE    30 F1 FY=-6000
FORCE    40 F1 FY=-4000 FX=2500 FZ=1500
"""


def test_steps_are_cases_that_follow_one_another():
    text = (
        f"CASE A = {1 / 3}*F1 + {1 / 3}*T1\nCASE B = {2 / 3}*F1 + {2 / 3}*T1 FROM=A\n"
        "CASE C = F1 + T1 FROM=B\nCASE THREE = F1 + T1 STEPS=3\nCASE ONE = F1 + T1\n"
    )
    results = solve(LINE + text)
    close(results["THREE"], results["C"], 1e-8)
    one, three = results["ONE"].state, results["THREE"].state
    assert np.abs(one.u - three.u).max() > 1e-6 * np.abs(one.u).max()  # a path matters


GUIDED = """\
PIPE     10 20 DX=6
PIPE     20 30 DX=6
ANCHOR   10
SUPPORT  30 Z GAP=0.1 MU=0.3
FORCE    30 F1 FX=2000 FZ=4000
"""


def test_an_event_splits_the_step_where_a_gap_closes():
    """The tip meets its guide while the load still grows: friction counts from there on."""
    free = solve(GUIDED.replace("GAP=0.1", "GAP=10") + "CASE A = F1\n")["A"]
    assert (free.state.side[free.system.contacts.word.index("Z", 6)]) == OPEN
    t = 0.1 / float(free.state.u[2, 2])
    assert 0.4 < t < 0.6
    results = solve(
        GUIDED + "CASE ON = F1 EVENTS=ON\nCASE OFF = F1\n"
        f"CASE PART = {t!r}*F1\nCASE REST = F1 FROM=PART\n"
    )
    close(results["ON"], results["REST"], 1e-7)
    note = next(w for w in results["ON"].warnings if w.startswith("EVENT"))
    assert note.startswith("EVENT: 30 Z closes at")
    assert float(note.split(" at ")[1].split()[0]) == pytest.approx(t, rel=1e-5)
    on, off = results["ON"].state, results["OFF"].state
    assert on.datum[-1, 0] == pytest.approx(t * free.state.u[2, 0], rel=1e-6)
    assert (on.mode[0], off.mode[0]) == (STICK, SLIP)


def test_mux_multiplies_every_coefficient():
    cases = "CASE A = F1 + T1 MUX={}\n"
    double = LINE.replace("0.3", "0.6").replace("0.4", "0.8")
    close(solve(LINE + cases.format(2))["A"], solve(double + cases.format(1))["A"])
    without = LINE.replace("MU=0.3", "MU=0").replace("MU=0.4", "MU=0")
    none, zero = solve(without + cases.format(1))["A"], solve(LINE + cases.format(0))["A"]
    assert np.abs(none.state.u - zero.state.u).max() <= 1e-12
    assert np.abs(zero.state.friction).max() == 0.0


def test_hot_modulus_is_that_of_the_table():
    """E=HOT: the modulus at T1, the expansion unchanged; cold cases keep theirs."""
    table = "MATERIAL TAB E=203e9 NU=0.3\nPROPERTY TAB T=20 E=203e9 ALPHA=12e-6\n"
    table += "PROPERTY TAB T=220 E=183e9 ALPHA=12e-6\n"
    cases = "CASE COLD = F1 + T1\nCASE HOT = F1 + T1 E=HOT\n"
    results = solve(table + LINE + cases)
    hot = "MATERIAL HOT E=193e9 NU=0.3 ALPHA=12e-6\n" + LINE + "CASE HOT = F1 + T1\n"
    close(results["HOT"], solve(hot)["HOT"], 1e-8)
    close(results["COLD"], solve(LINE + "CASE COLD = F1 + T1\n")["COLD"], 1e-8)
    assert results.work["analyse"] <= 2


UNEVEN = """\
MATERIAL M E=203e9 NU=0.3
PROPERTY M T=20  E=203e9 ALPHA=12e-6
PROPERTY M T=220 E=190e9 ALPHA=12e-6
MATERIAL SOFT E=2e11 NU=0.3
PROPERTY SOFT T=20  E=2e11 ALPHA=12e-6
PROPERTY SOFT T=220 E=1e6  ALPHA=12e-6
OPERATE  T1=220 TREF=20
ANCHOR   10
PIPE     10 20 DX=5 MATERIAL=M
PIPE     20 30 DX=5 MATERIAL=SOFT
PIPE     30 40 DX=5 MATERIAL=M
SUPPORT  40 +Y MU=0.3
FORCE    40 F1 FY=-1000
{springs}CASE COLD = F1
CASE HOT  = F1 + T1  FROM=COLD E=HOT STEPS=2
CASE BACK = F1       FROM=HOT
"""


def test_a_hot_case_may_start_where_the_cold_chain_has_no_node():
    """The hot modulus ends chains at 20 and 30; springs of no weight end them there always."""
    springs = "SUPPORT 20 Z K=1e-6\nSUPPORT 30 Z K=1e-6\n"
    found, held = solve(UNEVEN.format(springs="")), solve(UNEVEN.format(springs=springs))
    for name in ("COLD", "HOT", "BACK"):
        u, v = found[name].state.u, held[name].state.u
        assert found[name].certificate.passed
        assert u == pytest.approx(v, rel=0, abs=1e-9 * np.abs(v).max())


def test_a_very_soft_pipe_that_its_supports_hold_is_no_mechanism():
    """Without friction it goes more than a thousand times its length."""
    case = trunnion.solve(trunnion.read(DECKS / "soft_pipe.inp"))["C"]
    assert case.certificate.worst < 1e-10
    assert SLIP in case.state.mode
