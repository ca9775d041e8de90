"""Properties of the algebra of results, on random numbers and random expressions."""

import random

import numpy as np
import pytest

from trunnion.deck.expressions import format_expression, parse
from trunnion.results.combine import Numbers, evaluate, is_linear, parents

SEED = 31
NAMES = ("A", "B", "C")
ROUND = 4e-16  # of the largest number that an expression of a dozen terms meets


@pytest.fixture
def rng():
    return random.Random(SEED)


def rows(seed, low=True):
    made = np.random.default_rng(seed)
    found = {}
    for name in NAMES:
        high = made.normal(size=40) * 10.0 ** made.integers(-8, 9, size=40)
        high[made.random(40) < 0.2] = 0.0
        found[name] = Numbers(high, low * 1e-17 * high * made.normal(size=40))
    return found


def value(text, numbers):
    found = evaluate(parse(text), numbers)
    return found.high + found.low


def expression(rng, depth, functions=("ABS", "SRSS", "MAX", "MIN", "SIGNMAX", "SCALAR")):
    """A random expression as text."""
    if depth == 0:
        return rng.choice(NAMES)

    def inner():
        return expression(rng, depth - rng.randint(1, depth), functions)

    kind = rng.choice(("+", "-", "*", "neg", "function"))
    if kind == "function" and functions:
        name = rng.choice(functions)
        count = 1 if name == "ABS" else rng.randint(1, 4)
        return f"{name}({','.join(inner() for _ in range(count))})"
    if kind == "*":
        return f"{rng.uniform(0.1, 3):.3g}*({inner()})"
    if kind == "neg":
        return f"(-{inner()})"
    return f"({inner()} {rng.choice('+-')} {inner()})"


def reference(text, numbers):
    """Evaluate by Python itself on plain numbers."""
    words = {
        "ABS": abs,
        "SRSS": lambda *a: sum(x * x for x in a) ** 0.5,
        "MAX": lambda *a: np.abs(a).max(axis=0),
        "MIN": lambda *a: np.abs(a).min(axis=0),
        "SIGNMAX": lambda *a: np.where(np.max(a, 0) >= -np.min(a, 0), np.max(a, 0), np.min(a, 0)),
        "SCALAR": lambda *a: sum(a),
    }
    return eval(text, {**words, **{name: n.high for name, n in numbers.items()}})


def test_random_expressions_are_what_python_makes_of_them(rng):
    for i in range(300):
        text, numbers = expression(rng, rng.randint(1, 5)), rows(i, low=False)
        want = reference(text, numbers)
        scale = sum(abs(n.high) for n in numbers.values()) * 3.0**5
        error = np.abs(value(text, numbers) - want)
        assert (error <= 1e-13 * scale).all(), f"seed {SEED}, {i}: {text}"


def test_random_expressions_read_back(rng):
    for i in range(300):
        text = expression(rng, rng.randint(1, 6))
        parsed = parse(text)
        assert parse(format_expression(parsed)) == parsed, f"seed {SEED}, {i}: {text}"


def test_difference_of_a_result_with_itself_is_zero(rng):
    for i in range(50):
        text = expression(rng, rng.randint(0, 4))
        assert not value(f"({text}) - ({text})", rows(i)).any(), f"seed {SEED}, {i}: {text}"


def test_one_operand_of_a_size_is_its_abs(rng):
    for i in range(50):
        text, numbers = expression(rng, rng.randint(0, 4)), rows(i)
        want = value(f"ABS({text})", numbers)
        for name in ("SRSS", "MAX", "MIN"):
            found = value(f"{name}({text})", numbers)
            assert np.array_equal(found, want), f"seed {SEED}, {i}: {name}({text})"


@pytest.mark.parametrize("name", ["MAX", "MIN", "SIGNMAX", "SRSS", "SCALAR"])
def test_order_of_operands_does_not_matter(name, rng):
    for i in range(50):
        parts, numbers = [expression(rng, rng.randint(0, 3)) for _ in range(4)], rows(i)
        parts.append(f"-{parts[0]}")  # equal size, other sign
        want = value(f"{name}({','.join(parts)})", numbers)
        rng.shuffle(parts)
        found = value(f"{name}({','.join(parts)})", numbers)
        if name in ("SRSS", "SCALAR"):
            size = value(f"SRSS({','.join(parts)})", numbers)
            assert np.allclose(found, want, rtol=0, atol=4e-15 * size.max()), f"seed {SEED}, {i}"
        else:
            assert np.array_equal(found, want), f"seed {SEED}, {i}: {parts}"


def test_factors_are_linear_in_algebraic_sums(rng):
    for i in range(100):
        text, numbers = expression(rng, rng.randint(1, 4), functions=("SCALAR",)), rows(i)
        assert is_linear(parse(text))
        n = rng.uniform(-5, 5)
        scaled = {k: Numbers(n * v.high, n * v.low) for k, v in numbers.items()}
        want = value(text, scaled)
        sign = "-" if n < 0 else ""
        found = value(f"{sign}{abs(n)!r}*({text})", numbers)
        size = max(np.abs(v.high).max() for v in scaled.values()) * 3.0**4
        assert np.allclose(found, want, rtol=0, atol=ROUND * size), f"seed {SEED}, {i}: {text}"


def test_sizes_scale_with_the_size_of_a_factor():
    numbers = rows(1)
    for name in ("ABS({})", "SRSS({},B)", "MAX({},B)", "MIN({},B)"):
        text = name.format("A")
        found = value(f"2*{text}", numbers)
        doubled = {k: Numbers(-2 * v.high, -2 * v.low) for k, v in numbers.items()}
        assert np.allclose(found, value(text, doubled), rtol=1e-15)


def test_signmax_keeps_the_sign_of_the_largest():
    numbers = {"A": Numbers(np.array([3.0, -5, 2]), np.zeros(3))}
    numbers["B"] = Numbers(np.array([-4.0, 1, -2]), np.zeros(3))
    assert value("SIGNMAX(A,B)", numbers).tolist() == [-4, -5, 2]
    assert value("MAX(A,B)", numbers).tolist() == [4, 5, 2]
    assert value("MIN(A,B)", numbers).tolist() == [3, 1, 2]
    assert value("SCALAR(A,B)", numbers).tolist() == [-1, -4, 0]
    assert value("SRSS(A,B)", numbers)[0] == 5


def test_parents_are_found_in_functions():
    assert parents(parse("SRSS(B, A) + MAX(A, 2*C)")) == ["B", "A", "C"]
    assert not is_linear(parse("A + SRSS(B)"))
