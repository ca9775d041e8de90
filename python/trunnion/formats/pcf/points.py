"""Point records of a PCF: coordinates in metres and the bore behind them."""

import re

from trunnion.formats.findings import Findings
from trunnion.formats.pcf.blocks import Attribute, Block
from trunnion.frozen import frozen
from trunnion.system.vectors import Vec

LARGEST = 1e9  # values above mean "no value" in attributes
_GLUED = re.compile(r"([-+]?[0-9]*\.?[0-9]+)([A-Za-z]{1,3})?")


@frozen
class Point:
    """Coordinates E N Up [m] and the bore as the file writes it; None if it does not."""

    xyz: Vec
    bore: float | None
    line: int


def points_of(block: Block, names: tuple[str, ...], unit: float, findings: Findings) -> list[Point]:
    """Read the point records of some names."""
    found = []
    for a in block.attributes:
        if a.name not in names:
            continue
        point = point_of(a, unit)
        if isinstance(point, str):
            findings.fault(a.line, f"{block.keyword} of line {block.line}: {a.name}: {point}")
        else:
            found.append(point)
    return found


def point_of(a: Attribute, unit: float) -> Point | str:
    """Read one point record; a text says what is wrong with it."""
    words = a.value.split()
    numbers = [plain(word) for word in words[:3]]
    if len(numbers) < 3:
        return f"{len(numbers)} coordinates; three are needed"
    if any(x is None or abs(x) > LARGEST for x in numbers):
        wrong = next(
            w for w, x in zip(words, numbers, strict=False) if x is None or abs(x) > LARGEST
        )
        return f"{wrong} is no coordinate"
    bore = None
    if len(words) > 3:
        glued = _GLUED.fullmatch(words[3])
        bore = float(glued[1]) if glued else None
    east, north, up = (x * unit for x in numbers if x is not None)
    usable = bore is not None and 0.0 < bore <= LARGEST
    return Point((east, north, up), bore if usable else None, a.line)


def plain(word: str) -> float | None:
    """Value of a decimal number, None if it is none."""
    try:
        value = float(word) if "_" not in word else None
    except ValueError:
        return None
    return value if value is not None and value - value == 0.0 else None
