"""The HTML report in a real browser, and what of it needs none."""

import dataclasses
import json
import re
import subprocess
from base64 import b64decode
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from pagebrowser import choose, chromium, opened, picture, requests, until_drawn, window
from program import leave

import trunnion
from trunnion.arrays import SLIP, STICK, Pass
from trunnion.certificate.scales import measure
from trunnion.cli import main
from trunnion.formats import read_any
from trunnion.report import html
from trunnion.report.html.story import Course, course, stories, words
from trunnion.report.units import report_units
from trunnion.results.supports import card_levels

EVIL = "</script><script>document.title='owned'</script><img src=x onerror=document.title='owned'>"
DECK = f"""\
TITLE    {EVIL}
UNITS    mm kN bar C
DEFAULT  MU=0.3
MATERIAL STEEL  E=203GPa NU=0.3 ALPHA=12e-6 DENSITY=7850
SECTION  P      OD=273.1 WALL=9.27
OPERATE  T1=170 TREF=20
ANCHOR   10
PIPE     10 20  DX=6000
SUPPORT  20     +Y GUIDE GAP=3
PIPE     20 30  DX=6000
BEND     30     R=381
PIPE     30 40  DZ=4000
SUPPORT  40     +Y
CASE SUS = W
CASE OPE = W + T1
COMB EXP = OPE - SUS
"""


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    """A report on disk."""
    home = tmp_path_factory.mktemp("html")
    (home / "line.inp").write_text(DECK)
    assert leave("run", home / "line.inp", "-o", home, "--html") == 0
    return home / "line.html"


@pytest.fixture(scope="module")
def browser(page):
    with chromium() as driver:
        opened(driver, page, "OPE move")
        yield driver


def test_page_loads_without_errors_and_without_any_request(page, browser):
    severe = [e for e in browser.get_log("browser") if e["level"] == "SEVERE"]
    assert severe == []
    outside = [url for url in requests(browser) if not url.startswith(("data:", "blob:"))]
    assert outside == [page.resolve().as_uri()]


def test_text_of_the_deck_is_no_markup(page, browser):
    assert browser.title == EVIL
    assert browser.execute_script("return document.querySelectorAll('img[src=x]').length") == 0
    assert browser.execute_script("return document.querySelector('h1').textContent") == EVIL


def test_cases_and_colours_give_different_pixels(browser):
    seen = {}
    for case, name in (("1", "OPE"), ("0", "SUS")):
        for colour in ("move", "bending", "state"):
            choose(browser, "case", case)
            choose(browser, "colour", colour)
            until_drawn(browser, f"{name} {colour}")
            seen[name, colour] = picture(browser)
    assert len(set(seen.values())) == len(seen)


def test_numbers_in_the_page_are_those_of_the_json(page, browser):
    answers = json.loads(page.with_suffix(".json").read_text())
    support = next(s for s in answers["cases"]["OPE"]["supports"] if s["node"] == "20")
    script = """
        const rows = document.querySelectorAll('[data-table=restraints] tbody tr');
        for (const row of rows) {
            const cells = [...row.children];
            if (cells[1].textContent === '20' && cells[2].textContent === 'OPE')
                return [cells[3].textContent, ...cells.slice(4, 10).map((c) => +c.dataset.value)];
        }"""
    state, *load = browser.execute_script(script)
    assert state == support["state"]
    # on the restraint [kN, kN m] against on the pipe [N, N m]: the same doubles but for the factor
    expected = [-1e-3 * x for x in [*support["force"], *support["moment"]]]
    np.testing.assert_allclose(load, expected, rtol=1e-14, atol=0.0)
    assert abs(load[1]) > 1.0


def test_tables_filter_and_sort(browser):
    script = """
        const done = arguments[0], t = document.querySelector('[data-table=displacements]');
        t.querySelectorAll('th')[2].click();
        const box = t.querySelector('input');
        box.value = 'DX > 20';
        box.dispatchEvent(new Event('input'));
        setTimeout(() => done([...t.querySelectorAll('tbody tr')].map(
            (r) => +r.children[2].dataset.value)), 400);"""
    found = browser.execute_async_script(script)
    assert found == sorted(found, reverse=True)
    assert found
    assert min(found) > 20.0


