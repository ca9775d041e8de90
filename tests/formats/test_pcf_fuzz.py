"""Damaged piping component files end in a model or in a named error.

TRUNNION_FUZZ=10000 makes so many variants; a failure prints its seed.
"""

import resource

from mutants import count, mutant
from pcf_lines import TABLE, everything

from trunnion.errors import DeckError, ModelError
from trunnion.formats import Findings, Options
from trunnion.formats.pcf import read
from trunnion.formats.sidetable import read_table
from trunnion.formats.source import source_of

MEMORY = 1_000_000  # KiB that a run over all variants may add to the process


def test_a_damaged_file_gives_a_model_or_a_named_error(tmp_path):
    table = tmp_path / "line.toml"
    table.write_text(TABLE)
    options = Options(table=table, anchors=("open-ends",))
    data = everything().encode()
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    models, unnamed = 0, []
    for seed in range(count(200)):
        for permissive in (False, True):
            try:
                source = source_of(mutant(data, seed), "x.pcf")
                read(source, Findings(source, permissive=permissive, options=options)).deck()
                models += 1
            except (DeckError, ModelError) as error:
                unnamed += [seed] * (not all(problem.text for problem in error.problems))
            except Exception as error:
                raise AssertionError(f"seed {seed}, permissive {permissive}") from error
    assert not unnamed
    assert models  # some damage is harmless
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < MEMORY


def test_a_damaged_side_table_is_a_table_or_a_named_error(tmp_path):
    unnamed = []
    for suffix, text in ((".toml", TABLE), (".csv", "SPEC,BORE,WALL,T1\nCS1,100,6mm,150C\n")):
        table = tmp_path / f"line{suffix}"
        for seed in range(count(200)):
            table.write_bytes(mutant(text.encode(), seed))
            try:
                read_table(table)
            except DeckError as error:
                unnamed += [seed] * (not all(problem.text for problem in error.problems))
            except Exception as error:
                raise AssertionError(f"seed {seed} of {suffix}") from error
    assert not unnamed
