"""VTU files, read back by meshio and compared with the JSON."""

import json
import re
from pathlib import Path
from xml.etree import ElementTree

import meshio
import numpy as np
import pytest

import trunnion
from trunnion.deck.reader import read_text
from trunnion.report import vtu
from trunnion.report.json import json_report

LINE = """\
DEFAULT  MU=0.3
MATERIAL STEEL  E=203e9 NU=0.3 ALPHA=11.7e-6 DENSITY=7850
SECTION  P10    OD=0.2731 WALL=0.00927
OPERATE  T1=170 P1=12e5 TREF=20
ANCHOR   10
PIPE     10 20  DX=6
SUPPORT  20     +Y
PIPE     20 30  DX=6
BEND     30     R=0.381
PIPE     30 40  DZ=4
SUPPORT  40     +Y
RIGID    40 50  DZ=1 WEIGHT=2000
SPRING   50     KX=1e5
SPRING   50 60  KY=1e5
ANCHOR   60
CASE OPE = W + P1 + T1
CASE SUS = W
COMB BIG = ABS(OPE)
"""
NAMES = ("axial_force", "shear_y", "shear_z", "torsion", "bending_y", "bending_z")


@pytest.fixture(scope="module")
def solved():
    model = read_text(LINE, "line.inp")
    return model, trunnion.solve(model)


@pytest.fixture(scope="module")
def numbers(solved):
    model, results = solved
    return json.loads(json_report(results, model))["cases"]


@pytest.fixture(scope="module")
def folder(solved, tmp_path_factory):
    model, results = solved
    home = tmp_path_factory.mktemp("vtu")
    for name, content in vtu.files(results, model, "line").items():
        (home / name).parent.mkdir(exist_ok=True)
        (home / name).write_bytes(content)
    return home


def mesh(folder, case, part):
    """Points with their data, scalars (n,) and vectors (n, 3); meshio leaves polylines out."""
    found = meshio.read(folder / "line_vtu" / f"{case}_{part}.vtu")
    found.point_data = {name: np.squeeze(data) for name, data in found.point_data.items()}
    return found


