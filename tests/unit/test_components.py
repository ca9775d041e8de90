"""Reducers, bodies, expansion joints, cold spring and uniform loads against closed forms."""

from math import pi

import numpy as np
import pytest

import trunnion
from trunnion import kernels
from trunnion.arrays import TAPER
from trunnion.certificate import deformation
from trunnion.deck.reader import read_text
from trunnion.loads import case_loads
from trunnion.model import Case, Term
from trunnion.report.text import text_report
from trunnion.results.interior import points, stations
from trunnion.system import build_system

E, NU = 200e9, 0.3
HEAD = f"""DEFAULT SHEAR=OFF
MATERIAL M E={E!r} NU={NU} ALPHA=12e-6 DENSITY=8000
SECTION BIG OD=0.4 WALL=0.2
SECTION SMALL OD=0.2 WALL=0.1
SECTION BIG
"""


def solved(body, head=HEAD):
    results = trunnion.solve(read_text(head + body, "deck.inp"))
    for case in results.cases.values():
        assert case.converged, case.cause
        assert case.certificate.passed, case.certificate
    return results


def moved(results, node, case="A"):
    """Movement of a node against the anchor at the first one: an anchor yields, 1e12 N/m."""
    table, system = results[case].displacements, results.system
    u, base = (
        np.array([table[label][c] for c in ("ux", "uy", "uz", "rx", "ry", "rz")])
        for label in (node, system.labels[0])
    )
    u -= base
    u[:3] -= np.cross(base[3:], system.xyz[system.labels.index(node)] - system.xyz[0])
    return u


# --- reducer


def test_solid_cone_bends_as_roark_says():
    """Tapered cantilever, diameters linear: 64 P L3/(3 pi E D1^3 D2) at the loaded small end.

    Roark's Formulas for Stress and Strain, 7th ed., table 8.11(a), n = 4 (wide end fixed):
    factor on P L3/(3 E I_small) is (D2/D1)^3; the stretch is 4 P L/(pi E D1 D2).
    """
    length, p, d1, d2 = 3.0, 1000.0, 0.4, 0.2
    u = moved(solved(f"""ANCHOR 1
REDUCER 1 2 DX={length} TO=SMALL
FORCE 2 F1 FX={p} FY={-p}
CASE A = F1
"""), "2")  # fmt: skip
    assert u[1] == pytest.approx(-64 * p * length**3 / (3 * pi * E * d1**3 * d2), rel=1e-12)
    assert u[0] == pytest.approx(4 * p * length / (pi * E * d1 * d2), rel=1e-12)
    # slope: integral of M/EI, with I = pi D^4/64 and D linear
    x, w = np.polynomial.legendre.leggauss(60)
    x = 0.5 * length * (1 + x)
    d = d1 + (d2 - d1) * x / length
    slope = (0.5 * length * w * 64 * p * (length - x) / (pi * E * d**4)).sum()
    assert u[5] == pytest.approx(-slope, rel=1e-12)


def test_solid_cone_twists_as_roark_says():
    """Circular section of linear taper: 32 T L (D1^2 + D1 D2 + D2^2)/(3 pi G D1^3 D2^3)."""
    length, t, d1, d2 = 3.0, 1000.0, 0.4, 0.2
    u = moved(solved(f"""ANCHOR 1
REDUCER 1 2 DX={length} TO=SMALL
FORCE 2 F1 MX={t}
CASE A = F1
"""), "2")  # fmt: skip
    g = E / 2 / (1 + NU)
    want = 32 * t * length * (d1**2 + d1 * d2 + d2**2) / (3 * pi * g * d1**3 * d2**3)
    assert u[3] == pytest.approx(want, rel=1e-12)


