"""Damaged piping component files end in a model or in a named error.

TRUNNION_FUZZ=10000 makes so many variants; a failure prints its seed.
"""

from mutants import round_trip, survive
from pcf_lines import TABLE, everything

from trunnion.formats import Findings, Options
from trunnion.formats.pcf import read
from trunnion.formats.sidetable import read_table
from trunnion.formats.source import source_of


def test_a_damaged_file_gives_a_model_or_a_named_error(tmp_path):
    table = tmp_path / "line.toml"
    table.write_text(TABLE)
    options = Options(table=table, anchors=("open-ends",))

    def deck(data, permissive):
        source = source_of(data, "x.pcf")
        round_trip(read(source, Findings(source, permissive=permissive, options=options)))

    survive(everything().encode(), deck, 200)


def test_a_damaged_side_table_is_a_table_or_a_named_error(tmp_path):
    for suffix, text in ((".toml", TABLE), (".csv", "SPEC,BORE,WALL,T1\nCS1,100,6mm,150C\n")):
        table = tmp_path / f"line{suffix}"

        def read(data, _, table=table):
            table.write_bytes(data)
            read_table(table)

        survive(text.encode(), read, 200)
