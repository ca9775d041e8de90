"""Colours that colour-blind readers tell apart (Okabe and Ito), and marks that need none."""

from collections.abc import Mapping
from typing import NamedTuple

INK, GREY, PALE, PAPER = "#1b2430", "#5d6875", "#c9d0d8", "#ffffff"
PIPE, RIM, BODY, GHOST = "#d3dbe5", "#5b6673", "#9aa6b4", "#d5dae0"
ARROW = "#a3004f"
FIELD = "viridis_r"  # sizes: pale is nothing, dark is most; even in grey


class Look(NamedTuple):
    """How something is drawn and called in the legend."""

    text: str
    colour: str
    mark: str = "o"  # of matplotlib
    filled: bool = True


STATES: Mapping[str, Look] = {
    "open": Look("open", "#555e68", "o", False),
    "engaged": Look("engaged", "#0072b2", "o"),
    "stick": Look("stick", "#009e73", "s"),
    "slip": Look("slip", "#d55e00", "^"),
    "free": Look("snubber free", "#b58fd0", "D", False),
    "locked": Look("snubber locked", "#3f1a5e", "D"),
}
NO_STATE = Look("restraint", "#44546a", "o")

TYPES: Mapping[str, Look] = {
    "anchor": Look("anchor", "#2f3b4a"),
    "displacement": Look("imposed movement", "#cc79a7"),
    "rest": Look("rest (the pipe may lift)", "#0072b2"),
    "guide": Look("guide", "#009e73"),
    "limit": Look("limit stop", "#d55e00"),
    "stop": Look("stop in a direction", "#56b4e9"),
    "turn": Look("rotation held", "#7a4fa0"),
    "hanger": Look("spring hanger", "#e69f00"),
    "spring": Look("elastic support", "#b8860b"),
    "snubber": Look("snubber", "#5b2a86"),
    "link": Look("restrained to another node", "#5d6875"),
}
