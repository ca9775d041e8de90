"""CAESAR II input XML, versions 7, 11 and 14, written from the description of the format.

The expected numbers are those of `input_xml.line`, in SI.
"""

import re

import pytest
from input_xml import UNITS, document, element, line, restraints, tag

import trunnion
from trunnion.deck.reader import read_text
from trunnion.errors import DeckError
from trunnion.formats import read_any

VERSIONS = ["7.00", "11.00", "14.00"]
FREE = (None, None, None)
PIPE = {
    **{"DIAMETER": 114.300003, "WALL_THICK": 6.02, "MODULUS": 203000.0, "POISSONS": 0.3},
    **{"PIPE_DENSITY": 0.00785, "MATERIAL_NUM": 106},
}


@pytest.fixture
def load(tmp_path):
    """Read the text of a file."""

    def read(text, permissive=False, encoding="utf-8"):
        path = tmp_path / "line_INPUT.XML"
        path.write_bytes(text.encode(encoding))
        return read_any(path, permissive=permissive)

    return read


@pytest.fixture(params=VERSIONS)
def whole(request, load):
    return load(line(request.param))


def said(error):
    return "\n".join(problem.text for problem in error.value.problems)


def test_elements_have_the_coordinates_of_the_file(whole):
    found = [(p.start, p.end, p.delta) for p in whole.model.pipes]
    assert found == [
        ("10", "20", (2.0, 0.0, 0.0)),
        ("20", "30", (0.0, 0.0, 3.0)),
        ("30", "40", (0.0, 0.0, 0.4)),
        ("40", "50", (0.0, 0.0, 2.5)),
        ("30", "60", (1.5, 0.0, 0.0)),
    ]
    assert whole.model.settings.up == "Y"


def test_blank_properties_are_those_of_the_element_before(whole):
    """Insulation ends with an explicit 0 on 40-50; the branch carries that."""
    sections = [whole.model.sections[p.section] for p in whole.model.pipes]
    sizes = [(s.od, s.wall, s.corrosion) for s in sections]
    assert sizes == [pytest.approx((0.1143, 0.00602, 0.0015), rel=1e-12)] * 5
    assert [s.fluid for s in sections] == pytest.approx([900.0] * 5, rel=1e-12)
    assert [s.insulation for s in sections] == [0.05, 0.05, 0.05, 0.0, 0.0]
    assert sections[0].insulation_density == pytest.approx(136.0, rel=1e-12)
    for p in whole.model.pipes:
        assert (p.operation.t, p.operation.p) == ({"1": 170.0}, {"1": 1.2e6})
        assert p.operation.tref == 21.11  # 70 F, which the file does not hold


def test_single_precision_is_undone(whole):
    """114.300003 and 152.399994 of the file are 114.3 and 152.4, to the last digit of the deck."""
    deck = whole.deck()
    assert "OD=114.3 WALL=6.02" in deck
    assert re.search(r"BEND +20 R=152\.4( K=.*)?\n", deck)


def test_the_material_is_that_of_its_number_with_the_constants_of_the_file(whole):
    (material,) = whole.model.materials.values()
    assert material.name == "A106-B"
    assert material.density == pytest.approx(7833.0, rel=1e-12)
    assert material.nu == 0.292


def test_a_rigid_is_a_body_with_its_weight(whole):
    (valve,) = (p for p in whole.model.pipes if p.rigid)
    assert (valve.start, valve.end) == ("30", "40")
    assert valve.weight == pytest.approx(320.0)


def test_restraints_by_the_codes_of_the_xml(whole):
    """0 anchor (not unused), 17 +Y, 7 guide and 10 stop along the pipe, whatever their cosines."""
    found = {
        (s.node, d.word): (d.gap, d.k, d.mu) for s in whole.model.supports for d in s.directions
    }
    assert next(s.node for s in whole.model.supports if s.kind == "anchor") == "10"
    assert found["30", "+Y"][0][0] == 0.002
    assert found["30", "+Y"][2] == 0.3
    stop = next(v for (node, word), v in found.items() if node == "50" and v[1] is not None)
    assert stop[0] == (0.005, 0.005)
    assert stop[1] == pytest.approx(875600.0)  # 8756 N/cm
    assert {node for node, _ in found} == {"30", "50"}


def test_a_vector_of_zeros_that_is_left_out_holds_the_node(whole):
    held = [d for d in whole.model.displacements if d.node == "60"]
    anchored = [s for s in whole.model.supports if s.node == "60"]
    assert anchored or any(d.d == (0.0,) * 6 for d in held)


