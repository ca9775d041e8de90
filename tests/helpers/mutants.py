"""Damage text files at random, in the ways that files are damaged, and read what comes of it."""

import os
import random
import re
import resource
import signal
from contextlib import contextmanager

from trunnion.deck.reader import read_text
from trunnion.errors import DeckError, ModelError

MEMORY = 1_000_000  # KiB that a run over all variants may add to the process
HANG = 60  # s that one variant may take

WORDS = (
    *("nan", "-nan", "inf", "*************", "1e308", "-1e308", "1D+99", "9999.99", "-1.0101"),
    *("0", "-1", "1", "2147483648", "99999999", "1e-30", "", "abc", "\x00", "\u0660", "é", "#$"),
    *("!", "&", '"', "<", "--", "0x10", "1_000", "1,5", "0.0000001", "-0.0", "1.5"),
)
_WORD = re.compile(rb"\S+")


def count(usual: int) -> int:
    """Number of variants: TRUNNION_FUZZ of the environment, or the usual one."""
    return int(os.environ.get("TRUNNION_FUZZ", usual))


def mutant(data: bytes, seed: int) -> bytes:
    """Damage one file; the same seed does the same damage."""
    rng = random.Random(seed)
    for _ in range(rng.choice((1, 1, 1, 2, 3, 8))):
        data = rng.choice(_DAMAGES)(data, rng)
    return data


def round_trip(imported):
    """Write the deck of a foreign file; it reads as the same model, whatever the damage was."""
    text = imported.deck()
    try:
        again = read_text(text)
    except (DeckError, ModelError) as error:
        raise AssertionError("the deck cannot be read") from error
    assert again == imported.model


def survive(data, read, usual):
    """Read damaged variants; each ends in a model or in a named error.

    Parameters
    ----------
    read : called with the bytes of a variant and whether to be permissive.
    usual : number of variants where TRUNNION_FUZZ gives none.

    Raises
    ------
    AssertionError : names the seed of a variant that ended otherwise, or took too much memory.
    """
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    good, unnamed = 0, []
    for seed in range(count(usual)):
        damaged = mutant(data, seed)
        for permissive in (False, True):
            try:
                with _limit():
                    read(damaged, permissive)
                good += 1
            except (DeckError, ModelError) as error:
                unnamed += [seed] * (not all(problem.text for problem in error.problems))
            except Exception as error:
                raise AssertionError(f"seed {seed}, permissive {permissive}") from error
    assert not unnamed
    assert good  # some damage is harmless
    grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
    assert grown < MEMORY, f"{grown} KiB"


@contextmanager
def _limit():
    """Let one variant take so long and no longer."""

    def late(*_):
        raise TimeoutError(f"more than {HANG} s")

    old = signal.signal(signal.SIGALRM, late)
    signal.alarm(HANG)
    try:
        yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, old)


def _replace_word(data, rng):
    words = list(_WORD.finditer(data))
    if not words:
        return data
    word = rng.choice(words)
    new = rng.choice(WORDS).encode("utf-8", "surrogateescape")
    if rng.random() < 0.7:  # keep the columns
        new = new.ljust(len(word[0]))
    return data[: word.start()] + new + data[word.end() :]


def _number(data, rng):
    words = [w for w in _WORD.finditer(data) if w[0].strip(b"+-.0123456789E") == b""]
    if not words:
        return data
    word = rng.choice(words)
    value = rng.choice((rng.uniform(-1e4, 1e4), rng.randrange(-5, 200), 10 ** rng.uniform(-9, 15)))
    text = f"{value:.6g}".encode().ljust(len(word[0]))
    return data[: word.start()] + text + data[word.end() :]


def _flip(data, rng):
    if not data:
        return data
    at = rng.randrange(len(data))
    return data[:at] + bytes([rng.randrange(256)]) + data[at + 1 :]


def _cut(data, rng):
    return data[: rng.randrange(len(data) + 1)]


def _lines(change):
    def damage(data, rng):
        lines = data.splitlines(keepends=True)
        if len(lines) < 3:
            return data
        change(lines, rng)
        return b"".join(lines)

    return damage


def _drop(lines, rng):
    at = rng.randrange(len(lines))
    del lines[at : at + rng.choice((1, 1, 2, 15))]


def _double(lines, rng):
    at, n = rng.randrange(len(lines)), rng.choice((1, 1, 2, 15, 60))
    lines[at:at] = lines[at : at + n]


def _swap(lines, rng):
    a, b = rng.randrange(len(lines)), rng.randrange(len(lines))
    lines[a], lines[b] = lines[b], lines[a]


def _move(lines, rng):
    a, n = rng.randrange(len(lines)), rng.randrange(1, 40)
    block = lines[a : a + n]
    del lines[a : a + n]
    at = rng.randrange(len(lines) + 1)
    lines[at:at] = block


def _blank(lines, rng):
    lines.insert(rng.randrange(len(lines)), b"\r\n")


_DAMAGES = (
    *(_replace_word, _replace_word, _number, _number, _number, _flip, _cut),
    *(_lines(_drop), _lines(_double), _lines(_swap), _lines(_move), _lines(_blank)),
)
