"""Input echo of modes, spectra, groups of supports and cycles."""

from trunnion.model import Model, Modes, Spectrum
from trunnion.report.columns import plain, section, table, words, wrapped


def dynamics_echo(model: Model) -> str:
    """Print what modes and spectra were asked for."""
    text = "" if model.modal is None else section("MODES") + _modes(model.modal)
    if model.spectra:
        text += section("SPECTRA") + _spectra(list(model.spectra.values()))
    if model.groups:
        text += section("GROUPS OF SUPPORTS", "that move together")
        text += "".join(wrapped(f"{g.name}: {', '.join(g.nodes)}") for g in model.groups)
    return text


def _modes(modes: Modes) -> str:
    about = modes.about or "none: supports without gap are closed"
    friction = f"{modes.friction:g} mu N per m" if modes.friction else "left out"
    rows = (
        ("modes", f"{modes.n}" + (f", up to {modes.fmax:g} Hz" if modes.fmax else "")),
        ("contact state of", about),
        ("snubbers", "locked"),
        ("mass", f"{modes.mass}, rotary inertia {'on' if modes.rotary else 'off'}"),
        ("nodes between", "where spans are too long" if modes.mesh == "AUTO" else "none"),
        ("lateral friction", friction),
    )
    return "".join(f"  {name:<22}{value}\n" for name, value in rows)


def _spectra(spectra: list[Spectrum]) -> str:
    """One row a point; how the spectrum runs between stands on its first."""
    points = [(s, i) for s in spectra for i in range(len(s.frequency))]
    between = [_between(s) if i == 0 else "" for s, i in points]
    columns = [
        words("NAME", [s.name if i == 0 else "" for s, i in points]),
        plain("FREQUENCY", [s.frequency[i] for s, i in points], 4, 12, "[Hz]"),
        plain("ACCELERATION", [s.acceleration[i] for s, i in points], 4, 14, "[m/s2]"),
        words("  BETWEEN", [f"  {text}" for text in between]),
    ]
    return table(columns)


def _between(spectrum: Spectrum) -> str:
    if spectrum.log:
        return "linear in the logarithms"
    return "linear in the period" if spectrum.by_period else "linear in the frequency"


def cycle_echo(model: Model) -> str:
    """Write every cycle as its card does."""
    width = max((len(cycle.name) for cycle in model.cycles), default=0) + 2
    text = section("CYCLES") if model.cycles else ""
    for cycle in model.cycles:
        start = f"  FROM={cycle.start}" if cycle.start else ""
        text += f"  {cycle.name:<{width}}{', '.join(cycle.cases)}  TIMES={cycle.times}{start}\n"
    return text
