"""Small-rotation theory has a limit; an answer beyond it says so."""

import pytest

import trunnion


def cantilever(moment: float) -> trunnion.Results:
    m = trunnion.Model("cantilever")
    m.material("S", E=200e9, NU=0.3)
    m.section("P", OD=0.1, WALL=0.01)
    m.anchor("10")
    m.pipe("10", "20", DX=10.0)
    m.force("20", "F1", MZ=moment)
    m.case("PUSH", "F1")
    return trunnion.solve(m)


@pytest.mark.parametrize(("moment", "beyond"), [(5e2, False), (2e5, True)])
def test_turns_beyond_small_rotations_are_named(moment, beyond):
    push = cantilever(moment)["PUSH"]
    assert push.converged
    turn = float(push.state.u[1, 5])
    assert (turn > 0.1) is beyond
    named = [w for w in push.warnings if "small rotations" in w]
    assert len(named) == beyond
    if beyond:
        assert named[0].startswith(f"node 20 turns by {turn:.3g} rad")
