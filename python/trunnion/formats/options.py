"""What a user says beside a foreign file: a side table, a tolerance, where anchors are."""

from pathlib import Path

from trunnion.frozen import frozen

MOST = 0.1  # largest tolerance [m]


@frozen
class Options:
    """Choices of one import; formats that have no use for one of them refuse it by name.

    `table` is a side table (TOML or CSV, docs/pcf.md), `tolerance` the largest distance [m] of
    two ends that are joined, `anchors` are node labels, "E,N,Up" in the units of the file, or
    "open-ends".
    """

    table: Path | None = None
    tolerance: float | None = None
    anchors: tuple[str, ...] = ()

    def given(self) -> list[str]:
        """Names of the options that are given."""
        pairs = (
            ("--table", self.table),
            ("--tolerance", self.tolerance),
            ("--anchor", self.anchors),
        )
        return [name for name, value in pairs if value not in (None, ())]


NONE = Options()


def length(text: str) -> float:
    """Value [m] of a --tolerance: "2mm"; a plain number is in mm.

    Raises
    ------
    WordError : no length, or beyond 0 to 100 mm.
    """
    from trunnion.deck.units import scale_of
    from trunnion.deck.values import WordError, number

    found = number(text, scale_of("mm", "length"), "length")
    if not 0.0 < found <= MOST:
        raise WordError(f"{text} must be above 0 and at most {1000 * MOST:g} mm")
    return found
