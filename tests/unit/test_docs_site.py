"""The site: built without a warning, complete in itself, fit for a browser without a network."""

import re
import subprocess
import sys
from pathlib import Path

import pytest
from pagebrowser import chromium, requests
from pages import DOCS, PAGES

ASSET = re.compile(r"""<(?:script|link|img|source|iframe)\b[^>]*?\b(?:src|href)=["']([^"']+)""")


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    """Build the site; a warning is an error."""
    place = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "sphinx", "-q", "-W", "--keep-going", "-b", "html"]
    done = subprocess.run(
        [*command, "-d", str(place / "doctrees"), str(DOCS), str(place / "html")],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert done.stderr == ""
    return place / "html"


def test_every_page_is_built(site):
    assert {page.stem for page in PAGES} <= {path.stem for path in site.glob("*.html")}


def test_nothing_is_fetched_from_elsewhere(site):
    for page in site.rglob("*.html"):
        for target in ASSET.findall(page.read_text(encoding="utf-8")):
            assert not re.match(r"(?:https?:)?//", target), f"{page.name}: {target}"
            if not target.startswith(("data:", "#")):
                file = page.parent / target.split("?")[0].split("#")[0]
                assert file.exists(), f"{page.name}: {target}"
    for sheet in site.rglob("*.css"):
        assert not re.search(r"(?:url\(|@import)\s*[\"']?(?:https?:)?//", sheet.read_text())


def test_formulas_are_drawn(site):
    theory = (site / "theory.html").read_text(encoding="utf-8")
    assert theory.count("<math") > 30
    assert "$$" not in re.sub(r"<pre>.*?</pre>", "", theory, flags=re.S)


def test_reference_is_filled_from_docstrings(site):
    page = (site / "api_reference.html").read_text(encoding="utf-8")
    assert "one without cases takes default ones" in page  # of trunnion.solve
    assert "Put a bend where two pipes meet" in page  # of Model.bend


@pytest.fixture(scope="module")
def browser():
    with chromium() as driver:
        yield driver


def opened(browser, page: Path, width: int, query: str = "") -> None:
    """Open a page in a window of a width; below 600 it is a phone's."""
    metrics = {"width": width, "height": 900, "deviceScaleFactor": 1, "mobile": width < 600}
    browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", metrics)
    browser.get(page.resolve().as_uri() + query)


@pytest.mark.parametrize("width", [1366, 390], ids=["laptop", "phone"])
def test_pages_fit_the_window_without_errors_or_network(site, browser, width):
    """Wide tables and formulas scroll by themselves; the page does not."""
    browser.get_log("browser")
    requests(browser)
    for page in PAGES:
        opened(browser, site / f"{page.stem}.html", width)
        over = browser.execute_script(
            "return document.documentElement.scrollWidth - document.documentElement.clientWidth"
        )
        assert over <= 1, f"{page.stem} is {over} pixels wider than a window of {width}"
    assert [entry for entry in browser.get_log("browser") if entry["level"] == "SEVERE"] == []
    assert {url.partition(":")[0] for url in requests(browser)} <= {"file", "data"}


def test_search_works_from_files(site, browser):
    from selenium.webdriver.common.by import By
    from selenium.webdriver.support.wait import WebDriverWait

    opened(browser, site / "search.html", 1366, "?q=snubber")
    theory = "#search-results li a[href^='theory.html']"  # results come one by one
    assert WebDriverWait(browser, 30).until(lambda d: d.find_elements(By.CSS_SELECTOR, theory))
