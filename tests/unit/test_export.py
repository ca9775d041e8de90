"""Jobs for other programs: what is written, what is refused, and that labels stay data."""

import ast
import json
import math
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from program import leave

import trunnion
from trunnion.arrays import ARC, TAPER, no_loads
from trunnion.certificate.deformation import expected, tip_vector
from trunnion.exports import build_job, files
from trunnion.exports.agreement import agrees, differences, laws, table, tried, unanswered
from trunnion.exports.calculix.answer import _blocks
from trunnion.exports.calculix.model import shear_coefficient
from trunnion.exports.hinges import MOST, chain, flexibility, hinge_count
from trunnion.exports.refusals import ExportError
from trunnion.exports.scene import stand
from trunnion.origin import Assumption, LeftOut, Origin
from trunnion.results.balance import load_sum
from trunnion.system import build_system

ROOT = Path(__file__).parents[2]
EVERYTHING = ROOT / "tests/decks/export_frictionless.inp"
ROUGH = ROOT / "tests/decks/export_rough.inp"
NASTY = '"""\nimport os\n\'{x}\\N{BULLET} é *END STEP\n*STEP'


@pytest.fixture(scope="module")
def solved():
    model = trunnion.read(EVERYTHING)
    return model, trunnion.solve(model)


@pytest.fixture(scope="module")
def job(solved):
    return build_job(*solved)


def data_of(script: bytes) -> dict:
    """Run a script as a module: its dictionary."""
    space = {"__name__": "exported"}
    exec(compile(script, "exported", "exec"), space)
    return space["JOB"]


# ------------------------------------------------------------------ hinges of bends and reducers
@pytest.mark.parametrize("shear", ["ON", "OFF"])
@pytest.mark.parametrize("kind", [ARC, TAPER])
def test_hinges_are_as_flexible_as_the_element(kind, shear):
    """Against the certificate's integral of section strains, which the hinges share nothing with.

    With SHEAR=OFF the flexibility that is given and taken back is 1/2000 of EA's: 1e-10 as well.
    """
    model = trunnion.read(EVERYTHING)
    model.default(SHEAR=shear)
    system = build_system(model)
    (e,) = np.flatnonzero(system.kind == kind)[:1]
    want = np.zeros((6, 6))
    for i in range(6):
        tip = np.zeros((6, len(system.kind)))
        tip[i] = 1.0
        want[:, i] = expected(system, no_loads(system), tip)[:, e]
    n = hinge_count(system, e)
    assert n < MOST
    assert shear == "ON" or n % 2 == 1
    scale = np.sqrt(np.outer(np.diag(want), np.diag(want)))
    assert np.abs((flexibility(system, e, n) - want) / scale).max() < 2e-10
    assert (np.linalg.eigvalsh(want / scale) > 0.0).all()


@pytest.mark.parametrize("kind", [ARC, TAPER])
def test_rigid_parts_carry_the_whole_load(kind):
    system = build_system(trunnion.read(EVERYTHING))
    (e,) = np.flatnonzero(system.kind == kind)[:1]
    found = chain(system, e)
    lengths = found.segment[:, :, 0].sum(axis=0)
    assert lengths[0] == pytest.approx(system.length[e], rel=1e-14)
    assert np.abs(lengths[1:]).max(initial=0.0) < 1e-14  # 2 s - 1 and 6 s2 - 6 s + 1
    first = system.xyz[system.ends[e, 0]]
    nodes = np.vstack([first, found.xyz[:-1], system.xyz[system.ends[e, 1]]])
    moment = (found.segment[:, 0, 1:] + found.segment[:, 0, :1] * (nodes - first)).sum(axis=0)
    if kind == TAPER:  # centre of a straight line
        want = 0.5 * system.length[e] * tip_vector(system)[:, e]
    else:  # and of an arc, from its centre by its bisector
        r, half = system.radius[e], 0.5 * system.angle[e]
        ex, ey = system.axes[e, :2]
        bisector = math.sin(half) * ex - math.cos(half) * ey
        want = system.length[e] * (r * ey + bisector * r * math.sin(half) / half)
    assert moment == pytest.approx(want, rel=1e-12, abs=1e-12)


