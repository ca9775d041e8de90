"""NUREG/CR-1677 volume 2 (August 1985), problem 1: envelope spectrum and independent motion.

The report's answers as quoted by the verification decks vm-nr1677-2-1a-a.dat, -1b-a and -1c-a of
ansys-mapdl-core 0.74.1 (MIT licence, (c) ANSYS, Inc.); lengths in inches, forces in lbf.

Two misreadings of the report are in those decks.

-   Node 32 at Y = -536.  All nodes of that leg, and both bends beside it, lie at -535; with it the
    15 frequencies are met to 0.03 %, with -536 to 0.26 % (`test_node_32_lies_in_its_plane`).
-   The lower spectrum.  Its 0.875 g at 12.5 Hz stands above the spectrum of case A, which
    envelops both levels (`test_lower_spectrum_pierces_its_envelope`).  An 8 for a 6 is the
    misreading: 0.675.  With it, and 0.6 for the other 8 in the table (0.8 at 21.74 Hz), all but
    one of the 84 movements and end forces of cases B and C, up to 8 % off before, are met to
    0.2 % (B6, C6).  That the second 8 is wrong, too, shows only in this agreement.  B and C keep
    the table of the decks, and their gaps are asserted.
"""

from dataclasses import replace

import numpy as np
import pytest
from published import PUBLISHED, Source, agrees, differs

from trunnion.solver.spectrum import acceleration

NR1677 = Source(
    PUBLISHED,
    "NUREG/CR-1677 volume 2, problem 1",
    "nr1677_v2_p1",
    "Bezler, Subudhi and Hartzman, August 1985: envelope spectrum (A), and two groups of supports "
    "that move independently, by SRSS (B) and absolute sum (C); answers of the report as quoted by "
    "the verification decks vm-nr1677-2-1a-a.dat, -1b-a and -1c-a of ansys-mapdl-core 0.74.1 (MIT "
    "licence, (c) ANSYS, Inc.). Frequencies within 0.05 %, A within 0.3 %, B and C within 0.2 %, "
    "reactions half a pound more. B and C are compared as B6 and C6, with two digits of the lower "
    "spectrum read otherwise: as printed in the source, it pierces its own envelope, and then "
    "movements are up to 1.5 % and end forces up to 8 % above the print, which another test holds.",
)
FREQUENCIES = (
    *(6.042, 6.256, 7.76, 8.943, 12.444, 12.83, 14.303, 15.486, 16.371, 18.543, 19.499),
    *(23.243, 24.105, 32.636, 33.837),
)