def test_same_deck_gives_the_same_page(page):
    model = trunnion.read(page.with_suffix(".inp"))
    again = html.files(trunnion.solve(model), model, "line")["line.html"]
    assert again == page.read_bytes()


def test_missing_packages_are_named_before_any_work(page, monkeypatch, tmp_path, capsys):
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    with pytest.raises(SystemExit) as stop:
        main(["run", str(page.with_suffix(".inp")), "-o", str(tmp_path), "--html"])
    assert stop.value.code == 2
    assert "--html needs the packages plotly and jinja2: pip install 'trunnion[html]'" in (
        capsys.readouterr().err
    )
    assert list(tmp_path.iterdir()) == []


def passes(system, first, second, n=8):
    """A made-up history: a guide-free pair of rests that open in turn."""
    rest = [i for i, word in enumerate(system.contacts.word) if word == "+Y"]
    found = []
    for i in range(n):
        side = np.where(system.contacts.two_way, 2, 0).astype(np.int8)
        reaction = np.zeros((len(side), 3), np.float32)
        side[rest[i % 2]] = -1
        for j, force in zip(rest, (first, second) if i % 2 == 0 else (second, first), strict=True):
            reaction[j, 1] = force
        m = len(system.sliders.mu)
        normal = np.linalg.norm(reaction[system.sliders.contact[:m]], axis=1)
        still = np.zeros((m, 3), np.float32)
        found.append(Pass(side, reaction, np.zeros(m, np.int8), still, normal.astype(np.float32)))
    return found


@pytest.mark.parametrize(("second", "why"), [(0.0, True), (990.0, False)])
def test_alternating_supports_are_explained_only_by_a_load_they_share(page, second, why):
    model = trunnion.read(page.with_suffix(".inp"))
    case = trunnion.solve(model)["OPE"]
    case.passes = passes(case.system, 1000.0, second)
    found = course(case)
    changes = {
        i: (np.flatnonzero(np.diff(found.level[:, i])) + 1).tolist()
        for i in range(len(case.system.cards))
    }
    card = next(i for i, c in enumerate(case.system.cards) if c.label == "40")
    said = words(case.system, found, changes, card, report_units(model.units))
    assert "fro: held there, the pipe comes off again; let go, it moves past its stop." in said
    assert "20 +Y GUIDE" in said
    assert ("engaged while that one is open and open while that one is engaged" in said) is not why
    assert ("these two alternate because they share a load" in said) is why


AGAINST = "slip while that one is stick and stick while that one is slip"


