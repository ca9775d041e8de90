"""Damaged neutral files end in a model or in a named error.

TRUNNION_FUZZ=10000 makes so many variants of each version; a failure prints its seed.
"""

import resource

import pytest
from cii_jobs import everything
from mutants import count, mutant

from trunnion.errors import DeckError, ModelError
from trunnion.formats import Findings
from trunnion.formats.caesar import read
from trunnion.formats.source import source_of

MEMORY = 1_000_000  # KiB that a run over all variants may add to the process


@pytest.mark.parametrize("version", [7.01, 11.0, 15.01])
def test_a_damaged_file_gives_a_model_or_a_named_error(version):
    data = everything(version).text().encode("cp1252")
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    models, unnamed = 0, []
    for seed in range(count(150)):
        for permissive in (False, True):
            try:
                source = source_of(mutant(data, seed), "x.cii")
                result = read(source, Findings(source, permissive=permissive))
                result.deck()
                models += 1
            except (DeckError, ModelError) as error:
                unnamed += [seed] * (not all(problem.text for problem in error.problems))
            except Exception as error:
                raise AssertionError(f"version {version}, seed {seed}") from error
    assert not unnamed
    assert models  # some damage is harmless
    after = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    assert after - before < MEMORY


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
