"""PNG pictures: what their artists show, looked up in the figures before they become pixels."""

import re
import subprocess
import sys
from itertools import combinations
from pathlib import Path

import matplotlib as mpl
import numpy as np
import pytest
from matplotlib.backends.backend_agg import RendererAgg
from matplotlib.collections import PolyCollection
from matplotlib.colors import to_hex, to_rgb, to_rgba
from matplotlib.text import Text
from program import leave

import trunnion
from trunnion.cli import main
from trunnion.deck.reader import read_text
from trunnion.report import plots
from trunnion.report.plots import figures, page
from trunnion.report.plots.convergence import phase_of, story
from trunnion.report.plots.cycles import traces
from trunnion.report.plots.glyphs import glyphs
from trunnion.report.plots.labels import Label, Space, place
from trunnion.report.plots.names import safe
from trunnion.report.plots.paint import Paint
from trunnion.report.plots.palette import STATES, TYPES
from trunnion.report.plots.pipe import paint_pipes, plain_faces
from trunnion.report.plots.scene import frame_of, subject
from trunnion.report.plots.supportrows import rows_of_loads, rows_of_states
from trunnion.report.plots.supportstates import glyph_looks, signed_loads
from trunnion.report.plots.view import isometric
from trunnion.report.units import report_units
from trunnion.results.supports import card_loads, card_nodes, card_states

MODELS = Path(__file__).parents[2] / "models"
HEAD = """\
UNITS    mm kN bar C
DEFAULT  MU=0.3
MATERIAL STEEL  E=203GPa NU=0.3 ALPHA=12e-6 DENSITY=7850
SECTION  P      OD=273.1 WALL=9.27
OPERATE  T1=170 TREF=20
"""
LINE = (
    r"TITLE    Cost $5^2$ of \frac{a & $\alpha line"
    + "\n"
    + HEAD
    + """\
ANCHOR   10
PIPE     10 20  DX=6000
SUPPORT  20     +Y GUIDE GAP=3
PIPE     20 30  DX=6000
BEND     30     R=381
PIPE     30 40  DZ=4000
SUPPORT  40     +Y
PIPE     40 45  DY=2000
PIPE     45 50  DZ=500
SUPPORT  50     +Y
SNUBBER  40     X
CASE SUS = W
CASE OPE = W + T1
COMB EXP = OPE - SUS
CASE EQ = U(0.3,0,0) ABOUT=OPE
COMB OCC = SUS + ABS(EQ)
"""
)


def made(model, stem="line", spread=0):
    """Figures of a model by their names, with the results."""
    results = trunnion.solve(model, spread=spread) if spread else trunnion.solve(model)
    with page.style():
        return dict(figures(results, model, stem)), results


def texts(figure):
    return [t for t in figure.findobj(Text) if t.get_text().strip() and t.get_visible()]


def said(figure):
    return "\n".join(t.get_text() for t in texts(figure))


def gid(figure, name):
    """The artist that carries a name."""
    found = figure.findobj(lambda a: a.get_gid() == name)
    assert found, f"nothing in the picture is called {name}"
    return found[0]


@pytest.fixture(scope="module")
def line():
    model = read_text(LINE, "line.inp")
    drawn, results = made(model)
    return model, results, drawn


@pytest.fixture(scope="module")
def of_model():
    """Figures and results of a deck in models/, made once."""
    kept = {}

    def get(name, spread=0):
        if name not in kept:
            kept[name] = made(trunnion.read(MODELS / f"{name}.inp"), name, spread)
        return kept[name]

    return get


def test_every_case_has_its_pictures(line):
    _, _, drawn = line
    cases = ("SUS", "OPE", "EXP", "EQ", "OCC")
    expected = [f"{case}.{what}" for case in cases for what in ("displaced", "supports")]
    assert list(drawn) == ["isometric", *expected, "convergence"]


