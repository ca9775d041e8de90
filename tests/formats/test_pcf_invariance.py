"""What a PCF does not mean changes no load: order, unit of length, place, bearing of a plant."""

import random
import re
from math import cos, radians, sin

import numpy as np
import pytest
from pcf_lines import TABLE, everything

import trunnion
from trunnion.formats import Options, read_any
from trunnion.system.geometry import place

_POINT = re.compile(r"(?m)^    (END-POINT|CENTRE-POINT|BRANCH1-POINT|CO-ORDS) (.*)$")
_HEADS = ("ISOGEN-FILES", "UNITS-", "PIPELINE-REFERENCE")


@pytest.fixture
def loads(tmp_path):
    """Solve the text of a file: loads of both cases by the place of each support [mm]."""
    table = tmp_path / "line.toml"
    table.write_text(TABLE)

    def solve(text):
        path = tmp_path / "line.pcf"
        path.write_text(text)
        options = Options(table=table, anchors=("open-ends",))
        model = read_any(path, options=options).model
        points = place(model, []).points
        found = {}
        for case, result in trunnion.solve(model).cases.items():
            table_ = result.supports
            for label, row in zip(table_.labels, table_.values, strict=True):
                found[case, tuple(round(1e3 * x, 2) + 0.0 for x in points[label])] = row[:6]
        return found

    return solve


def moved(text, change):
    """Change the coordinates of every point."""

    def point(match):
        words = match[2].split()
        xyz = change(*(float(x) for x in words[:3]))
        return "    " + " ".join([match[1], *(f"{x:.9f}" for x in xyz), *words[3:]])

    return _POINT.sub(point, text)


def same(one, other):
    """Compare loads at the same places, relative to the largest."""
    assert one.keys() == other.keys()
    rows, others = (np.array([d[key] for key in one]) for d in (one, other))
    np.testing.assert_allclose(others, rows, rtol=0.0, atol=1e-8 * np.abs(rows).max())


def test_the_order_of_components_and_of_their_points_means_nothing(loads):
    text = everything()
    wanted = loads(text)
    blocks = re.split(r"(?m)^(?=[A-Z<])", text)
    start = [b for b in blocks if b.startswith(_HEADS)]
    end = blocks[next(i for i, b in enumerate(blocks) if b.startswith("MATERIALS")) :]
    body = [b for b in blocks if b and b not in start and b not in end]
    for seed in range(4):
        print("seed", seed)
        rng = random.Random(seed)
        shuffled = []
        for b in body:
            head, *lines = b.splitlines(keepends=True)
            rng.shuffle(lines)
            shuffled.append("".join([head, *lines]))
        rng.shuffle(shuffled)
        same(wanted, loads("".join([*start, *shuffled, *end])))


def test_inches_mean_the_same_as_millimetres(loads):
    text = everything()
    inches = moved(text, lambda *xyz: (x / 25.4 for x in xyz))
    same(loads(text), loads(inches.replace("UNITS-CO-ORDS MM", "UNITS-CO-ORDS INCH")))


def test_a_plant_may_stand_anywhere_and_bear_any_way(loads):
    """Guides by the points of the compass are taken out: they turn by right angles only."""
    text = re.sub(r"SUPPORT\n    CO-ORDS.*\n    SKEY GUID\n.*\n", "", everything())
    assert text.count("GUID") == 0
    c, s = cos(radians(17.0)), sin(radians(17.0))
    shift = (51000.0, -700.0, 33.0)

    def turn(x, y, z):
        return c * x - s * y + shift[0], s * x + c * y + shift[1], z + shift[2]

    found = loads(moved(text, turn))
    back = {}
    for (case, (x, y, z)), (fx, fy, fz, mx, my, mz) in found.items():
        x, y = x - shift[0], y - shift[1]
        at = (round(c * x + s * y, 1) + 0.0, round(c * y - s * x, 1) + 0.0, round(z - shift[2], 1))
        back[case, at] = (
            c * fx + s * fy,
            c * fy - s * fx,
            fz,
            c * mx + s * my,
            c * my - s * mx,
            mz,
        )
    wanted = {
        (case, tuple(round(x, 1) for x in at)): row for (case, at), row in loads(text).items()
    }
    same(wanted, back)
