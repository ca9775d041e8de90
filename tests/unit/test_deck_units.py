"""Units of cards and suffixes: exact where they can be, pint's elsewhere, written back exactly."""

import itertools
import random
import subprocess
import sys

import pint
import pytest

from trunnion.deck import units as un
from trunnion.deck.reader import read_text
from trunnion.deck.writer import shortest
from trunnion.model import Units

PINT = pint.UnitRegistry()
SEED = 7


def in_pint(unit):
    """Give a unit as pint spells it."""
    names = {"c": "delta_degC", "degc": "delta_degC", "k": "kelvin", "f": "delta_degF"}
    names |= {"degf": "delta_degF", "deg": "degree", "pa": "Pa", "kpa": "kPa", "mpa": "MPa"}
    names |= {"gpa": "GPa", "n": "N", "kn": "kN", "mn": "MN"}
    return PINT.Quantity(1.0, names.get(unit, unit))


@pytest.mark.parametrize("name", un._ATOMS)
def test_own_units_are_those_of_pint(name):
    unit = un._ATOMS[name]
    theirs = in_pint(name).to_base_units()
    assert unit.num / unit.den == pytest.approx(theirs.magnitude, rel=1e-14)
    dims = dict(theirs.dimensionality)
    names = ("[length]", "[mass]", "[time]", "[temperature]")
    assert unit.exponents == tuple(dims.get(n, 0) for n in names)


@pytest.mark.parametrize(
    ("text", "dimension", "value"),
    [
        ("6000mm", "length", 6.0),
        ("273.1mm", "length", 0.2731),
        ("1in", "length", 0.0254),
        ("10ft", "length", 3.048),
        ("2kN/mm", "stiffness", 2e6),
        ("1lbf/in", "stiffness", 4.4482216152605 / 0.0254),
        ("1psi", "pressure", 4.4482216152605 / 0.0254**2),
        ("3N.m/deg", "rotational stiffness", 3 * 180 / 3.141592653589793),
        ("0.284lb/in3", "density", 0.284 * 0.45359237 / 0.0254**3),
        ("7.85g/cm3", "density", 7850.0),  # by pint
        ("1kip", "force", 4448.2216152605),  # by pint
        ("30ksi", "modulus", 30 * 6894757.293168361),  # by pint
        ("1kip*ft", "moment", 4448.2216152605 * 0.3048),  # by pint
        ("90deg", "angle", 1.5707963267948966),
        ("0.3g", "in g", 0.3),
        ("9.80665m/s2", "in g", 1.0),
        ("32F", "temperature", 0.0),
        ("0K", "temperature", -273.15),
        ("-40degF", "temperature", -40.0),
        ("1e-5/F", "expansion", 1.8e-5),
    ],
)
def test_suffix_gives_the_value_in_si(text, dimension, value):
    from trunnion.deck.values import number

    assert number(text, lambda x: x, dimension) == pytest.approx(value, rel=4e-16)


def test_a_difference_of_temperatures_has_no_offset():
    deck = "UNITS in lbf psi F\nMATERIAL A E=29e6 ALPHA=6.5e-6 TREF=70\nSECTION S NPS=4 SCH=40\n"
    deck += "OPERATE T1=250 TREF=70\nPIPE 10 20 DX=120\nANCHOR 10\nCASE A = T1\n"
    model = read_text(deck)
    pipe, material = model.pipes[0], model.materials["A"]
    rise = pipe.operation.t["1"] - pipe.operation.tref
    assert material.alpha * rise == pytest.approx(6.5e-6 * 180.0, rel=1e-15)
    assert material.table_tref == pipe.operation.tref == pytest.approx(21.1111111111111, rel=1e-14)


def test_every_units_card_writes_any_number_back():
    rng = random.Random(SEED)
    for names in itertools.product(un.LENGTHS, un.FORCES, un.PRESSURES, un.TEMPERATURES):
        units = Units(*names)
        table = un.derived(units)
        scales = un.scales(units)
        for dimension in un.DIMENSIONS:
            values = [rng.uniform(-1, 1) * 10 ** rng.randint(-12, 12) for _ in range(3)]
            for value in (*values, 0.0, 1.0, 0.1, 20.0, 1e12):
                text = shortest(value, dimension, table)
                again = number_of(text, scales[dimension], dimension)
                assert again == value, (names, dimension, value, text)


def number_of(text, scale, dimension):
    from trunnion.deck.values import number

    return number(text, scale, dimension)


def test_a_typed_number_is_written_as_it_was_typed():
    rng = random.Random(SEED)
    for length in un.LENGTHS:
        table, scales = un.derived(Units(length)), un.scales(Units(length))
        for dimension in ("length", "stiffness", "modulus", "density", "temperature"):
            for _ in range(200):
                typed = f"{rng.randint(1, 99999)}e{rng.randint(-6, 6)}"
                value = scales[dimension](float(typed))
                assert float(shortest(value, dimension, table)) == float(typed)


def test_pint_is_imported_for_rare_suffixes_only():
    plain = "MATERIAL A E=203GPa\\nSECTION S OD=10in WALL=9mm\\nOPERATE P1=12bar\\nANCHOR 1 K={}\\n"
    plain += "PIPE 1 2 DX=20ft\\nCASE A = W\\n"
    for stiffness, imported in (("2kN/mm", False), ("2kip/in", True)):
        code = "import sys; from trunnion.deck.reader import read_text; "
        code += f"read_text('{plain.format(stiffness)}'); print('pint' in sys.modules)"
        run = [sys.executable, "-c", code]
        answer = subprocess.run(run, capture_output=True, text=True, check=True)
        assert answer.stdout.strip() == str(imported)


def test_a_plain_deck_imports_nothing_heavy():
    code = "import sys; from trunnion.deck.reader import read_text; "
    code += (
        "read_text('MATERIAL A E=2e11\\nSECTION S OD=0.2 WALL=0.01\\nPIPE 1 2 DX=1\\nCASE A=W');"
    )
    code += "print([m for m in ('pint', 'fluids', 'scipy', 'h5py') if m in sys.modules])"
    answer = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    )
    assert answer.stdout.strip() == "[]"