# case, node of the deck, component: printed
MOVEMENTS = {
    ("A", "506N", "UX"): 0.058608,
    ("A", "33", "UY"): 0.112744,
    ("A", "15", "UZ"): 0.0102848,
    ("A", "32", "RX"): 0.00146853,
    ("A", "32", "RY"): 0.00109722,
    ("A", "506N", "RZ"): 0.00127548,
    ("B", "506N", "UX"): 0.0783074,
    ("B", "32", "UY"): 0.189857,
    ("B", "32", "UZ"): 0.198692,
    ("B", "506N", "RX"): 0.0015069,
    ("B", "3031N", "RY"): 0.00222876,
    ("B", "3031N", "RZ"): 0.00205115,
    ("C", "506N", "UX"): 0.0908314,
    ("C", "32", "UY"): 0.263393,
    ("C", "32", "UZ"): 0.275874,
    ("C", "2728F", "RX"): 0.00150778,
    ("C", "3031N", "RY"): 0.00309194,
    ("C", "3031N", "RZ"): 0.00284469,
}
# case, ends of the element, end: N Vy Vz T My Mz; of the bend in our axes (its y is our z)
FIRST, BEND, LAST = ("1", "203N"), ("2728N", "2728F"), ("35", "36")
END_FORCES = {
    ("A", LAST, 0): (119.9, 56.63, 55.95, 595.8, 675.0, 606.2),
    ("A", LAST, 1): (119.9, 56.63, 55.95, 595.8, 2685.0, 3329.0),
    ("A", BEND, 0): (183.7, 120.4, 26.74, 265.8, 398.2, 1308.0),
    ("A", BEND, 1): (120.4, 183.7, 26.74, 1123.0, 1496.0, 3095.0),
    ("B", FIRST, 0): (92.71, 86.43, 81.5, 1318.0, 2885.0, 2775.0),
    ("B", FIRST, 1): (92.71, 86.43, 81.5, 1318.0, 2041.0, 1907.0),
    ("B", LAST, 0): (84.2, 66.72, 74.27, 431.3, 1169.0, 1119.0),
    ("B", LAST, 1): (84.2, 66.72, 74.27, 431.3, 4724.0, 4484.0),
    ("B", BEND, 0): (121.7, 90.72, 30.01, 556.2, 989.2, 1036.0),
    ("B", BEND, 1): (90.72, 121.7, 30.01, 755.7, 1948.0, 2681.0),
    ("C", FIRST, 0): (127.7, 116.5, 109.0, 1522.0, 3548.0, 3503.0),
    ("C", FIRST, 1): (127.7, 116.5, 109.0, 1522.0, 2450.0, 2316.0),
    ("C", LAST, 0): (115.6, 91.81, 102.6, 582.5, 1615.0, 1544.0),
    ("C", LAST, 1): (115.6, 91.81, 102.6, 582.5, 6548.0, 6198.0),
    ("C", BEND, 0): (163.9, 123.3, 41.34, 769.1, 1365.0, 1399.0),
    ("C", BEND, 1): (123.3, 163.9, 41.34, 1034.0, 2692.0, 3666.0),
}
# case, node, direction: printed in whole pounds
REACTIONS = {
    ("A", "1", "Y"): 107,
    ("A", "4", "Y"): 234,
    ("A", "20", "X"): 78,
    ("A", "2728F", "Z"): 89,
    ("A", "36", "Z"): 56,
    ("B", "1", "X"): 86,
    ("B", "14", "Z"): 34,
    ("B", "26", "Z"): 53,
    ("B", "2728F", "Z"): 95,
    ("B", "36", "Z"): 74,
    ("C", "1", "X"): 117,
    ("C", "1", "Y"): 128,
    ("C", "1", "Z"): 109,
    ("C", "4", "Y"): 278,
    ("C", "7", "Z"): 100,
    ("C", "7", "X"): 113,
    ("C", "14", "Z"): 44,
    ("C", "14", "X"): 65,
    ("C", "20", "Z"): 35,
    ("C", "20", "X"): 63,
    ("C", "26", "Z"): 72,
    ("C", "26", "X"): 185,
    ("C", "2728F", "Y"): 204,
    ("C", "2728F", "Z"): 131,
    ("C", "36", "X"): 116,
    ("C", "36", "Y"): 92,
    ("C", "36", "Z"): 103,
}
CLOSE = {"A": 3e-3, "B6": 2e-3, "C6": 2e-3}
# a moment of which no digit, read otherwise, is near: it stays open
OPEN = {("B6", FIRST, 0, "My"): 0.9901}
PARTS = ("N", "Vy", "Vz", "T", "My", "Mz")


@pytest.fixture
def found(shaken):
    return shaken("nr1677_v2_p1")


def ours(case):
    """The case of the deck that is compared with a case of the report."""
    return case if case == "A" else f"{case}6"


def test_frequencies(found):
    assert found.modes.proven
    both = zip(FREQUENCIES, found.modes.frequency.tolist(), strict=True)
    for i, (printed, number) in enumerate(both, 1):
        agrees(NR1677, f"mode {i}", printed, number, "Hz", rel=5e-4)