@pytest.mark.parametrize(
    ("name", "spread", "picture"),
    [
        ("strut_three", 20, "PUSH.answers"),
        ("cycle_line", 0, "HEAT.cycle"),
        ("nr1677_v1_p3", 0, "modes"),
    ],
)
def test_answers_cycles_and_modes_have_pictures(of_model, name, spread, picture):
    assert picture in of_model(name, spread)[0]


def written(figure, monkeypatch):
    """Every text that is drawn, with its box."""
    drawn = {}
    plain = RendererAgg.draw_text

    def draw_text(self, *args, **keys):
        drawn[id(keys["mtext"])] = keys["mtext"]
        return plain(self, *args, **keys)

    monkeypatch.setattr(RendererAgg, "draw_text", draw_text)
    figure.canvas.draw()
    return [(t.get_text(), t.get_window_extent()) for t in drawn.values()]


DECKS = ["hot_header", "snubber_line", "rack_50", "components", "nr1677_v1_p3", "slide_unload"]


@pytest.mark.parametrize("name", DECKS)
def test_no_text_covers_other_text_or_leaves_the_page(of_model, name, monkeypatch):
    drawn = of_model(name)[0]
    for picture in [*list(drawn)[:5], *list(drawn)[-2:]]:
        figure = drawn[picture]
        width, height = figure.canvas.get_width_height()
        boxes = written(figure, monkeypatch)
        for text, box in boxes:
            assert box.x0 >= 0, (picture, text)
            assert box.y0 >= 0, (picture, text)
            assert box.x1 <= width, (picture, text)
            assert box.y1 <= height, (picture, text)
        for (a, first), (b, second) in combinations(boxes, 2):
            x = min(first.x1, second.x1) - max(first.x0, second.x0)
            y = min(first.y1, second.y1) - max(first.y0, second.y0)
            assert min(x, y) < 2.0, f"{picture}: {a!r} and {b!r} overlap by {x:.0f} x {y:.0f}"


@pytest.mark.parametrize("up", [1, 2])
def test_up_is_vertical_and_scales_are_equal(up):
    deck = LINE if up == 1 else LINE.replace("MU=0.3", "MU=0.3 UP=Z").replace("+Y", "+Z")
    deck = deck if up == 1 else deck.replace("DY=2000", "DZ=2000").replace("DZ=4000", "DY=4000")
    system = trunnion.solve(read_text(deck, "line.inp")).system
    view = isometric(system.xyz, system.up)
    axis = np.eye(3)[up]
    assert view.right @ axis == pytest.approx(0.0, abs=1e-15)
    assert view.rise @ axis > 0.5
    lengths = np.linalg.norm(view.flat(np.eye(3)), axis=1)
    np.testing.assert_allclose(lengths, np.sqrt(2 / 3), rtol=1e-12)  # isometric: all alike
    with page.style():
        figure = dict(
            figures(trunnion.solve(read_text(deck, "l.inp")), read_text(deck, "l.inp"), "l")
        )
    axes = figure["isometric"].axes[0]
    origin, right, rise = axes.transData.transform([(0, 0), (1, 0), (0, 1)])
    assert right[0] - origin[0] == pytest.approx(rise[1] - origin[1], rel=1e-6)


def test_bends_are_arcs_and_pipes_as_wide_as_their_diameter(line):
    _, results, drawn = line
    found = subject(results.system)
    on_bend = found.course.lines.element == [p.type for p in results.system.parts].index("bend")
    arc = found.course.at[on_bend]
    corner = np.array([12.0, 0.0, 0.0])
    centre = corner + np.array([-0.381, 0.0, 0.381])
    np.testing.assert_allclose(np.linalg.norm(arc - centre, axis=1), 0.381, rtol=1e-9)
    assert len(arc) == 19  # 5 degrees apart
    axes = drawn["isometric"].axes[0]
    quads = [p.vertices[:4] for c in axes.collections for p in c.get_paths() if len(p) == 5]
    widths = [np.linalg.norm(q[0] - q[3]) for q in quads]
    scale = np.ptp(axes.get_xlim()) / (72.0 * axes.get_position().width * page.WIDTH)
    least = max(0.2731, 2.2 * scale)
    assert min(abs(w - least) for w in widths) < 1e-9


