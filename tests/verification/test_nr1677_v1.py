"""NUREG/CR-1677 volume 1 (August 1980), problems 1, 3, 5 and 7: uniform support motion.

The report's answers (EPIPE, a SAP IV) as quoted by the verification decks vm-nr1677-1-*a-a.dat of
ansys-mapdl-core 0.74.1 (MIT licence, (c) ANSYS, Inc.); lengths in inches, forces in lbf.

What the answers show of how they were made:

-   Spectra are linear in period.  The points that the verification decks add between those of the
    report, for a program that interpolates logarithms, lie on these lines, to the digits given
    (`test_added_points_lie_on_lines_in_period`).
-   The directions of each mode combine before the modes are grouped (10 %).  Only problem 7 has
    close modes whose order matters; problem 5 is a plain SRSS.
-   The movements of problem 7 in its deck are not the report's but of the deck's own program: five
    digits instead of six, logarithms, modes before directions.

All other differences are single numbers that a digit read otherwise would mend, most of them
shown wrong by statics or by the same number at the other end of the element.  They are in
MISREAD with the number found here; nothing is changed to meet them.
"""

from dataclasses import replace

import numpy as np
import pytest
from published import PUBLISHED, Source, agrees, differs

from trunnion.solver.spectrum import acceleration

NR1677 = {
    problem: Source(
        PUBLISHED,
        f"NUREG/CR-1677 volume 1, problem {problem[1]}",
        f"nr1677_v1_{problem}",
        "Bezler, Hartzman and Reich, August 1980: modes and uniform response spectrum; answers of "
        f"the report (EPIPE) as quoted by the verification deck vm-nr1677-1-{problem[1]}a-a.dat of "
        "ansys-mapdl-core 0.74.1 (MIT licence, (c) ANSYS, Inc.). Frequencies within 0.05 %, half a "
        "unit of the last of four digits; movements within 0.02 %; end forces within 0.07 %. N Vy "
        "Vz T My Mz in the axes of that end, in the source's order.",
    )
    for problem in ("p1", "p3", "p5", "p7")
}
FREQUENCIES = {
    "p1": (28.53, 55.77, 81.5, 141.7, 162.8),
    "p3": (9.36, 12.71, 15.38, 17.8, 21.6, 25.1, 32.03, 38.07, 40.29, 48.9),
    "p5": (4.036, 4.257, 9.116, 11.19, 17.11, 18.17, 22.38, 27.19, 28.01, 37.98, 40.97),
    "p7": (
        *(5.034, 7.813, 8.193, 8.977, 9.312, 9.895, 13.22, 14.96, 15.07, 17.75, 18.21),
        *(22.9, 25.02, 25.85, 26.94, 28.13, 30.3, 35.22, 37.1, 42.61, 44.42, 48.09),
    ),
}

# problem, case, node of the deck (of the source), component: printed
MOVEMENTS = {
    ("p1", "RS", "4F", "UX"): 0.00784967,  # 5
    ("p1", "RS", "8N", "UY"): 0.00249629,  # 7
    ("p1", "RS", "4M", "UZ"): 0.0174471,  # 4
    ("p1", "RS", "4N", "RX"): 0.00018413,  # 3
    ("p1", "RS", "8N", "RY"): 0.000212142,  # 7
    ("p1", "RS", "4N", "RZ"): 0.0000701236,  # 3
    ("p3", "RS", "1415N", "UX"): 0.22913,  # 14
    ("p3", "RS", "8M", "UY"): 0.0980058,  # 8
    ("p3", "RS", "8F", "UZ"): 0.166289,  # 9
    ("p3", "RS", "4N", "RX"): 0.00271028,  # 3
    ("p3", "RS", "8N", "RY"): 0.0049938,  # 7
    ("p3", "RS", "17", "RZ"): 0.00239003,
    ("p5", "RS", "607F", "UX"): 0.0976006,  # 7
    ("p5", "RS", "1314N", "UY"): 0.0600532,  # 13
    ("p5", "RS", "910F", "UZ"): 0.0465745,  # 10
    ("p5", "RS", "1314F", "RX"): 0.000442117,  # 14
    ("p5", "RS", "607N", "RY"): 0.00109853,  # 6
    ("p5", "RS", "708F", "RZ"): 0.000195557,  # 8
    ("p7", "RSL", "809N", "UX"): 0.084658,  # 8
    ("p7", "RSL", "809N", "UY"): 0.24339,  # 8
    ("p7", "RSL", "1112N", "UZ"): 0.34208,  # 11
    ("p7", "RSL", "7", "RX"): 0.005784,
    ("p7", "RSL", "14", "RY"): 0.0021064,
    ("p7", "RSL", "4950F", "RZ"): 0.0012406,  # 50
}


