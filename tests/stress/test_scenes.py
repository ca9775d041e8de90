"""Random and manufactured scenes: a certified answer that exact arithmetic confirms, or a cause.

The first seeds of the long run (`make stress N=20000`), so that a fault found there is a fault
here.  A fault prints its seed; `outcome.of_invented(seed)` runs it alone.
"""

from collections import Counter

import pytest
from outcome import GOOD, of_invented, of_manufactured

CHUNK = 60


@pytest.mark.parametrize("first", range(0, 600, CHUNK))
def test_a_random_scene_is_right_or_refused_by_name(first):
    ends = [of_invented(seed) for seed in range(first, first + CHUNK)]
    faults = [f"seed {end.seed}: {end.fault}" for end in ends if end.fault]
    assert not faults, "\n".join(faults)
    assert sum(end.what.startswith("certified") for end in ends) >= 0.7 * CHUNK


def test_chosen_displacements_come_back():
    ends = [of_manufactured(seed) for seed in range(200)]
    faults = [f"seed {end.seed}: {end.fault}" for end in ends if end.fault]
    assert not faults, "\n".join(faults)
    count = Counter(end.what for end in ends)
    print(count)
    assert sum(n for what, n in count.items() if what.startswith(GOOD)) >= SHARE * len(ends)
