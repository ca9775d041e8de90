"""Codes of restraints: their names, the words of a model, what stands in for those it has not.

The codes are those of the neutral file (the program's user guide, RESTRANT).
"""

_AXES = "XYZ"

# code -> word of the model; what is not here has no counterpart
WORDS: dict[int, str] = {1: "ANC", 8: "GUIDE", 9: "LIMIT", 25: "+LIM", 26: "-LIM"}
for _k, _axis in enumerate(_AXES):
    WORDS |= {2 + _k: _axis, 5 + _k: f"R{_axis}", 13 + _k: f"+{_axis}", 16 + _k: f"-{_axis}"}
    WORDS |= {19 + _k: f"+R{_axis}", 22 + _k: f"-R{_axis}", 10 + _k: f"{_axis}SNB"}

# codes that the program has and a model has not
OTHERS: dict[int, str] = {}
# word that stands in for each of them with --permissive, and what is lost
STAND_INS: dict[int, tuple[str, str]] = {}
_ROD = "a swinging rod; taken without its length, so that it does not swing"
_YIELD = "a bilinear restraint; taken with its first stiffness, so that it does not yield"
_SPRING = "a spring with an initial load and a travel; taken with its stiffness alone"
_SNUBBER = "a one-way snubber; taken as one that locks both ways"
for _k, _axis in enumerate(_AXES):
    for _first, _sign in ((27, ""), (30, "+"), (33, "-")):
        OTHERS[_first + _k] = f"{_sign}{_axis}ROD"
        STAND_INS[_first + _k] = f"{_sign}{_axis}", _ROD
    for _first, _head in ((36, ""), (39, "R"), (42, "+"), (45, "-"), (48, "+R"), (51, "-R")):
        OTHERS[_first + _k] = f"{_head}{_axis}2"
        STAND_INS[_first + _k] = f"{_head}{_axis}", _YIELD
    OTHERS[54 + _k] = f"{_axis}SPR"
    STAND_INS[54 + _k] = _axis, _SPRING
    for _first, _sign in ((57, "+"), (60, "-")):
        OTHERS[_first + _k] = f"{_sign}{_axis}SNB"
        STAND_INS[_first + _k] = f"{_axis}SNB", _SNUBBER


def name_of(code: int) -> str:
    """Name a code as the program does."""
    word = WORDS.get(code, "")
    return {"GUIDE": "GUI", "LIMIT": "LIM"}.get(word, word) or (
        OTHERS.get(code) or f"of code {code}"
    )