def swapped(force):
    """The report's y and z of an arc are our z and y."""
    n, vy, vz, t, my, mz = force
    return n, vz, vy, t, mz, my


# problem, ends of the element in the deck, end: N Vy Vz T My Mz as printed
END_FORCES = {
    ("p1", "1", "2", 0): (4.958, 17.88, 36.43, 629.6, 3227.0, 1394.0),
    ("p1", "1", "2", 1): (4.958, 17.88, 36.43, 629.6, 1260.0, 474.2),
    ("p1", "4M", "4F", 0): swapped((9.3, 10.63, 9.239, 142.1, 289.9, 828.4)),
    ("p1", "4M", "4F", 1): swapped((12.38, 10.63, 4.305, 423.7, 261.3, 541.9)),
    ("p1", "10", "11", 0): (24.02, 7.472, 34.78, 113.0, 1871.0, 650.1),
    ("p1", "10", "11", 1): (24.02, 7.472, 34.78, 113.0, 2477.0, 774.5),
    ("p3", "1", "2", 0): (154.4, 209.2, 463.3, 13090.0, 43130.0, 18060.0),
    ("p3", "1", "2", 1): (154.4, 209.2, 463.3, 13090.0, 18760.0, 8095.0),
    ("p3", "8N", "8M", 0): swapped((270.6, 39.15, 1813.0, 5823.0, 20040.0, 5439.0)),
    ("p3", "8N", "8M", 1): swapped((1200.0, 39.15, 1386.0, 7810.0, 31740.0, 2256.0)),
    ("p3", "1920F", "21", 0): (633.3, 471.2, 1012.0, 5724.0, 9985.0, 8126.0),
    ("p3", "1920F", "21", 1): (633.3, 471.2, 1012.0, 5724.0, 44680.0, 27570.0),
    ("p5", "1", "203N", 0): (473.6, 120.9, 463.6, 3979.0, 52390.0, 9741.0),
    ("p5", "1", "203N", 1): (473.6, 120.9, 403.6, 3479.0, 44110.0, 7434.0),
    ("p5", "20", "2021F", 0): swapped((418.4, 215.4, 262.6, 9940.0, 23180.0, 12000.0)),
    ("p5", "20", "2021F", 1): swapped((316.8, 215.4, 346.2, 15060.0, 22180.0, 4918.0)),
    ("p5", "3031F", "3233N", 0): (525.9, 233.8, 497.2, 15180.0, 11900.0, 7325.0),
    ("p5", "3031F", "3233N", 1): (525.9, 233.8, 497.2, 15180.0, 11900.0, 7326.0),
    ("p7", "1", "203N", 0): (236.4, 80.72, 260.5, 4947.0, 22170.0, 2106.0),
    ("p7", "1", "203N", 1): (236.0, 80.72, 266.5, 4947.0, 20590.0, 1656.0),
    ("p7", "3839F", "40", 0): (50.36, 28.53, 27.62, 482.0, 96.69, 1625.0),  # shears swapped
    ("p7", "3839F", "40", 1): (50.36, 28.53, 27.62, 462.0, 428.0, 1796.0),
    ("p7", "4950N", "4950F", 0): swapped((94.27, 35.29, 26.37, 235.4, 2491.0, 446.6)),
    ("p7", "4950N", "4950F", 1): swapped((26.07, 35.29, 94.27, 469.2, 2176.0, 134.0)),
}