THICK = """\
UNITS    mm kN bar C
MATERIAL S  E=203GPa NU=0.3 ALPHA=12e-6 DENSITY=7850
SECTION  P  NPS=24 SCH=40
OPERATE  T1=150
ANCHOR   10
PIPE     10 20 DX=1500
BEND     20
PIPE     20 30 DZ=2500
BEND     30
PIPE     40 30 DY=-1600
ANCHOR   40
CASE OPE = W + T1
"""


@pytest.mark.parametrize("picture", ["isometric", "OPE.displaced"])
def test_no_slit_shows_where_a_bend_meets_its_tangent(picture):
    """Each part of a pipe ends in the very edge in which the next begins, also run backwards."""
    drawn, results = made(read_text(THICK, "thick.inp"), "thick")
    quads = [
        path.vertices[:4]
        for collection in drawn[picture].axes[0].collections
        for path in collection.get_paths()
        if len(path) == 5
    ]
    od = results.system.od[0]
    parts = [q for q in quads if abs(np.linalg.norm(q[0] - q[3]) - od) < 1e-9]
    edges = [np.sort(edge, axis=0).ravel() for q in parts for edge in (q[[0, 3]], q[[1, 2]])]
    alone = [e for e in edges if sum(np.allclose(e, x, atol=1e-9, rtol=0) for x in edges) < 2]
    lines = 2 if picture == "OPE.displaced" else 1  # the undeformed one, too
    assert len(parts) > 50 * lines
    assert len(alone) == 2 * lines  # at the anchors


def test_the_rim_of_a_corner_lies_behind_the_pipes_that_meet_there():
    """Also where pipes are so thick that a corner covers several of their parts."""
    deck = HEAD + "ANCHOR 1\nPIPE 1 2 DX=1000\nPIPE 2 3 DZ=1000\nPIPE 3 4 DY=700\nCASE A = W\n"
    found = subject(trunnion.solve(read_text(deck, "corner.inp")).system)
    paint = Paint()
    with page.style():
        frame = frame_of(page.page("", ""), (1, 1, 6, 5), found)
    faces = plain_faces(found.system, found.course)
    paint_pipes(paint, frame, found.system, found.course, found.course.at, faces)
    rim = to_rgba(plots.palette.RIM)
    discs = [i for i, p in enumerate(paint.polygons) if len(p) > 4]
    fills = [i for i, p in enumerate(paint.polygons) if len(p) == 4 and paint.faces[i] != rim]
    assert len(discs) == 8  # two corners, two ends each, rim and fill
    covered = 0
    for i in discs:
        middle = paint.polygons[i].mean(axis=0)
        radius = np.linalg.norm(paint.polygons[i][0] - middle)
        for k in fills:
            if np.linalg.norm(paint.polygons[k].mean(axis=0) - middle) < radius:
                covered += 1
                assert (paint.depths[i] < paint.depths[k]) == (paint.faces[i] == rim)
    assert covered > 16


def test_states_have_the_colour_and_mark_of_their_words(line):
    _, results, drawn = line
    for name in ("SUS", "OPE"):
        case, figure = results[name], drawn[f"{name}.supports"]
        states = card_states(case)
        assert len(set(states)) > 1
        for state in set(states):
            drawn_marks = gid(figure, f"state {state}")
            assert drawn_marks.get_marker() == STATES[state].mark
            assert len(drawn_marks.get_xdata()) == states.count(state)
            used = drawn_marks.get_markerfacecolor() if STATES[state].filled else "#ffffff"
            assert to_hex(used) == (STATES[state].colour if STATES[state].filled else "#ffffff")