def test_forces_are_in_newtons(whole):
    (force,) = whole.model.forces
    assert (force.node, force.set) == ("30", "1")
    assert force.f == pytest.approx((1000.0, 0.0, 0.0, 0.0, 50.0, 0.0))


def test_all_versions_give_one_model(load):
    models = [load(line(version)).model for version in VERSIONS]
    for model in models[1:]:
        assert [p.delta for p in model.pipes] == [p.delta for p in models[0].pipes]
        assert model.sections == models[0].sections
        assert [s.directions for s in model.supports] == [s.directions for s in models[0].supports]


def test_a_converted_deck_is_the_same_model(whole):
    assert read_text(whole.deck()) == whole.model
    assert read_text(whole.deck()).deck() == whole.model.deck()


def test_the_line_solves_and_is_certified(whole):
    results = trunnion.solve(whole.model)
    assert all(case.certificate.passed for case in results.cases.values())


def one(inside=" ", version="14.00", **values):
    """A single anchored pipe with something at its end."""
    anchor = restraints(version, (10, 0, None, None, None, None, (0.0, 0.0, 0.0), ""))
    return document(
        version,
        element(10, 20, (1000.0, None, None), anchor, version=version, **{**PIPE, **values}),
        element(20, 30, (1000.0, None, None), inside, version=version),
    )


@pytest.mark.parametrize(
    ("code", "word"),
    [(1, "X"), (2, "Y"), (3, "Z"), (4, "RX"), (5, "RY"), (6, "RZ"), (16, "+X"), (18, "+Z")],
)
def test_codes_along_the_axes(load, code, word):
    cosines = tuple(float(axis == word[-1]) for axis in "XYZ")
    slot = restraints("14.00", (30, code, None, None, None, None, cosines, ""))
    found = [d.word for s in load(one(slot)).model.supports for d in s.directions]
    assert found == [word]


def words_of(load, *codes, permissive=False, cosines=(0.0, 1.0, 0.0)):
    slots = [(30, code, None, None, None, None, cosines, "") for code in codes]
    found = load(one(restraints("14.00", *slots)), permissive=permissive)
    return [d.word for s in found.model.supports for d in s.directions], found.left_out


def test_guides_and_stops_come_in_threes(load):
    """A real file has 9 and 12 with the placeholder 0 0 1 on what its tags call guides, stops."""
    placeholder = (0.0, 0.0, 1.0)
    assert words_of(load, 9, 12, cosines=placeholder) == (["GUIDE", "LIMIT"], ())


@pytest.mark.parametrize(("code", "word"), [(19, "-X"), (20, "-Y"), (24, "+RZ"), (27, "-RZ")])
def test_a_code_known_by_its_place_in_the_list_only_is_named(load, code, word):
    cosines = tuple(float(axis == word[-1]) for axis in "XYZ")
    with pytest.raises(DeckError, match=f"type {code}: what it means follows from its place"):
        words_of(load, code, cosines=cosines)
    words, left_out = words_of(load, code, permissive=True, cosines=cosines)
    assert (words, len(left_out)) == ([word], 1)


@pytest.mark.parametrize("code", [34, 62, 1.5, -3])
def test_codes_that_nobody_has_explained_are_named(load, code):
    with pytest.raises(DeckError, match=f"element 20-30, node 30: .*type {code}") as error:
        words_of(load, code)
    assert "--permissive" in said(error)
    words, left_out = words_of(load, code, permissive=True)
    assert (words, left_out[0].element) == ([], "element 20-30, node 30")


def test_a_yielding_rotation_is_named_and_stands_in_as_rigid(load):
    """31 to 33 of real files: K2 in the gap, the yield moment in the friction, on couplings."""
    slot = restraints("14.00", (30, 31, None, 1.0, 1535.0, None, (1.0, 0.0, 0.0), ""))
    with pytest.raises(DeckError, match="node 30: restraint RX2: a bilinear restraint"):
        load(one(slot))
    (made,) = load(one(slot), permissive=True).model.supports[1].directions
    assert (made.word, made.gap, made.mu) == ("RX", (0.0, 0.0), None)


