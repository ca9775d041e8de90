"""Checks of a whole model that need no geometry and no arrays: names, labels, sets, loops."""

from collections import Counter
from collections.abc import Iterable, Iterator

from trunnion.checks import known_labels
from trunnion.deck import expressions as ex
from trunnion.deck.record import Fault, Mark
from trunnion.deck.values import nearest
from trunnion.model import Case, Comb, Model, Place


def check(model: Model, broken: frozenset[str] | set[str] = frozenset()) -> list[Fault]:
    """Find every fault of a model; words in `broken` had an error already."""
    found = [
        *_labels(model, broken),
        *_bends(model, broken),
        *_nodes(model, broken),
        *_supports(model, broken),
        *_pipes(model, broken),
        *_names(model),
        *_load_sets(model, broken),
        *_references(model, broken),
    ]
    return found


def _own_labels(model: Model) -> Iterator[tuple[str, Place, str]]:
    """Labels of nodes that cards define, with the head of the card."""
    for pipe in model.pipes:
        word = "RIGID" if pipe.rigid else "PIPE"
        yield pipe.start, pipe.place, word
        yield pipe.end, pipe.place, word
    for spring in model.springs:
        yield spring.start, spring.place, "SPRING"
        yield spring.end, spring.place, "SPRING"
    for node in model.nodes:
        yield node.label, node.place, "NODE"


def _bend_points(model: Model) -> set[str]:
    """Give the labels 30N 30M 30F of every bend."""
    return {bend.node + point for bend in model.bends for point in "NMF"}


def _labels(model: Model, broken: Iterable[str]) -> Iterator[Fault]:
    """Labels of digits + N/M/F belong to bends; NODE cards name a node once."""
    points = _bend_points(model)
    told = set(broken)
    for label, place, word in _own_labels(model):
        if (
            label[-1] in "NMF"
            and label not in points
            and label[:-1].isdigit()
            and label not in told
        ):
            told.add(label)
            message = f"label {label} is kept for bends, and {label[:-1]} is no bend"
            yield Fault(place, f"{word} {label}", message, label)
    seen: dict[str, Place] = {}
    for node in model.nodes:
        if node.label in seen:
            message = f"node {node.label} has coordinates at {seen[node.label]} already"
            yield Fault(node.place, f"NODE {node.label}", message, node.label)
        seen.setdefault(node.label, node.place)


def _bends(model: Model, broken: frozenset[str] | set[str]) -> Iterator[Fault]:
    """Check that every bend joins two pipes and is wider than its pipe."""
    seen: dict[str, Place] = {}
    ends: dict[str, list[int]] = {bend.node: [] for bend in model.bends}
    for i, pipe in enumerate(model.pipes):
        for label in (pipe.start, pipe.end):
            if label in ends:
                ends[label].append(i)
    for bend in model.bends:
        head = f"BEND {bend.node}"
        if bend.node in seen:
            message = f"node {bend.node} has a bend at {seen[bend.node]} already"
            yield Fault(bend.place, head, message, bend.node)
            continue
        seen[bend.node] = bend.place
        pipes = ends[bend.node]
        if bend.node in broken:
            continue
        if len(pipes) != 2:
            some = (
                "no pipe ends"
                if not pipes
                else "one pipe ends"
                if len(pipes) == 1
                else f"{len(pipes)} pipes end"
            )
            hint = f"; a branch starts at {bend.node}N, {bend.node}M or {bend.node}F" * (
                len(pipes) > 2
            )
            yield Fault(
                bend.place, head, f"{some} at node {bend.node}; a bend joins two{hint}", bend.node
            )
            continue
        for i in pipes:
            if model.pipes[i].rigid:
                message = f"a RIGID ends at node {bend.node}; a bend joins two pipes"
                yield Fault(bend.place, head, message, bend.node)
                break
            section = model.sections.get(model.pipes[i].section)
            if section and bend.radius is not None and bend.radius < 0.5 * section.od:
                message = f"R is less than half the outside diameter of {section.name}"
                yield Fault(bend.place, head, message, "R=")
                break


