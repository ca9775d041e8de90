"""Same deck, same bytes: in a new process, with other thread counts; renumbered, to 1e-12."""

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from invent import invented
from plainscenes import model

import trunnion

MODELS = Path(__file__).parents[2] / "models"


@pytest.mark.parametrize(
    ("deck", "more"),
    [("rack_50", ""), ("hot_header", ""), ("nr1677_v2_p1", ""), ("rack_200", "MODES 20\n")],
    ids=["friction", "cases", "spectra", "modes by Lanczos"],  # the last two call BLAS
)
def test_threads_and_processes_change_no_byte(deck, more, tmp_path):
    written = []
    file = tmp_path / f"{deck}.inp"
    file.write_text((MODELS / file.name).read_text() + more)
    for threads in ("1", "2", "4", "1"):
        out = tmp_path / f"{len(written)}"
        env = os.environ | {f"{name}_NUM_THREADS": threads for name in ("OMP", "OPENBLAS", "MKL")}
        subprocess.run(
            [sys.executable, "-m", "trunnion", "run", str(file), "-o", out],
            check=True, env=env, capture_output=True,
        )  # fmt: skip
        written.append({path.name: path.read_bytes() for path in sorted(out.iterdir())})
    assert written[0]
    assert all(one == written[0] for one in written[1:])


@pytest.mark.parametrize("seed", [2, 3, 6, 12, 15, 24, 33, 41])
def test_shuffled_cards_give_the_same_numbers(seed):
    """Nodes, pipes and anchors in another order: other numbers of freedoms, other elimination."""
    scene = invented(seed)
    first = trunnion.solve(model(scene))["C"]
    assert first.converged, "choose a seed that is solved"
    assert first.digits is not None
    for shuffle in (1, 2):
        case = trunnion.solve(model(scene, np.random.default_rng(shuffle)))["C"]
        assert case.converged
        rows = [case.system.labels.index(label) for label in first.system.labels]
        a, b = first.state, case.state
        for part in (slice(0, 3), slice(3, 6)):
            whole = a.u[:, part] + a.u_low[:, part]
            other = b.u[rows][:, part] + b.u_low[rows][:, part]
            assert np.abs(other - whole).max() <= 1e-12 * max(np.abs(whole).max(), 1e-9)