def test_each_direction_word_has_its_own_colour(line):
    """Node 20 when hot: the rest carries, the guide beside it may be open."""
    _, results, _ = line
    case = results["OPE"]
    found = subject(results.system)
    with page.style():
        from trunnion.report.plots.glyphs import stand

        figure = page.page("", "")
        frame = frame_of(figure, (1, 1, 6, 5), found)
    bodies = glyphs(case.system, stand(case.system, frame, found.course))
    looks = glyph_looks(case, bodies)
    rows = {row.name: row.look for _, row in rows_of_states(case, report_units(line[0].units))}
    for body, look in zip(bodies, looks, strict=True):
        if body.contact >= 0 and case.system.cards[body.card].kind == "support":
            label = case.system.cards[body.card].label
            assert look == rows[f"{label} {case.system.contacts.word[body.contact]}"]
    kinds = {(case.system.cards[b.card].label, b.kind) for b in bodies}
    assert {("10", "anchor"), ("20", "rest"), ("20", "guide"), ("40", "snubber")} <= kinds


def test_the_table_says_what_the_text_report_says(line):
    model, results, drawn = line
    from trunnion.report.states import state_table

    units = report_units(model.units)
    table = state_table(results["OPE"], units)
    shown = said(drawn["OPE.supports"])
    for _, row in rows_of_states(results["OPE"], units):
        assert row.name in shown
        if row.name.endswith(("ANCHOR", "moment")):
            continue
        line_ = next(r for r in table.splitlines() if r.split()[:2] == row.name.split()[:2])
        assert row.cells[0] in line_
        if row.cells[1]:
            known = [float(x) for x in re.findall(r"-?\d+\.\d+", line_)]
            assert min(abs(x - float(row.cells[1])) for x in known) < 1e-3
            assert row.cells[1] in shown


def test_arrows_are_as_long_as_loads_and_point_along_them(line):
    _, results, drawn = line
    case, figure = results["OPE"], drawn["OPE.supports"]
    found = next(
        c
        for c in figure.axes[0].findobj(PolyCollection)
        if to_hex(c.get_facecolor()[0]) == plots.palette.ARROW
    )
    load = card_loads(case)[:, :3]
    order = np.argsort(-np.linalg.norm(load, axis=1), kind="stable")
    view = isometric(case.system.xyz, case.system.up)
    ratios = []
    for path, card in zip(found.get_paths(), order, strict=False):
        tip = path.vertices[2]
        tail = path.vertices[5:7].mean(axis=0)
        flat = view.flat(load[card])
        ratios.append(np.linalg.norm(tip - tail) / np.linalg.norm(flat))
        assert np.cross([*(tip - tail), 0], [*flat, 0])[2] == pytest.approx(
            0.0, abs=1e-9 * np.linalg.norm(tip - tail) * np.linalg.norm(flat)
        )
        assert (tip - tail) @ flat > 0.0
    np.testing.assert_allclose(ratios, ratios[0], rtol=1e-9)
    assert len(ratios) >= 3


def test_loads_press_on_rests_and_pull_at_hangers(of_model):
    """Arrow heads are at the rest, feet at the hanger, where both carry weight downwards."""
    drawn, results = of_model("hangers")
    case = results["OPE"]
    found = next(
        c
        for c in drawn["OPE.supports"].axes[0].findobj(PolyCollection)
        if to_hex(c.get_facecolor()[0]) == plots.palette.ARROW
    )
    order = np.argsort(-np.linalg.norm(card_loads(case)[:, :3], axis=1), kind="stable")
    nodes = np.array(card_nodes(case.system))[order]
    at = isometric(case.system.xyz, case.system.up).flat(case.system.xyz[nodes])
    kinds = [case.system.cards[i].kind for i in order]
    assert set(kinds) == {"anchor", "hanger", "support"}
    for kind, place_, path in zip(kinds, at, found.get_paths(), strict=True):
        above = path.vertices[:7, 1].max() > place_[1] + 0.1
        below = path.vertices[:7, 1].min() < place_[1] - 0.5
        assert (above, below) == ((False, True) if kind == "hanger" else (True, False)), kind