@pytest.mark.parametrize(
    ("alike", "end"), [(14, ": both slip, or both stick."), (0, f": {AGAINST}."), (7, ".")]
)
def test_sliders_that_alternate_are_told_with_their_reason(page, alike, end):
    model = trunnion.read(page.with_suffix(".inp"))
    case = trunnion.solve(model)["OPE"]
    n = 14
    mine = np.array([STICK, SLIP] * (n // 2), np.int8)
    theirs = np.where(np.arange(n) < alike, mine, STICK + SLIP - mine)
    cards = [i for i, c in enumerate(case.system.cards) if c.label in ("20", "40")]
    level = np.zeros((n, len(case.system.cards)), np.int8)
    level[:, cards[0]], level[:, cards[1]] = mine, theirs
    nothing = np.zeros(level.shape)
    made = Course(level, nothing, np.full(level.shape, np.nan), np.full(level.shape, np.nan))
    changes = {i: (np.flatnonzero(np.diff(level[:, i])) + 1).tolist() for i in cards}
    said = words(case.system, made, changes, cards[0], report_units(model.units))
    assert "It went to and fro: stuck, it needs more friction than mu N; sliding, less." in said
    assert "20 +Y GUIDE" not in said
    assert said.endswith(f"mostly change in the same iterations{end}")


def test_a_rest_that_lifts_off_a_support_whose_stop_holds_is_told():
    """The card stays engaged by its stop; its rest and its stop have turns of their own."""
    deck = Path(__file__).parents[2] / "models" / "foreign" / "skid_line_14.00.xml"
    imported = read_any(deck)
    results = trunnion.solve(imported.model)
    told = stories(results, report_units(imported.model.units))
    case = next(one for one in told if one["case"] == "OPE1")
    said = {one["name"]: one["words"] for one in case["supports"]}
    lifted = said["55 +Y GUIDE LIMIT"]
    assert lifted.startswith("Engaged throughout: ")
    assert "+Y opened at iteration " in lifted
    assert case["note"].startswith(f"{len(said)} of 7 supports changed state")
    names = {name for record in results["OPE1"].history for name in record["changed"]}
    assert names == set(said)  # the bars of the chart count the supports that are told of


def test_story_ends_in_the_states_of_the_answer(page):
    case = trunnion.solve(trunnion.read(page.with_suffix(".inp")))["OPE"]
    assert len(case.passes) == len(case.history) + 1
    held = np.unique(case.system.contacts.card)
    np.testing.assert_array_equal(course(case).level[-1, held], card_levels(case)[held])


# ------------------------------------------------------------------ bodies, hover, slider, paper
PARTS = """\
TITLE    Valve, flanges, joint and reducer, Z up
UNITS    mm kN bar C
DEFAULT  MU=0.3 UP=Z
MATERIAL STEEL  E=203GPa NU=0.3 ALPHA=12e-6 DENSITY=7850
SECTION  P8     OD=219.1 WALL=8.18
SECTION  P10    OD=273.1 WALL=9.27
OPERATE  T1=150 P1=8 TREF=20
ANCHOR   10
FLANGE   10 20  DX=110 WEIGHT=0.5
VALVE    20 30  DX=700 WEIGHT=4
PIPE     30 40  DX=2000
SUPPORT  40     +Z GUIDE GAP=3
JOINT    40 50  DX=500 AXIAL=180N/mm LATERAL=95N/mm AREA=62000
PIPE     50 60  DX=1500
BEND     60     R=381
PIPE     60 70  DY=2500
SUPPORT  70     +Z
SNUBBER  70     X
REDUCER  70 80  DY=400 TO=P8
SECTION  P8
PIPE     80 90  DY=1200
ANCHOR   90
CASE SUS = W + P1
CASE OPE = W + P1 + T1
CASE EQX = U(0.2,0,0) ABOUT=OPE
"""


@pytest.fixture(scope="module")
def parts(tmp_path_factory):
    home = tmp_path_factory.mktemp("parts")
    (home / "parts.inp").write_text(PARTS)
    assert leave("run", home / "parts.inp", "-o", home, "--html") == 0
    return home / "parts.html"


@pytest.fixture(scope="module")
def parts_browser(parts):
    with chromium() as driver:
        opened(driver, parts, "OPE move")
        yield driver


def drawn_radii(page, kind):
    """Radii of the rings of the element of a type, and the places of the rings along it."""
    text = page.read_text(encoding="utf-8")
    data = text.split('<script type="application/json" id="data">')[1].split("</script>")[0]
    scene = json.loads(data)["scene"]
    at = np.frombuffer(b64decode(scene["at"]), "<f4").reshape(-1, 3)
    radius = np.frombuffer(b64decode(scene["radius"]), "<f4")
    e = scene["type"].index(kind)
    rings = slice(*scene["first"][e : e + 2])
    start = at[rings][0]
    return radius[rings], np.linalg.norm(at[rings] - start, axis=1)


def test_a_valve_is_two_cones_and_a_flange_a_disc_on_the_pipe_they_stand_in(parts):
    pipe = 0.5 * 0.2731
    radii, along = drawn_radii(parts, "valve")
    assert radii[0] == radii[-1] == pytest.approx(pipe, rel=1e-6)
    neck = int(radii.argmin())
    assert along[neck] == pytest.approx(0.35, abs=1e-6)  # half way of 700 mm
    assert radii[neck] < 0.5 * pipe < pipe < radii.max()
    np.testing.assert_allclose(radii, radii[::-1])
    disc, along = drawn_radii(parts, "flange")
    assert disc.max() == radii.max()
    assert np.ptp(along[disc == disc.max()]) > 0.7 * 0.110


def test_a_joint_has_waves_and_a_reducer_is_a_cone(parts):
    radii, along = drawn_radii(parts, "joint")
    pipe = 0.5 * 0.2731
    crests = (np.diff(np.sign(np.diff(radii))) < 0).sum()
    assert crests == 6
    assert radii[0] == radii[-1] == pytest.approx(pipe, rel=1e-6)
    assert along[-1] == pytest.approx(0.5, rel=1e-6)
    cone, _ = drawn_radii(parts, "reducer")
    assert (np.diff(cone) < 0.0).all()
    assert cone[[0, -1]] == pytest.approx([pipe, 0.5 * 0.2191], rel=1e-6)


def test_pointing_at_the_pipe_shows_the_numbers_there(parts, parts_browser):
    """A real mouse over node 50, where joint 40-50 and pipe 50-60N meet."""
    from selenium.webdriver import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.support.wait import WebDriverWait

    browser = parts_browser
    x, y, wide, high, texts = browser.execute_script(
        """
        const stage = document.getElementById('scene'), scene = stage._fullLayout.scene._scene;
        const marks = stage.data.find((t) => t.mode === 'markers' && t.text[0].includes('node '));
        const i = marks.text.findIndex((t) => t.includes('node 50<'));
        const p = scene.glplot.cameraParams, times = (m, v) => [0, 1, 2, 3].map((r) =>
            m[r] * v[0] + m[4 + r] * v[1] + m[8 + r] * v[2] + m[12 + r] * v[3]);
        const s = scene.dataScale, at = [marks.x[i] * s[0], marks.y[i] * s[1], marks.z[i] * s[2]];
        const c = times(p.projection, times(p.view, times(p.model, [...at, 1])));
        const box = stage.getBoundingClientRect();
        return [box.width * 0.5 * (1 + c[0] / c[3]), box.height * 0.5 * (1 - c[1] / c[3]),
            box.width, box.height, [...new Set(stage.data[0].text)]];"""
    )
    host = browser.find_element(By.ID, "scene")
    shift = round(x - 0.5 * wide), round(y - 0.5 * high)
    ActionChains(browser).move_to_element_with_offset(host, shift[0] - 4, shift[1]).perform()
    ActionChains(browser).move_to_element_with_offset(host, *shift).perform()
    shown = WebDriverWait(browser, 60).until(
        lambda d: "".join(e.text for e in d.find_elements(By.CSS_SELECTOR, "g.hovertext"))
    )

    def plain(text):
        return re.sub(r"<[^>]+>|\s", "", text).replace("\u2212", "-")

    there = [text for text in texts if re.match("<b>(node 50|joint 40-50|pipe 50-60N)<", text)]
    assert plain(shown) in [plain(text) for text in there]
    (node,) = [text for text in texts if text.startswith("<b>node 50<")]
    row = json.loads(parts.with_suffix(".json").read_text())["cases"]["OPE"]["nodes"]["50"]
    moves = [float(word) for word in node.split("moves ")[1].split(" mm")[0].split()]
    turns = [float(word) for word in node.split("turns ")[1].split(" deg")[0].split()]
    np.testing.assert_allclose(moves, 1e3 * np.array(row[:3]), rtol=1e-4, atol=1e-12)
    np.testing.assert_allclose(turns, np.degrees(row[3:]), rtol=1e-4, atol=1e-12)


def test_hover_texts_of_supports_are_their_loads(parts, parts_browser):
    script = """
        const t = document.getElementById('scene').data.find((t) => t.type === 'mesh3d' &&
            t.facecolor && t.text.some((x) => x.includes('load on the restraint')));
        return [...new Set(t.text)];"""
    texts = parts_browser.execute_script(script)
    case = json.loads(parts.with_suffix(".json").read_text())["cases"]["OPE"]
    for support, text in zip(case["supports"], texts, strict=True):
        assert support["name"] in text
        assert f"<br>{support['state']}<br>" in text
        for value in support["force"]:
            shown = float(f"{-1e-3 * value:.5g}")
            assert abs(shown) < 5e-13 or f"{shown:g}" in text or repr(shown) in text


def test_the_slider_moves_the_pipe_and_says_by_how_much(parts_browser):
    browser = parts_browser
    seen = {}
    for value in ("0", "50", "100"):
        browser.execute_script(
            "const s = document.getElementById('scale'); s.value = arguments[0];"
            "document.getElementById('scene').dataset.drawn = '';"
            "s.dispatchEvent(new Event('input'));",
            value,
        )
        until_drawn(browser, "OPE move")
        factor = browser.execute_script("return document.getElementById('factor').textContent")
        seen[factor] = picture(browser)
    assert next(iter(seen)) == "\u00d7 0"
    assert len(set(seen.values())) == 3
    factors = [float(text[2:]) for text in seen]
    assert factors == sorted(factors)


BY_ELEMENT = {"forces", "stresses"}


@pytest.mark.parametrize("every", [False, True])
def test_paper_has_the_tables_that_are_asked_for_and_no_buttons(parts_browser, every):
    browser = parts_browser
    browser.execute_script("document.getElementById('every').checked = arguments[0]", every)
    pdf = browser.execute_cdp_cmd(
        "Page.printToPDF", {"preferCSSPageSize": True, "printBackground": True}
    )
    assert len(pdf["data"]) > 20_000
    browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
    try:
        browser.execute_script("window.dispatchEvent(new Event('beforeprint'))")
        hidden, tables, high, caption, unprinted = browser.execute_script(
            """
            const shows = (e) => getComputedStyle(e).display !== 'none';
            return [[...document.querySelectorAll('.tabs, .bar, #controls button, .hint')]
                    .filter(shows).length,
                [...document.querySelectorAll('[data-table]')].map((t) =>
                    [t.dataset.table, shows(t) && t.getBoundingClientRect().height > 20]),
                document.querySelector('.stage').getBoundingClientRect().bottom -
                    document.querySelector('header').getBoundingClientRect().top,
                document.getElementById('caption').innerText,
                [...document.querySelectorAll('.unprinted')].filter(shows)
                    .map((e) => e.textContent)];"""
        )
    finally:
        browser.execute_script("document.getElementById('every').checked = false")
        browser.execute_script("window.dispatchEvent(new Event('afterprint'))")
        browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})
    assert hidden == 0
    assert {"restraints", "displacements", "certificate"} <= {name for name, _ in tables}
    assert {name for name, seen in tables if not seen} == (set() if every else BY_ELEMENT)
    assert len(unprinted) == (not every)
    assert all(text.startswith("Not printed: Element forces, Stresses.") for text in unprinted)
    page = 186 / 273 * 1260  # a landscape A4 less its margins, as wide as the page is laid out
    assert 300 < high < page
    assert caption.startswith("OPE = W + P1 + T1: displacement; movements \u00d7 ")


