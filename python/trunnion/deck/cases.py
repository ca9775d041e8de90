"""Cards of cases and combinations to the model."""

from trunnion.deck import expressions as ex
from trunnion.deck.context import Context
from trunnion.deck.record import Record
from trunnion.model import Case, Comb, Term


def case(run: Context, record: Record) -> None:
    """CASE: a sum of load sets; of names of cases it is a COMB."""
    names = ex.case_names(record.expression)
    if names and not any(n in ex.RESERVED for n in names):
        known = {case.name for case in run.model.cases} | run.carried.broken
        if all(n in known for n in names) and "vector" not in str(record.expression):
            _comb_of_case(run, record)
            return
    try:
        items = ex.terms(record.expression)
    except ValueError as error:
        run.complain(record, str(error), "ABS")
        return
    faulty = _faulty_terms(run, record, items)
    keys = record.keys
    if faulty:
        return
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


def _faulty_terms(run: Context, record: Record, items: list[Term]) -> bool:
    """Complain of terms of a CASE that are no load sets."""
    cases = {case.name for case in run.model.cases}
    faulty = False
    for name in dict.fromkeys(term.name for term in items):
        if name in ex.LOAD_SETS or (name == "U" and _has_vector(items)):
            continue
        faulty = True
        if name in run.carried.broken and name not in cases:
            continue
        if name in cases:
            message = f"{name} is a case; CASE sums load sets, COMB sums results of cases"
        else:
            message = ex.unknown_set(name, cases)
        run.complain(record, message, name)
    return faulty


def _has_vector(items: list[Term]) -> bool:
    """Tell whether U stands with its vector."""
    return all(term.vector is not None for term in items if term.name == "U")


def _comb_of_case(run: Context, record: Record) -> None:
    """CASE EXP = OPE - SUS is a combination."""
    for key in record.keys:
        run.complain(
            record, f"{key}: this sums results of cases, a COMB, which has no {key}", f"{key}="
        )
    comb(run, record)


def comb(run: Context, record: Record) -> None:
    """COMB: an expression of names of cases."""
    expression = record.expression
    text = str(expression)
    if "'vector'" in text:
        run.complain(record, "U(x,y,z) is a load set; COMB sums results of cases", "U")
        return
    for name in dict.fromkeys(ex.case_names(expression)):
        if name in ex.RESERVED:
            run.complain(record, f"{name} is a load set; COMB sums results of cases", name)
            return
    made = Comb(record.args[0], expression, ex.format_expression(expression), record.place)
    run.keep(run.model.cases, made)
