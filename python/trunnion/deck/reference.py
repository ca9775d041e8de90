"""The reference page of the deck, made from the keyword table.

python -m trunnion.deck.reference > docs/deck_reference.md
"""

from collections.abc import Iterator

from trunnion.deck import units as un
from trunnion.deck.cards import MAX_BYTES, MAX_CARD, MAX_DEPTH, MAX_LINE
from trunnion.deck.keywords import ANY, PRESSURE_SETS, TABLE, TEMPERATURE_SETS, Key, Keyword
from trunnion.library.materials import GRADES
from trunnion.library.sections import SCHEDULES
from trunnion.model import Units

_INTRODUCTION = f"""# The deck

A deck is a text file (UTF-8) of cards, one a line, in free field.

- Words stand apart by spaces or tabs. The first word of a card is its keyword. Keywords, keys,
  labels and names may be written in capitals or small letters; they are kept in capitals.
- `KEY=VALUE` gives a value. Spaces around `=` and after a comma do not matter.
- `!` starts a comment. `&` at the end of a line continues the card on the next line.
- A plain number is in the deck's own unit, given by the `UNITS` card. Any number may carry a unit
  of its own: `273.1mm`, `12bar`, `203GPa`, `2kN/mm`, `7850kg/m3`, `90deg`. Products are written
  with `.` (`kN.m`), powers with a digit (`kg/m3`). Capitals do not matter there either: `MPA` and
  `mpa` are megapascal. Temperatures are offset units: `170C`, `338F`, `443K`.
- Node labels are made of letters, digits, `_` and `.`. Digits followed by `N`, `M` or `F` are kept
  for bends: a bend at 30 has a near, a mid and a far point, 30N 30M 30F, and 30 is 30F.
- `MATERIAL`, `SECTION` and `OPERATE` carry over: they hold for the pipes that follow, until
  changed. All other cards may stand in any order.
- All errors of a deck are told at once, each with file, line and the words at fault. A deck with
  an error is not solved.

Limits: {MAX_LINE} characters a line, {MAX_CARD} a card, {MAX_BYTES // 10**6} MB a deck with its
includes, {MAX_DEPTH} files deep. Only ordinary files are read.
"""


_FAMILIES = frozenset((*TEMPERATURE_SETS, *PRESSURE_SETS))

EXAMPLE = """\
TITLE    Hot oil header, one expansion loop
UNITS    mm kN bar C
DEFAULT  MU=0.3
MATERIAL A106B  E=203GPa NU=0.3 ALPHA=11.7e-6 DENSITY=7850
SECTION  HDR    NPS=10 SCH=40 FLUID=850 INSULATION=75mm INSULATION_DENSITY=140
OPERATE  T1=170 P1=12 TREF=20

ANCHOR   10
PIPE     10 20   DX=6000
SUPPORT  20      +Y GUIDE GAP=3     ! rests, and is guided with 3 mm to each side
PIPE     20 30   DX=6000
BEND     30      R=381
PIPE     30 40   DZ=4000
SUPPORT  40      +Y
SUPPORT  30M     +Y K=2kN/mm
SNUBBER  40      X                  ! lets the pipe grow, holds it in an earthquake

CASE SUS = W + P1
CASE OPE = W + P1 + T1
COMB EXP = OPE - SUS
CASE HSUS = W + P1               ON=OPE
CASE EQX = U(0.3,0,0)            ABOUT=OPE
COMB OCC = ABS(SUS) + ABS(EQX)
CYCLE HEAT = OPE, SUS            TIMES=4
MODES 12 ABOUT=OPE
"""


def page() -> str:
    """Write the whole page."""
    lines = [_INTRODUCTION, "```deck", EXAMPLE + "```", "", "## Cards", ""]
    lines += [f"- [{k.name}](#{k.name.lower()}): {_first_sentence(k.meaning)}" for k in TABLE]
    for keyword in TABLE:
        lines += ["", *_card(keyword)]
    lines += ["", *_units(), "", *_tables()]
    return "\n".join(lines) + "\n"


def _first_sentence(text: str) -> str:
    """Cut a meaning for the list of cards."""
    return text.split(". ")[0].rstrip(".")


