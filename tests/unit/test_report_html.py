"""The HTML report in a real browser, and what of it needs none."""

import json

import numpy as np
import pytest
from pagebrowser import choose, chromium, opened, picture, requests, until_drawn

import trunnion
from trunnion.arrays import Pass
from trunnion.cli import main
from trunnion.report import html
from trunnion.report.html.story import course, words
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
    with pytest.raises(SystemExit) as stop:
        main(["run", str(home / "line.inp"), "-o", str(home), "--html"])
    assert stop.value.code == 0
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
    assert "It went to and fro." in said
    assert "20 +Y GUIDE" in said
    assert ("these two alternate because they share a load" in said) is why


def test_story_ends_in_the_states_of_the_answer(page):
    case = trunnion.solve(trunnion.read(page.with_suffix(".inp")))["OPE"]
    assert len(case.passes) == len(case.history) + 1
    held = np.unique(case.system.contacts.card)
    np.testing.assert_array_equal(course(case).level[-1, held], card_levels(case)[held])
