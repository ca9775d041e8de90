"""Cases as text, and the order in which they can be solved."""

from collections.abc import Mapping, Sequence

from trunnion.errors import ModelError, Problem
from trunnion.model import Case, Comb, Model, Term
from trunnion.results.combine import parents


def case_text(case: Case) -> str:
    """The sum of a case as on its card: "W + P1 + 0.5*T1"."""
    text = ""
    for term in case.terms:
        sign = "-" if term.factor < 0 else "+"
        lead = f" {sign} " if text else ("-" if sign == "-" else "")
        text += lead + _term_text(term)
    return text


def _term_text(term: Term) -> str:
    size = abs(term.factor)
    name = term.name
    if term.vector is not None:
        name += "({:g},{:g},{:g})".format(*term.vector)
    return name if size == 1.0 else f"{size:g}*{name}"


def needs(case: Case | Comb) -> list[str]:
    """Names of the cases that must be solved first."""
    if isinstance(case, Comb):
        return parents(case.expression)
    return [name for name in (case.start, case.about, case.on) if name]


def needed(model: Model, wanted: Sequence[str]) -> list[Case | Comb]:
    """Cases that are wanted and those that they need, in the deck's order."""
    by_name = {case.name: case for case in model.cases}
    found: set[str] = set()
    todo = list(wanted)
    while todo:
        case = by_name.get(todo.pop())
        if case is None or case.name in found:
            continue
        found.add(case.name)
        todo += needs(case)
        if isinstance(case, Case) and case.spectrum and model.modal and model.modal.about:
            todo.append(model.modal.about)
    return [case for case in model.cases if case.name in found]


def in_order(cases: Sequence[Case | Comb]) -> list[Case | Comb]:
    """Deck order, but every case after those it needs.

    Raises
    ------
    ModelError
        A case that is not defined, or one that needs itself.
    """
    by_name = {case.name: case for case in cases}
    done: dict[str, Case | Comb] = {}
    for case in cases:
        _visit(case.name, (), by_name, done)
    return list(done.values())


def _visit(
    name: str,
    path: tuple[str, ...],
    by_name: Mapping[str, Case | Comb],
    done: dict[str, Case | Comb],
) -> None:
    if name in done:
        return
    case = by_name.get(name)
    if case is None or name in path:
        what = "is not defined" if case is None else "refers to itself"
        raise ModelError([Problem("cases", f"CASE {name} {what}")])
    for need in needs(case):
        _visit(need, (*path, name), by_name, done)
    done[name] = case