def test_shear_coefficient_makes_u1_timoshenkos_beam():
    ei, ga, gas, length = 1.3e7, 6e8, 2.9e8, 0.7
    f = 12.0 * ei / (shear_coefficient(ei, ga, gas, length) * ga * length**2)
    true = 12.0 * ei / (gas * length**2)
    assert (1.0 + f) / (1.0 - f) ** 2 == pytest.approx(1.0 / (1.0 + true), rel=1e-13)
    turning = (4.0 + f + f**2) / (1.0 - f) ** 2  # y3 of CalculiX' e_c3d_u1.f, of EI/L
    assert turning == pytest.approx((4.0 + true) / (1.0 + true), rel=1e-13)


# ------------------------------------------------------------------ scripts for OpenSees
def test_script_holds_the_job_and_needs_nothing_of_trunnion(solved, job):
    (script,) = files(job, "opensees", "line").values()
    tree = ast.parse(script)
    modules = {
        getattr(node, "module", None) or node.names[0].name
        for node in ast.walk(tree)
        if isinstance(node, ast.Import | ast.ImportFrom)
    }
    assert {name.partition(".")[0] for name in modules} <= {*sys.stdlib_module_names, "openseespy"}
    data = data_of(script)
    _, results = solved
    assert tuple(data["nodes"]) == results.system.labels
    assert list(data["cases"]) == ["SUS", "OPE", "HOT", "FOR", "ON", "EQX"]
    kinds = [len(data[name]) for name in ("straights", "chains", "springs")]
    assert sum(kinds) == len(data["elements"]) == len(results.system.parts)
    sides = {row[4:] for row in data["supports"][data["cases"]["OPE"]["supports"]]}
    assert {(0.0, 0.0), (0.001, 0.001), (0.002, 0.001), (0.001, math.inf)} <= sides
    docs = ast.get_docstring(tree)
    assert "EQX: linear, on the contacts that OPE left closed" in docs


@pytest.mark.parametrize("program", ["opensees", "calculix"])
def test_same_job_same_bytes(solved, program):
    first = files(build_job(*solved), program, "line")
    model = trunnion.read(EVERYTHING)
    assert files(build_job(model, trunnion.solve(model)), program, "line") == first


@pytest.mark.parametrize("program", ["opensees", "calculix"])
def test_labels_and_titles_stay_data(program):
    model = trunnion.Model(title=NASTY)
    model.material("M", E=2e11, ALPHA=1e-5, DENSITY=7850)
    model.section("P", OD=0.2, WALL=0.01)
    model.anchor("A", NAME="x")
    model.pipe("A", "B", DX=3)
    model.support("B", "+Y", NAME="y")
    model.case("SUS", "W")
    results = trunnion.solve(model)
    cards = tuple(
        trunnion.arrays.Card(c.label, c.cnode, NASTY, c.kind, c.line) for c in results.system.cards
    )
    object.__setattr__(results["SUS"].system, "cards", cards)
    made = files(build_job(model, results), program, "line")
    for name, content in made.items():
        assert content.isascii()
        if name.endswith(".py"):
            assert [card[1] for card in data_of(content)["cards"]] == [NASTY] * 2
        else:
            lines = content.decode().splitlines()
            assert lines.count("*STEP") == lines.count("*END STEP") == 1


def test_script_says_what_lacks_where_openseespy_is_not_installed(job, tmp_path):
    """In the words of Python, without a file half written."""
    (script,) = files(job, "opensees", "line").values()
    (tmp_path / "line_opensees.py").write_bytes(script)
    blocked = (
        "import sys; sys.modules['openseespy'] = None; import runpy; "
        "sys.argv = ['line_opensees.py']; runpy.run_path('line_opensees.py', run_name='__main__')"
    )
    done = subprocess.run(
        [sys.executable, "-c", blocked], cwd=tmp_path, capture_output=True, text=True
    )
    assert "openseespy" in done.stderr
    assert [p.name for p in tmp_path.iterdir()] == ["line_opensees.py"]


