"""One job in four systems of units gives one set of loads: every quantity has its own constant.

The constants of a file turn inch, lbf, psi, lb/in3 and F into its units (UNITS of the format).
"""

from math import pi

import numpy as np
import pytest
from cii import Cii
from cii_jobs import ANC, GUI, RESTING, Y, slot

import trunnion
from trunnion.formats import Findings
from trunnion.formats.caesar import read
from trunnion.formats.source import source_of

INCH, POUND, LBF = 0.0254, 0.45359237, 4.4482216152605
PSI, LIGHT = LBF / INCH**2, POUND / INCH**3
CELSIUS, FAHRENHEIT = (1 / 1.8, -32 / 1.8), (1.0, 0.0)
# SI size of one unit: length, force, pressure, modulus, density, stiffness, moment, moment by
# degree, load by length, length of elements, diameter, wall; scale and shift of temperatures
IN_LB = (INCH, LBF, PSI, PSI, LIGHT, LBF / INCH, LBF * INCH, LBF * INCH, LBF / INCH)
CM_KGF = (1e-2, 9.80665, 98066.5, 98066.5, 1.0, 980.665, 9.80665, 9.80665, 9.80665)
SYSTEMS = {
    "mm, N, bar": ((1e-3, 1.0, 1e5, 1e6, 1e6, 100.0, 1.0, 1.0, 100.0, 1e-3, 1e-3, 1e-3), CELSIUS),
    "in, lb, ft": ((*IN_LB, 0.3048, INCH, INCH), FAHRENHEIT),
    "m, kN, kPa": ((1.0, 1e3, 1e3, 1e9, 1.0, 1e5, 1e3, 1e3, 1e3, 1.0, 1e-3, 1e-3), CELSIUS),
    "cm, kgf": ((*CM_KGF, 1e-3, 1e-3, 1e-3), CELSIUS),
}


def line(system, version):
    """A line with every quantity that has a unit."""
    sizes, (scale, shift) = SYSTEMS[system]
    length, force, pressure, modulus, density, kt, moment, turning, load, delta, od, wall = sizes
    lengths = (INCH / length, INCH / delta, INCH / od, INCH / wall)
    constants = (
        *(lengths[0], LBF / force, 1.0, LBF * INCH / moment, LBF * INCH / moment, PSI / pressure),
        *(scale, shift, PSI / pressure, PSI / modulus, LIGHT / density, LIGHT / density),
        *(LIGHT / density, LBF / INCH / kt, LBF * INCH / turning, LBF / INCH / load, 1.0),
        *(PSI / pressure, *lengths),
    )
    kr = turning * 180 / pi

    def t(celsius):
        return (celsius * 1.8 + 32) * scale + shift

    c = Cii(version=version, constants=constants, labels=(system, "ON"), ambient=t(21.11))
    c.defaults = {
        **{"od": 0.27305 / od, "wall": 0.009271 / wall, "insulation": 0.075 / wall},
        **{"corrosion": 0.0015 / wall, "t1": t(170.0), "p1": 12e5 / pressure, "nu": 0.292},
        **{"e": 203.4e9 / modulus, "density": 7833.44 / density, "fluid": 850 / density},
        **{"insulation_density": 140 / density},
    }
    pushed = [(20, {1: (0.0, -500 / force, 0.0, 0.0, 0.0, 300 / moment)})]
    held = [slot(10, ANC), slot(20, RESTING, mu=0.3, cosines=Y)]
    c.add(10, 20, dx=6.0 / delta, RESTRANT=held, FORCMNT=pushed)
    bend = {"radius": 0.381 / length, "nodes": ((45.0, 29), (0.0, 28))}
    c.add(20, 30, dx=6.0 / delta, BEND=bend)
    guided = [slot(40, GUI, gap=0.003 / length, mu=0.2), slot(29, 3, k=2e6 / kt, cosines=Y)]
    resting = slot(40, RESTING, cosines=Y, gap=0.002 / length)
    c.add(30, 40, dz=4.0 / delta, RESTRANT=[*guided, resting])
    push = [0.0, -300 / load, *[0.0] * 34]
    c.add(40, 50, dz=0.5 / delta, RIGID=(2100 / force, 1), UNIFORM=push)
    rates = (2e5 / kt, 3e6 / kt, 5e3 / kr, 1e6 / kr, 0.05 / od)
    c.add(50, 60, dz=0.6 / delta, EXPJT=rates)
    stops = [slot(70, 6, k=4e5 / kr, gap=0.5), slot(70, 4, k=1e8 / kt), slot(70, 2)]
    arms = (0.0, 0.0, 0.0, 0.0, 0.3 / length, 0.0)
    c.add(60, 70, dz=2.0 / delta, RESTRANT=stops, OFFSETS=arms)
    moved = {1: (0.0015 / length, -0.003 / length, None, None, None, 0.5)}
    end = [slot(80, 4, k=1e6 / kt)]
    c.add(70, 80, dz=2.0 / delta, dy=-1.0 / delta, DISPLMNT=[(80, moved)], RESTRANT=end)
    c.hangers = [{"node": 60, "k": 1e5 / kt, "cold": 8000 / force}]
    return c


def loads(system, version):
    source = source_of(line(system, version).text().encode("cp1252"), "line.cii")
    results = trunnion.solve(read(source, Findings(source)).model)
    return np.concatenate([results[case].supports.values[:, :6] for case in ("SUS", "OPE")])


@pytest.mark.parametrize("version", [7.01, 15.01])
@pytest.mark.parametrize("system", ["in, lb, ft", "m, kN, kPa", "cm, kgf"])
def test_loads_do_not_hang_on_the_units_of_the_file(system, version):
    # numbers of a file have 6 or 7 digits; the joint's pressure thrust adds up to 1e-5 of it
    wanted = loads("mm, N, bar", version)
    np.testing.assert_allclose(
        loads(system, version), wanted, rtol=0.0, atol=2e-5 * np.abs(wanted).max()
    )