def _nodes(model: Model, broken: frozenset[str] | set[str]) -> Iterator[Fault]:
    """Check that nodes on all other cards exist."""
    known = known_labels(model)
    uses: list[tuple[str, Place, str, Mark]] = []
    uses += [(b.node, b.place, "BEND", b.node) for b in model.bends]
    uses += [(m.node, m.place, "MASS", m.node) for m in model.masses]
    uses += [(s.node, s.place, s.kind.upper(), s.node) for s in model.supports]
    uses += [(s.cnode, s.place, s.kind.upper(), "CNODE=") for s in model.supports if s.cnode]
    uses += [(d.node, d.place, "DISPLACEMENT", d.node) for d in model.displacements]
    uses += [(f.node, f.place, "FORCE", f.node) for f in model.forces]
    for label, place, word, mark in uses:
        if label in known or label in broken or word == "BEND":
            continue
        if label[-1] in "NMF" and label[:-1] in known:
            why = f": {label[:-1]} is no bend"
        else:
            why = nearest(label, known)
        head = f"{word} {label}" if mark != "CNODE=" else word
        yield Fault(place, head, f"node {label} is not defined{why}", mark)


def _supports(model: Model, broken: frozenset[str] | set[str]) -> Iterator[Fault]:
    """Check CNODE and ALONG."""
    pipes: set[tuple[str, str]] | None = None
    for support in model.supports:
        head = f"{support.kind.upper()} {support.node}"
        if support.cnode == support.node:
            yield Fault(support.place, head, "CNODE is the node itself", "CNODE=")
        for direction in support.directions:
            if direction.along is None:
                continue
            if pipes is None:
                pipes = {(p.start, p.end) for p in model.pipes}
            a, _, b = direction.along.partition("-")
            if a in broken or b in broken or ((a, b) in pipes and support.node in broken):
                continue
            if (a, b) not in pipes and (b, a) not in pipes:
                names = {f"{p}-{q}" for p, q in pipes}
                message = f"ALONG={direction.along} is no pipe{nearest(direction.along, names)}"
                yield Fault(support.place, head, message, "ALONG=")
            elif _corner(support.node, model) not in (_corner(a, model), _corner(b, model)):
                message = f"pipe {direction.along} does not end at node {support.node}"
                yield Fault(support.place, head, message, "ALONG=")
            break


def _corner(label: str, model: Model) -> str:
    """Label of the bend that a bend point belongs to, or the label itself."""
    return (
        label[:-1] if label[-1] in "NMF" and label[:-1] in {b.node for b in model.bends} else label
    )


def _pipes(model: Model, broken: frozenset[str] | set[str]) -> Iterator[Fault]:
    """Check sections and materials of pipes, and that there is something to solve."""
    if not (model.pipes or model.springs or model.supports or broken):
        message = "no PIPE, SPRING or SUPPORT card: there is nothing to solve"
        yield Fault(Place("", 0), "", message)
    told = {"", *broken}
    for pipe in model.pipes:
        for what, name, known in (
            ("section", pipe.section, model.sections),
            ("material", pipe.material, model.materials),
        ):
            if name not in known and name not in told:
                told.add(name)
                head = f"PIPE {pipe.start} {pipe.end}"
                message = f"{what} {name} is not defined{nearest(name, known)}"
                yield Fault(pipe.place, head, message, f"{what.upper()}=")


def _names(model: Model) -> Iterator[Fault]:
    """Check that names of cases and supports are used once."""
    seen: dict[str, Place] = {}
    for case in model.cases:
        if case.name in seen:
            message = f"case {case.name} is already defined at {seen[case.name]}"
            yield Fault(case.place, f"{_word(case)} {case.name}", message, case.name)
        seen.setdefault(case.name, case.place)
    named = Counter(support.name for support in model.supports if support.name)
    twice = {name for name, count in named.items() if count > 1}
    first: dict[str, Place] = {}
    for support in model.supports:
        if support.name in twice and first.setdefault(support.name, support.place) != support.place:
            head = f"{support.kind.upper()} {support.node}"
            message = f"name {support.name} is already used at {first[support.name]}"
            yield Fault(support.place, head, message, "NAME=")


def _word(case: Case | Comb) -> str:
    """Keyword of a case."""
    return "CASE" if isinstance(case, Case) else "COMB"


_CARDS = {"T": "OPERATE", "P": "OPERATE", "D": "DISPLACEMENT", "F": "FORCE", "U": "ACCELERATION"}


def _load_sets(model: Model, broken: frozenset[str] | set[str]) -> Iterator[Fault]:
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


def _references(model: Model, broken: frozenset[str] | set[str]) -> Iterator[Fault]:
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
