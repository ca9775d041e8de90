"""The HTML report: one page with everything in it, for any browser, without a network.

Python gathers plain numbers (`scene`, `tables`, `story`); the page's own scripts draw them with
plotly.js, which its Python package carries.  Text of the deck enters the page as data or through
the escaping of the template, never as markup.
"""

import json
from pathlib import Path

from trunnion.arrays import Results
from trunnion.model import Model
from trunnion.report.causes import told_cause
from trunnion.report.html.scene import scene
from trunnion.report.html.story import stories
from trunnion.report.html.tables import tables
from trunnion.report.screen import all_warnings
from trunnion.report.units import report_units
from trunnion.results.supports import is_good

HERE = Path(__file__).parent


def files(results: Results, model: Model, stem: str) -> dict[str, bytes]:
    """Write the page."""
    from jinja2 import Environment, FileSystemLoader, StrictUndefined
    from plotly.offline import get_plotlyjs

    units = report_units(model.units)
    cases = results.cases.values()
    bad = {case.name: told_cause(case, units) for case in cases if not is_good(case)}
    data = {
        "scene": scene(results, units),
        "tables": tables(results, model),
        "stories": stories(results, units),
    }
    environment = Environment(
        loader=FileSystemLoader(HERE),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    page = environment.get_template("page.html.j2").render(
        title=results.title or stem,
        cases=[(c.name, c.text, c.name not in bad, bad.get(c.name)) for c in cases],
        worst=max((c.certificate.worst for c in cases if c.certificate), default=None),
        origin=model.origin,
        warnings=all_warnings(results, units),
        deck=model.deck(),
        data=embedded(data),
        style=_own("page.css"),
        plotly=get_plotlyjs(),
        scripts=[_own("scene.js"), _own("tables.js")],
    )
    return {f"{stem}.html": page.encode()}


def embedded(data: object) -> str:
    """JSON that may stand in a script element: no text in it can end that element."""
    text = json.dumps(data, allow_nan=False, separators=(",", ":"), ensure_ascii=True)
    return text.replace("<", "\\u003c").replace(">", "\\u003e").replace("&", "\\u0026")


def _own(name: str) -> str:
    return (HERE / name).read_text(encoding="utf-8")
