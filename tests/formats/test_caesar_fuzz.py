"""Damaged neutral files end in a model or in a named error.

TRUNNION_FUZZ=10000 makes so many variants of each version; a failure prints its seed.
"""

import pytest
from cii_jobs import crowded, everything
from mutants import round_trip, survive

from trunnion.errors import DeckError
from trunnion.formats import Findings
from trunnion.formats.caesar import read
from trunnion.formats.source import source_of


def deck(data, permissive):
    source = source_of(data, "x.cii")
    round_trip(read(source, Findings(source, permissive=permissive)))


@pytest.mark.parametrize("version", [7.01, 11.0, 15.01])
@pytest.mark.parametrize("made", [everything, crowded])
def test_a_damaged_file_gives_a_model_or_a_named_error(version, made):
    survive(made(version).text().encode("cp1252"), deck, 150)


@pytest.mark.parametrize("field", range(19))
@pytest.mark.parametrize("value", ["9999999999999", "-1", "2147483647", "100000"])
def test_a_count_that_cannot_be_is_named_before_anything_is_made(field, value):
    lines = everything(11.0).text().split("\r\n")
    at = next(i for i, x in enumerate(lines) if x.startswith("#$ CONTROL")) + 1 + field // 6
    k = 2 + 13 * (field % 6)
    lines[at] = lines[at][:k] + value.rjust(13) + lines[at][k + 13 :]
    source = source_of("\r\n".join(lines).encode("cp1252"), "x.cii")
    with pytest.raises(DeckError) as caught:
        read(source, Findings(source))
    assert any(str(at + 1) in str(p.place) or "CONTROL" in p.text for p in caught.value.problems)