def pixels(png):
    """(high, wide, 3) colours from 0 to 1."""
    from matplotlib.image import imread

    return imread(BytesIO(png))[..., :3]


def printed(browser, folder):
    """Pixels of the first page on paper."""
    pdf = browser.execute_cdp_cmd(
        "Page.printToPDF", {"preferCSSPageSize": True, "printBackground": True}
    )
    (folder / "page.pdf").write_bytes(b64decode(pdf["data"]))
    command = ["pdftoppm", "-png", "-r", "80", "-l", "1", "-singlefile", "page.pdf", "page"]
    subprocess.run(command, cwd=folder, check=True)
    return pixels((folder / "page.png").read_bytes())


def coloured(image):
    """Part of the pixels that are far from grey."""
    return float((np.ptp(image, axis=2) > 0.3).mean())


@pytest.mark.parametrize("wide", [1000, 1440, 2200])
def test_paper_shows_the_model_as_it_is_seen(parts_browser, tmp_path, wide):
    """In the middle of the page: colour bar and legend, no canvas, stand beside and above."""
    browser = parts_browser
    with window(browser, wide, 900):
        choose(browser, "colour", "bending")
        until_drawn(browser, "OPE bending")
        first = printed(browser, tmp_path)
        choose(browser, "colour", "move")
        until_drawn(browser, "OPE move")
        second = printed(browser, tmp_path)
        left = browser.execute_script("return document.querySelectorAll('canvas').length")
    high, across = first.shape[:2]
    middle = np.s_[int(0.3 * high) : int(0.85 * high), int(0.2 * across) : int(0.8 * across)]
    for page in (first, second):
        assert coloured(page[middle]) > 0.005
        assert coloured(page[:, : int(0.04 * across)]) < 1e-3  # margins stay empty
        assert coloured(page[:, int(0.97 * across) :]) < 1e-3
    assert (np.abs(first - second)[middle].max(axis=2) > 0.2).mean() > 0.002
    assert left == 1  # the canvas for paper has gone


