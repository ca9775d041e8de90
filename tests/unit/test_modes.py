"""Natural modes against closed forms; EI, m and so on come from the arrays, not from a print."""

from dataclasses import replace

import numpy as np
import pytest

import trunnion
from trunnion.arrays import no_contacts
from trunnion.deck.reader import read_text
from trunnion.errors import ModelError
from trunnion.loads.masses import model_masses
from trunnion.model import Modes
from trunnion.solver import eigen, modes, pencil
from trunnion.solver.ledger import Ledger
from trunnion.solver.locked import chosen, frozen_system, no_sliders
from trunnion.solver.mesh import refine_system, whole_mesh
from trunnion.solver.modal import modes_of, with_friction
from trunnion.solver.modes import natural_modes
from trunnion.solver.structure import Structure
from trunnion.system import build_system

HEAD = """\
UNITS m N Pa C
DEFAULT SHEAR={shear} G=10
MATERIAL S E=200GPa NU=0.3 DENSITY=7800
SECTION P OD=0.08 WALL=0.008
"""
PI = np.pi


def deck(body: str, shear: str = "OFF"):
    model = read_text(HEAD.format(shear=shear) + body + "CASE SUS = W\n", "modes.inp")
    system = build_system(model)
    return system, model_masses(model, system)


def cantilever(n: int, length: float = 5.0) -> str:
    pipes = "".join(f"PIPE {i} {i + 1} DX={length / n!r}\n" for i in range(n))
    return "ANCHOR 0\n" + pipes


def pinned(n: int, length: float = 5.0) -> str:
    pipes = "".join(f"PIPE {i} {i + 1} DX={length / n!r}\n" for i in range(n))
    return f"SUPPORT 0 X Y Z RX\nSUPPORT {n} Y Z\n" + pipes


def matrices(system, masses, ledger=None, *, lumped=True, rotary=True):
    structure = Structure(system, ledger or Ledger(), whole=True)
    return pencil.Pencil(structure, masses, lumped=lumped, rotary=rotary)


def solved(system, masses, n, fmax=None, **how):
    ledger = Ledger()
    found = natural_modes(matrices(system, masses, ledger, **how), n, fmax=fmax)
    assert found.residual.max(initial=0.0) < 1e-9
    assert found.proven
    return found, ledger


def bending(system, masses) -> float:
    """Square root of EI / m."""
    return float(np.sqrt(system.rigidity[0, 2] / masses.line[0]))


@pytest.mark.parametrize(("lumped", "rate"), [(False, 4.0), (True, 2.0)])
def test_frequencies_converge_at_the_rate_of_the_mass_matrix(lumped, rate):
    # Strang and Fix (1973), section 6.3: h^4 with consistent cubics; second bending mode.  (With
    # both ends held lumps converge as fast: the trapezium rule is exact for sines.)
    # The anchor turns a little: what the meshes converge to is 1e-7 below the closed form.
    system, masses = deck(cantilever(80))
    limit = solved(system, masses, 4, lumped=False, rotary=False)[0].frequency[2]
    exact = 4.694091132974175**2 / (2.0 * PI * 25.0) * bending(system, masses)
    assert limit == pytest.approx(exact, rel=3e-7)
    error = []
    for n in (5, 10, 20):
        found, _ = solved(*deck(cantilever(n)), 4, lumped=lumped, rotary=False)
        error.append(abs(found.frequency[2] / limit - 1.0))
    slopes = np.log2(np.array(error[:-1]) / error[1:])
    assert slopes == pytest.approx(rate, abs=0.1)


def test_rotary_inertia_and_shear_of_a_pinned_beam():
    # Timoshenko (1921): a quadratic in w2 for each sine
    for shear in ("OFF", "ON"):
        system, masses = deck(pinned(40), shear)
        found, _ = solved(system, masses, 9, lumped=False, rotary=True)
        ei, gas = system.rigidity[0, 2:]
        m, j = masses.line[0], masses.inertia[0, 1]
        for i in (1, 2, 3):
            k = i * PI / 5.0
            c = 1.0 / gas if shear == "ON" else 0.0
            roots = np.roots([j * m * c, -(m + j * k**2 + ei * m * c * k**2), ei * k**4])
            exact = np.sqrt(roots.real.min()) / (2.0 * PI)
            assert np.isclose(found.frequency, exact, rtol=3e-5).sum() == 2


