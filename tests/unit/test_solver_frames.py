"""Random small frames each end certified, or refused with a named cause."""

import signal
import time
from collections import Counter

import pytest
from frames import frame

import trunnion

BLOCKS, SIZE = 10, 30
LONGEST = 20.0  # seconds, all cases of one frame
TURNED = (130, 536, 1065, 1399, 1539, 2385, 2603, 3452, 6761)


@pytest.fixture
def bell():
    """Ring when a solve hangs."""

    def ring(*_):
        raise TimeoutError

    before = signal.signal(signal.SIGALRM, ring)
    yield lambda seconds: signal.setitimer(signal.ITIMER_REAL, seconds)
    signal.setitimer(signal.ITIMER_REAL, 0.0)
    signal.signal(signal.SIGALRM, before)


def judge(seed, bell):
    """Solve one frame; count how its cases end."""
    ends = Counter()
    model = frame(seed)
    names = {label for p in model.pipes for label in (p.start, p.end)}
    bell(LONGEST)
    start = time.monotonic()
    results = trunnion.solve(model)
    bell(0.0)
    assert time.monotonic() - start < LONGEST, f"seed {seed}"
    for name, case in results.cases.items():
        if case.converged:
            assert case.certificate.passed, f"seed {seed} {name}"
            assert case.certificate.worst < 1e-10, f"seed {seed} {name}: {case.certificate}"
            ends["certified"] += 1
        else:
            assert case.state is None
            named = any(f" {label}" in case.cause for label in names)
            assert named or "settle" in case.cause or "starts from" in case.cause, case.cause
            ends["refused"] += 1
    return ends


@pytest.mark.parametrize("block", range(BLOCKS))
def test_frames_end_certified(block, bell):
    ends = Counter()
    for seed in range(SIZE * block, SIZE * (block + 1)):
        ends += judge(seed, bell)
    assert ends["certified"] == 3 * SIZE, ends


@pytest.mark.parametrize("seed", TURNED)
def test_frames_on_which_plain_renewal_cycles(seed, bell):
    """Found among 9000 random frames: capacities cycle, or a support locks itself."""
    assert judge(seed, bell)["certified"] == 3