@pytest.mark.parametrize("sample", ["hot_line_11.cii", "skid_line_14.00.xml"])
def test_the_first_sheet_of_a_foreign_file_has_its_model_too(sample, tmp_path):
    """Below five and nine lines of what was assumed, in the lower half of the sheet."""
    deck = Path(__file__).parents[2] / "models" / "foreign" / sample
    assert leave("run", deck, "-o", tmp_path, "--html") == 0
    with chromium() as driver:
        opened(driver, tmp_path / f"{deck.stem}.html", "OPE1 move")
        first = printed(driver, tmp_path)
    high, across = first.shape[:2]
    lower = np.s_[int(0.5 * high) : int(0.95 * high), int(0.2 * across) : int(0.9 * across)]
    assert coloured(first[lower]) > 0.003


def test_the_picture_ends_where_the_window_of_a_laptop_does(parts_browser):
    browser = parts_browser
    with window(browser, 1366, 657):
        ends = browser.execute_script(
            """
            window.scrollTo(0, 0);
            return ['.stage', '#scene', '#scene .colorbar'].map((s) =>
                document.querySelector(s).getBoundingClientRect().bottom);"""
        )
    assert max(ends) <= 657
    assert ends[1] > 600


def test_digits_of_node_labels_are_as_high_as_those_of_text(parts_browser):
    """The height of a digit in a font of 12 px is 8 to 9 px."""
    from scipy.ndimage import find_objects, label

    browser = parts_browser
    seen = []
    for shown in (False, True):
        browser.execute_script(
            "document.getElementById('scene').dataset.drawn = '';"
            "const b = document.getElementById('names'); b.checked = arguments[0];"
            "b.dispatchEvent(new Event('change'));",
            shown,
        )
        until_drawn(browser, "OPE move")
        seen.append(pixels(picture(browser)))
    browser.execute_script(
        "const b = document.getElementById('names'); b.checked = false;"
        "b.dispatchEvent(new Event('change'));"
    )
    inked = np.abs(seen[1] - seen[0]).max(axis=2) > 0.3
    blots, n = label(inked, np.ones((3, 3)))
    heights = [rows.stop - rows.start for rows, _ in find_objects(blots)]
    assert n > 10
    assert 7 <= np.median(heights) <= 12


