"""What late versions do otherwise: ASME B31J for elbows and tees, ASME II-D for expansion.

The tee's flexibility and the elbow's factor are checked here by hand from B31J-2017 Table 1-1;
that version 14 has both was seen in what it printed (docs/caesar.md).
"""

import math

import pytest
from cii_jobs import ANC, job, slot
from input_xml import document, element, restraints, tag

import trunnion
from trunnion.deck.reader import read_text
from trunnion.errors import DeckError
from trunnion.formats import Findings
from trunnion.formats.caesar import read
from trunnion.formats.caesar_xml import read as read_xml
from trunnion.formats.source import source_of

RUN, BRANCH = (114.3, 6.02), (88.9, 5.49)


def model_of(cii):
    source = source_of(cii.text().encode("cp1252"), "line.cii")
    result = read(source, Findings(source))
    assert read_text(result.deck()) == result.model
    return result


def tee(version=15.0, kind=3, code=None, **first):
    """Run along X with a branch along Z from 20, closed by an elbow; kind is the SIF's type."""
    c = job(version)
    c.defaults |= {"od": RUN[0], "wall": RUN[1]}
    c.add(
        10,
        20,
        dx=2000.0,
        RESTRANT=[slot(10, ANC)],
        SIF=(20, kind),
        **first,
        **({} if code is None else {"ALLOWBLS": code}),
    )
    c.add(20, 30, dx=2000.0, RESTRANT=[slot(30, ANC)])
    c.add(20, 40, dz=1500.0, od=BRANCH[0], wall=BRANCH[1], BEND={"radius": 114.3})
    c.add(40, 50, dy=1000.0, od=BRANCH[0], wall=BRANCH[1], RESTRANT=[slot(50, ANC)])
    return c


def test_a_welding_tee_is_stiff_to_the_surface_of_its_run_and_flexible_there():
    result = model_of(tee())
    link = next(p for p in result.model.pipes if p.rigid)
    assert (link.start, link.end, link.weight) == ("20", "21", 0.0)
    assert link.delta == pytest.approx((0.0, 0.0, RUN[0] / 2e3))
    branch = next(p for p in result.model.pipes if p.end == "40")
    assert (branch.start, branch.delta) == ("22", pytest.approx((0.0, 0.0, 1.5 - RUN[0] / 2e3)))
    (spring,) = result.model.springs
    q = (BRANCH[0] - BRANCH[1]) / (RUN[0] - RUN[1])
    k = (0.34 * q - 0.49 * q**2 + 0.18 * q**3) * ((RUN[0] - RUN[1]) / 2 / RUN[1]) ** 1.46
    k *= BRANCH[1] / RUN[1]
    second = math.pi / 64 * (BRANCH[0] ** 4 - (BRANCH[0] - 2 * BRANCH[1]) ** 4) * 1e-12
    about_the_run = 203400e6 * second / (k * BRANCH[0] / 1e3)
    assert (spring.start, spring.end, spring.axis) == ("21", "22", (1.0, 0.0, 0.0))
    assert spring.k == pytest.approx((1e12, 1e12, 1e12, about_the_run, 1e12, 1e12), rel=1e-6)
    results = trunnion.solve(result.model)
    assert results["SUS"].converged


def test_an_elbow_of_90_degrees_has_13_by_h():
    (bend,) = model_of(tee()).model.bends
    r2 = (BRANCH[0] - BRANCH[1]) / 2
    k = 1.3 * r2**2 / (BRANCH[1] * 114.3)
    stiff = 1 + 6 * 1.2 / 203400 * (r2 / BRANCH[1]) ** (7 / 3) * (114.3 / r2) ** (1 / 3)
    assert bend.k == pytest.approx(k / stiff, rel=1e-6)
    assert any("ASME B31J" in a.text for a in model_of(tee()).assumed)


def test_another_fitting_is_stiff_inside_the_run_only():
    model = model_of(tee(kind=5)).model
    assert (len(model.springs), sum(p.rigid for p in model.pipes)) == (0, 1)


@pytest.mark.parametrize("cii", [tee(11.0), tee(15.0, code=3), tee(kind=11)])
def test_earlier_versions_code_3_and_welds_have_no_such_tee(cii):
    model = model_of(cii).model
    assert (len(model.springs), sum(p.rigid for p in model.pipes)) == (0, 0)


@pytest.mark.parametrize(("version", "code", "late"), [("14.00", None, True), ("14.00", 3, False)])
def test_the_code_of_an_input_xml_decides(version, code, late):
    pipe = {"DIAMETER": RUN[0], "WALL_THICK": RUN[1], "MATERIAL_NUM": 106, "TEMP_EXP_C1": 150.0}
    none = (0.0, 0.0, 0.0)
    anchor = restraints(version, (10, 0, None, None, None, None, none, ""))
    allowed = tag("ALLOWABLESTRESS", PIPING_CODE=code)
    sif = tag("SIF", SIF_NUM="1", NODE=20, TYPE=3)
    text = document(
        version,
        element(10, 20, (2000.0, None, None), anchor + allowed + sif, version=version, **pipe),
        element(20, 30, (2000.0, None, None), version=version),
        element(20, 40, (None, None, 1500.0), version=version, DIAMETER=88.9, WALL_THICK=5.49),
    )
    source = source_of(text.encode(), "line.xml")
    model = read_xml(source, Findings(source)).model
    assert len(model.springs) == late
    assert next(iter(model.materials.values())).grade == "A106-B-IID"


def test_a_users_material_expands_by_the_name_of_its_standard():
    pipe = {"DIAMETER": RUN[0], "WALL_THICK": RUN[1], "MATERIAL_NUM": 501, "TEMP_EXP_C1": 150.0}
    anchor = restraints("14.00", (10, 0, None, None, None, None, (0.0, 0.0, 0.0), ""))
    text = document("14.00", element(10, 20, (2000.0, None, None), anchor, **pipe))
    text = text.replace(" NAME=", ' MATERIAL_NAME="1.7338S-40-200" NAME=')
    source = source_of(text.encode(), "line.xml")
    result = read_xml(source, Findings(source))
    assert next(iter(result.model.materials.values())).grade == "A335-P11-IID"
    assert any(
        "material 501 (1.7338S-40-200) expands as low chrome" in a.text for a in result.assumed
    )


def test_a_tee_on_a_run_without_a_wall_is_named():
    c = tee()
    for made in c.elements[:2]:
        made["wall"] = 0.0
    with pytest.raises(DeckError, match="element 10-20: no pipe has an OD of 114"):
        model_of(c)