def test_displacements_are_drawn_by_the_factor_that_is_stated(line):
    _, results, drawn = line
    figure = drawn["OPE.displaced"]
    factor = float(re.search(r"drawn x (\S+)", said(figure))[1])
    found = subject(results.system)
    from trunnion.report.centreline import along

    _, move, _ = along(results["OPE"], found.course.lines)
    size = np.linalg.norm(move[:, :3], axis=1)
    i = int(size.argmax())
    ring = gid(figure, "largest")
    at = found.view.flat(found.course.at[i] + factor * move[i, :3])
    np.testing.assert_allclose([ring.get_xdata()[0], ring.get_ydata()[0]], at, atol=1e-12)
    assert f"{1e3 * size[i]:.3f} mm" in said(figure)


def test_colour_grows_with_displacement_up_to_the_end_of_the_bar(line):
    _, results, drawn = line
    bar = drawn["OPE.displaced"].axes[1]
    found = subject(results.system)
    from trunnion.report.centreline import along

    _, move, _ = along(results["OPE"], found.course.lines)
    most = 1e3 * np.linalg.norm(move[:, :3], axis=1).max()
    np.testing.assert_allclose(bar.get_ylim(), (0.0, most), rtol=1e-12)
    shades = mpl.colormaps[plots.palette.FIELD](np.linspace(0, 1, 9))[:, :3]
    grey = shades @ [0.2126, 0.7152, 0.0722]
    assert (np.diff(grey) < 0.0).all()  # readable without colours


def test_sizes_without_sign_have_no_shape_and_no_single_arrow(line, of_model):
    _, results, drawn = line
    assert "without a shape" in said(drawn["OCC.displaced"])
    assert "drawn x" not in said(drawn["OCC.displaced"])
    assert "drawn x" in said(drawn["EXP.displaced"])
    _, load, both = signed_loads(results["OCC"])
    assert any(both)
    assert (np.count_nonzero(load[np.array(both)], axis=1) == 1).all()
    spectrum, answers = of_model("nr1677_v1_p3")
    assert "without a shape" in said(spectrum["RS.displaced"])
    assert all(signed_loads(answers["RS"])[2])
    cells = [
        c for row in rows_of_loads(answers["RS"], report_units(line[0].units)) for c in row.cells
    ]
    assert any(c.startswith("±") for c in cells)
    assert not any(c.startswith("-") for c in cells)


def test_a_case_that_failed_says_so_and_shows_no_numbers(results, model):
    with page.style():
        drawn = dict(figures(results, model, "cantilever"))
    for name in ("OFF.displaced", "OFF.supports"):
        text = said(drawn[name])
        assert "NOT CONVERGED" in text
        assert "friction cycles at 30 +Y" in text
        assert "certificate passed" not in text
        assert not drawn[name].findobj(lambda a: a.get_gid() == "largest")
    assert "NOT CONVERGED" in said(drawn["convergence"])
    assert "friction cycles at 30 +Y" in said(drawn["convergence"])
    assert "NOT CONVERGED" not in said(drawn["OPE.displaced"])


def test_iterations_and_the_limit_of_the_certificate_are_drawn(line):
    _, results, drawn = line
    figure = drawn["convergence"]
    case = results["OPE"]
    panel = next(a for a in figure.axes if a.get_title(loc="left").startswith("OPE:"))
    known = {phase_of(str(record["what"])) for record in case.history}
    points = sum(len(gid(panel, phase).get_xdata()) for phase in known)
    assert points == len(case.history) == len(story(case).value)
    assert gid(panel, "limit").get_ydata()[0] == 1e-9
    worst = gid(panel, "certificate").get_ydata()
    assert np.atleast_1d(worst)[0] == pytest.approx(case.certificate.worst)
    scale = case.history[0]["residual"] / story(case).value[0]
    assert scale == pytest.approx(np.abs(card_loads(case)[:, :3]).max(), rel=0.5)
    items = gid(figure, "OPE").get_xdata()
    assert len(items) == len(case.certificate.items)