@pytest.mark.parametrize("turned", [False, True])
def test_weight_of_a_solid_cone_and_where_it_acts(turned):
    """A frustum weighs rho g pi L (D1^2 + D1 D2 + D2^2)/12, its moment about the large end
    is rho g pi L2 (D1^2 + 2 D1 D2 + 3 D2^2)/48."""
    length, d1, d2, g = 3.0, 0.4, 0.2, 9.80665
    first, last = ("SMALL", "BIG") if turned else ("BIG", "SMALL")
    ends = ("2 1", -length) if turned else ("1 2", length)
    results = solved(f"""ANCHOR 1
SECTION {first}
REDUCER {ends[0]} DX={ends[1]} TO={last}
CASE A = W
""")
    force = results["A"].supports["1"]
    weight = 8000 * g * pi * length * (d1**2 + d1 * d2 + d2**2) / 12
    moment = 8000 * g * pi * length**2 * (d1**2 + 2 * d1 * d2 + 3 * d2**2) / 48
    assert force["fy"] == pytest.approx(weight, rel=1e-12)
    assert force["mz"] == pytest.approx(moment, rel=1e-12)


PIPES = """DEFAULT SHEAR=ON
MATERIAL M E=200GPa NU=0.3 ALPHA=12e-6 DENSITY=7850
SECTION S10 OD=273.1mm WALL=9.27mm FLUID=900 INSULATION=50mm INSULATION_DENSITY=140
SECTION S6 OD=168.3mm WALL=7.11mm FLUID=900 INSULATION=50mm INSULATION_DENSITY=140
"""


def stepped(n, offset=0.0):
    """The same reducer as n short pipes with the diameters at their middles."""
    lines, at = [], [0.0]
    for i in range(n):
        s = (i + 0.5) / n
        od, wall = 0.2731 + s * (0.1683 - 0.2731), 9.27e-3 + s * (7.11e-3 - 9.27e-3)
        lines.append(
            f"SECTION P{i} OD={od!r} WALL={wall!r} FLUID=900 INSULATION=0.05 INSULATION_DENSITY=140"
        )
        lines.append(f"PIPE N{i} N{i + 1} DX={0.4 / n!r}")
    return "\n".join(lines), at


def test_steps_converge_to_the_reducer_with_order_two():
    """n pipes with the diameters of their middles: the error falls as 1/n2, load and weight."""
    tail = "FORCE {end} F1 FY=-10000 FZ=3000 FX=2000 MX=900 MY=500\nCASE A = F1\nCASE B = W\n"
    exact = solved("ANCHOR N0\nSECTION S10\nREDUCER N0 E DX=0.4 TO=S6\n" + tail.format(end="E"),
                   PIPES)  # fmt: skip
    for name in "AB":
        want, errors, rows = moved(exact, "E", name), [], []
        for n in (4, 8, 16):
            steps, _ = stepped(n)
            found = solved(f"{steps}\nANCHOR N0\n" + tail.format(end=f"N{n}"), PIPES)
            rows.append(moved(found, f"N{n}", name))
            errors.append(np.abs(rows[-1] - want).max() / np.abs(want).max())
        assert (4 * rows[2] - rows[1]) / 3 == pytest.approx(want, rel=2e-4, abs=1e-12)
        assert np.diff(np.log2(errors)) == pytest.approx([-2.0, -2.0], abs=0.1)


@pytest.mark.parametrize("flat", ["UP", "DOWN"])
def test_flat_reducer_has_half_the_difference_of_diameters(flat):
    model = read_text(PIPES + f"SECTION S10\nREDUCER 1 2 DX=0.4 TO=S6 FLAT={flat}\nPIPE 2 3 DX=1\n")
    system = build_system(model)
    drop = 0.5 * (0.2731 - 0.1683)
    at = system.xyz[system.labels.index("2")]
    assert at == pytest.approx([0.4, drop if flat == "UP" else -drop, 0.0])
    assert system.length[0] == pytest.approx(0.4)
    assert system.taper[0] == pytest.approx([0.1683, 7.11e-3, drop])
    assert system.axes[0, 0] == pytest.approx([1.0, 0.0, 0.0])