def test_node_32_lies_in_its_plane(found, shake):
    """With Y = -536, as in the source, single frequencies are 0.2 to 0.3 % off."""
    model = found.model
    down = [
        replace(n, xyz=(n.xyz[0], -536 * 0.0254, n.xyz[2])) if n.label == "32" else n
        for n in model.nodes
    ]
    literal = shake(replace(model, nodes=down))
    ratio = literal.modes.frequency / FREQUENCIES
    assert ratio[[1, 3, 14]] == pytest.approx([1.0021, 0.9975, 0.9974], abs=2e-4)
    assert np.abs(found.modes.frequency / FREQUENCIES - 1.0).max() < 3e-4


@pytest.mark.parametrize("key", MOVEMENTS, ids="-".join)
def test_movements(found, key):
    case, *where = key
    number, unit = found.movement(ours(case), *where), "in" if key[2][0] == "U" else "rad"
    what = f"{ours(case)}, {' '.join(where)}"
    agrees(NR1677, what, MOVEMENTS[key], number, unit, rel=CLOSE[ours(case)])


@pytest.mark.parametrize("key", END_FORCES, ids=lambda key: f"{key[0]} {'-'.join(key[1])} {key[2]}")
def test_end_forces(found, key):
    case, element, at = key
    force = found.end(ours(case), *element, at)
    for part, number, printed in zip(PARTS, force, END_FORCES[key], strict=True):
        gap = OPEN.get((ours(case), element, at, part))
        what = f"{ours(case)}, {'-'.join(element)} at {element[at]} {part}"
        unit = "lbf" if part[0] in "NV" else "in lbf"
        if gap is None:
            agrees(NR1677, what, printed, number, unit, rel=CLOSE[ours(case)])
        else:
            differs(
                NR1677, what, printed, number, unit, found=gap * printed, abs=2e-4 * printed,
                why="no digit, read otherwise, is near; the other 83 numbers of B and C are met",
            )  # fmt: skip


@pytest.mark.parametrize("key", REACTIONS, ids="-".join)
def test_reactions(found, key):
    """Half a pound of print, and what the forces are off."""
    case, *where = key
    printed = REACTIONS[key]
    allowed = 0.5 + CLOSE[ours(case)] * printed
    what, number = f"{ours(case)}, load on {' '.join(where)}", found.reaction(ours(case), *where)
    agrees(NR1677, what, printed, number, "lbf", abs=allowed)


def test_lower_spectrum_pierces_its_envelope(found):
    """Case A takes the upper spectrum for both levels; the source's lower one is above it."""
    spectra = found.model.spectra
    lower, upper = spectra["LOWER"], spectra["UPPER"]
    f, a = np.array(lower.frequency), np.array(lower.acceleration)
    above = acceleration(upper, f) < a
    assert f[above] == pytest.approx([12.5])
    reread = np.array(spectra["LOWER6"].acceleration)
    assert (acceleration(upper, f) > reread).all()
    changed = np.flatnonzero(reread != a)
    assert a[changed] / 9.81456 == pytest.approx([0.875, 0.8])
    assert reread[changed] / 9.81456 == pytest.approx([0.675, 0.6])


@pytest.mark.parametrize(("case", "most"), [("B", 1.0798), ("C", 1.0674)])
def test_gaps_with_the_spectrum_as_printed_in_the_source(found, case, most):
    """Movements 0.1 to 1.5 % above the print, end forces up to 8 %: never below by 0.5 %."""
    ratios = [
        found.movement(case, *where) / printed
        for (which, *where), printed in MOVEMENTS.items()
        if which == case
    ]
    assert 1.0 < min(ratios) < max(ratios) < 1.015
    forces = np.array(
        [
            found.end(case, *element, at) / printed
            for (which, element, at), printed in END_FORCES.items()
            if which == case
        ]
    )
    differs(
        NR1677, f"{case}, largest of our end forces over the print", "1.000", forces.max(),
        found=most, abs=2e-4, why=f"with the lower spectrum as the source prints it; {case}6 reads "
        "two of its digits otherwise (0.675 and 0.6 for 0.875 and 0.8), for at 12.5 Hz it would "
        "pierce the spectrum that envelops it, and all but one of the numbers are met",
    )  # fmt: skip
    assert forces.min() > 0.995