# ------------------------------------------------------------------ input for CalculiX
def steps_of(text: str) -> list[list[str]]:
    return [step.splitlines() for step in text.split("*STEP")[1:]]


def test_calculix_has_a_step_a_case_and_a_file_a_modulus(job):
    made = files(job, "calculix", "line")
    cold, hot = (content.decode() for content in made.values())
    assert list(made) == ["line_calculix.inp", "line_calculix_2.inp"]
    assert re.findall(r"\*\* step \d: (\w+)", cold) == ["SUS", "OPE", "FOR", "ON", "EQX"]
    assert re.findall(r"\*\* step \d: (\w+)", hot) == ["HOT"]
    assert [len(steps_of(text)) for text in (cold, hot)] == [5, 1]


def test_calculix_can_read_every_line(job):
    for content in files(job, "calculix", "line").values():
        for line in content.decode().splitlines():
            assert len(line) <= 132
            if not line.startswith(("*", "HIDDEN", "U", "RF")):
                words = line.rstrip(",").split(", ")
                assert len(words) <= 16
                assert all(len(word) <= 20 and float(word) is not None for word in words)


def test_forces_of_a_step_are_the_loads_of_its_case(solved, job):
    """On the nodes of the pipe and of rigid parts; pairs on auxiliary freedoms are no loads."""
    _, results = solved
    text = files(job, "calculix", "line")["line_calculix.inp"].decode()
    auxiliary = set()
    for block in re.findall(r"\*NSET, NSET=HIDDEN\n((?:\d+,\n)+)", text):
        auxiliary |= {int(word) for word in block.split(",\n") if word}
    turns = {int(line.split(",")[0]) for line in _block(text, "*NODE, NSET=TURNS")}
    turns |= _turning_parts(text, auxiliary)
    for name, step in zip(("SUS", "OPE", "FOR", "ON", "EQX"), steps_of(text), strict=True):
        total = np.zeros(3)
        at = step.index("*CLOAD, OP=NEW") + 1
        for line in step[at : step.index("*NODE PRINT, NSET=PIPES")]:
            node, freedom, x = line.split(", ")
            if int(node) not in auxiliary | turns and int(freedom) <= 3:
                total[int(freedom) - 1] += float(x)
        case = results[name]
        want = load_sum(case.system, case.loads)[:3] + case.loads.preload.sum() * case.system.up
        assert total == pytest.approx(want, rel=1e-9, abs=1e-4), name  # 1e7 N in 13 digits


def _block(text: str, head: str) -> list[str]:
    lines = text.splitlines()
    at = lines.index(head) + 1 if head in lines else len(lines)
    end = next((i for i in range(at, len(lines)) if lines[i].startswith("*")), at)
    return lines[at:end]


def _turning_parts(text: str, auxiliary: set[int]) -> set[int]:
    """Nodes that are rotations of rigid parts: they come in pairs, translation first."""
    plain = [int(line.split(",")[0]) for line in _block(text, "*NODE")]
    return set([node for node in plain if node not in auxiliary][1::2])


def test_a_closed_gap_is_a_ground_that_is_held_and_an_open_one_is_free(solved, job):
    _, results = solved
    text = files(job, "calculix", "line")["line_calculix.inp"].decode()
    for name, step in zip(("SUS", "OPE", "FOR", "ON", "EQX"), steps_of(text), strict=True):
        held = [line for line in step if re.fullmatch(r"\d+, 1, 1", line)]
        closed = [hold for hold in stand(results[name]).holds if hold.closed]
        assert len(held) == len(closed), name