def test_eccentric_reducer_is_a_beam_with_a_drop_in_its_axis():
    """A tension along the axis bends an eccentric reducer: the integral of P e(x)/EI.

    Fixed at the large end, P at the small end's centre: M(x) = P (offset - e(x)), so the small end
    turns by the integral of M/EI and the cantilever with the same M sags accordingly.
    """
    p, length = 1e5, 0.4
    results = solved(f"ANCHOR 1\nSECTION S10\nREDUCER 1 2 DX={length} TO=S6 FLAT=DOWN\n"
                     f"FORCE 2 F1 FX={p}\nCASE A = F1\n", PIPES)  # fmt: skip
    x, w = np.polynomial.legendre.leggauss(60)
    s, w = 0.5 * (1 + x), 0.5 * w * length
    od, wall = 0.2731 + s * (0.1683 - 0.2731), 9.27e-3 + s * (7.11e-3 - 9.27e-3)
    bore = od - 2 * wall
    ei, ea = 200e9 * pi / 64 * (od**4 - bore**4), 200e9 * pi / 4 * (od**2 - bore**2)
    drop = 0.5 * (0.2731 - 0.1683)
    moment = p * drop * (1 - s)  # about z: the force lies below the centre of the section
    u = moved(results, "2")
    assert u[5] == pytest.approx((w * moment / ei).sum(), rel=1e-12)
    assert u[1] == pytest.approx((w * moment / ei * length * (1 - s)).sum(), rel=1e-12)
    stretch = (w * (p / ea + moment / ei * drop * (1 - s))).sum()
    assert u[0] == pytest.approx(stretch, rel=1e-12)


def test_hot_reducer_keeps_its_shape_and_a_held_one_pushes():
    head = PIPES + "SECTION S10\nOPERATE T1=120\n"
    body = "REDUCER 1 2 DX=0.4 TO=S6 FLAT=DOWN\nCASE A = T1\n"
    u = moved(solved("ANCHOR 1\n" + body, head), "2")
    drop = 0.5 * (0.2731 - 0.1683)
    assert u[:3] == pytest.approx(np.array([0.4, -drop, 0.0]) * 12e-6 * 100, rel=1e-12)
    assert np.abs(u[3:]).max() < 1e-15


def test_a_reducer_cut_at_any_point_goes_on_as_itself():
    """Interior points equal the nodes of the reducer written as two reducers."""
    end = "FORCE 3 F1 FY=-10000 FX=5000 MZ=800\nCASE A = W + F1 + T1\n"
    head = PIPES + "OPERATE T1=120\n"
    middle = "SECTION SM OD=0.2207 WALL=8.19mm FLUID=900 INSULATION=50mm INSULATION_DENSITY=140\n"
    whole = solved("ANCHOR 1\nSECTION S10\nREDUCER 1 3 DX=0.4 TO=S6 FLAT=DOWN\n" + end, head)
    halves = solved("ANCHOR 1\n" + middle + "SECTION S10\nREDUCER 1 2 DX=0.2 TO=SM FLAT=DOWN\n"
                    "REDUCER 2 3 DX=0.2 TO=S6 FLAT=DOWN\n" + end, head)  # fmt: skip
    assert moved(whole, "3") == pytest.approx(moved(halves, "3"), rel=1e-10)
    at = points(whole["A"], np.array([0]), np.array([0.5]))
    base, node = (halves.system.labels.index(label) for label in "12")
    lift = at.displacement[0] - whole["A"].state.u[0]
    lift[:3] -= np.cross(whole["A"].state.u[0, 3:], halves.system.xyz[node])
    assert base == 0
    assert lift == pytest.approx(moved(halves, "2"), rel=1e-10)
    two = halves["A"].state.end_force[1, 0]
    assert -at.force[0] == pytest.approx(two, rel=1e-9, abs=1e-6)
    assert np.isfinite(stations(whole["A"], 4).displacement).all()


