"""Standard pipe sizes."""

import pytest

from trunnion.library.names import UnknownName
from trunnion.library.sections import SCHEDULES, nominal_inches, pipe_size


@pytest.mark.parametrize(
    ("nps", "schedule", "od", "wall"),
    [
        ("10", "40", 0.273, 0.00927),  # ASME B36.10M table 1
        ("16", "STD", 0.4064, 0.00953),
        ("3/4", "80", 0.0267, 0.00391),
        ("1-1/2", "40", 0.0483, 0.00368),
        (8, "10S", 0.2191, 0.00376),  # ASME B36.19M
        (24.0, "XS", 0.610, 0.0127),
    ],
)
def test_standard_sizes_are_nominal(nps, schedule, od, wall):
    assert pipe_size(nps=nps, schedule=schedule) == (od, wall)


def test_dn_names_the_same_pipe_as_nps():
    assert pipe_size(dn="250", schedule="40") == pipe_size(nps="10", schedule="40")
    assert pipe_size(dn=15, schedule="80") == pipe_size(nps="1/2", schedule="80")


def test_every_size_of_the_package_has_a_dn():
    from fluids.piping import schedule_lookup

    from trunnion.library.sections import _INCHES

    for schedule in SCHEDULES:
        assert set(schedule_lookup[schedule][0]) <= set(_INCHES.values())


@pytest.mark.parametrize("size", [{"nps": "11"}, {"nps": "ten"}, {"nps": "1/0"}, {"dn": "260"}, {}])
def test_unknown_size_is_named(size):
    with pytest.raises(UnknownName, match="size"):
        pipe_size(**size)


def test_unknown_schedule_names_the_nearest():
    with pytest.raises(UnknownName) as error:
        pipe_size(nps="10", schedule="10T")
    assert "10" in error.value.nearest


def test_nominal_inches_of_both_systems():
    assert nominal_inches(dn=250) == nominal_inches(nps="10") == 10.0
    assert nominal_inches(nps="1-1/2") == nominal_inches(dn="40") == 1.5