def test_printed_blocks_are_read_by_step(tmp_path):
    (tmp_path / "a.dat").write_text(
        "\n displacements (v(i),i=1..ndof) for set PIPES and time  0.1000000E+01\n\n"
        "         1  1.0E-03  2.0E-03 -3.0E-03  0.0E+00  0.0E+00  4.0E-04\n"
        "\n forces (fx,fy,fz) for set GROUNDS and time  0.1000000E+01\n\n"
        "         7 -4.0E+02  0.0E+00  0.0E+00\n"
        "\n displacements (v(i),i=1..ndof) for set PIPES and time  0.2000000E+01\n\n"
        "         1  5.0E-03  0.0E+00  0.0E+00  0.0E+00  0.0E+00  0.0E+00\n"
    )
    first, second = _blocks(tmp_path / "a.dat")
    assert first["PIPES"][1].tolist() == [1e-3, 2e-3, -3e-3, 0.0, 0.0, 4e-4]
    assert first["GROUNDS"][7].tolist() == [-400.0, 0.0, 0.0]
    assert second["PIPES"][1][0] == 5e-3


# ------------------------------------------------------------------ what is held, what is refused
def test_friction_that_is_held_is_said(solved):
    model = trunnion.read(ROUGH)
    job = build_job(model, trunnion.solve(model))
    said = "\n".join(job.notes)
    assert re.search(
        r"SUS: friction is held as Trunnion found it \(\d stick, \d slip, \d open\)", said
    )
    assert "SUS: 1 gap all round a pipe is held" in said
    assert not [note for note in build_job(*solved).notes if "friction" in note]


def test_cases_that_are_no_static_job_are_named_with_their_place():
    model = trunnion.read(ROOT / "models/snubber_line.inp")
    results = trunnion.solve(model)
    with pytest.raises(ExportError) as error:
        build_job(model, results)
    (problem,) = error.value.problems
    assert str(problem.place).endswith("snubber_line.inp:51")
    assert problem.text.startswith("CASE EQYN: ABOUT= with NONLINEAR")
    job = build_job(model, results, permissive=True)
    assert job.left_out == (problem,)
    assert [case.name for case in job.scene.cases][-1] == "EQZ"
    assert "LEFT OUT: CASE EQYN" in files(job, "opensees", "x")["x_opensees.py"].decode()


def test_a_spectrum_is_refused_and_nothing_is_written(tmp_path, capsys):
    deck = ROOT / "models/nr1677_v1_p1.inp"
    assert leave("export", deck, "-o", tmp_path) == 2
    said = capsys.readouterr().err
    assert "a response spectrum combines modes" in said
    assert "nothing was written" in said
    assert not list(tmp_path.iterdir())


def test_friction_without_an_answer_names_its_supports():
    model = trunnion.read(ROOT / "models/vm29.inp")
    with pytest.raises(
        ExportError, match=r"vm29.inp:22: CASE SLIDE: there is no answer whose fric"
    ):
        build_job(model, trunnion.solve(model))


def test_default_cases_are_cases():
    """A deck that names none has SUS, OPE, EXP and, about OPE, one of each acceleration."""
    model = trunnion.Model()
    model.material("M", E=2e11, ALPHA=1e-5, DENSITY=7850)
    model.section("P", OD=0.2, WALL=0.01)
    model.operate(T1=170)
    model.anchor("A")
    model.pipe("A", "B", DX=3)
    model.support("B", "+Y")
    model.acceleration("U1", X=0.2)
    job = build_job(model, trunnion.solve(model))
    assert [case.name for case in job.scene.cases] == ["SUS", "OPE", "BY_U1"]
    assert job.notes == ("BY_U1: linear, on the contacts that OPE left closed",)


def test_calculix_holds_every_contact_so_it_needs_an_answer():
    model = trunnion.read(ROOT / "models/b313_s302.inp")
    results = trunnion.solve(model)
    results["SUS"].state, results["SUS"].converged = None, False
    assert len(build_job(model, results, ["SUS"]).scene.cases) == 1  # OpenSees finds contacts
    with pytest.raises(ExportError, match=r"no answer whose contacts could be held at 20 \+Y, 50"):
        build_job(model, results, ["SUS"], program="calculix")


@pytest.mark.parametrize(
    ("name", "said"), [("OPEN", "OPEN is not a case"), ("EXP", "COMB EXP: no case")]
)
def test_only_cases_can_be_chosen(name, said):
    model = trunnion.read(ROOT / "models/b313_s302.inp")
    with pytest.raises(ExportError, match=said):
        build_job(model, trunnion.solve(model), [name])