def test_stress_of_a_reducer_is_that_of_its_own_end():
    results = solved("ANCHOR 1\nSECTION S10\nREDUCER 1 2 DX=0.4 TO=S6\nFORCE 2 F1 FX=1e5\n"
                     "CASE A = F1\n", PIPES)  # fmt: skip
    stress = results["A"].stresses["1-2"]
    for end, od, wall in (("from", 0.2731, 9.27e-3), ("to", 0.1683, 7.11e-3)):
        area = pi / 4 * (od**2 - (od - 2 * wall) ** 2)
        assert stress[f"axial_{end}"] == pytest.approx(1e5 / area, rel=1e-12)


def test_certificate_and_kernel_agree_on_reducers_and_share_no_code():
    rng = np.random.default_rng(20)
    model = read_text(
        PIPES + "ANCHOR 1\nSECTION S10\nREDUCER 1 2 DX=0.4 DZ=0.1 TO=S6 AXIS=(1,0.1,0)\n"
    )
    system = build_system(model)
    loads = case_loads(model, system, Case("A", (Term(1.0, "W"),)))
    tip = rng.normal(size=(6, 1)) * 1e4
    law = deformation.expected(system, loads, tip)[:, 0]
    from trunnion.forms import forms, part_load

    form, axes = forms(system), system.axes[0]
    load = np.ascontiguousarray(
        np.einsum("nij,npj->npi", system.axes, part_load(loads.dist, loads.vary, np.ones(1)))
    )
    kind = np.array([TAPER], np.int32)
    f = kernels.tip_flexibility(kind, form, system.rigidity, system.flex)[0]
    v = kernels.tip_deformation(
        kind, form, system.rigidity, system.flex, load, np.zeros(1), np.zeros(1)
    )[0]
    own = np.concatenate((axes @ tip[:3, 0], axes @ tip[3:, 0]))
    v = v + f @ own
    turned = np.concatenate((axes.T @ v[:3], axes.T @ v[3:]))
    assert turned == pytest.approx(law, rel=1e-12)


def test_reducer_has_its_mass_in_modes():
    results = solved("ANCHOR 1\nSECTION S10\nREDUCER 1 2 DX=0.4 TO=S6\nPIPE 2 3 DX=4\n"
                     "CASE A = W\nMODES 3 FMAX=400 MASS=CONSISTENT\n", PIPES)  # fmt: skip
    halves = solved("ANCHOR 1\nSECTION SM OD=0.2207 WALL=8.19mm FLUID=900 INSULATION=50mm "
                    "INSULATION_DENSITY=140\nSECTION S10\nREDUCER 1 M DX=0.2 TO=SM\n"
                    "REDUCER M 2 DX=0.2 TO=S6\nPIPE 2 3 DX=4\n"
                    "CASE A = W\nMODES 3 FMAX=400 MASS=CONSISTENT\n", PIPES)  # fmt: skip
    weight = -results["A"].supports["1"]["fy"]
    assert results.modes.total_mass[1] == pytest.approx(-weight / 9.80665, rel=1e-12)
    # the mass is even along each reducer: near the anchor that moves no frequency by 1e-4
    assert results.modes.frequency == pytest.approx(halves.modes.frequency, rel=1e-4)


# --- valve, flange


def test_valve_and_flange_are_rigid_bodies_by_another_name():
    def ends(word):
        results = solved(f"ANCHOR 1\nSECTION S10\nPIPE 1 2 DX=2\n{word} 2 3 DX=0.5 WEIGHT=3000\n"
                         "PIPE 3 4 DX=1\nCASE A = W\n", PIPES)  # fmt: skip
        return moved(results, "4"), results.system.parts[1].type

    rigid, name = ends("RIGID")
    assert name == "rigid"
    for word in ("VALVE", "FLANGE"):
        same, name = ends(word)
        assert (same == rigid).all()
        assert name == word.lower()


# --- expansion joint

LINE = PIPES + "SECTION S10\nOPERATE P1=10bar T1=120\n"