def _form(keyword: Keyword) -> str:
    """Write the words of a card in their order, those that may be missing in brackets."""
    words = [f"[{p.name}]" if p.optional else p.name for p in keyword.positionals]
    if keyword.form == "units":
        words = ["length", "force", "pressure", "temperature"]
    if keyword.form == "text":
        words = ["text" if keyword.name == "TITLE" else "file"]
    if keyword.keys:
        words.append("KEY=VALUE ...")
    words += [f"[{flag}]" for flag, _ in keyword.flags]
    return " ".join([keyword.name, *words])


def _card(keyword: Keyword) -> Iterator[str]:
    """Write the section of one keyword."""
    yield f"### {keyword.name}"
    yield ""
    yield keyword.meaning
    yield ""
    yield "```deck"
    yield _form(keyword)
    yield keyword.example
    yield "```"
    for note in keyword.notes:
        yield ""
        yield note
    if keyword.positionals and keyword.form != "equation":
        yield ""
        for positional in keyword.positionals:
            unit = positional.dimension if positional.kind == "number" else ""
            yield f"- `{positional.name}`: {positional.meaning}{f' ({unit})' if unit else ''}"
    if keyword.keys:
        yield ""
        yield "| key | meaning | dimension or choices | without it |"
        yield "|---|---|---|---|"
        for key in keyword.keys:
            if key.name not in _FAMILIES:
                yield f"| `{key.name}=` | {key.meaning} | {_values(key)} | {_without(key)} |"
            elif key.name.endswith("1"):  # one row for T1 to T9
                names = f"`{key.name}=` to `{key.name[0]}9=`"
                meaning = key.meaning.replace(f"set {key.name}", "that set")
                yield f"| {names} | {meaning} | {_values(key)} | {_without(key)} |"
        for flag, meaning in keyword.flags:
            yield f"| `{flag}` | {meaning} | no value | |"


def _values(key: Key) -> str:
    """Say what values a key takes."""
    if key.choices:
        return " ".join(key.choices)
    words = {
        "gap": "length or angle",
        "vector": "(a,b,c)",
        "lengths": "lengths (x,y,z)",
        "along": "pipe a-b",
        "node": "node",
    }
    text = words.get(key.kind, key.kind)
    if key.kind == "pairs":
        return f"({key.dimension.replace(', ', ',')}),(...) ..."
    if key.kind == "number":
        text = key.dimension or "stiffness or rotational stiffness"
    bounds = "" if key.bounds is ANY else f", {key.bounds}"
    return text + bounds


def _without(key: Key) -> str:
    """Say what holds when a key is missing."""
    return "an error" if key.required else key.default


def _units() -> Iterator[str]:
    """Write the table of derived units."""
    yield "## Units"
    yield ""
    yield "The `UNITS` card names four units; all others follow by the unit of length, here with"
    yield "F for the unit of force, P for pressure and T for temperature."
    yield ""
    yield f"length: {' '.join(un.LENGTHS)}; force: {' '.join(un.FORCES)}; pressure:"
    yield f"{' '.join(un.PRESSURES)}; temperature: {' '.join(un.TEMPERATURES)}."
    yield ""
    yield "| dimension | used for | " + " | ".join(un.LENGTHS) + " |"
    yield "|---|---|" + "---|" * len(un.LENGTHS)
    tables = [un.derived(Units(length, "F", "P", "T")) for length in un.LENGTHS]
    for dimension, (meaning, _, _) in un.DIMENSIONS.items():
        cells = [table[dimension] or "-" for table in tables]
        if dimension == "expansion":
            cells = ["/K, or /F when T is F"] * len(un.LENGTHS)
        yield f"| {dimension} | {meaning} | " + " | ".join(cells) + " |"


def _tables() -> Iterator[str]:
    """List the rows of the libraries that GRADE and SCH name."""
    yield "## Libraries"
    yield ""
    yield "Grades of `GRADE=`, with E and mean expansion against temperature, density at 20 C:"
    yield f"{', '.join(GRADES)}."
    yield ""
    yield f"Schedules of `SCH=`: {', '.join(SCHEDULES)}."


if __name__ == "__main__":
    print(page(), end="")