def test_chosen_cases_alone_are_written(tmp_path, capsys):
    deck = ROOT / "models/b313_s302.inp"
    assert leave("export", deck, "--case", "OPE", "-o", tmp_path) == 0
    assert "wrote" in capsys.readouterr().out
    (path,) = tmp_path.iterdir()
    assert path.name == "b313_s302_opensees.py"
    assert list(data_of(path.read_bytes())["cases"]) == ["OPE"]


def test_what_a_foreign_file_lost_is_said_again():
    model = trunnion.read(ROOT / "models/pipe_10m.inp")
    lost = LeftOut("element 30-40", "a nozzle", "line.cii:210")
    guess = Assumption("steel is cold at 21 C", "line.cii:7")
    model.origin = Origin("line.cii", "CAESAR II neutral file, version 11.0", (lost,), (guess,))
    job = build_job(model, trunnion.solve(model))
    assert job.notes == (
        "LEFT OUT: element 30-40: a nozzle (line.cii:210)",
        "assumed: steel is cold at 21 C (line.cii:7)",
    )
    text = files(job, "calculix", "x")["x_calculix.inp"].decode()
    assert "LEFT OUT: element 30-40" in text
    assert "assumed: steel is cold" in text


# ------------------------------------------------------------------ comparison
def report(**changes) -> dict:
    case = {
        "converged": True,
        "nodes": {"10": [0.0, 0.001, 0.0, 0.0, 0.0, 1e-4]},
        "supports": [{"id": "10", "force": [1e4, 0.0, 0.0], "moment": [0.0, 0.0, 2e3]}],
        "elements": [{"id": "10-20", "force_from": [1e4] * 6, "force_to": [-1e4] * 6}],
    }
    return {"program": "Other", "cases": {"OPE": case | changes}}


def test_the_worst_of_each_kind_is_found():
    other = report(nodes={"10": [0.0, 0.001, 0.0, 0.0, 0.0, 1e-4 + 5e-10]})
    moved, *rest = differences(report(), other)
    assert (moved.kind, moved.where, moved.unit) == ("movement", "10 rz", "rad")
    assert moved.share == pytest.approx(5e-6, rel=1e-9)
    assert [row.share for row in rest] == [0.0, 0.0]
    assert "DIFFERS" in table([moved], "Other", 1e-6)
    assert not agrees([moved, *rest], {}, 1e-6)


@pytest.mark.parametrize("six", [[math.nan] * 6, [math.inf] * 6])
def test_what_is_no_number_differs(six):
    rows = differences(report(), report(nodes={"10": six}))
    assert rows[0].share == math.inf


def test_a_node_that_one_side_has_not_differs():
    rows = differences(report(), report(nodes={"99": [0.0] * 6}))
    assert rows[0].share == math.inf


def test_round_off_of_nothing_agrees():
    """A free pipe that grows: forces of 1e-10 N on both sides are none."""
    none = [{"id": "10", "force": [3e-10, 0.0, 0.0], "moment": [0.0] * 3}]
    rows = differences(report(supports=none), report(supports=[{**none[0], "force": [0.0] * 3}]))
    assert rows[1].share < 1e-9


def test_without_an_answer_nothing_is_confirmed():
    other = {"program": "Other", "cases": {"OPE": {"converged": False, "cause": "no"}}}
    assert differences(report(), other) == []
    assert unanswered(report(), other) == {"OPE": "no"}
    assert not agrees([], {}, 1e-6)
    assert unanswered({"cases": {}}, report())["OPE"].startswith("there is no such case")


@pytest.mark.parametrize(
    ("friction", "said"),
    [
        ({"rest": 1e-9, "kept": 1e-12}, "find the same answer from rest (1.0e-09)"),
        ({"rest": None, "kept": 1e-12}, "find no answer from rest, begun at this one keep it"),
        ({"rest": 0.2, "kept": None}, "find another (2.0e-01)"),
        ({"not_tried": "45 GUIDE"}, "not used (45 GUIDE)"),
    ],
)
def test_what_friction_elements_make_of_an_answer_is_said(friction, said):
    assert said in tried(report(friction=friction), 1e-6)["OPE"]
    assert tried(report(), 1e-6) == {}