# the same keys, with the component: what is found here, and how the print shows that it is wrong
MISREAD_MOVEMENTS = {
    ("p1", "RS", "4F", "UX"): 0.0078398,  # one digit: 0.00783967
    ("p3", "RS", "1415N", "UX"): 0.22417,  # one digit: 0.22413
}
MISREAD_FORCES = {
    ("p1", "1", "2", 1, "Mz"): 473.22,  # one digit: 473.2
    ("p3", "1", "2", 0, "T"): 13495.0,  # one digit: 13490, twice
    ("p3", "1", "2", 1, "T"): 13495.0,
    ("p5", "1", "203N", 1, "Vz"): 463.61,  # 463.6 at the other end
    ("p5", "1", "203N", 1, "T"): 3978.8,  # 3979 at the other end
    ("p5", "20", "2021F", 0, "Vy"): 202.59,  # one digit: 202.6
    ("p5", "20", "2021F", 1, "Vy"): 340.06,  # one digit: 340.2
    ("p5", "20", "2021F", 1, "My"): 4419.7,  # one digit: 4418
    ("p7", "1", "203N", 0, "N"): 236.86,  # one digit: 236.9; the other end differs, which it cannot
    ("p7", "1", "203N", 1, "N"): 236.86,
    ("p7", "1", "203N", 0, "Vz"): 266.53,  # 266.5 at the other end
    ("p7", "3839F", "40", 0, "Vz"): 27.018,  # one digit: 27.02, twice
    ("p7", "3839F", "40", 1, "Vz"): 27.018,
    ("p7", "3839F", "40", 1, "T"): 481.97,  # 482.0 at the other end
    ("p7", "3839F", "40", 0, "Mz"): 1645.1,  # one digit: 1645
    ("p7", "4950N", "4950F", 0, "Vy"): 26.068,  # the N of the other end of a right angle: 26.07
    ("p7", "4950N", "4950F", 1, "My"): 138.99,  # one digit: 139.0
    ("p7", "4950N", "4950F", 1, "Mz"): 2170.2,  # one digit: 2170
}
# the moments of the other end stand there again, though there is shear between
REPEATED = {
    ("p5", "3031F", "3233N", 0, "My"): 13107.0,
    ("p5", "3031F", "3233N", 0, "Mz"): 7014.2,
}
PARTS = ("N", "Vy", "Vz", "T", "My", "Mz")
CLOSE = 7e-4  # four digits are printed: half a unit of the last is up to 0.05 %


@pytest.fixture
def of(shaken):
    """Answers of a problem."""
    return lambda problem: shaken(f"nr1677_v1_{problem}")


MISREAD = "one digit of the source, read otherwise, gives our number"


def moved(where):
    """What a movement is called in the record."""
    case, label, component = where
    return f"{case}, {label} {component}"


def unit_of(where):
    return "in" if where[2].startswith("U") else "rad"


def pulled(start, end, at, part):
    """What a force is called in the record, and its unit."""
    return f"RS, {start}-{end} at {(start, end)[at]} {part}", "lbf" if part[0] in "NV" else "in lbf"


def found_force(of, key):
    """Our number for a key of MISREAD_FORCES, and the print's."""
    problem, start, end, at, part = key
    i = PARTS.index(part)
    return of(problem).end("RS", start, end, at)[i], END_FORCES[problem, start, end, at][i]


def one_digit_away(printed, number):
    """Whether one digit of the print, read otherwise, is the number."""
    text = f"{printed:.10f}"
    others = (
        float(text[:i] + digit + text[i + 1 :])
        for i, old in enumerate(text)
        if old.isdigit()
        for digit in "0123456789"
    )
    return any(abs(number / x - 1.0) < CLOSE for x in others if x)


@pytest.mark.parametrize("problem", FREQUENCIES)
def test_frequencies(of, problem):
    """To 0.05 %, which is half a unit of the last of four digits."""
    modes = of(problem).modes
    assert modes.proven
    assert modes.residual.max() < 1e-11
    found = zip(FREQUENCIES[problem], modes.frequency.tolist(), strict=True)
    for i, (printed, ours) in enumerate(found, 1):
        agrees(NR1677[problem], f"mode {i}", printed, ours, "Hz", rel=5e-4)


MET = [key for key in MOVEMENTS if key not in MISREAD_MOVEMENTS]


@pytest.mark.parametrize("key", MET, ids="-".join)
def test_movements(of, key):
    problem, *where = key
    found = of(problem).movement(*where)
    agrees(NR1677[problem], moved(where), MOVEMENTS[key], found, unit_of(where), rel=2e-4)


@pytest.mark.parametrize("key", END_FORCES, ids=lambda key: f"{key[0]} {key[1]}-{key[2]} {key[3]}")
def test_end_forces(of, key):
    problem, *where = key
    found = of(problem).end("RS", *where)
    left = MISREAD_FORCES.keys() | REPEATED.keys()
    for part, number, printed in zip(PARTS, found, END_FORCES[key], strict=True):
        if (*key, part) not in left:
            what, unit = pulled(*where, part)
            agrees(NR1677[problem], what, printed, number, unit, rel=CLOSE)


@pytest.mark.parametrize("key", MISREAD_MOVEMENTS, ids="-".join)
def test_misread_movements(of, key):
    """The print is 0.1 % and 2.2 % off; one digit mends it."""
    problem, *where = key
    found, printed = of(problem).movement(*where), MOVEMENTS[key]
    differs(
        NR1677[problem], moved(where), printed, found, unit_of(where),
        found=MISREAD_MOVEMENTS[key], rel=5e-5, why=MISREAD,
    )  # fmt: skip
    assert abs(found / printed - 1.0) > CLOSE
    assert one_digit_away(printed, found)