def raw(folder, case, name, dtype):
    """One array of the appended data, by its offset: a length of 8 bytes, then the numbers."""
    content = (folder / "line_vtu" / f"{case}_pipes.vtu").read_bytes()
    head, _, data = content.partition(b'<AppendedData encoding="raw">\n_')
    found = re.search(rf'Name="{name}"[^>]*offset="(\d+)"'.encode(), head)
    at = int(found[1])
    size = int(np.frombuffer(data, "<u8", 1, at)[0])
    return np.frombuffer(data, dtype, size // np.dtype(dtype).itemsize, at + 8)


def runs(folder, case):
    """Points of each element as slices."""
    stops = raw(folder, case, "offsets", "<i8")
    return [slice(a, b) for a, b in zip([0, *stops[:-1]], stops, strict=True)]


def test_the_collection_names_every_file_at_the_time_of_its_case(folder, numbers):
    rows = ElementTree.parse(folder / "line.pvd").getroot().findall("Collection/DataSet")
    assert [row.get("name") for row in rows[::2]] == list(numbers)
    assert [row.get("timestep") for row in rows] == ["0", "0", "1", "1", "2", "2"]
    assert all((folder / row.get("file")).is_file() for row in rows)
    assert len(list((folder / "line_vtu").iterdir())) == len(rows)


def test_every_element_is_a_polyline_from_node_to_node(folder, numbers):
    kinds = raw(folder, "OPE", "types", "u1")
    assert set(kinds.tolist()) == {4}  # VTK_POLY_LINE
    found = mesh(folder, "OPE", "pipes")
    elements = numbers["OPE"]["elements"]
    pieces = runs(folder, "OPE")
    assert len(pieces) == len(elements) == len(kinds)
    assert raw(folder, "OPE", "connectivity", "<i8").tolist() == list(range(len(found.points)))
    for piece, element in zip(pieces, elements, strict=True):
        for i, end in ((piece.start, "from"), (piece.stop - 1, "to")):
            node = numbers["OPE"]["nodes"][element[end]]
            move = [*found.point_data["displacement"][i], *found.point_data["rotation"][i]]
            # the inside of an element is integrated from its first end: round-off of the length
            assert np.allclose(move, node, rtol=0.0, atol=1e-12)


def test_a_bend_is_round_and_its_middle_moves_as_in_the_json(folder, numbers):
    found, elements = mesh(folder, "OPE", "pipes"), numbers["OPE"]["elements"]
    (bend,) = [i for i, e in enumerate(elements) if e["type"] == "bend"]
    piece = runs(folder, "OPE")[bend]
    xyz = found.points[piece]
    assert len(xyz) == 19  # 90 degrees in parts of 5
    centre = np.array([12.0 - 0.381, 0.0, 0.381])
    assert np.allclose(np.linalg.norm(xyz - centre, axis=1), 0.381, rtol=1e-12)
    middle = found.point_data["displacement"][piece][9]
    assert np.allclose(middle, numbers["OPE"]["nodes"]["30M"][:3], rtol=0.0, atol=1e-12)


def test_section_forces_at_the_ends_are_those_of_the_json(folder, numbers):
    found, elements = mesh(folder, "OPE", "pipes"), numbers["OPE"]["elements"]
    largest = max(abs(x) for e in elements for x in e["local_to"])
    for piece, element in zip(runs(folder, "OPE"), elements, strict=True):
        if element["type"] == "spring":
            continue
        for i, end, sign in ((piece.start, "from", -1.0), (piece.stop - 1, "to", 1.0)):
            section = [found.point_data[name][i] for name in NAMES]
            expected = sign * np.array(element[f"local_{end}"])
            assert np.allclose(section, expected, rtol=0.0, atol=1e-10 * largest)


def test_cell_data_are_the_end_forces_of_the_json(folder, numbers):
    elements = numbers["OPE"]["elements"]
    for end in ("from", "to"):
        force = raw(folder, "OPE", f"force_{end}", "<f8").reshape(-1, 3)
        moment = raw(folder, "OPE", f"moment_{end}", "<f8").reshape(-1, 3)
        expected = [e[f"force_{end}"] for e in elements]
        assert np.array_equal(np.hstack([force, moment]), expected)
    kinds = {"pipe": 0, "bend": 1, "spring": 2, "rigid": 3}
    assert raw(folder, "OPE", "kind", "<i4").tolist() == [kinds[e["type"]] for e in elements]


def test_stress_is_there_for_pipes_alone(folder, numbers):
    found = mesh(folder, "OPE", "pipes").point_data["von_mises"]
    stresses = {pipe["id"]: pipe["von_mises"] for pipe in numbers["OPE"]["stresses"]}
    for piece, element in zip(runs(folder, "OPE"), numbers["OPE"]["elements"], strict=True):
        if element["type"] in ("rigid", "spring"):
            assert np.isnan(found[piece]).all()
        else:
            ends = found[[piece.start, piece.stop - 1]]
            assert np.allclose(ends, stresses[element["id"]], rtol=1e-8)  # 9 digits in the JSON


def test_restraints_are_points_with_forces_on_the_pipe(folder, numbers):
    states = ("open", "engaged", "stick", "slip", "free", "locked")
    for case, entry in numbers.items():
        found, cards = mesh(folder, case, "restraints"), entry["supports"]
        assert [block.type for block in found.cells] == ["vertex"]
        for name in ("force", "moment", "friction"):
            assert np.array_equal(found.point_data[name], [card[name] for card in cards])
        expected = [-1 if c["state"] is None else states.index(c["state"]) for c in cards]
        assert found.point_data["state"].tolist() == expected


def test_sizes_without_sign_are_exact_at_the_ends_and_drawn_on_the_same_bends(folder, numbers):
    found, same = mesh(folder, "BIG", "pipes"), mesh(folder, "OPE", "pipes")
    assert np.allclose(found.points, same.points, rtol=0.0, atol=1e-12)
    for piece, element in zip(runs(folder, "BIG"), numbers["BIG"]["elements"], strict=True):
        ends = found.point_data["displacement"][[piece.start, piece.stop - 1]]
        expected = [numbers["BIG"]["nodes"][element[end]][:3] for end in ("from", "to")]
        assert np.allclose(ends, expected, rtol=1e-15, atol=0.0)


def test_a_failed_case_has_no_file(results, model):
    names = list(vtu.files(results, model, "a"))
    assert "a_vtu/OPE_pipes.vtu" in names
    assert not [name for name in names if "OFF" in name]


def test_the_name_of_the_deck_is_escaped_in_the_collection(results, model):
    content = vtu.files(results, model, 'a&"b')['a&"b.pvd'].decode()
    rows = ElementTree.fromstring(content).findall("Collection/DataSet")
    assert rows[0].get("file") == 'a&"b_vtu/OPE_pipes.vtu'


def test_every_array_is_documented(folder):
    text = (Path(__file__).parents[2] / "docs" / "tables_and_files.md").read_text()
    for part in ("pipes", "restraints"):
        content = (folder / "line_vtu" / f"OPE_{part}.vtu").read_bytes()
        head = content.partition(b"<AppendedData")[0].decode()
        inner = head[head.index("<PointData") :]
        names = re.findall(r'<DataArray [^>]*Name="(\w+)"', inner)
        assert len(names) > 6
        assert [name for name in names if f"`{name}`" not in text] == []