def test_a_law_that_fails_is_no_agreement():
    other = report(law=1e-3, law_at="friction of 20")
    rows = differences(report(), other)
    assert not agrees(rows, laws(other), 1e-6)
    assert agrees(rows, {}, 1e-6)


def test_confirm_names_what_is_not_installed(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr("trunnion.exports.confirm.find_spec", lambda name: None)
    assert leave("confirm", ROOT / "models/pipe_10m.inp", "-o", tmp_path) == 2
    assert "pip install 'trunnion[opensees]'" in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


@pytest.fixture
def own_answer(monkeypatch):
    """Another program that finds what Trunnion found."""

    def answer(job, program, folder, stem):
        from trunnion.report.json import json_report

        model = trunnion.read(ROOT / f"models/{stem}.inp")
        found = json.loads(json_report(trunnion.solve(model), model))
        names = [case.name for case in job.scene.cases]
        return {"program": "Other 1", "cases": {name: found["cases"][name] for name in names}}

    monkeypatch.setattr("trunnion.exports.confirm.answer", answer)
    monkeypatch.setattr("trunnion.exports.confirm.missing", lambda program: "")


@pytest.mark.usefixtures("own_answer")
def test_confirm_names_the_cases_that_it_must_leave_out_and_why(capsys):
    assert leave("confirm", ROOT / "models/snubber_line.inp") == 0
    said = capsys.readouterr().out
    assert "6 cases confirmed by Other 1" in said
    assert said.splitlines()[-1].startswith("not confirmed: ")
    assert "snubber_line.inp:51: CASE EQYN: ABOUT= with NONLINEAR" in said.splitlines()[-1]


@pytest.mark.usefixtures("own_answer")
def test_a_case_that_has_no_answer_is_not_confirmed(capsys):
    assert leave("confirm", ROOT / "models/vm29.inp") == 1
    said = capsys.readouterr().out
    assert "1 case confirmed by Other 1" in said
    assert "CASE SLIDE: there is no answer" in said
    assert leave("confirm", ROOT / "models/vm29.inp", "--case", "STICK") == 0
    assert "SLIDE" not in capsys.readouterr().out


@pytest.mark.usefixtures("own_answer")
@pytest.mark.parametrize(
    ("deck", "more", "said"),
    [
        ("snubber_line", ["--case", "EQYN"], "CASE EQYN: ABOUT= with NONLINEAR"),
        ("nr1677_v1_p1", [], "CASE RS: a response spectrum combines modes"),
        ("vm29", ["--permissive"], "--permissive is for files of other programs"),
    ],
)
def test_nothing_that_can_be_confirmed_is_bad_input(deck, more, said, capsys):
    assert leave("confirm", ROOT / f"models/{deck}.inp", *more) == 2
    err = capsys.readouterr().err
    assert said in err
    assert "--permissive leaves" not in err


@pytest.mark.parametrize(("factor", "code"), [(1.0, 0), (1.0 + 3e-6, 1)])
def test_confirm_says_whether_they_agree(factor, code, tmp_path, capsys, monkeypatch):
    """With an answer that is Trunnion's own, or a little off."""

    def answer(job, program, folder, stem):
        from trunnion.report.json import json_report

        model = trunnion.read(ROOT / "models/pipe_10m.inp")
        found = json.loads(json_report(trunnion.solve(model)))
        for six in found["cases"]["SUS"]["nodes"].values():
            six[:] = [factor * x for x in six]
        return found | {"program": "Other 1"}

    monkeypatch.setattr("trunnion.exports.confirm.answer", answer)
    monkeypatch.setattr("trunnion.exports.confirm.missing", lambda program: "")
    assert leave("confirm", ROOT / "models/pipe_10m.inp") == code
    said = capsys.readouterr().out
    assert ("1 case confirmed by Other 1" in said) == (code == 0)
    assert ("DIFFERS" in said) == (code == 1)