def test_a_file_with_the_codes_of_the_guide_is_named_and_read_by_the_guide(load):
    """Such files have 14 for +Y, 8 for GUI, 9 for LIM, 1 for ANC: those of the neutral file."""
    with pytest.raises(DeckError, match="written by another program"):
        words_of(load, 14, 8, 9)
    assert words_of(load, 14, 8, 9, permissive=True)[0] == ["+Y", "GUIDE", "LIMIT"]
    slot = restraints("14.00", (30, 1, None, None, None, None, (0.0, 0.0, 0.0), ""))
    with pytest.raises(DeckError, match="written by another program"):
        load(one(slot))


def test_what_is_unknown_is_named_with_its_element(load):
    with pytest.raises(DeckError, match="element 20-30: SLUG, which is not known here"):
        load(one(tag("SLUG", MASS=3.0)))
    nozzle = tag("API650_NOZZLE", NOZZLE_NODE=30, TANK_NODE=31, DIAM=9000.0)
    with pytest.raises(DeckError, match="node 30: flexible nozzle"):
        load(one(nozzle))
    load_ = tag("UNIFORMLOAD", VECTOR_NUM="1", UX=0.0, UY=-3.0, UZ=0.0)
    with pytest.raises(DeckError, match="uniform load; the XML does not say whether it is in g"):
        load(one(load_))


def test_a_spring_without_its_rate_is_named(load):
    hanger = tag("HANGER", NODE=30, COLD_LOAD=5000.0, HOT_LOAD=4800.0, HGR_TABLE="1")
    with pytest.raises(DeckError, match="node 30: spring hanger that is given: its rate is not"):
        load(one(hanger))


def test_a_hanger_to_be_designed_keeps_its_limits(load):
    limits = {"RIGID_SUP": 3.0, "MAX_TRAVEL": 50.0, "LOAD_VAR": 20.0, "AVAIL_SPACE": 9999.990234}
    hanger = tag("HANGER", NODE=20, COLD_LOAD=None, HGR_TABLE="1", **limits)
    (design,) = (
        s.design for s in load(one(hanger, TEMP_EXP_C1=99.0)).model.supports if s.design is not None
    )
    assert (design.rod, design.most, design.variation) == (0.003, 0.05, 0.2)
    endless = hanger.replace('MAX_TRAVEL="50.000000"', 'MAX_TRAVEL="9999.990234"')
    (design,) = (
        s.design
        for s in load(one(endless, TEMP_EXP_C1=99.0)).model.supports
        if s.design is not None
    )
    assert design.most is None


def test_the_xml_does_not_say_whether_bourdon_effects_are_on(load):
    (said,) = (a for a in load(line("14.00")).assumed if "Bourdon" in a.text)
    assert "does not say whether Bourdon effects of pressure are on" in said.text
    assert "DEFAULT BOURDON=ELONGATION" in said.text


def test_counts_of_the_head_are_checked(load):
    with pytest.raises(DeckError, match="NUMELT is 7, there are 5 PIPINGELEMENT"):
        load(line("14.00").replace('NUMELT="5"', 'NUMELT="7"'))
    with pytest.raises(DeckError, match="NUMREST is 4, 3 elements have a RESTRAINT"):
        load(line("14.00").replace('NUMREST="3"', 'NUMREST="4"'))
    load(line("14.00").replace('NOHGRS="0"', 'NOHGRS="3"'))  # always 0, so never checked


def test_the_diameter_that_changes_without_a_reducer_is_reported(load):
    text = document(
        "14.00",
        element(10, 20, (1000.0, None, None), **PIPE),
        element(20, 30, (1000.0, None, None), DIAMETER=88.900002, WALL_THICK=5.49),
    )
    texts = [str(a) for a in load(text).assumed]
    assert any("node 20: the OD changes from 114.3 to 88.9 mm" in t for t in texts)


def test_small_temperatures_are_strains(load):
    imported = load(one(TEMP_EXP_C1=0.0012))
    results = trunnion.solve(imported.model)
    assert results["OPE"].displacements["30"]["ux"] == pytest.approx(2.0 * 0.0012, rel=1e-9)
    assert "expansions (length by length)" in " ".join(a.text for a in imported.assumed)


def test_insulation_without_density_has_that_of_the_program(load):
    model = load(one(INSUL_THICK=40.0)).model
    density = next(iter(model.sections.values())).insulation_density
    assert density == pytest.approx(184.2, abs=0.05)


def test_north_along_y_means_that_z_is_vertical(load):
    text = (
        one()
        .replace('NORTH_Z="-1.000000"', 'NORTH_Z="0"')
        .replace('NORTH_Y="0.000000"', 'NORTH_Y="1"')
    )
    assert load(text).model.settings.up == "Z"


