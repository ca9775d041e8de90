"""models/hangers.inp: the design of hangers repeated by hand on rigid supports and forces."""

from pathlib import Path

import pytest
from published import CLOSED, Source, agrees

import trunnion
from trunnion.deck.reader import read_text

HANGERS = Source(
    CLOSED,
    "Two spring hangers on a riser",
    "hangers",
    "The steps of the design repeated by hand, one after the other, on rigid supports and then on "
    "their reactions as forces (`by_hand` in test_hangers.py).",
)
DECK = Path(__file__).parents[2] / "models" / "hangers.inp"
PRINTED = {  # on top of the deck: size, cold and hot load [N], rate [N/mm], travel [mm], change [%]
    "H1": ("MEDIUM-12", 4826, 4063, 39.7, 19.229, 18.8),
    "H2": ("SHORT-14", 6766, 5475, 125.0, 10.328, 23.6),
}


@pytest.fixture(scope="module")
def results():
    return trunnion.solve(trunnion.read(DECK))


def by_hand():
    """Weight on rigid supports, then the heated line on their reactions as forces."""
    text = DECK.read_text().partition("CASE SUS")[0]
    rigid = text.replace("HANGER   30      DESIGN", "SUPPORT 30 Y")
    rigid = rigid.replace("HANGER   40      DESIGN", "SUPPORT 40 Y")
    weight = trunnion.solve(read_text(rigid + "CASE A = W\n"))["A"]
    hot = {node: weight.supports[node]["fy"] for node in ("30", "40")}
    free = text.replace("HANGER   30      DESIGN NAME=H1", f"FORCE 30 F1 FY={hot['30']!r}")
    free = free.replace("HANGER   40      DESIGN NAME=H2", f"FORCE 40 F1 FY={hot['40']!r}")
    moved = trunnion.solve(read_text(free + "CASE A = W + T1 + F1\n"))["A"]
    rise = {
        node: moved.displacements[node]["uy"] - weight.displacements[node]["uy"] for node in hot
    }
    return hot, rise


def test_loads_and_travels_are_those_of_the_steps_by_hand(results):
    hot, rise = by_hand()
    for found in results.hangers:
        assert found.hot == pytest.approx(hot[found.node], rel=1e-9)
        assert found.travel == pytest.approx(rise[found.node], rel=1e-9)
        assert found.cold == pytest.approx(found.hot + found.rate * found.travel, rel=1e-12)
        assert found.variation <= 0.25


def test_printed_selection(results):
    for found in results.hangers:
        size, cold, hot, rate, travel, change = PRINTED[found.name]
        assert found.size == size
        for what, printed, ours, unit in (
            ("cold load", cold, found.cold, "N"),
            ("hot load", hot, found.hot, "N"),
            ("rate", rate, found.rate / 1e3, "N/mm"),
            ("travel", travel, 1e3 * found.travel, "mm"),
            ("change", change, 100 * found.variation, "%"),
        ):
            agrees(HANGERS, f"{found.name} {size}, {what}", printed, ours, unit)


def test_operation_on_the_selected_springs_puts_the_hot_load_on_them(results):
    for found in results.hangers:
        assert results["OPE"].supports[found.name]["fy"] == pytest.approx(found.hot, rel=1e-6)