def test_the_legend_names_the_types_of_supports(parts_browser):
    lines = parts_browser.execute_script(
        "return [...document.querySelectorAll('#legend div')].map((d) => [d.textContent,"
        "d.querySelector('i').style.background])"
    )
    names = [name for name, _ in lines]
    assert names == ["anchor", "rest", "guide", "snubber", "load on the restraint"]
    assert len({colour for _, colour in lines}) == len(names)


# ------------------------------------------------------------------ convergence of a case
def test_iterations_are_relative_to_a_force_with_its_unit(page):
    model = trunnion.read(page.with_suffix(".inp"))
    results = trunnion.solve(model)
    case = results["OPE"]
    told = next(s for s in stories(results, report_units(model.units)) if s["case"] == "OPE")
    force = measure(case.system, case.loads, case.state).force
    assert told["axis"] == f"out of balance / {force * 1e-3:.3g} kN"
    for entry, record in zip(told["passes"], case.history, strict=True):
        assert entry["residual"] == pytest.approx(record["residual"] / force, rel=1e-12)
        assert entry["said"] == f"{record['residual'] * 1e-3:.2e} kN"


def test_a_story_says_whether_its_case_is_certified(page):
    model = trunnion.read(page.with_suffix(".inp"))
    results = trunnion.solve(model)
    case, units = results["OPE"], report_units(model.units)
    told = next(s for s in stories(results, units) if s["case"] == "OPE")
    worst = f"worst item {case.certificate.worst:.1e} ({case.certificate.where})"
    assert told["verdict"] == f"Converged and certified: {worst}, allowed 1.0e-09."
    assert told["worst"] == case.certificate.worst < told["limit"] == 1e-9
    case.converged, case.cause = False, "20 +Y GUIDE goes to and fro"
    told = next(s for s in stories(results, units) if s["case"] == "OPE")
    assert told["verdict"] == "NOT CONVERGED: 20 +Y GUIDE goes to and fro"
    assert not told["good"]


