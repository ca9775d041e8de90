"""The certificate of solved cases cannot be fooled: no reported number may be wrong by 1e-6.

On small models every number is changed; on the rack a seeded sample.  A number is changed by
1e-6 of the largest of its kind, and by 1e-6 of itself where it is at least 1e-3 of the largest.
"""

import sys
from functools import cache
from pathlib import Path

import numpy as np
import pytest

import trunnion
from trunnion.certificate import certify
from trunnion.deck.reader import read_text

ROOT = Path(__file__).parents[2]
sys.path.insert(0, str(ROOT / "benchmarks"))
from rack import rack_model, read_rack  # noqa: E402

SKEWED = """\
UNITS    mm kN bar C
DEFAULT  MU=0.3
MATERIAL S  E=203GPa NU=0.3 ALPHA=11.7e-6 DENSITY=7850
SECTION  P  OD=219.1 WALL=8.18 FLUID=900
OPERATE  T1=150 TREF=20
ANCHOR   10
PIPE     10 20 DX=3000
PIPE     20 30 DX=2000
BEND     30 R=305
PIPE     30 40 DZ=4000
SUPPORT  20  +Y GUIDE GAP=2
SUPPORT  30M +(0.3,1,0.2)
SUPPORT  40  +Y (1,0,1) GAP=3
PIPE     40 50 DZ=2000
ANCHOR   50
CASE OPE = W + T1
"""
CASES = ("hot_header", "b313_s302", "rack_50", "skewed")
FIELDS = (
    "u", "u_low", "end_force", "reaction", "friction", "normal", "slide", "datum", "datum_end",
)  # fmt: skip
SAMPLE, SEED = 350, 3


@cache
def solved(name):
    if name == "skewed":
        return trunnion.solve(read_text(SKEWED, "skewed.inp"))["OPE"]
    if name == "rack_50":
        model = rack_model(read_rack(ROOT / "tests/data/rack_50.json.gz"), "fric1")
        return trunnion.solve(model)["FRIC1"]
    return trunnion.solve(trunnion.read(ROOT / f"models/{name}.inp"))["OPE"]


def passes(case):
    return certify(
        case.system, case.loads, case.state, correction_u=1e-16, correction_r=1e-16
    ).passed


def largest(case, name, index):
    """Largest number of the kind that this one is of: translations, rotations, forces, moments."""
    kin = {"u_low": "u", "datum": "slide", "datum_end": "slide"}.get(name, name)
    kind = getattr(case.state, kin)
    if kind.shape[-1] == 6:
        kind = kind[..., :3] if index[-1] < 3 else kind[..., 3:]
    elif name == "reaction":
        turning = case.system.contacts.rotational
        kind = kind[turning == turning[index[0]]]
    return float(np.abs(kind).max())


def changes(case):
    """All changes of one number by 1e-6: field, index, amount."""
    found = []
    for name in FIELDS:
        array = getattr(case.state, name)
        for index in np.ndindex(array.shape):
            size = largest(case, name, index)
            value = abs(float(array[index]))
            found.append((name, index, 1e-6 * size))
            if value >= 1e-3 * size > 0.0:
                found.append((name, index, 1e-6 * value))
    return [change for change in found if change[2] > 0.0]


@pytest.mark.parametrize("name", CASES)
def test_no_number_of_a_solved_case_can_be_wrong(name):
    case = solved(name)
    assert passes(case)
    every = changes(case)
    rng = np.random.default_rng(SEED)
    if len(every) > 2 * SAMPLE:
        pick = rng.choice(len(every), SAMPLE, replace=False)
        every = [every[i] for i in pick]
    fooled = []
    for field, index, amount in every:
        array = getattr(case.state, field)
        kept = array[index]
        array[index] = kept + rng.choice((-1.0, 1.0)) * amount
        if passes(case):
            fooled.append((field, index, float(kept), amount))
        array[index] = kept
    assert fooled == [], f"seed {SEED}"
    assert passes(case)


@pytest.mark.parametrize("name", CASES)
def test_no_state_of_a_solved_case_can_be_wrong(name):
    case = solved(name)
    fooled = []
    for field, values in (("side", (0, -1, 1, 2, 3)), ("mode", (0, 1, 2, 3, 4))):
        array = getattr(case.state, field)
        for i, kept in enumerate(array.tolist()):
            for value in set(values) - {kept}:
                array[i] = value
                if passes(case):
                    fooled.append((field, i, kept, value))
            array[i] = kept
    assert fooled == []
    assert passes(case)
