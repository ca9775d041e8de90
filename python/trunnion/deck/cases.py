"""Cards of cases and combinations to the model."""

from trunnion.deck import expressions as ex
from trunnion.deck.context import Context
from trunnion.deck.record import Record
from trunnion.model import Case, Comb, SpectrumUse

_SPECTRUM = ("MODAL", "SPATIAL", "GROUPS", "FIRST", "DAMPING", "DURATION", "ZPA", "MISSING")
_WITHOUT_HISTORY = ("STEPS", "MUX", "EVENTS", "ITERATION")


def case(run: Context, record: Record) -> None:
    """CASE: a sum of load sets, or of spectra; of names of cases only it is a COMB."""
    cases = {case.name for case in run.model.cases}
    names = ex.case_names(record.expression)
    if ex.has("shock", record.expression):
        spectrum_case(run, record)
        return
    if names and not ex.has("vector", record.expression) and cases.issuperset(names):
        for key in record.keys:
            mark = key if key == "NONLINEAR" else f"{key}="
            run.complain(
                record, f"{key}: this sums results of cases, a COMB, which has no {key}", mark
            )
        comb(run, record)
        return
    if not _are_load_sets(run, record, names, cases):
        run.give_up(record)
        return
    try:
        items = ex.terms(record.expression)
    except ValueError as error:
        run.complain(record, str(error), str(error).split()[0])
        return
    _keys_fit(run, record)
    keys = record.keys
    run.keep(
        run.model.cases,
        Case(
            record.args[0],
            tuple(items),
            keys.get("FROM"),
            keys.get("STEPS", 1),
            keys.get("MUX", 1.0),
            keys.get("E") == "HOT",
            None if "EVENTS" not in keys else keys["EVENTS"] == "ON",
            keys.get("ITERATION"),
            keys.get("SNUBBERS"),
            record.place,
            keys.get("ABOUT"),
            keys.get("ON"),
            "NONLINEAR" in keys,
        ),
    )


def _keys_fit(run: Context, record: Record) -> None:
    """Complain of keys of a CASE that exclude each other or would do nothing."""
    keys = record.keys
    bases = [key for key in ("FROM", "ABOUT", "ON") if key in keys]
    if len(bases) > 1:
        message = f"{bases[0]} and {bases[1]}: a case has one of FROM, ABOUT and ON"
        run.complain(record, message, f"{bases[1]}=")
    if "NONLINEAR" in keys and "ABOUT" not in keys:
        run.complain(record, "NONLINEAR goes with ABOUT=", "NONLINEAR")
    elif "NONLINEAR" not in keys and bases[:1] in (["ABOUT"], ["ON"]):
        for key in _WITHOUT_HISTORY:
            if key in keys:
                message = f"{key} does nothing in a linear case without friction, {bases[0]}="
                run.complain(record, message, f"{key}=")
    for key, state, does in (("ABOUT", "FREE", "locks"), ("ON", "LOCKED", "frees")):
        if key in keys and keys.get("SNUBBERS") == state:
            run.complain(record, f"SNUBBERS={state}: {key}= {does} snubbers", "SNUBBERS=")
    for key in _SPECTRUM:
        if key in keys:
            run.complain(record, f"{key} goes with SPECTRUM(...) only", f"{key}=")


def _are_load_sets(run: Context, record: Record, names: list[str], cases: set[str]) -> bool:
    """Tell whether all names in a CASE are load sets, and complain of those that are not."""
    wrong = [name for name in dict.fromkeys(names) if name not in ex.LOAD_SETS]
    for name in wrong:
        if name in cases:
            message = f"{name} is a case; CASE sums load sets, COMB sums results of cases"
            run.complain(record, message, name)
        elif name not in run.carried.broken:
            run.miss(record, ex.unknown_set(name, cases), name)
    return not wrong


def spectrum_case(run: Context, record: Record) -> None:
    """CASE of SPECTRUM(...) terms: a response spectrum, combined as its keys say."""
    keys = record.keys
    try:
        shocks = ex.shocks(record.expression)
    except ValueError as error:
        run.complain(record, str(error), "SPECTRUM")
        return
    for key in keys:
        if key not in _SPECTRUM:
            mark = key if key == "NONLINEAR" else f"{key}="
            run.complain(
                record, f"{key} does not go with SPECTRUM(...); modes say about what", mark
            )
    zpa = keys.get("ZPA")
    use = SpectrumUse(
        tuple(shocks),
        modal=keys.get("MODAL", "SRSS"),
        spatial=keys.get("SPATIAL", "SRSS"),
        groups=keys.get("GROUPS", "ABS"),
        first=keys.get("FIRST", "MODES"),
        damping=keys.get("DAMPING", 0.02),
        duration=keys.get("DURATION", 10.0),
        missing_mass=keys.get("MISSING") == "ON",
        zpa=None if zpa is None else zpa * run.model.settings.g,
    )
    run.keep(run.model.cases, Case(record.args[0], (), place=record.place, spectrum=use))


def comb(run: Context, record: Record) -> None:
    """COMB: an expression of names of cases."""
    expression = record.expression
    words = [("vector", "U"), ("shock", "SPECTRUM")]
    names = [name for word, name in words if ex.has(word, expression)]
    for name in dict.fromkeys([*names, *ex.case_names(expression)]):
        if name in ex.RESERVED:
            run.complain(record, f"{name} is a load set; COMB sums results of cases", name)
            return
    made = Comb(record.args[0], expression, ex.format_expression(expression), record.place)
    run.keep(run.model.cases, made)
