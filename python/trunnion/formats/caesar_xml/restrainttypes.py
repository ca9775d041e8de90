"""Restraint types of the XML: groups of three, one an axis, in an order of their own.

Real files have 0 to 7, 9, 10, 12, 16 to 18 and 31 to 33 (GUI and LIM of the group's third number
carry the cosines 0 0 1 as a placeholder).  What stands between them follows from the order of the
groups, and is said to.  Files of other programs write the codes of the vendor's guide, which are
those of neutral files.
"""

from collections.abc import Iterable

from trunnion.formats.caesar_xml.tags import Numbers, Tag

#: type -> code of the neutral file
CODES: dict[int, int] = {0: 1}
for _k in range(3):
    CODES |= {1 + _k: 2 + _k, 4 + _k: 5 + _k, 7 + _k: 8, 10 + _k: 9, 16 + _k: 13 + _k}
    CODES |= {31 + _k: 39 + _k}
#: those that follow from the order of the groups alone
BY_ORDER: dict[int, int] = {}
for _k in range(3):
    BY_ORDER |= {13 + _k: 10 + _k, 19 + _k: 16 + _k, 22 + _k: 19 + _k, 25 + _k: 22 + _k}
    BY_ORDER |= {28 + _k: 36 + _k}
_GUIDE = range(1, 63)
_PLUS, _SNUBBERS = range(16, 19), range(13, 16)


def written_by_guide(tags: Iterable[Tag], numbers: Numbers) -> bool:
    """Tell whether a file has the guide's codes: 13 to 15 (+X to +Z) and nothing of 16 to 18.

    In the program's own list those are +X to +Z, and 13 to 15 would be snubbers.
    """
    types = {numbers.get(r, "TYPE") for tag in tags for r in tag.all("RESTRAINT")}
    return any(t in types for t in _SNUBBERS) and not any(t in types for t in _PLUS)


def code_of(kind: float, cosines: tuple[float, ...], *, guide: bool) -> tuple[int | None, str]:
    """Give the neutral file's code of a type, None if it has none; and what is doubtful about it.

    Parameters
    ----------
    guide : the file has the guide's codes.
    """
    n = int(kind) if kind == round(kind) and abs(kind) < 1000.0 else -1
    # 1 is ANC and has no cosines in the guide; it is X and has them in the program's own list
    if guide or (n == 1 and not any(cosines)):
        doubt = f"type {kind:g}: types are those of the vendor's guide, not of its program: written"
        return (n if n in _GUIDE else None), f"{doubt} by another program; taken by the guide"
    if n in CODES:
        return CODES[n], ""
    if n in BY_ORDER:
        return BY_ORDER[n], f"type {kind:g}: what it means follows from its place in the list only"
    return None, f"restraint of type {kind:g}, whose meaning is not known"
