"""Modal combination: by hand, and at the limits where the methods must agree."""

import numpy as np
import pytest

from trunnion.solver.combination import (
    METHODS,
    close_groups,
    combine_modes,
    cqc_factors,
    dsum_factors,
)

R = np.array([[3.0, -1.0], [4.0, 2.0], [-12.0, 5.0]])


def test_srss_and_abs_by_hand():
    f = np.array([1.0, 2.0, 3.0])
    assert combine_modes(R, f, "SRSS") == pytest.approx([13.0, np.sqrt(30.0)], rel=1e-15)
    assert combine_modes(R, f, "ABS") == pytest.approx([19.0, 8.0], rel=1e-15)


def test_groups_start_at_their_lowest_mode():
    """9.3 is within 10 % of 9.0 but not of 8.2, where its group starts; 9.0 starts the next."""
    f = np.array([5.0, 7.8, 8.2, 9.0, 9.3, 9.9, 13.0])
    found = [group.tolist() for group in close_groups(f)]
    assert found == [[0], [1, 2], [3, 4, 5], [6]]


def test_modes_ten_percent_apart_are_close():
    assert [len(group) for group in close_groups(np.array([10.0, 11.0, 11.0001]))] == [2, 1]


def test_grouping_by_hand():
    """The first two modes are close: their sizes add, the third is apart."""
    f = np.array([10.0, 10.5, 20.0])
    by_hand = [np.hypot(7.0, 12.0), np.hypot(3.0, 5.0)]
    assert combine_modes(R, f, "GROUP") == pytest.approx(by_hand, rel=1e-15)


def test_cqc_factor_by_hand():
    """Damping 5 %, frequencies 0.9 to 1: 8 b2 (1+r) r^1.5 / ((1-r2)2 + 4 b2 r (1+r)2)."""
    by_hand = 0.02 * 1.9 * 0.9**1.5 / (0.19**2 + 0.01 * 0.9 * 1.9**2)
    factors = cqc_factors(np.array([9.0, 10.0]), 0.05)
    assert factors == pytest.approx(np.array([[1.0, by_hand], [by_hand, 1.0]]), rel=1e-14)


def test_double_sum_factor_by_hand():
    """Equations 6 to 9 of the guide for 5 and 5.5 Hz, damping 2 %, 10 s."""
    low, high = 2.0 * np.pi * 5.0, 2.0 * np.pi * 5.5
    apart = (high - low) * np.sqrt(1.0 - 0.02**2)
    wide = (0.02 + 2.0 / (10.0 * low)) * low + (0.02 + 2.0 / (10.0 * high)) * high
    factors = dsum_factors(np.array([5.0, 5.5]), 0.02, 10.0)
    assert factors[0, 1] == pytest.approx(1.0 / (1.0 + (apart / wide) ** 2), rel=1e-14)
    assert np.diag(factors) == pytest.approx([1.0, 1.0], rel=1e-15)


def test_modes_of_one_frequency():
    """CQC adds them with their signs; GROUP, DSUM and ABS add their sizes."""
    f = np.full(3, 7.0)
    assert combine_modes(R, f, "CQC") == pytest.approx([5.0, 6.0], rel=1e-14)
    for method in ("GROUP", "DSUM"):
        assert combine_modes(R, f, method) == pytest.approx([19.0, 8.0], rel=1e-14)


@pytest.mark.parametrize("method", ["GROUP", "CQC", "DSUM"])
def test_modes_far_apart_give_srss(method):
    """Seven decades apart; the double sum needs a long motion, too."""
    f = np.array([1e-1, 1e2, 1e5])
    found = combine_modes(R, f, method, damping=1e-4, duration=1e9)
    assert found == pytest.approx(combine_modes(R, f, "SRSS"), rel=1e-7)


@pytest.mark.parametrize("method", METHODS)
def test_one_mode_is_its_size(method):
    assert combine_modes(R[2:], np.array([3.0]), method) == pytest.approx([12.0, 5.0], rel=1e-15)


def test_order_of_methods():
    """SRSS <= DSUM, GROUP <= ABS for any modes; CQC <= DSUM's limits do not hold in general."""
    rng = np.random.default_rng(1677)
    r = rng.normal(size=(12, 40))
    f = np.sort(rng.uniform(3.0, 20.0, 12))
    least, most = (combine_modes(r, f, method) for method in ("SRSS", "ABS"))
    for method in ("GROUP", "DSUM"):
        found = combine_modes(r, f, method)
        assert (found >= least * (1.0 - 1e-14)).all()
        assert (found <= most * (1.0 + 1e-14)).all()


def test_unknown_method_is_named():
    with pytest.raises(ValueError, match="NRL is not one of SRSS GROUP CQC ABS DSUM"):
        combine_modes(R, np.array([1.0, 2.0, 3.0]), "NRL")
