"""Cards of cases and combinations to the model."""

from trunnion.deck import expressions as ex
from trunnion.deck.context import Context
from trunnion.deck.record import Record
from trunnion.model import Case, Comb


def case(run: Context, record: Record) -> None:
    """CASE: a sum of load sets; of names of cases only it is a COMB."""
    cases = {case.name for case in run.model.cases}
    names = ex.case_names(record.expression)
    if names and not ex.has_vector(record.expression) and cases.issuperset(names):
        for key in record.keys:
            message = f"{key}: this sums results of cases, a COMB, which has no {key}"
            run.complain(record, message, f"{key}=")
        comb(run, record)
        return
    if not _are_load_sets(run, record, names, cases):
        run.give_up(record)
        return
    try:
        items = ex.terms(record.expression)
    except ValueError as error:
        run.complain(record, str(error), "ABS")
        return
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
        ),
    )


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


def comb(run: Context, record: Record) -> None:
    """COMB: an expression of names of cases."""
    expression = record.expression
    names = ["U"] if ex.has_vector(expression) else []
    for name in dict.fromkeys([*names, *ex.case_names(expression)]):
        if name in ex.RESERVED:
            run.complain(record, f"{name} is a load set; COMB sums results of cases", name)
            return
    made = Comb(record.args[0], expression, ex.format_expression(expression), record.place)
    run.keep(run.model.cases, made)