def test_torsion_and_push_of_a_cantilever():
    system, masses = deck(cantilever(60))
    found, _ = solved(system, masses, 14, lumped=False, rotary=False)
    ea, gj = system.rigidity[0, :2]
    for stiffness, inertia in ((ea, masses.line[0]), (gj, masses.inertia[0, 0])):
        exact = np.sqrt(stiffness / inertia) / 20.0
        assert np.isclose(found.frequency, exact, rtol=1e-4).sum() == 1


def test_mass_on_a_weightless_cantilever():
    system, masses = deck(cantilever(1) + "MASS 1 M=100\n")
    masses = replace(masses, line=0.0 * masses.line, inertia=0.0 * masses.inertia)
    found, _ = solved(system, masses, 3)
    ei, ea = system.rigidity[0, 2], system.rigidity[0, 0]
    tip = 125.0 / (3.0 * ei) + 1e-12 + 25e-12  # the anchor gives way and turns
    assert 2.0 * PI * found.frequency[:2] == pytest.approx((100.0 * tip) ** -0.5, rel=1e-12)
    push = 5.0 / ea + 1e-12
    assert 2.0 * PI * found.frequency[2] == pytest.approx((100.0 * push) ** -0.5, rel=1e-12)
    assert found.effective_mass.sum(axis=0) == pytest.approx(100.0, rel=1e-9)


@pytest.mark.parametrize("lumped", [False, True])
def test_rigid_modes_of_a_free_pipe(lumped):
    system, masses = deck(pinned(12))
    free = replace(system, contacts=no_contacts())
    found, _ = solved(free, masses, 9, lumped=lumped)
    assert found.rigid == 6
    assert (found.frequency[:6] == 0.0).all()
    assert found.effective_mass[:6].sum(axis=0) == pytest.approx(found.total_mass, rel=1e-9)
    exact = 4.730040744862704**2 / (2.0 * PI * 25.0) * bending(system, masses)
    assert found.frequency[6:8] == pytest.approx(exact, rel=0.03 if lumped else 2e-3)
    assert np.abs(found.effective_mass[6:]).max() < 1e-9 * found.total_mass[0]


def test_a_mass_that_a_spring_holds_one_way_only():
    body = cantilever(1) + "NODE 9 X=0 Y=0 Z=9\nSPRING 1 9 KX=1000\nMASS 9 M=10\n"
    system, masses = deck(body)
    found, _ = solved(system, masses, 3, lumped=True)
    assert found.rigid == 2
    assert (2.0 * PI * found.frequency[2]) ** 2 == pytest.approx(100.0, rel=0.1)


def test_a_pipe_free_to_spin_without_inertia_is_named():
    system, masses = deck(pinned(4))
    c = system.contacts
    loose = replace(system, contacts=chosen(c, np.flatnonzero(~c.rotational)))
    with pytest.raises(ModelError, match=r"node \d moves in RX without stiffness and mass"):
        natural_modes(matrices(loose, masses, rotary=False), 3)


@pytest.mark.parametrize("lumped", [False, True])
def test_all_modes_carry_all_mass(lumped):
    body = "".join(f"PIPE {i} {i + 1} DX=1 DY={0.3 * i}\n" for i in range(5)) + "PIPE 5 6 DZ=2\n"
    system, masses = deck("SPRING 0 KX=1e5 KY=1e5 KZ=1e5 KRX=1e5 KRY=1e5 KRZ=1e5\n" + body)
    every = matrices(system, masses, lumped=lumped).rank
    found, _ = solved(system, masses, every, lumped=lumped)
    total = float(masses.line @ system.length)
    assert found.total_mass == pytest.approx(total, rel=1e-12)
    assert found.effective_mass.sum(axis=0) == pytest.approx(total, rel=1e-9)


