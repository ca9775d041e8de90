"""The JSON's modes."""

import numpy as np

from trunnion.arrays import ModeSet, System
from trunnion.report.encode import dump, finite, lines, listing, rows
from trunnion.results.tables import mass_percent, period_of


def mode_entries(modes: ModeSet, system: System) -> str:
    """Write frequencies, participation, effective mass, proof, and shapes at the model's nodes."""
    share = mass_percent(modes)
    named = [dict(zip(system.labels, rows(shape), strict=False)) for shape in modes.shape]
    n = len(system.labels)
    exact = {}
    if modes.added:
        exact["shapes_added"] = listing(f"[{','.join(rows(shape[n:]))}]" for shape in modes.shape)
    if modes.shape_low.any():
        exact["shapes_low"] = listing(f"[{','.join(rows(low))}]" for low in modes.shape_low)
    return lines(
        {
            "frequency_hz": dump(modes.frequency.tolist()),
            "period_s": dump([finite(x) for x in period_of(modes).tolist()]),
            "participation": f"[{','.join(rows(modes.participation))}]",
            "effective_mass": f"[{','.join(rows(modes.effective_mass))}]",
            "effective_mass_percent": f"[{','.join(rows(share))}]",
            "effective_mass_sum_percent": dump(np.sum(share, axis=0).tolist()),
            "total_mass": dump(modes.total_mass.tolist()),
            "residual": dump([finite(x) for x in modes.residual.tolist()]),
            "rigid": dump(modes.rigid),
            "added_nodes": dump(modes.added),
            "proven": dump(modes.proven),
            "counted_hz": dump(modes.counted),
            "mesh_hz": dump(modes.cut),
            "shapes": listing(lines(shape) for shape in named),
            **exact,
        }
    )