def test_charts_have_the_star_of_the_certificate_below_its_limit(page, browser):
    charts = browser.execute_script(
        """
        return [...document.querySelectorAll('.residual')].map((chart) => [
            chart.layout.yaxis.title.text, chart.data.map((t) => [t.name, t.y])]);"""
    )
    assert charts
    for title, traces in charts:
        assert title.endswith(" kN")
        _, balance, limit, star = traces
        assert balance[0] == "out of balance"
        assert limit[0] == "allowed in the certificate, 1e-9"
        assert star[0].startswith("certificate, worst item ")
        assert star[1][0] < limit[1][0] == 1e-9


def test_the_whole_outline_stands_in_the_middle_and_in_sight(parts_browser):
    found = parts_browser.execute_script(
        """
        const stage = document.getElementById('scene'), scene = stage._fullLayout.scene._scene;
        const marks = stage.data.find((t) => t.mode === 'markers' && t.text[0].includes('node '));
        const p = scene.glplot.cameraParams, s = scene.dataScale, times = (m, v) =>
            [0, 1, 2, 3].map((r) => m[r] * v[0] + m[4 + r] * v[1] + m[8 + r] * v[2] + m[12 + r]);
        return marks.x.map((_, i) => {
            const v = [marks.x[i] * s[0], marks.y[i] * s[1], marks.z[i] * s[2]];
            return times(p.projection, times(p.view, times(p.model, v))).slice(0, 2); });"""
    )
    found = np.array(found)
    assert np.abs(found).max() < 0.95
    assert np.abs(0.5 * (found.max(axis=0) + found.min(axis=0))).max() < 0.1
    assert np.ptp(found, axis=0).max() > 1.0


