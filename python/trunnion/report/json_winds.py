"""The JSON's wind sets: every factor, and pressure and load on each element."""

import numpy as np

from trunnion.arrays import System
from trunnion.loads.wind import WindLoad, wind_loads
from trunnion.model import Model
from trunnion.report.encode import dump, lines, listing, numbers, records, rows, words
from trunnion.results.tables import element_ids


def wind_entries(model: Model, system: System) -> str:
    """Write every wind set by its name."""
    ids = words(element_ids(system.parts))
    return lines({name: _wind(found, ids) for name, found in wind_loads(model, system).items()})


def _wind(found: WindLoad, ids: list[str]) -> str:
    wind, at = found.wind, np.flatnonzero(found.width > 0.0)
    asce7 = {
        "speed": wind.speed,
        "exposure": wind.exposure,
        "kzt": wind.kzt,
        "kd": wind.kd,
        "gust": wind.gust,
    }
    elements = {
        "id": [ids[e] for e in at.tolist()],
        "height": rows(found.height[at]),
        "width": numbers(found.width[at]),
        "pressure": numbers(found.pressure[at]),
        "load": rows(found.load[at]),
    }
    return lines(
        {
            "direction": dump(list(wind.direction)),
            "shape": dump(wind.shape),
            "ground": dump(wind.ground),
            "table": dump([list(pair) for pair in wind.table]),
            "asce7": dump(asce7 if wind.speed is not None else None),
            "elements": listing(records(elements)),
        }
    )
