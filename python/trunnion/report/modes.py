"""Modes in the text report: frequencies, participation, effective mass, their proof, shapes."""

import numpy as np

from trunnion.arrays import ModeSet, Results, System
from trunnion.report.columns import integers, numbers, plain, section, table, words, wrapped
from trunnion.report.counts import counted
from trunnion.report.units import Quantity, ReportUnits
from trunnion.results.tables import mass_percent, period_of


def mode_report(modes: ModeSet, system: System, units: ReportUnits) -> str:
    """Print the modes; shapes at the nodes of the model's own `system` only."""
    if not len(modes.frequency):
        return "\n  none\n"
    return (
        _table(modes, units) + _mass(modes, units) + _proof(modes) + _shapes(modes, system, units)
    )


def mode_warnings(results: Results) -> list[str]:
    """Say where the list of modes may have a gap, and that parts move freely."""
    modes = results.modes
    lines: list[str] = []
    if modes is None:
        return lines
    if not len(modes.frequency):
        lines.append("MODES: none, the lowest lies above FMAX")
    if not modes.proven:
        lines.append("MODES: it is not proven that no mode is missing")
    if modes.rigid:
        lines.append(f"MODES: {modes.rigid} of 0 Hz: the structure, or a part of it, moves freely")
    return lines


def mode_lines(results: Results) -> list[str]:
    """Say in one line what was found: how many modes, the lowest, the mass in them."""
    modes = results.modes
    if modes is None or not len(modes.frequency):
        return []
    lowest = ", ".join(f"{f:.4g}" for f in modes.frequency[:4])
    more = ", ..." if len(modes.frequency) > 4 else ""
    mass = " ".join(
        f"{c} {x:.1f}" for c, x in zip("XYZ", mass_percent(modes).sum(axis=0), strict=True)
    )
    return [
        f"  {counted(len(modes.frequency), 'mode')}: {lowest}{more} Hz; effective mass {mass} %"
    ]


def _table(modes: ModeSet, units: ReportUnits) -> str:
    part = modes.participation * units.mass.factor**0.5
    share, unit = mass_percent(modes), f"[{units.mass.unit}^0.5]"
    sums = np.cumsum(share, axis=0)
    columns = [
        integers("MODE", [i + 1 for i in range(len(modes.frequency))], 6),
        plain("FREQUENCY", modes.frequency, 5, 13, "[Hz]"),
        plain("PERIOD", period_of(modes), 6, 12, "[s]"),
        *(plain(f"PART. {c}", part[:, i], 3, 11, unit) for i, c in enumerate("XYZ")),
        *(plain(f"MASS {c}", share[:, i], 3, 9, "[%]") for i, c in enumerate("XYZ")),
        *(plain(f"SUM {c}", sums[:, i], 3, 9, "[%]") for i, c in enumerate("XYZ")),
    ]
    residual = [f"{x:.1e}" for x in modes.residual.tolist()]
    columns.append(words("  RESIDUAL", [f"  {x}" for x in residual]))
    note = "participation factors of mass-normalised modes; effective mass of the total"
    return section("NATURAL MODES", note) + table(columns)


def _mass(modes: ModeSet, units: ReportUnits) -> str:
    """Total mass, that of the modes listed, and what they leave out."""
    total, found = modes.total_mass, modes.effective_mass.sum(axis=0)
    rows = np.stack([total, found, total - found])
    columns = [words("", ["total mass", "in the modes above", "not in them"], most=24)]
    mass: Quantity = units.mass.showing(float(total.max(initial=0.0)))
    columns += [numbers(c, rows[:, i], mass, 14) for i, c in enumerate("XYZ")]
    return section("EFFECTIVE MASS") + table(columns)


def _proof(modes: ModeSet) -> str:
    """Say what was counted, what moves freely and which nodes were added."""
    text = section("PROOF OF THE MODES")
    if modes.proven:
        text += wrapped(
            f"a Sturm count (negative pivots of K - w2 M) shows that no mode below "
            f"{modes.counted:.6g} Hz is missing"
        )
    else:
        text += wrapped("NOT PROVEN that no mode is missing: no factor could be trusted")
    text += wrapped(f"largest residual |K x - w2 M x| / |w2 M x| {modes.residual.max():.1e}")
    text += wrapped(f"modes without stiffness (rigid bodies): {modes.rigid}")
    return text + wrapped(f"nodes added where spans are long for the cut-off: {modes.added}")


def _shapes(modes: ModeSet, system: System, units: ReportUnits) -> str:
    """Print each shape at the model's nodes, its largest translation 1."""
    text, n = "", len(system.labels)
    per = f"[rad/{units.length.unit}]"
    for i, shape in enumerate(modes.shape):
        size = float(np.linalg.norm(shape[:, :3], axis=1).max(initial=0.0))
        own = shape[:n] / (size or 1.0)
        columns = [words("NODE", system.labels)]
        columns += [plain(f"D{c}", own[:, k], 5, 12) for k, c in enumerate("XYZ")]
        turned = own[:, 3:] / units.length.factor
        columns += [plain(f"R{c}", turned[:, k], 6, 13, per) for k, c in enumerate("XYZ")]
        title = f"MODE {i + 1}: SHAPE"
        text += section(title, f"{modes.frequency[i]:.5f} Hz; largest translation 1")
        text += table(columns)
    return text
