"""Input echo of dynamics: spectra, groups of supports, modes asked for, cycles."""

from collections.abc import Iterator
from dataclasses import fields

import numpy as np

from trunnion.model import Cycle, Model, Modes, SpectrumUse
from trunnion.report.columns import plain, section, table, words, wrapped
from trunnion.report.units import ReportUnits


def dynamic_echo(model: Model, units: ReportUnits) -> str:
    """Print spectra, groups and the MODES card."""
    return _spectra(model, units) + _groups(model) + _modes(model)


def _spectra(model: Model, units: ReportUnits) -> str:
    found = list(model.spectra.values())
    if not found:
        return ""
    rows = [(s, f, a) for s in found for f, a in zip(s.frequency, s.acceleration, strict=True)]
    frequency = np.array([f for _, f, _ in rows])
    a = np.array([a for _, _, a in rows])
    laws = ["log-log" if s.log else "linear in " + _abscissa(s.by_period) for s in found]
    law = dict(zip([s.name for s in found], laws, strict=True))
    first = [i == 0 or rows[i - 1][0] is not s for i, (s, _, _) in enumerate(rows)]
    names = [s.name if one else "" for (s, _, _), one in zip(rows, first, strict=True)]
    imperial = units.length.unit in ("in", "ft")
    scale, unit = (1.0 / 0.0254, "[in/s2]") if imperial else (1.0, "[m/s2]")
    columns = [
        words("NAME", names),
        words("BETWEEN POINTS", [law[name] if name else "" for name in names]),
        plain("FREQUENCY", frequency, 5, 14, "[Hz]"),
        plain("PERIOD", 1.0 / frequency, 5, 14, "[s]"),
        plain("ACCELERATION", a / model.settings.g, 5, 14, "[g]"),
        plain("", scale * a, 4, 14, unit),
    ]
    return section("RESPONSE SPECTRA") + table(columns)


def _abscissa(by_period: bool) -> str:
    return "period" if by_period else "frequency"


def _groups(model: Model) -> str:
    if not model.groups:
        return ""
    text = section("GROUPS OF SUPPORTS", "that move together")
    return text + "".join(wrapped(f"{g.name} = {', '.join(g.nodes)}") for g in model.groups)


def _modes(model: Model) -> str:
    if model.modal is None:
        return ""
    return section("MODES") + f"  {modes_text(model.modal)}\n"


def modes_text(modes: Modes) -> str:
    """Say what was asked for, as on the card."""
    words = [str(modes.n)]
    words += [f"FMAX={modes.fmax:g}"] if modes.fmax is not None else []
    words += [f"ABOUT={modes.about}"] if modes.about else []
    words += [f"MASS={modes.mass}", f"MESH={modes.mesh}"]
    words += [f"ROTARY={'ON' if modes.rotary else 'OFF'}"]
    words += [f"FRICTION={modes.friction:g}/m"] if modes.friction else []
    return " ".join(words)


def cycle_text(cycle: Cycle) -> str:
    """Say what is followed, as on the card."""
    start = f" FROM={cycle.start}" if cycle.start else ""
    return f"{', '.join(cycle.cases)} TIMES={cycle.times}{start}"


def spectrum_options(use: SpectrumUse, g: float) -> Iterator[str]:
    """Say how a response spectrum case combines, as on its card; also what holds by default."""
    grouped = any(shock.group for shock in use.shocks)
    for field in fields(use):
        value, name = getattr(use, field.name), field.name.upper()
        if field.name in ("modal", "spatial", "first") or (field.name == "groups" and grouped):
            yield f"{name}={value}"
        elif field.name == "damping" and use.modal in ("CQC", "DSUM"):
            yield f"DAMPING={value:g}"
        elif field.name == "duration" and use.modal == "DSUM":
            yield f"DURATION={value:g}"
        elif field.name == "missing_mass" and value:
            yield "MISSING=ON"
        elif field.name == "zpa" and value is not None:
            yield f"ZPA={value / g:g}"