@pytest.mark.parametrize("key", MISREAD_FORCES, ids=lambda key: " ".join(map(str, key)))
def test_misread_forces(of, key):
    """The print is 0.2 % to 29 % off; one digit mends it."""
    found, printed = found_force(of, key)
    what, unit = pulled(*key[1:])
    differs(
        NR1677[key[0]], what, printed, found, unit,
        found=MISREAD_FORCES[key], rel=5e-5, why=MISREAD,
    )  # fmt: skip
    assert abs(found / printed - 1.0) > CLOSE
    assert one_digit_away(printed, found)


@pytest.mark.parametrize("key", REPEATED, ids=lambda key: " ".join(map(str, key)))
def test_repeated_moments(of, key):
    found, printed = found_force(of, key)
    *element, _, part = key
    what, unit = pulled(*key[1:])
    differs(
        NR1677[key[0]], what, printed, found, unit, found=REPEATED[key], rel=5e-5,
        why="the print repeats the moment of the other end, though there is shear between",
    )  # fmt: skip
    assert found_force(of, (*element, 1, part))[0] == pytest.approx(printed, rel=CLOSE)


def test_doubled_element_explains_the_branch(of, shake):
    """Problem 7 with element 25 of both definitions: five frequencies 0.9 to 1.3 % too high.

    That is what a rebuild of the deck found that kept both; in its program the second replaces
    the first.
    """
    model = of("p7").model
    pipe = next(p for p in model.pipes if (p.start, p.end) == ("26", "27"))
    assert pipe.material == "VALVE"
    light = replace(
        model.materials["VALVE"], name="BOTH", e=27e6 * 6894.757293168 + 81e6 * 6894.757293168
    )
    twice = [replace(p, material="BOTH") if p is pipe else p for p in model.pipes]
    both = replace(model, pipes=twice, materials={**model.materials, "BOTH": light})
    ratio = shake(both).modes.frequency / FREQUENCIES["p7"]
    off = np.flatnonzero(np.abs(ratio - 1.0) > 5e-3) + 1
    assert off.tolist() == [6, 13, 16, 18, 20]
    assert ratio[off - 1] == pytest.approx([1.0092, 1.0132, 1.0134, 1.0093, 1.0127], abs=1e-4)


def test_order_of_combination_matters_where_modes_are_close(of, shake):
    """Problem 7 with modes before directions: 2 % off at the end of 39-40."""
    model = of("p7").model
    (case, _) = model.cases
    use = replace(case.spectrum, first="MODES")
    other = shake(replace(model, cases=[replace(case, spectrum=use)]))
    axial = other.end("RS", "3839F", "40", 0)[3]
    assert axial / 482.0 == pytest.approx(0.983, abs=5e-4)


# frequency [Hz] and acceleration [in/s2] that the source adds between the report's points
ADDED = {
    ("p1", "H"): {25: 533.2, 28.5: 467.2, 30: 443.6, 55: 289, 80: 239.4, 140: 192.6, 162: 184.1},
    ("p1", "V"): {25: 355.5, 28.5: 311.5, 30: 295.7, 55: 192.7, 80: 159.6, 140: 128.4, 162: 122.7},
    ("p3", "H"): {9: 1090, 10: 733, 20: 668, 25: 533, 30: 444, 40: 349, 45: 324, 50: 306},
    ("p5", "H"): {4.25: 66.83, 10: 65.34, 15: 43.53, 20: 40.96, 25: 39.41, 30: 38.38, 35: 37.64},
    ("p7", "H"): {5: 329.5, 6: 236.4, 7: 169.9, 7.8: 129.0, 8.2: 111.54, 9: 81.26, 9.3: 71.25},
    ("p7", "V"): {5: 109.48, 6: 98.75, 7: 91.08, 7.8: 86.36, 8.2: 84.35, 9: 80.86, 9.3: 79.7},
}


@pytest.mark.parametrize("key", ADDED, ids="-".join)
def test_added_points_lie_on_lines_in_period(of, key):
    """To 0.4 %, as 1090 is printed; straight lines of logarithms miss some by 1.9 % and more."""
    problem, name = key
    spectrum = of(problem).model.spectra[name]
    f, a = (np.array(list(x)) for x in (ADDED[key].keys(), ADDED[key].values()))
    assert acceleration(spectrum, f) / 0.0254 == pytest.approx(a, rel=4e-3)
    logarithms = acceleration(replace(spectrum, log=True), f) / 0.0254
    assert np.abs(logarithms / a - 1.0).max() > 0.019