def arc(straights: int) -> str:
    """A quarter circle of radius 2 m between two anchors, as a bend or as straights."""
    if not straights:
        return "ANCHOR 0\nPIPE 0 1 DX=2\nBEND 1 R=2 K=1\nPIPE 1 2 DY=2\nANCHOR 2\n"
    turn = np.linspace(0.0, PI / 2, straights + 1)
    xy = 2.0 * np.column_stack((np.sin(turn), 1.0 - np.cos(turn)))
    pipes = "".join(
        f"PIPE {i} {i + 1} DX={float(d[0])!r} DY={float(d[1])!r}\n"
        for i, d in enumerate(np.diff(xy, axis=0))
    )
    return f"ANCHOR 0\n{pipes}ANCHOR {straights}\n"


def test_arcs_move_as_many_short_straights():
    system, masses = deck(arc(0), "ON")
    mesh = refine_system(system, masses.line, 8000.0)
    inner = masses.parted(mesh.part_of, len(mesh.system.labels))
    curved, _ = solved(mesh.system, inner, 8, lumped=False)
    error = []
    for n in (20, 40):
        facets, _ = solved(*deck(arc(n), "ON"), 8, lumped=False)
        error.append(np.abs(facets.frequency / curved.frequency - 1.0)[:4])
    assert error[1].max() < 3e-4
    assert error[0] / error[1] == pytest.approx(4.0, rel=0.15)  # facets close in as h^2


def test_few_arcs_are_near():
    system, masses = deck(arc(0), "ON")
    fine = refine_system(system, masses.line, 2000.0)
    good, _ = solved(
        fine.system, masses.parted(fine.part_of, len(fine.system.labels)), 2, lumped=False
    )
    mesh = refine_system(system, masses.line, float(good.frequency[1]))
    few, _ = solved(
        mesh.system, masses.parted(mesh.part_of, len(mesh.system.labels)), 2, lumped=False
    )
    assert mesh.added < fine.added
    assert few.frequency == pytest.approx(good.frequency, rel=1e-3)


def test_extra_nodes_change_no_static_answer():
    body = "ANCHOR 0\nPIPE 0 1 DX=5\nBEND 1 R=1\nPIPE 1 2 DY=3\nPIPE 2 3 DZ=0.1\n"
    system, masses = deck(body, "ON")
    mesh = refine_system(system, masses.line, 60.0)
    n = len(system.labels)
    assert mesh.added == len(mesh.system.labels) - n > 0
    assert mesh.system.labels[:n] == system.labels
    assert (mesh.system.length[mesh.part_of == 3] == system.length[3]).all()  # short: not cut
    answers = []
    for s in (system, mesh.system):
        structure = Structure(s, Ledger(), whole=True)
        assert structure.factorise(structure.closed_tangent, structure.stuck_tangent)
        r = np.zeros((structure.n_node, 6))
        r[system.labels.index("3")] = [1.0, 2.0, -3.0, 0.5, -0.3, 0.7]
        answers.append(structure.solve(r)[:n])
    np.testing.assert_allclose(answers[1], answers[0], rtol=1e-8, atol=1e-12)
    for e, part in enumerate(mesh.last):
        assert mesh.system.ends[part, 1] == system.ends[e, 1]
        assert mesh.part_of[part] == e
        assert mesh.system.ends[e, 0] == system.ends[e, 0]


def lines(n: int, more: float) -> str:
    """Equal cantilevers side by side, or each a little longer than the one before."""
    return "".join(
        f"NODE A{i} X=0 Y=0 Z={i}\nANCHOR A{i}\nPIPE A{i} B{i} DX={5.0 + more * i!r}\n"
        for i in range(n)
    )


def test_close_frequencies_are_all_found():
    system, masses = deck(lines(12, 1e-5))
    mesh = refine_system(system, masses.line, 60.0)
    inner = masses.parted(mesh.part_of, len(mesh.system.labels))
    found, ledger = solved(mesh.system, inner, 16, lumped=False)
    per_line = [
        solved(mesh.system, inner, 1, lumped=False)[0].frequency[0]
        * (5.0 / (5.0 + 1e-5 * i)) ** 2
        * ((5.0 + 1e-5 * 11) / 5.0) ** 2
        for i in range(12)
    ]
    expected = np.sort(np.repeat(per_line, 2))[:16]
    assert found.frequency == pytest.approx(expected, rel=1e-8)
    assert ledger.count["inertia"] >= 1