@pytest.mark.parametrize("zoom", [1.0, 8.0])
def test_nothing_is_cut_off_however_wide_and_near(parts_browser, zoom):
    """Between the planes before and behind, as the wheel zooms: by the aspect ratio."""
    browser = parts_browser
    with window(browser, 2200, 657):
        browser.execute_async_script(
            """
            const stage = document.getElementById('scene'), done = arguments[1];
            const r = stage._fullLayout.scene.aspectratio, f = arguments[0];
            Plotly.relayout(stage, { 'scene.aspectratio': { x: f * r.x, y: f * r.y, z: f * r.z } })
                .then(() => setTimeout(done, 300));""",
            zoom,
        )
        depth, speed = browser.execute_script(
            """
            const stage = document.getElementById('scene'), scene = stage._fullLayout.scene._scene;
            const p = scene.glplot.cameraParams, s = scene.dataScale;
            const times = (m, v) => [0, 1, 2, 3].map((r) =>
                m[r] * v[0] + m[4 + r] * v[1] + m[8 + r] * v[2] + m[12 + r]);
            const depth = stage.data.flatMap((t) => Array.from(t.x, (x, i) => x === null ? 0 :
                times(p.projection, times(p.view, times(p.model,
                    [x * s[0], t.y[i] * s[1], t.z[i] * s[2]])))[2]));
            const { eye, center } = stage._fullLayout.scene.camera;
            return [[Math.min(...depth), Math.max(...depth)], scene.camera.translateSpeed *
                Math.hypot(eye.x - center.x, eye.y - center.y, eye.z - center.z)];"""
        )
    assert -1.0 < depth[0] < depth[1] < 1.0
    assert speed == pytest.approx(2.0)  # the height of the picture is 2: it follows the mouse


THICK = """\
UNITS    mm kN bar C
MATERIAL S  E=203GPa NU=0.3 ALPHA=12e-6 DENSITY=7850
SECTION  P  NPS=24 SCH=40
ANCHOR   10
PIPE     10 20 DX=1500
BEND     20
PIPE     20 30 DZ=2500
ANCHOR   30
CASE OPE = W
"""


def test_anchors_leave_thick_pipes_to_be_seen_and_node_marks_long_lines(tmp_path):
    long = THICK.partition("PIPE")[0].replace("NPS=24", "NPS=4")
    long += "".join(f"PIPE {i} {i + 1} DX=6000\nSUPPORT {i + 1} +Y\n" for i in range(10, 90))
    found = {}
    with chromium() as driver:
        for name, deck in (("thick", THICK), ("long", long + "CASE OPE = W\n")):
            (tmp_path / f"{name}.inp").write_text(deck)
            assert leave("run", tmp_path / f"{name}.inp", "-o", tmp_path, "--html") == 0
            opened(driver, tmp_path / f"{name}.html", "OPE move")
            found[name] = driver.execute_script(
                """
                const data = document.getElementById('scene').data;
                const solid = data.find((t) => t.type === 'mesh3d' && t.facecolor);
                const marks = data.find((t) => t.mode === 'markers');
                const x = Array.from(solid.y.slice(0, 8));
                return [Math.max(...x) - Math.min(...x), Array.isArray(marks.marker.color)];"""
            )
    assert found["thick"][1] is False
    assert 0.61 < found["thick"][0] < 2 * 0.61  # the block of the first anchor, across
    assert found["long"][1] is True  # of the colours of the pipe


def test_many_cases_are_counted_in_the_head_and_those_that_failed_named(results, model):
    cases = dict(results.cases)
    ope = cases["OPE"]
    for i in range(30):
        cases[f"X{i}"] = dataclasses.replace(ope, name=f"X{i}")
    many = dataclasses.replace(results, cases=cases)
    head = html.files(many, model, "a")["a.html"].decode().partition("</header>")[0]
    assert "32 of 33 cases certified" in head
    assert '">OFF</span>' in head
    assert '">X7</span>' not in head


def test_a_picture_of_many_elements_has_few_points_on_each():
    from types import SimpleNamespace

    from trunnion.report.html.scene import DRAWN, POINTS, _parts

    for n_elem, n_case in ((5, 3), (200, 3), (5000, 1), (5000, 12), (100_000, 1)):
        parts = _parts(SimpleNamespace(kind=np.zeros(n_elem)), n_case)
        points = (parts + 1) * n_elem
        assert 1 <= parts <= 8
        assert parts == 1 or (points <= DRAWN and points * n_case <= POINTS)
