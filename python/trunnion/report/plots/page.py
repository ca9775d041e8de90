"""A page: a figure of fixed size with a title strip, which is the same bytes every time.

Figures are made without pyplot and drawn by Agg in the font that matplotlib carries, with its
default settings whatever the user's own are.  Text is never read as mathematics: a $ of a deck is
a $.
"""

import unicodedata
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from io import BytesIO

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties, findfont, get_font
from matplotlib.text import Text

from trunnion.arrays import CaseResult
from trunnion.report.plots.palette import GREY, INK, PALE, PAPER

DPI = 120
WIDTH, HEIGHT = 11.0, 7.8  # inches
EDGE = 0.28  # of white paper around [in]
TOP, FOOT = 0.86, 0.34  # title strip, foot line [in]
SMALL, NORMAL, LARGE = 8.5, 9.5, 14.0  # sizes of text [pt]
FONT = "DejaVu Sans"
STYLE = {
    "font.family": FONT,
    "font.size": NORMAL,
    "text.parse_math": False,
    "text.color": INK,
    "axes.labelcolor": INK,
    "axes.edgecolor": GREY,
    "axes.linewidth": 0.8,
    "axes.unicode_minus": False,
    "xtick.color": GREY,
    "ytick.color": GREY,
    "xtick.labelcolor": INK,
    "ytick.labelcolor": INK,
    "figure.facecolor": PAPER,
    "savefig.facecolor": PAPER,
}


@contextmanager
def style() -> Iterator[None]:
    """Matplotlib's defaults with the few changes of these pages, in here only."""
    with mpl.rc_context():
        mpl.rcdefaults()
        mpl.rcParams.update(STYLE)  # type: ignore[arg-type]
        yield


def page(title: str, what: str, note: str = "", *, height: float = HEIGHT) -> Figure:
    """Begin a page: what it is of, what it shows, and a note in the foot line.

    The title is the deck's own; each text is cut where the page ends.
    """
    figure = Figure(figsize=(WIDTH, height), dpi=DPI)
    FigureCanvasAgg(figure)
    room = 72.0 * (WIDTH - 2 * EDGE)
    put(figure, EDGE, height - EDGE - 0.02, fitted(title, room, LARGE, bold=True),
        size=LARGE, bold=True, top=True)  # fmt: skip
    put(figure, EDGE, height - EDGE - 0.31, fitted(what, room, 10.5), size=10.5, top=True)
    rule(figure, height - TOP + 0.06)
    put(figure, EDGE, EDGE - 0.1, fitted(note, room, SMALL), size=SMALL, colour=GREY)
    return figure


def put(
    figure: Figure,
    x: float,
    y: float,
    text: str,
    *,
    size: float = NORMAL,
    colour: str = INK,
    bold: bool = False,
    right: bool = False,
    top: bool = False,
    middle: bool = False,
) -> Text:
    """Write text at a place of the page [in]; x is its left end, or its right one."""
    width, height = figure.get_size_inches()
    return figure.text(
        x / width,
        y / height,
        shown(text),
        fontsize=size,
        color=colour,
        fontweight="bold" if bold else "normal",
        ha="right" if right else "left",
        va="top" if top else "center" if middle else "baseline",
    )


def rule(figure: Figure, y: float, x: float = EDGE, end: float = WIDTH - EDGE) -> None:
    """Draw a thin line across [in]."""
    from matplotlib.lines import Line2D

    width, height = figure.get_size_inches()
    figure.add_artist(Line2D([x / width, end / width], [y / height] * 2, color=PALE, lw=0.8))


def area(figure: Figure, left: float, low: float, width: float, height: float) -> Axes:
    """Add axes at a place of the page [in]."""
    w, h = figure.get_size_inches()
    return figure.add_axes((left / w, low / h, width / w, height / h))


def certified(case: CaseResult) -> str:
    """Say how well a case is certified."""
    found = case.certificate
    if found is None:
        return ""
    worst = f"{found.worst:.1e}" if found.worst else "0"
    return f"certificate passed, worst {worst}"


def png(figure: Figure) -> bytes:
    """Draw a page; no date and no version in it."""
    buffer = BytesIO()
    figure.savefig(buffer, format="png", dpi=DPI, metadata={"Software": None})
    return buffer.getvalue()


@cache
def _font(bold: bool = False) -> tuple[str, frozenset[int]]:
    """File of the font and the characters that it has."""
    wanted = FontProperties(family=FONT, weight="bold" if bold else "normal")
    path = findfont(wanted, fallback_to_default=True)
    return path, frozenset(get_font(path).get_charmap())


def shown(text: str) -> str:
    """Replace what the font cannot show: control characters by spaces, others by a square."""
    if text.isascii() and text.isprintable():
        return text
    known = _font()[1]
    found = []
    for c in text:
        if unicodedata.category(c) in ("Cc", "Cf", "Zl", "Zp", "Cs"):
            found.append("\n" if c == "\n" else " ")
        else:
            found.append(c if ord(c) in known else "\N{WHITE SQUARE}")
    return "".join(found)


@cache
def extent(text: str, size: float, bold: bool = False) -> tuple[float, float]:
    """Width and height of one line of text [pt]."""
    font = get_font(_font(bold)[0])
    font.set_size(size, 72)
    font.set_text(shown(text), 0.0)
    width, height = font.get_width_height()
    return width / 64.0, height / 64.0


def fitted(text: str, room: float, size: float, *, bold: bool = False) -> str:
    """Cut text to a width [pt], with a mark where something is gone."""
    text = " ".join(shown(text).split("\n"))
    if extent(text, size, bold)[0] <= room:
        return text
    low, high = 0, len(text)
    while low < high:
        half = (low + high + 1) // 2
        if extent(text[:half].rstrip() + "\N{HORIZONTAL ELLIPSIS}", size, bold)[0] <= room:
            low = half
        else:
            high = half - 1
    return text[:low].rstrip() + "\N{HORIZONTAL ELLIPSIS}"