def test_a_missed_mode_is_noticed_and_found(monkeypatch):
    system, masses = deck(lines(12, 1e-3))
    mesh = refine_system(system, masses.line, 60.0)
    inner = masses.parted(mesh.part_of, len(mesh.system.labels))
    whole, before = solved(mesh.system, inner, 10, lumped=False)
    many, calls = eigen.many, []

    def forgetful(p, k, known):
        calls.append(len(known))
        w2, x = many(p, k, known)
        if len(calls) == 1:  # the third is lost
            keep = [i for i in range(len(w2)) if i != 2]
            return w2[keep], x[keep]
        return w2, x

    monkeypatch.setattr(modes, "many", forgetful)
    found, after = solved(mesh.system, inner, 10, lumped=False)
    assert calls[0] == 0 < calls[1]
    np.testing.assert_allclose(found.frequency, whole.frequency, rtol=1e-10)
    assert after.count["inertia"] > before.count["inertia"]


def test_lanczos_and_dense_algebra_agree(monkeypatch):
    system, masses = deck(cantilever(12))
    dense, _ = solved(system, masses, 10, lumped=True)
    monkeypatch.setattr(modes, "DENSE", 0)
    lanczos, _ = solved(system, masses, 10, lumped=True)
    np.testing.assert_allclose(lanczos.frequency, dense.frequency, rtol=1e-11)
    scale = np.abs(dense.shape).max()
    np.testing.assert_allclose(lanczos.shape, dense.shape, atol=1e-7 * scale)


def test_the_same_deck_gives_the_same_bytes():
    system, masses = deck(lines(12, 1e-3))
    mesh = refine_system(system, masses.line, 60.0)
    inner = masses.parted(mesh.part_of, len(mesh.system.labels))
    a, _ = solved(mesh.system, inner, 10)
    b, _ = solved(mesh.system, inner, 10)
    assert a.frequency.tobytes() == b.frequency.tobytes()
    assert a.shape.tobytes() == b.shape.tobytes()


def test_shapes_are_orthonormal_and_their_sign_is_fixed():
    system, masses = deck(cantilever(8))
    p = matrices(system, masses, lumped=False)
    found = natural_modes(p, 8)
    x = found.shape.reshape(8, -1)
    np.testing.assert_allclose(x @ p.mass_product(x).T, np.eye(8), atol=1e-11)
    moved = found.shape[:, :, :3].reshape(8, -1)
    for row in moved[np.abs(moved).max(axis=1) > 1e-6]:
        assert row[np.argmax(np.abs(row))] > 0.0
    assert found.participation[0, 1] == pytest.approx(found.participation[1, 2], rel=1e-9)
    assert abs(found.participation[0, 2]) < 1e-6 * abs(found.participation[1, 2])


def test_more_modes_than_the_mass_matrix_has_rank():
    system, masses = deck(cantilever(1) + "MASS 1 M=100\n")
    with pytest.raises(ModelError, match="MODES 4: the mass matrix has rank 3 "):
        natural_modes(matrices(system, masses, rotary=False), 4)
    card = Modes(n=40, mass="LUMPED", mesh="NONE", rotary=False)
    with pytest.raises(ModelError, match="MODES 40: the mass matrix has rank 3 "):
        modes_of(system, masses, card, Ledger())


def test_modes_above_the_cut_are_left_out():
    system, masses = deck(cantilever(12))
    found, _ = solved(system, masses, 8, lumped=False, fmax=20.0)
    assert len(found.frequency) == 4
    assert found.shape.shape[0] == len(found.residual) == len(found.effective_mass) == 4


def test_the_mesh_follows_the_highest_mode():
    system, masses = deck(cantilever(1))
    found, _ = modes_of(system, masses, Modes(n=8, mass="CONSISTENT", rotary=False), Ledger())
    exact = np.array([1.8751040687, 4.6940911330, 7.8547574382, 10.9955407349])
    exact = exact**2 / (2.0 * PI * 25.0) * bending(system, masses)
    assert found.added > 4
    assert found.frequency == pytest.approx(np.repeat(exact, 2), rel=3e-4)
    lumped, _ = modes_of(system, masses, Modes(n=8, mass="LUMPED", rotary=False), Ledger())
    bends = np.array([f for f in lumped.frequency if f < 110.0])
    assert bends[:6] == pytest.approx(np.repeat(exact, 2)[:6], rel=0.015)  # a free end


