"""Checks of the cases of a whole model: names, load sets, references, loops."""

from collections.abc import Iterator, Sequence, Set
from typing import NamedTuple

from trunnion.cases.default_cases import is_operating, with_cases
from trunnion.deck import expressions as ex
from trunnion.deck.record import Fault, Mark
from trunnion.deck.values import nearest
from trunnion.model import Case, Comb, Cycle, Model, Place, Shock

Named = Case | Comb | Cycle


def check_cases(model: Model, broken: Set[str]) -> Iterator[Fault]:
    """Find every fault of the cases; words in `broken` had an error already."""
    if not broken:
        model = with_cases(model)
    named: list[Named] = [*model.cases, *model.cycles]
    yield from _names(named)
    yield from _load_sets(model, broken)
    yield from _spectra(model, broken)
    yield from _hangers(model, broken)
    yield from _references(model, named, broken)


def _names(named: list[Named]) -> Iterator[Fault]:
    """Check that names of cases, combinations and cycles are used once."""
    seen: dict[str, Place] = {}
    for case in named:
        if case.name in seen:
            message = f"case {case.name} is already defined at {seen[case.name]}"
            yield Fault(case.place, _head(case), message, case.name)
        seen.setdefault(case.name, case.place)


def _head(case: Named) -> str:
    """Keyword and name of a case."""
    return f"{type(case).__name__.upper()} {case.name}"


_CARDS = {
    **{"T": "OPERATE", "P": "OPERATE", "D": "DISPLACEMENT", "F": "FORCE", "U": "ACCELERATION"},
    **{"WIND": "WIND", "S": "SNOW", "Q": "UNIFORM", "CS": "PIPE"},
}


def _load_sets(model: Model, broken: Set[str]) -> Iterator[Fault]:
    """Check that every set that a case takes is given by some card."""
    given: set[str] = {"S"} if model.snows else set()
    operations = {id(p.operation): p.operation for p in model.pipes}
    for operation in operations.values():
        given.update("T" + s for s in operation.t)
        given.update("P" + s for s in operation.p)
    given.update("D" + d.set for d in model.displacements)
    given.update("F" + f.set for f in model.forces)
    given.update("U" + a.set for a in model.accelerations)
    given.update("WIND" + w.set for w in model.winds)
    given.update("Q" + q.set for uniform in {p.uniform for p in model.pipes} for q in uniform)
    given.update("CS" for pipe in model.pipes if pipe.cut)
    for case in model.cases:
        if not isinstance(case, Case):
            continue
        for name in dict.fromkeys(term.name for term in case.terms):
            card = _CARDS.get(name.rstrip("123456789")) if name != "U" else None
            if card and name not in given and name not in broken and card not in broken:
                before = " before a pipe" if card in ("OPERATE", "UNIFORM") else ""
                message = f"no {card} card{before} gives {name}"
                if name == "CS":
                    message = "no PIPE card has CUTSHORT= or CUTLONG=: CS is nothing"
                yield Fault(case.place, _head(case), message, name)
            occasional = name[0] == "U" or name.startswith("WIND")
            if occasional and case.about is None and case.snubbers is None:
                message = f"{name} needs ABOUT=, or SNUBBERS=FREE or LOCKED"
                yield Fault(case.place, _head(case), message, name)


def _hangers(model: Model, broken: Set[str]) -> Iterator[Fault]:
    """Check what hangers to be selected name: their case and their series."""
    asked = [s for s in model.supports if s.design is not None]
    if not asked:
        return
    cases = {case.name: case for case in model.cases}
    own = {size.series for size in model.spring_sizes}
    for s in asked:
        assert s.design is not None
        head, name = f"HANGER {s.node}", s.design.operating
        case = cases.get(name or "")
        if name and name not in broken and not (isinstance(case, Case) and is_operating(case)):
            why = "has no weight with temperature or movement" if case else "is not defined"
            message = f"case {name} {why}{'' if case else nearest(name, cases)}"
            yield Fault(s.place, head, message, "OPERATING=")
        series = own or (_series(s.design.table) if s.design.series else set())
        if s.design.series and s.design.series not in series | broken:
            message = f"series {s.design.series} is not one of {' '.join(sorted(series))}"
            yield Fault(s.place, head, message, "SERIES=")


def _series(table: str) -> Set[str]:
    """Series of a table of the library."""
    from trunnion.library.springs import spring_table

    return {size.series for size in spring_table(table)}


def _spectra(model: Model, broken: Set[str]) -> Iterator[Fault]:
    """Check what response spectrum cases name, and that there are modes for them."""
    groups = {group.name for group in model.groups}
    for case in model.cases:
        if not isinstance(case, Case) or case.spectrum is None:
            continue
        head = _head(case)
        if model.modal is None and "MODES" not in broken:
            message = "a response spectrum needs modes; write a MODES card"
            yield Fault(case.place, head, message, "SPECTRUM")
        shocks = case.spectrum.shocks
        for name in dict.fromkeys(shock.spectrum for shock in shocks):
            if name not in model.spectra and name not in broken:
                message = f"spectrum {name} is not defined{nearest(name, model.spectra)}"
                yield Fault(case.place, head, message, name)
        for name in dict.fromkeys(shock.group for shock in shocks if shock.group):
            if name not in groups and name not in broken:
                message = f"group {name} is not defined{nearest(name, groups)}"
                yield Fault(case.place, head, message, name)
        if 0 < sum(shock.group is None for shock in shocks) < len(shocks):
            message = "SPECTRUM(...) with and without a group: motion is uniform or by groups"
            yield Fault(case.place, head, message, "SPECTRUM")
        else:
            yield from (Fault(case.place, head, m, "SPECTRUM") for m in _twice(model, shocks))


