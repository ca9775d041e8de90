"""Damaged input XML ends in a model or in a named error.

TRUNNION_FUZZ=10000 makes so many variants of each version; a failure prints its seed.
"""

import pytest
from input_xml import crowded, line
from mutants import round_trip, survive

from trunnion.errors import DeckError, ModelError
from trunnion.formats import Findings
from trunnion.formats.caesar_xml import read
from trunnion.formats.source import source_of


def deck(data, permissive=False):
    source = source_of(data, "x.xml")
    round_trip(read(source, Findings(source, permissive=permissive)))


@pytest.mark.parametrize("version", ["7.00", "11.00", "14.00"])
@pytest.mark.parametrize("made", [line, crowded])
def test_a_damaged_file_gives_a_model_or_a_named_error(version, made):
    # one attribute a line: damage of words and lines meets tags and values alike
    text = made(version).replace(' NODE="', '\nNODE="').replace("><", ">\n<")
    survive(text.encode(), deck, 150)


@pytest.mark.parametrize("value", ["1e300", "-1", "0", "99999999", "0.5", "nan", "", "abc", "1_0"])
def test_every_number_of_the_file_may_be_anything(value):
    text = line("14.00")
    starts = [i for i in range(len(text)) if text.startswith('="', i)]
    unnamed = []
    for at in starts[:: max(1, len(starts) // 60)]:
        end = text.index('"', at + 2)
        try:
            deck((text[: at + 2] + value + text[end:]).encode())
        except (DeckError, ModelError) as error:
            unnamed += [at] * (not all(problem.text for problem in error.problems))
    assert not unnamed