def test_statics_build_no_mass_matrix():
    model = read_text(HEAD.format(shear="ON") + cantilever(2) + "CASE SUS = W\n", "modes.inp")
    work = trunnion.solve(model).work
    assert work.get("mass", 0) == work.get("inertia", 0) == 0


def test_a_factor_that_cannot_be_believed_moves_the_shift(monkeypatch):
    system, masses = deck(cantilever(8))
    count_below, asked = pencil.Pencil.count_below, []

    def doubtful(self, w2, x, gap):
        asked.append(w2)
        return None if len(asked) < 3 else count_below(self, w2, x, gap)

    monkeypatch.setattr(pencil.Pencil, "count_below", doubtful)
    solved(system, masses, 6)
    assert len(set(asked)) == 3
    monkeypatch.setattr(pencil.Pencil, "count_below", lambda *_: None)
    found = natural_modes(matrices(system, masses), 6)
    assert not found.proven


def test_friction_holds_sideways_where_supports_press():
    body = (
        "ANCHOR 0\nPIPE 0 1 DX=4\nSUPPORT 1 +Y MU=0.3\nPIPE 1 2 DX=4\nSUPPORT 2 +Y MU=0.3\n"
        "FORCE 2 F1 FY=1e6\n"
    )
    text = HEAD.format(shear="OFF") + body + "CASE SUS = W\nCASE UP = W + F1\n"
    model = read_text(text, "modes.inp")
    results = trunnion.solve(model)
    for name, pressing in (("SUS", 2), ("UP", 0)):
        case = results[name]
        if name == "UP":  # the force lifts the end off
            pressing = int((case.state.normal > 0.0).sum())
            assert pressing < 2
        frozen, keep = frozen_system(case.system, case.state, snubbers=True)
        held, longer = with_friction(case.system, case.state, frozen, keep, 1000.0)
        added = held.contacts.k[len(frozen.contacts.k) :]
        assert len(longer) == len(held.contacts.k)
        expected = [300.0 * x for x in case.state.normal if x > 0.0 for _ in (0, 1)]
        assert added == pytest.approx(expected, rel=1e-12)
        assert len(added) == 2 * pressing
        masses = model_masses(model, case.system)
        card = Modes(n=2, mass="LUMPED", mesh="NONE")
        parent = Structure(case.system, Ledger())
        free = modes_of(frozen, masses, card, Ledger(), parent, keep)[0].frequency[0]
        springs = modes_of(held, masses, card, Ledger(), parent, longer)[0].frequency[0]
        assert springs > free if pressing else springs == free


@pytest.mark.parametrize(("whole", "analyses"), [(True, 1), (False, 2)])
def test_a_frozen_structure_shares_the_analysis_of_the_statics(whole, analyses):
    """Of a structure with all nodes; the chains of statics have none of the inner nodes."""
    system, masses = deck(cantilever(8))
    ledger = Ledger()
    parent = Structure(system, ledger, whole=whole)
    parent.factorise(parent.closed_tangent, parent.stuck_tangent)
    frozen = replace(system, sliders=no_sliders())
    keep = np.arange(len(system.contacts.k), dtype=np.int32)
    card = Modes(n=4, mesh="NONE")
    modes_of(frozen, masses, card, ledger, parent, keep)
    assert ledger.count["analyse"] == analyses
    assert ledger.count["mass"] == 1
    assert whole_mesh(system).added == 0


@pytest.mark.parametrize(("n", "fmax"), [(3, None), (8, 20.0), (8, None)])
def test_all_modes_below_the_counted_frequency_are_listed(n, fmax):
    """Modes found behind the last one asked for, or above FMAX, are not in the list."""
    system, masses = deck(pinned(8))
    found, _ = solved(system, masses, n, fmax=fmax)
    every, _ = solved(system, masses, 20)
    assert (every.frequency < found.counted * (1.0 - 1e-6)).sum() <= len(found.frequency)
    assert found.counted > found.frequency[-1] * (1.0 - 1e-12)