def test_joint_without_length_has_its_rates():
    results = solved("""ANCHOR 1
JOINT 1 2 AXIS=(1,0,0) AXIAL=200N/mm LATERAL=300N/mm BENDING=4000 TORSION=9000 AREA=60000mm2
FORCE 2 F1 FX=100 FY=200 FZ=-300 MX=50 MY=60 MZ=70
CASE A = F1
""", LINE)  # fmt: skip
    want = [100 / 2e5, 200 / 3e5, -300 / 3e5, 50 / 9000, 60 / 4000, 70 / 4000]
    assert moved(results, "2") == pytest.approx(want, rel=1e-12)


def test_joint_with_length_is_a_uniform_beam():
    """EI/L = bending rate: a cantilever under a tip load sags V L3/3EI and stretches V/k."""
    length, bending = 0.6, 5000.0
    results = solved(f"""ANCHOR 1
JOINT 1 2 DX={length} AXIAL=200N/mm BENDING={bending}
FORCE 2 F1 FX=100 FY=200
CASE A = F1
""", LINE)  # fmt: skip
    ei = bending * length
    u = moved(results, "2")
    assert u[:2] == pytest.approx([100 / 2e5, 200 * length**3 / (3 * ei)], rel=1e-12)
    assert u[5] == pytest.approx(200 * length**2 / (2 * ei), rel=1e-12)


def test_pressure_pushes_the_ends_of_a_joint_apart():
    """Anchor - pipe - joint - pipe - anchor: the thrust P A stretches the joint against the pipe.

    By hand: the pipes and the joint are springs in series between anchors, k = 1/sum(1/ki); the
    joint's ends are pushed apart by F = P A, so the anchors get F k_rest/(k_joint + k_rest).
    """
    k, area, p = 2e5, 0.06, 10e5
    results = solved(f"""ANCHOR 1
PIPE 1 2 DX=2
JOINT 2 3 DX=0.3 AXIAL={k} LATERAL=3e5 AREA={area}
PIPE 3 4 DX=3
ANCHOR 4
CASE A = P1
""", LINE)  # fmt: skip
    od, wall = 0.2731, 9.27e-3
    ea = 200e9 * pi / 4 * (od**2 - (od - 2 * wall) ** 2)
    rest = 1 / (5 / ea + 2e-12)  # pipes and the two anchors of 1e12 N/m
    thrust = p * area * rest / (k + rest)
    assert results["A"].supports["1"]["fx"] == pytest.approx(thrust, rel=1e-9)
    assert results["A"].supports["4"]["fx"] == pytest.approx(-thrust, rel=1e-9)


def test_joint_grows_with_temperature_over_its_length():
    results = solved("ANCHOR 1\nJOINT 1 2 DX=0.3 AXIAL=200N/mm LATERAL=3e5\nCASE A = T1\n", LINE)
    assert moved(results, "2")[:3] == pytest.approx([0.3 * 12e-6 * 100, 0, 0], rel=1e-12, abs=1e-18)


def test_joint_weighs_what_it_and_its_contents_weigh():
    results = solved("ANCHOR 1\nANCHOR 2\nJOINT 1 2 DX=0.3 AXIAL=2e5 LATERAL=3e5 WEIGHT=500\n"
                     "CASE A = W\nCASE B = WNC\nCASE C = WW\n", LINE)  # fmt: skip
    room = 9.80665 * pi / 4 * (0.2731 - 2 * 9.27e-3) ** 2 * 0.3
    for name, weight in (("A", 500 + 900 * room), ("B", 500), ("C", 500 + 1000 * room)):
        for node in "12":
            assert results[name].supports[node]["fy"] == pytest.approx(weight / 2, rel=1e-12)


# --- cold spring, uniform loads


