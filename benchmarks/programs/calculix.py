"""CalculiX (program ccx) on a rack, linear, in a process of its own.

Beams are B32R pipes, which CalculiX turns into solid elements: another model of the pipe.  Anchors
are fixed, two-way supports are SPRING1 elements of 1e12 N/m.  The clock runs over the process, its
reading included.  Gaps were tried as GAPUNI elements and as nonlinear SPRINGA elements of 1e12 and
of 1e9 N/m: without NLGEOM they are not iterated, with it the increments shrink until it gives up.
"""

import os
import resource
import shutil
import subprocess
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
from rack_line import Rack

from programs.outcome import Outcome

MOST = 5000  # nodes; 100 000 would take 11 GB


def calculix(rack: Rack, case: str) -> Callable[[], Outcome]:
    """Write the input; what is returned runs ccx on it."""
    program = shutil.which("ccx")
    if program is None:
        raise ImportError("ccx is not installed")
    if case != "lin":
        raise NotImplementedError("no set-up of its gap elements was found that converges")
    n = len(rack["nodes"])
    if n > MOST:
        raise NotImplementedError("solid elements would take several GB")
    text = "\n".join(cards(rack)) + "\n"

    def run() -> Outcome:
        with TemporaryDirectory() as folder:
            (Path(folder) / "rack.inp").write_text(text)
            start = time.perf_counter()
            done = subprocess.run(
                [program, "rack"], cwd=folder, capture_output=True, text=True, env=dict(os.environ)
            )
            seconds = time.perf_counter() - start
            peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
            answer = Path(folder) / "rack.dat"
            u = displacements(answer, n) if answer.exists() else None
        facts: dict[str, float | str] = {"peak_mb": peak}
        if done.returncode or u is None:
            return Outcome(seconds, None, f"ends with exit code {done.returncode}", facts)
        return Outcome(seconds, u, None, facts)

    return run


def cards(rack: Rack) -> Iterator[str]:
    """Input cards; pipe nodes are numbered from 1, mid-side nodes follow."""
    pipe, section, xyz = rack["pipe"], rack["section"], np.array(rack["nodes"])
    n = len(xyz)
    ends = np.array(rack["elements"])
    middle = xyz[ends].mean(axis=1)
    yield "*NODE, NSET=PIPES"
    yield from (f"{i + 1}, {x:.9g}, {y:.9g}, {z:.9g}" for i, (x, y, z) in enumerate(xyz))
    yield "*NODE, NSET=MIDDLES"
    yield from (f"{n + i + 1}, {x:.9g}, {y:.9g}, {z:.9g}" for i, (x, y, z) in enumerate(middle))
    arm = np.abs(xyz[ends[:, 1]] - xyz[ends[:, 0]])
    for name, which in (("ALONG", arm[:, 2] < 0.5), ("ACROSS", arm[:, 2] >= 0.5)):
        yield f"*ELEMENT, TYPE=B32R, ELSET={name}"
        for e in np.flatnonzero(which):
            yield f"{e + 1}, {ends[e, 0] + 1}, {n + e + 1}, {ends[e, 1] + 1}"
    yield from ("*MATERIAL, NAME=STEEL", "*ELASTIC", f"{pipe['E']}, {pipe['nu']}")
    yield from ("*DENSITY", f"{section['w'] / (section['A'] * pipe['g'])}")
    yield from ("*EXPANSION, ZERO=0.", f"{pipe['alpha']}")
    for name, normal in (("ALONG", "0., 0., 1."), ("ACROSS", "1., 0., 0.")):
        yield f"*BEAM SECTION, ELSET={name}, MATERIAL=STEEL, SECTION=PIPE"
        yield from (f"{pipe['od'] / 2}, {pipe['t']}", normal)
    yield from supports(rack, n + len(ends))
    yield "*BOUNDARY"
    yield from (f"{node + 1}, 1, 6" for node in rack["anchors"])
    yield from ("*INITIAL CONDITIONS, TYPE=TEMPERATURE", "PIPES, 0.", "MIDDLES, 0.")
    yield from ("*STEP", "*STATIC")
    yield from ("*TEMPERATURE", f"PIPES, {pipe['dT']}", f"MIDDLES, {pipe['dT']}")
    yield from ("*DLOAD", f"ALONG, GRAV, {pipe['g']}, 0., -1., 0.")
    yield f"ACROSS, GRAV, {pipe['g']}, 0., -1., 0."
    yield from ("*NODE PRINT, NSET=PIPES", "U", "*END STEP")


def supports(rack: Rack, used: int) -> Iterator[str]:
    """Two-way springs; `used` numbers of elements are taken."""
    for tag, s in enumerate(rack["supports"], used + 1):
        yield from (f"*ELEMENT, TYPE=SPRING1, ELSET=S{tag}", f"{tag}, {s['node'] + 1}")
        axis = int(np.argmax(np.abs(s["dir"])))
        yield from (f"*SPRING, ELSET=S{tag}", f"{axis + 1}", f"{rack['kn']}")


def displacements(path: Path, n: int) -> np.ndarray | None:
    """Displacements (n, 6) of the last block of a .dat file; rotations are not printed."""
    blocks = path.read_text().split("displacements")
    u = np.full((n, 6), np.nan)
    for line in blocks[-1].splitlines()[1:]:
        words = line.split()
        if len(words) == 4:
            u[int(words[0]) - 1, :3] = [float(word) for word in words[1:]]
    return None if np.isnan(u[:, :3]).any() else np.nan_to_num(u)
