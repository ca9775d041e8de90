"""Checks of the cases of a whole model: names, load sets, references, loops."""

from collections.abc import Iterator, Set

from trunnion.deck import expressions as ex
from trunnion.deck.record import Fault
from trunnion.deck.values import nearest
from trunnion.model import Case, Comb, Model, Place


def check_cases(model: Model, broken: Set[str]) -> Iterator[Fault]:
    """Find every fault of the cases; words in `broken` had an error already."""
    yield from _names(model)
    yield from _load_sets(model, broken)
    yield from _references(model, broken)


def _names(model: Model) -> Iterator[Fault]:
    """Check that names of cases are used once."""
    seen: dict[str, Place] = {}
    for case in model.cases:
        if case.name in seen:
            message = f"case {case.name} is already defined at {seen[case.name]}"
            yield Fault(case.place, f"{_word(case)} {case.name}", message, case.name)
        seen.setdefault(case.name, case.place)


def _word(case: Case | Comb) -> str:
    """Keyword of a case."""
    return "CASE" if isinstance(case, Case) else "COMB"


_CARDS = {"T": "OPERATE", "P": "OPERATE", "D": "DISPLACEMENT", "F": "FORCE", "U": "ACCELERATION"}


def _load_sets(model: Model, broken: Set[str]) -> Iterator[Fault]:
    """Check that every set that a case takes is given by some card."""
    given: set[str] = set()
    operations = {id(p.operation): p.operation for p in model.pipes}
    for operation in operations.values():
        given.update("T" + s for s in operation.t)
        given.update("P" + s for s in operation.p)
    given.update("D" + d.set for d in model.displacements)
    given.update("F" + f.set for f in model.forces)
    given.update("U" + a.set for a in model.accelerations)
    for case in model.cases:
        if not isinstance(case, Case):
            continue
        for name in dict.fromkeys(term.name for term in case.terms):
            card = _CARDS.get(name[0]) if len(name) == 2 and name[1].isdigit() else None
            if card and name not in given and name not in broken:
                before = " before a pipe" if card == "OPERATE" else ""
                message = f"no {card} card{before} gives {name}"
                yield Fault(case.place, f"CASE {case.name}", message, name)
            if name[0] == "U" and case.snubbers is None:
                message = f"{name} in a CASE needs SNUBBERS=FREE or SNUBBERS=LOCKED"
                yield Fault(case.place, f"CASE {case.name}", message, name)


def _references(model: Model, broken: Set[str]) -> Iterator[Fault]:
    """Check that FROM and COMB name cases, and that none leads back to itself."""
    cases = {case.name: case for case in model.cases}
    if not model.cases and not broken:
        yield Fault(Place("", 0), "", "no CASE card; write for instance CASE SUS = W")
    links: dict[str, list[str]] = {}
    for case in model.cases:
        head = f"{_word(case)} {case.name}"
        if isinstance(case, Case):
            wanted = [case.start] if case.start else []
        else:
            wanted = list(dict.fromkeys(ex.case_names(case.expression)))
        links.setdefault(case.name, [])
        for name in wanted:
            mark = "FROM=" if isinstance(case, Case) else name
            if name in cases:
                links[case.name].append(name)
                if isinstance(case, Case) and isinstance(cases[name], Comb):
                    message = f"FROM={name}: a COMB has no state to start from"
                    yield Fault(case.place, head, message, mark)
            elif name not in broken:
                yield Fault(
                    case.place, head, f"case {name} is not defined{nearest(name, set(cases))}", mark
                )
    yield from _loops(cases, links)


def _loops(cases: dict[str, Case | Comb], links: dict[str, list[str]]) -> Iterator[Fault]:
    """Find the cases that need themselves: take away those that need nothing, again and again."""
    needs = {name: set(others) for name, others in links.items()}
    users: dict[str, list[str]] = {name: [] for name in needs}
    for name, others in needs.items():
        for other in others:
            users[other].append(name)
    free = [name for name, others in needs.items() if not others]
    while free:
        name = free.pop()
        for user in users[name]:
            needs[user].discard(name)
            if not needs[user]:
                free.append(user)
        del needs[name]
    while needs:
        loop = [next(iter(needs))]
        while (following := min(needs[loop[-1]], key=list(cases).index)) not in loop:
            loop.append(following)
        loop = loop[loop.index(following) :]
        case = cases[loop[0]]
        chain = " -> ".join([*loop, loop[0]])
        mark = "FROM=" if isinstance(case, Case) else loop[1 % len(loop)]
        yield Fault(case.place, f"{_word(case)} {case.name}", f"needs itself: {chain}", mark)
        dead = set(loop)
        while dead:  # and whoever needs the loop
            needs = {n: o for n, o in needs.items() if n not in dead}
            dead = {n for n, o in needs.items() if not o <= needs.keys()}