def test_cold_spring_pulls_a_held_pipe():
    """Cut short by c between anchors: EA c/L pulls both; cut long pushes."""
    od, wall = 0.2731, 9.27e-3
    ea = 200e9 * pi / 4 * (od**2 - (od - 2 * wall) ** 2)
    want = 0.001 / (5 / ea + 2e-12)
    for key, sign in (("CUTSHORT", 1), ("CUTLONG", -1)):
        results = solved(f"ANCHOR 1\nPIPE 1 2 DX=2\nPIPE 2 3 DX=3 {key}=0.001\nANCHOR 3\n"
                         "CASE A = CS\nCASE B = 2*CS\nCASE C = W\n", LINE)  # fmt: skip
        assert results["A"].supports["1"]["fx"] == pytest.approx(-sign * want, rel=1e-9)
        assert results["B"].supports["1"]["fx"] == pytest.approx(-2 * sign * want, rel=1e-9)
        assert abs(results["C"].supports["1"]["fx"]) < 1e-6 * want


def test_half_the_expansion_cut_short_halves_the_force_of_a_held_pipe():
    growth = 5 * 12e-6 * 100
    results = solved(f"ANCHOR 1\nPIPE 1 2 DX=5 CUTSHORT={growth / 2}\nANCHOR 2\n"
                     "CASE A = T1 + CS\nCASE B = T1\n", LINE)  # fmt: skip
    full = results["B"].supports["1"]["fx"]
    assert results["A"].supports["1"]["fx"] == pytest.approx(full / 2, rel=1e-9)


def test_uniform_load_carries_over_until_it_is_changed():
    results = solved("""ANCHOR 1
UNIFORM Q1 Y=-200 Z=30
PIPE 1 2 DX=2
PIPE 2 3 DX=3
UNIFORM Q1 X=0
UNIFORM Q2 GX=0.5
PIPE 3 4 DX=4
CASE A = Q1
CASE B = Q2
CASE C = W
""", LINE)  # fmt: skip
    force = results["A"].supports["1"]
    assert [force[c] for c in ("fx", "fy", "fz")] == pytest.approx([0, 1000, -150], abs=1e-8)
    weight = results["C"].supports["1"]["fy"] * 4 / 9
    assert results["B"].supports["1"]["fx"] == pytest.approx(-0.5 * weight, rel=1e-12)


ROUND_TRIP = """
TITLE    All components
UNITS    mm kN bar C
MATERIAL A E=203GPa ALPHA=11.7e-6 DENSITY=7850
SECTION  S10 NPS=10 SCH=40 FLUID=850
SECTION  S6 NPS=6 SCH=40 FLUID=850
SECTION  S10
OPERATE  T1=170 P1=12
ANCHOR   10
PIPE     10 20 DX=3000 CUTSHORT=4
UNIFORM  Q1 Y=-0.5
UNIFORM  Q2 GX=0.2 GZ=0.1
FLANGE   20 30 DX=100 WEIGHT=0.4
VALVE    30 40 DX=450 WEIGHT=2.1
FLANGE   40 50 DX=100 WEIGHT=0.4
UNIFORM  Q2 X=0
REDUCER  50 60 DX=178 TO=S6 FLAT=DOWN
PIPE     60 70 DX=1000 CUTLONG=2.5
REDUCER  70 75 DZ=178 TO=S10
JOINT    75 80 DZ=300 AXIAL=180N/mm LATERAL=95N/mm AREA=62000 WEIGHT=0.9 SECTION=S6
JOINT    80 90 AXIS=(0,0,1) AXIAL=1 LATERAL=2 BENDING=3 TORSION=4
PIPE     90 95 DZ=1000
ANCHOR   95
CASE A = W + P1 + T1 + CS + Q1 + Q2
"""


def test_components_go_round_deck_and_model():
    model = read_text(ROUND_TRIP)
    assert read_text(model.deck()) == model
    assert [pipe.card for pipe in model.pipes].count("REDUCER") == 2


def test_report_echoes_components():
    model = read_text(ROUND_TRIP)
    text = text_report(trunnion.solve(model), model).decode()
    for head in ("REDUCERS", "EXPANSION JOINTS", "COLD SPRING", "UNIFORM LOADS", "RIGID BODIES"):
        assert head in text