def test_a_cycle_shows_the_widest_range_once_a_course(of_model):
    drawn, results = of_model("cycle_line")
    found = traces(results.cycles["HEAT"])
    assert np.ptp(found[0].values) == pytest.approx(146_142.6, rel=1e-3)  # the deck's own number
    assert found[1].alike == 9  # ten rests slide alike
    assert "146143 N; each case on its own 73071 N" in said(drawn["HEAT.cycle"])


def test_three_answers_stand_beside_each_other(of_model):
    drawn, _ = of_model("strut_three", 20)
    text = said(drawn["PUSH.answers"])
    for word in ("open", "slip", "stick", "3626", "18979"):
        assert word in text.split()


def test_text_of_the_deck_is_no_mathematics(line):
    _, results, drawn = line
    for figure in drawn.values():
        title = next(t for t in texts(figure) if t.get_fontsize() == page.LARGE)
        assert title.get_text() == results.title
        assert not any(t.get_parse_math() for t in texts(figure))


def test_signs_that_the_font_has_not_become_squares_and_draw_without_warning():
    deck = LINE.replace("Cost", "\u6f22\u5b57")
    drawn, _ = made(read_text(deck, "line.inp"))
    title = next(t for t in texts(drawn["isometric"]) if t.get_fontsize() == page.LARGE)
    assert title.get_text().startswith("\u25a1\u25a1")
    assert page.shown("a\x07b\u202ec\ud800") == "a b c "
    assert page.png(drawn["isometric"]).startswith(b"\x89PNG")


def seen_by(colour, matrix):
    """L*a*b* of a colour as someone with a colour vision deficiency sees it."""
    rgb = np.array(to_rgb(colour))
    linear = np.where(rgb <= 0.04045, rgb / 12.92, ((rgb + 0.055) / 1.055) ** 2.4)
    xyz = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]])
    t = (xyz @ np.clip(np.array(matrix) @ linear, 0, 1)) / [0.9505, 1.0, 1.089]
    f = np.where(t > 0.008856, np.cbrt(t), 7.787 * t + 16 / 116)
    return np.array([116 * f[1] - 16, 500 * (f[0] - f[1]), 200 * (f[1] - f[2])])


# Machado, Oliveira, Fernandes (2009), severity 1.0
DEUTERANOPIA = [[0.367, 0.861, -0.228], [0.280, 0.673, 0.047], [-0.012, 0.043, 0.969]]
PROTANOPIA = [[0.152, 1.053, -0.205], [0.115, 0.786, 0.099], [-0.004, -0.048, 1.052]]


@pytest.mark.parametrize("matrix", [np.eye(3), DEUTERANOPIA, PROTANOPIA])
def test_states_stay_apart_for_colour_blind_readers(matrix):
    """A difference of 10 in L*a*b* is seen at a glance (2.3 is just noticed)."""
    for (a, first), (b, second) in combinations(STATES.items(), 2):
        apart = np.linalg.norm(seen_by(first.colour, matrix) - seen_by(second.colour, matrix))
        assert apart > 10.0, f"{a} and {b}"


def test_states_stay_apart_without_any_colour():
    looks = [(look.mark, look.filled) for look in STATES.values()]
    assert len(set(looks)) == len(looks)


def test_types_have_their_own_colours():
    colours = [look.colour for look in TYPES.values()]
    assert len(set(colours)) >= len(colours) - 1  # a link is a dashed line of an ink of its own


