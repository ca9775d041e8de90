"""The estimate of digits against the error that 60-digit arithmetic finds, on bad models.

The estimate is one sample of what the last bits of the input do, a chain of pipes counted as one
part; the true error, which has its own signs, lies at most 2.5 decades above it, and 3 below.
"""

import pytest
from ballarithmetic import Judge, reported
from plainscenes import Pipe, Scene, Support, model

import trunnion

TRUST, SPARE = 2.5, 3.0

STEEL = {"e": 2e11, "od": 0.3, "wall": 0.01, "density": 7850.0, "alpha": 1.2e-5, "hot": 150.0}


def run(*lengths: float, way=(1.0, 0.0, 0.0)) -> list[tuple[float, float, float]]:
    """Nodes along a line, `lengths` apart."""
    at = [0.0]
    for length in lengths:
        at.append(at[-1] + length)
    return [(way[0] * x, way[1] * x, way[2] * x) for x in at]


def beside() -> Scene:
    """1 mm of solid bar beside 1 km of pipe."""
    xyz = run(1e-3, 1e3, 1e-3, 0.5, way=(0.6, 0.64, 0.48))
    line, bar = STEEL, {**STEEL, "od": 1.0, "wall": 0.49}
    pipes = [Pipe(i, i + 1, **(line if i == 1 else bar)) for i in range(4)]
    scene = Scene("1 mm beside 1 km", xyz, pipes, anchors=[0, 4])
    scene.weight, scene.forces = False, {2: (1.0, -2.0, 3.0, 0.0, 0.0, 0.0)}
    return scene


def hinge() -> Scene:
    """A long line that two rests 1 mm apart keep from turning over."""
    xyz = run(1e-3, 100.0, way=(0.6, 0.0, 0.8))
    at = ((0.8, 0.0, -0.6), (0.0, 1.0, 0.0))
    supports = [Support(i, way, k=1e9) for i in (0, 1) for way in at]
    supports.append(Support(0, (0.6, 0.0, 0.8)))
    xyz.append((60.0, 3.0, 80.0))
    supports.append(Support(3, (0.8, 0.0, -0.6), k=1e-2))
    pipes = [Pipe(i, i + 1, **STEEL) for i in range(3)]
    return Scene("two rests 1 mm apart", xyz, pipes, supports)


def skew() -> Scene:
    """Skew supports of 1e16 N/m on thin pipe."""
    xyz = run(3.0, 4.0, 5.0)
    thin = {**STEEL, "wall": 0.0006}
    supports = [Support(i, (0.3, 1.0 * i, 0.9), k=1e16) for i in (1, 2)]
    supports.append(Support(3, (1.0, 2.0, 3.0), "minus", k=1e16))
    return Scene("k 1e16", xyz, [Pipe(i, i + 1, **thin) for i in range(3)], supports, [0])


def held() -> Scene:
    """Heat that has nowhere to go: what is left to move is a small difference."""
    xyz = run(300.0, 1e-3, 700.0)
    supports = [Support(i, (1.0, 0.0, 0.0), k=1e16) for i in (1, 2)]
    scene = Scene("held heat", xyz, [Pipe(i, i + 1, **STEEL) for i in range(3)], supports, [0, 3])
    scene.weight = False
    return scene


def plain() -> Scene:
    """Nothing bad at all."""
    xyz = run(6.0, 5.0, 4.0)
    return Scene("plain", xyz, [Pipe(i, i + 1, **STEEL) for i in range(3)], anchors=[0, 3])


@pytest.mark.parametrize("make", [beside, hinge, skew, held, plain])
def test_the_estimate_brackets_the_true_error(make):
    scene = make()
    case = trunnion.solve(model(scene))["C"]
    assert case.converged, case.cause
    found = Judge(scene).judge(*reported(scene, case))
    assert found.determined
    assert case.digits is not None
    left, at = case.digits
    print(f"{scene.name}: {left:.1f} digits, worst at {at}; error {found.error:.1e}")
    assert found.error <= max(10.0 ** (TRUST - left), 4e-16)
    assert 10.0**-left <= 10.0**SPARE * max(found.error, 1e-16)