def _twice(model: Model, shocks: Sequence[Shock]) -> Iterator[str]:
    """Say what a response spectrum case would move twice in one direction."""
    nodes = {group.name: group.nodes for group in model.groups}
    seen: set[tuple[str, str | None]] = set()
    moved: dict[tuple[str, str], str | None] = {}
    for shock in shocks:
        direction, group = shock.direction, shock.group
        if (direction, group) in seen:
            whose = f" for group {group}" if group else ""
            yield f"SPECTRUM(...) stands twice in {direction}{whose}"
            continue
        seen.add((direction, group))
        for node in nodes.get(group or "", ()):
            other = moved.setdefault((direction, node), group)
            if other != group:
                yield f"node {node} moves in {direction} with groups {other} and {group}"


class Link(NamedTuple):
    """One name that a record needs: where it stands, and whether it must have a state."""

    name: str
    mark: Mark
    word: str  # FROM, ABOUT, ON; "" in expressions and lists


def links_of(case: Named) -> list[Link]:
    """Names that a case, combination or cycle needs."""
    if isinstance(case, Comb):
        return [Link(name, name, "") for name in dict.fromkeys(ex.case_names(case.expression))]
    keys = [("FROM", case.start)]
    links = []
    if isinstance(case, Case):
        keys += [("ABOUT", case.about), ("ON", case.on)]
    else:
        links = [Link(name, name, "CYCLE") for name in dict.fromkeys(case.cases)]
    return links + [Link(name, f"{word}=", word) for word, name in keys if name is not None]


def _references(model: Model, named: list[Named], broken: Set[str]) -> Iterator[Fault]:
    """Check that names of cases are those of cases, and that none leads back to itself."""
    cases: dict[str, Named] = {}
    for case in named:
        cases.setdefault(case.name, case)  # a second one of a name is told
    links = {name: links_of(case) for name, case in cases.items()}
    known = {name: [k for k in mine if k.name in cases] for name, mine in links.items()}
    looped: set[str] = set()
    for loop in _loops(known):
        looped.update(loop)
        case, second = cases[loop[0]], loop[1 % len(loop)]
        chain = " -> ".join([*loop, loop[0]])
        mark = next(link.mark for link in known[loop[0]] if link.name == second)
        yield Fault(case.place, _head(case), f"needs itself: {chain}", mark)
    for name, case in cases.items():
        for link in links[name]:
            fault = _refused(link, cases, broken)
            if fault and not looped.issuperset((name, link.name)):
                yield Fault(case.place, _head(case), fault, link.mark)
    if model.modal is not None and model.modal.about is not None:
        link = Link(model.modal.about, "ABOUT=", "ABOUT")
        fault = _refused(link, cases, broken)
        if fault:
            yield Fault(model.modal.place, "MODES", fault, link.mark)


def _refused(link: Link, cases: dict[str, Named], broken: Set[str]) -> str:
    """Say why a case cannot stand where a link names it, or nothing."""
    case, before = cases.get(link.name), f"{link.word}={link.name}: "
    if case is None:
        known = link.name in broken
        return "" if known else f"case {link.name} is not defined{nearest(link.name, set(cases))}"
    if link.word in ("", "CYCLE"):
        before = ""
    if isinstance(case, Cycle):
        return f"{before}{link.name} is a CYCLE, not a case"
    if link.word == "" or (isinstance(case, Case) and has_state(case)):
        return ""
    if isinstance(case, Comb):
        return f"{before}a COMB has no state to start from{_to_follow(link)}"
    if case.spectrum:
        return f"{before}a response spectrum has no contact state"
    word = "ABOUT" if case.about else "ON"
    return f"{before}{case.name} is a linear case itself ({word}=), without a contact state"


def _to_follow(link: Link) -> str:
    """Say what a cycle does with its cases."""
    return f"; {link.name} cannot be followed" if link.word == "CYCLE" else ""


def has_state(case: Case) -> bool:
    """Tell whether a case ends in a contact state that others may start from or freeze."""
    return case.about is None and case.on is None and case.spectrum is None


def _loops(links: dict[str, list[Link]]) -> Iterator[list[str]]:
    """Find the cases that need themselves: take away those that need nothing, again and again."""
    needs = {name: {link.name for link in mine} for name, mine in links.items()}
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
    order = {name: i for i, name in enumerate(links)}
    while needs:
        loop = [next(iter(needs))]
        while (following := min(needs[loop[-1]], key=order.__getitem__)) not in loop:
            loop.append(following)
        loop = loop[loop.index(following) :]
        yield loop
        dead = set(loop)
        while dead:  # and whoever needs the loop
            needs = {n: o for n, o in needs.items() if n not in dead}
            dead = {n for n, o in needs.items() if not o <= needs.keys()}
