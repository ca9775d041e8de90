"""Frozen records behave as frozen dataclasses do."""

import copy
import dataclasses
import pickle

import pytest

from trunnion.frozen import frozen


@frozen
class Point:
    """Fields with and without defaults, with a factory, and one left out of ==."""

    x: float
    tags: dict[str, int] = dataclasses.field(default_factory=dict)
    y: float = 0.0
    place: str = dataclasses.field(default="", compare=False)


@dataclasses.dataclass(frozen=True, slots=True)
class Standard:
    """The same by the standard library."""

    x: float
    tags: dict[str, int] = dataclasses.field(default_factory=dict)
    y: float = 0.0
    place: str = dataclasses.field(default="", compare=False)


@frozen(eq=False)
class Array:
    """A record without a truth value."""

    values: list[float]


def test_fields_and_defaults_are_those_of_a_dataclass():
    for make in (lambda c: c(1.0), lambda c: c(1.0, {"a": 1}, place="z"), lambda c: c(x=2, y=3)):
        assert dataclasses.asdict(make(Point)) == dataclasses.asdict(make(Standard))
        assert repr(make(Point)) == repr(make(Standard)).replace("Standard", "Point")
    assert [f.name for f in dataclasses.fields(Point)] == ["x", "tags", "y", "place"]
    assert Point.__match_args__ == ("x", "tags", "y", "place")
    with pytest.raises(TypeError, match="missing 1 required positional argument: 'x'"):
        Point()


def test_a_factory_makes_a_new_value_each_time():
    assert Point(1.0).tags is not Point(1.0).tags


def test_equality_and_hash_leave_out_what_is_not_compared():
    assert Point(1.0, {}, 2.0, "here") == Point(1.0, {}, 2.0, "there")
    assert Point(1.0, {}, 2.0) != Point(1.0, {}, 3.0)
    assert Point(1.0) != Standard(1.0)
    assert hash(Point(1.0, (), 2.0, "here")) == hash(Point(1.0, (), 2.0, "there"))


def test_nothing_of_a_record_can_be_changed():
    point = Point(1.0)
    with pytest.raises(dataclasses.FrozenInstanceError, match=r"Point\.x cannot be changed"):
        point.x = 2.0
    with pytest.raises(dataclasses.FrozenInstanceError):
        del point.x
    with pytest.raises(dataclasses.FrozenInstanceError):
        point.other = 2.0
    assert not hasattr(point, "__dict__")


def test_records_are_replaced_copied_and_pickled():
    point = Point(1.0, {"a": 1}, 2.0, "here")
    assert dataclasses.replace(point, y=5.0) == Point(1.0, {"a": 1}, 5.0)
    assert dataclasses.replace(point, y=5.0).place == "here"
    for other in (copy.copy(point), copy.deepcopy(point), pickle.loads(pickle.dumps(Array([1.0])))):
        assert other is not point
    assert copy.deepcopy(point) == point
    assert copy.deepcopy(point).tags is not point.tags


def test_records_of_arrays_are_equal_to_themselves_only():
    one = Array([1.0])
    assert one == one
    assert one != Array([1.0])
    assert len({one, Array([1.0])}) == 2