def test_labels_and_factors_must_agree(load):
    units = [(n, "in." if n == "LENGTH" else label, f) for n, label, f in UNITS]
    text = document("14.00", element(10, 20, (1000.0, None, None), **PIPE), units=units)
    with pytest.raises(DeckError, match=r"LENGTH: label 'in\.' means a factor of 1"):
        load(text)


def test_units_of_other_jobs(load):
    """Feet and inches: the same pipe of 1 m."""
    english = {
        **{"LENGTH": ("in.", 1.0), "COMPOUND_LENGTH": ("ft.", 0.083333), "FORCE": ("lb.", 1.0)},
        **{"STRESS": ("lb./sq.in.", 1.0), "EMOD": ("lb./sq.in.", 1.0), "TEMP": ("F", 1.0)},
        **{"PRESSURE": ("lb./sq.in.", 1.0), "PDENS": ("lb./cu.in.", 1.0)},
        **{"IDENS": ("lb./cu.in.", 1.0), "FDENS": ("lb./cu.in.", 1.0)},
        **{"DIAMETER": ("in.", 1.0), "THICKNESS": ("in.", 1.0), "TRANS_STIFF": ("lb./in.", 1.0)},
    }
    units = [(n, *english.get(n, (label, f))) for n, label, f in UNITS]
    pipe = {"DIAMETER": 4.5, "WALL_THICK": 0.237, "TEMP_EXP_C1": 338.0, "PRESSURE1": 100.0}
    pipe |= {"MODULUS": 29.5e6, "POISSONS": 0.3, "PIPE_DENSITY": 0.283, "MATERIAL_NUM": 106}
    model = load(document("14.00", element(10, 20, (10.0, None, None), **pipe), units=units)).model
    (made,), (section,) = model.pipes, model.sections.values()
    assert made.delta == pytest.approx((3.048, 0.0, 0.0), rel=1e-15)
    assert (section.od, section.wall) == pytest.approx((0.1143, 0.0060198))
    assert made.operation.t["1"] == pytest.approx(170.0)
    assert made.operation.p["1"] == pytest.approx(689475.7, rel=1e-6)
    assert (model.units.length, model.units.temperature) == ("ft", "F")


def test_nan_and_inf_are_blanks(load):
    for word in ("-nan", "nan", "inf", "1.#IND"):
        text = one(CORR_ALLOW=7.0).replace('CORR_ALLOW="7.000000"', f'CORR_ALLOW="{word}"')
        assert next(iter(load(text).model.sections.values())).corrosion == 0.0


def test_results_and_other_files_are_refused_by_name(load):
    with pytest.raises(DeckError, match="a file of results; export the input"):
        load(document("14.00", element(10, 20, (1.0, None, None), **PIPE), kind="Output"))
    with pytest.raises(DeckError, match="the root is not CAESARII"):
        load('<?xml version="1.0"?><PROJECT/>')
    with pytest.raises(DeckError, match=r"version '5\.20'; 7 to 15 are read"):
        load(one().replace('VERSION="14.00"', 'VERSION="5.20"'))


BOMB = "".join(f'<!ENTITY a{n} "{f"&a{n - 1};" * 10}">' for n in range(1, 12))


@pytest.mark.parametrize(
    ("text", "cause"),
    [
        (f'<!DOCTYPE x [<!ENTITY a0 "ha">{BOMB}]><CAESARII>&a11;</CAESARII>', "document type"),
        ('<!DOCTYPE x SYSTEM "file:///etc/passwd"><CAESARII/>', "document type"),
        ('<!DOCTYPE x [<!ENTITY e SYSTEM "/etc/passwd">]><CAESARII A="&e;"/>', "document type"),
        ("<CAESARII>" + "<A>" * 100_000, "nested deeper than 6"),
        ("<CAESARII " + " ".join(f'A{n}="1"' for n in range(5000)) + "/>", "attributes"),
        ("<CAESARII><PIPINGMODEL>", "no element found|cut off|unclosed|no well-formed"),
        ("<CAESARII>&unknown;</CAESARII>", "undefined entity|no well-formed"),
    ],
)
def test_hostile_xml_is_refused_by_name(load, text, cause):
    with pytest.raises(DeckError, match=cause) as error:
        load(text)
    assert "root:" not in said(error)


def test_texts_of_a_windows_code_page_are_read_and_said(load):
    text = line("14.00").replace('NAME="HEADER"', 'NAME="Kühlwasser °C"')
    assert "text read as cp1252" in load(text, encoding="cp1252").deck()