@pytest.mark.parametrize(
    "deck",
    [
        HEAD + "ANCHOR 1\nPIPE 1 2 DX=5\nCASE A = W\n",
        HEAD + "ANCHOR 1\nPIPE 1 2 DY=500000\nCASE A = W\n",
        HEAD + "PIPE 1 2 DX=5000\nMODES 3\n",
        HEAD
        + "NODE 1 X=0\nSPRING 1 KX=1 KY=1 KZ=1 KRX=1 KRY=1 KRZ=1\nFORCE 1 F1 FX=1\nCASE A = F1\n",
        HEAD + "ANCHOR 1\nPIPE 1 2 DX=1000 DY=-1000 DZ=1000\nSUPPORT 2 +Y CNODE=3 RX\n"
        "PIPE 1 3 DZ=2000\nCASE A = W\n",
        HEAD + "ANCHOR 1\nPIPE 1 2 DX=5000\nCASE A = U(0,0,0) SNUBBERS=FREE\n",
    ],
    ids=["5 mm", "500 m", "no restraints", "one node", "toward the reader, CNODE", "no load"],
)
def test_odd_models_are_drawn(deck):
    drawn, _ = made(read_text(deck, "odd.inp"))
    for figure in drawn.values():
        assert page.png(figure).startswith(b"\x89PNG")
    if "ANCHOR" not in deck and "SPRING" not in deck:
        assert "no restraints" in said(drawn["isometric"])


def test_labels_of_a_large_model_are_thinned_and_its_supports_are_dots():
    rows = [f"PIPE {i} {i + 1} DX=3000\n" for i in range(1, 1200)]
    rows += [f"SUPPORT {i} +Y\n" for i in range(2, 1200, 2)]
    drawn, results = made(read_text(HEAD + "ANCHOR 1\n" + "".join(rows) + "CASE A = W\n", "l.inp"))
    labels = set(results.system.labels)
    shown = [t for t in texts(drawn["isometric"]) if t.get_text() in labels]
    assert 10 < len(shown) <= 48
    assert f"{len(shown)} of 1200 nodes have room for a label" in said(drawn["isometric"])
    numbers = sorted(int(t.get_text()) for t in shown)
    assert max(np.diff(numbers)) < 300  # evenly along the line
    polygons = sum(len(c.get_paths()) for c in drawn["isometric"].axes[0].collections)
    assert polygons == 2 * len(subject(results.system).course.parts)  # no bodies of 599 rests
    assert "rest (the pipe may lift)  (599)" in said(drawn["isometric"])


def test_labels_take_no_place_that_is_taken():
    space = Space(np.array([100.0, 60.0]))
    space.lines(np.array([[[0.0, 30.0], [100.0, 30.0]]]), np.array([3.0]))
    points = np.column_stack([np.linspace(5.0, 95.0, 40), np.full(40, 30.0)])
    found = place(space, points, lambda _: (20.0, 8.0), most=40)
    assert 4 <= len(found) < 40  # the rest has no place
    for a, b in combinations(found, 2):
        assert abs(a.x - b.x) >= 20.0 - 1e-9 or abs(a.y - b.y) >= 8.0 - 1e-9
    for label in found:
        assert abs(label.y - 30.0) >= 3.0 + 4.0
        assert 10.0 <= label.x <= 90.0
        assert 4.0 <= label.y <= 56.0


def test_what_is_left_out_of_a_file_stands_in_every_picture_and_north_where_it_is_known(tmp_path):
    from pcf_lines import everything

    from trunnion.formats import read_any
    from trunnion.formats.options import Options

    (tmp_path / "line.pcf").write_text(everything())
    options = Options(anchors=("open-ends",))
    model = read_any(tmp_path / "line.pcf", permissive=True, options=options).model
    n = len(model.origin.left_out)
    assert n > 1
    drawn, _ = made(model)
    for name, figure in drawn.items():
        assert f"LEFT OUT: {n} features of line.pcf" in said(figure), name
    assert "Y north" in said(drawn["isometric"])