def test_python_words_make_the_same_components():
    model = trunnion.Model()
    model.material("A", E=203e9)
    model.section("S6", OD=0.1683, WALL=0.00711)
    model.section("S10", OD=0.2731, WALL=0.00927)
    model.uniform("Q1", Y=-500)
    model.reducer(1, 2, DX=0.2, TO="S6", FLAT="DOWN")
    model.valve(2, 3, DX=0.4, WEIGHT=900)
    model.flange(3, 4, DX=0.1, WEIGHT=90)
    model.joint(4, 5, DX=0.3, AXIAL=1e5, LATERAL=1e5)
    assert read_text(model.deck()) == model
    assert [p.card for p in model.pipes] == ["REDUCER", "VALVE", "FLANGE", "JOINT"]


# --- offsets

BRANCH = """ANCHOR 1
PIPE 1 2 DX=2
PIPE 2 3 DX=2
ANCHOR 3
{branch}FORCE 5 F1 FX=4000 FY=-3000 FZ=5000
CASE A = F1 + W
CASE B = T1
"""


def test_offset_is_a_weightless_rigid_arm_from_node_to_pipe():
    """The same branch through a spring of 1e12 in all directions to a node of its own."""
    off = "PIPE 2 5 DY=3 OFFSET1=(0,0.13655,0)\n"
    arm = ("NODE 1 X=0\nNODE 4 X=2 Y=0.13655\nSPRING 2 4 KX=1e12 KY=1e12 KZ=1e12 KRX=1e12 "
           "KRY=1e12 KRZ=1e12\nPIPE 4 5 DY=2.86345\n")  # fmt: skip
    a, b = (solved(BRANCH.format(branch=branch), LINE) for branch in (off, arm))
    for name in "AB":
        assert moved(a, "5", name) == pytest.approx(moved(b, "5", name), rel=1e-9, abs=1e-15)
        for node in "13":
            for key in ("fx", "fy", "fz", "mx", "my", "mz"):
                want = b[name].supports[node][key]
                assert a[name].supports[node][key] == pytest.approx(want, rel=1e-9, abs=1e-6)


def test_offset_shortens_the_cantilever_and_carries_its_moment():
    """Anchor, arm of 0.5 m, cantilever of 2.5 m: sag P L3/3EI, moment at the anchor P 3 m."""
    results = solved("ANCHOR 1\nPIPE 1 2 DX=3 OFFSET1=(0.5,0,0)\nFORCE 2 F1 FY=-1000\nCASE A = F1\n"
                     "CASE B = W\n", "DEFAULT SHEAR=OFF\n" + PIPES.partition("\n")[2])  # fmt: skip
    od, bore = 0.1683, 0.1683 - 2 * 7.11e-3
    ei = 200e9 * pi / 64 * (od**4 - bore**4)
    arm = 1000 / 1e12 + 1000 * 2.75 / 1e12 * 2.75  # it yields, and turns, at its middle
    assert moved(results, "2")[1] == pytest.approx(-1000 * 2.5**3 / (3 * ei) - arm, rel=1e-10)
    assert results["A"].supports["1"]["mz"] == pytest.approx(3000.0, rel=1e-12)
    whole = solved("ANCHOR 1\nPIPE 1 2 DX=2.5\nCASE B = W\n", PIPES)
    weight = whole["B"].supports["1"]["fy"]
    assert results["B"].supports["1"]["fy"] == pytest.approx(weight, rel=1e-12)


def test_offsets_go_round_and_are_echoed():
    model = read_text("UNITS mm N bar C\n" + "MATERIAL A E=200GPa\nSECTION S OD=273.1 WALL=9.27\n"
                      "ANCHOR 1\nPIPE 1 2 DX=3000 OFFSET1=(0,136.55,0) OFFSET2=(5,0,-2.5)\n"
                      "CASE SUS = W\n")  # fmt: skip
    assert model.pipes[0].offsets == ((0.0, 0.13655, 0.0), (0.005, 0.0, -0.0025))
    assert read_text(model.deck()) == model
    assert "OFFSETS" in text_report(trunnion.solve(model), model).decode()