def test_north_is_not_invented(line):
    assert "north" not in said(line[2]["isometric"])


def test_lines_to_labels_cross_no_text_and_no_other_support():
    space = Space(np.array([200.0, 100.0]))
    start, end = np.array([20.0, 50.0]), np.array([120.0, 50.0])
    assert not space.crosses(start, end)
    space.body(22.0, 50.0, 10.0, 10.0)  # that of the node itself
    assert not space.crosses(start, end)
    space.body(70.0, 50.0, 10.0, 10.0)
    assert space.crosses(start, end)
    assert not space.crosses(start, np.array([20.0, 90.0]))
    space = Space(np.array([200.0, 100.0]))
    space.write(Label(0, 70.0, 50.0, 10.0, 8.0, False), start)
    assert space.crosses(start, end)


def test_names_of_files_are_safe_and_stay_apart():
    names = [
        "OPE",
        "A/B",
        "A%2FB",
        "A.B",
        "..",
        "A B",
        "\u00e9",
        "e\u0301",
        "x" * 300,
        "x" * 299,
        "",
        "\0",
    ]
    found = [safe(name) for name in names]
    assert len(set(found)) == len(found)
    for name in found:
        assert re.fullmatch(r"[A-Za-z0-9_+%~-]*", name)
        assert len(name) <= 80
    assert safe("OPE") == "OPE"


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """Pictures on disk."""
    home = tmp_path_factory.mktemp("png")
    (home / "line.inp").write_text(LINE)
    assert leave("run", home / "line.inp", "-o", home, "--png") == 0
    return home


def test_two_cases_give_different_pixels(run):
    from matplotlib.image import imread

    first, second = (imread(run / f"line.{c}.displaced.png") for c in ("SUS", "OPE"))
    assert first.shape == second.shape
    assert (first != second).any(axis=2).mean() > 0.005


def test_same_deck_gives_the_same_bytes_whatever_the_user_prefers(run, monkeypatch):
    model = trunnion.read(run / "line.inp")
    monkeypatch.setitem(mpl.rcParams, "font.size", 20.0)
    monkeypatch.setitem(mpl.rcParams, "lines.linewidth", 7.0)
    again = plots.files(trunnion.solve(model), model, "line")
    assert mpl.rcParams["font.size"] == 20.0  # and what they prefer is left as it was
    assert {name: (run / name).read_bytes() for name in again} == again
    assert all(b"tEXt" not in content for content in again.values())


def test_a_new_process_gives_the_same_bytes(run, tmp_path):
    command = [sys.executable, "-m", "trunnion", "run", "line.inp", "-o", str(tmp_path), "--png"]
    subprocess.run(command, cwd=run, check=True, capture_output=True)
    pictures = sorted(p.name for p in run.glob("*.png"))
    assert sorted(p.name for p in tmp_path.glob("*.png")) == pictures
    assert len(pictures) == 12
    for name in pictures:
        assert (tmp_path / name).read_bytes() == (run / name).read_bytes()


def test_files_appear_together_or_not_at_all(run, tmp_path, monkeypatch):
    drawn = []

    def full(figure):
        drawn.append(figure)
        if len(drawn) == 5:
            raise OSError("no space left on device")
        return b"picture"

    monkeypatch.setattr("trunnion.report.plots.png", full)
    with pytest.raises(SystemExit):
        main(["run", str(run / "line.inp"), "-o", str(tmp_path), "--png"])
    assert list(tmp_path.iterdir()) == []


def test_missing_package_is_named_before_any_work(run, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    with pytest.raises(SystemExit) as stop:
        main(["run", str(run / "line.inp"), "-o", str(tmp_path), "--png"])
    assert stop.value.code == 2
    said = capsys.readouterr().err
    assert "--png needs the package matplotlib: pip install 'trunnion[plot]'" in said
    assert list(tmp_path.iterdir()) == []
