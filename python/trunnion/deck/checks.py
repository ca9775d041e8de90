"""Checks of a whole model that need no geometry and no arrays: labels, bends, supports."""

from collections.abc import Iterator, Set

from trunnion.deck.case_checks import check_cases
from trunnion.deck.record import Fault, Mark
from trunnion.deck.values import nearest
from trunnion.model import Bend, Model, Pipe, Place, Support
from trunnion.system.checks import known_labels


def check(model: Model, broken: Set[str] = frozenset()) -> list[Fault]:
    """Find every fault of a model; words in `broken` had an error already."""
    return [
        *_labels(model, broken),
        *_bends(model, broken),
        *_nodes(model, broken),
        *_supports(model, broken),
        *_support_names(model),
        *_pipes(model, broken),
        *check_cases(model, broken),
    ]


def _own_labels(model: Model) -> Iterator[tuple[str, Place, str]]:
    """Labels of nodes that cards define, with the head of the card."""
    for pipe in model.pipes:
        word = pipe.card
        yield pipe.start, pipe.place, word
        yield pipe.end, pipe.place, word
    for spring in model.springs:
        yield spring.start, spring.place, "SPRING"
        yield spring.end, spring.place, "SPRING"
    for node in model.nodes:
        yield node.label, node.place, "NODE"


def _labels(model: Model, broken: Set[str]) -> Iterator[Fault]:
    """Labels of digits + N/M/F belong to bends; NODE cards name a node once."""
    kept = {bend.node + point for bend in model.bends for point in "NMF"}
    kept |= broken  # and labels that are told
    for label, place, word in _own_labels(model):
        if label[-1] in "NMF" and label[:-1].isdigit() and label not in kept:
            kept.add(label)
            message = f"label {label} is kept for bends, and {label[:-1]} is no bend"
            yield Fault(place, f"{word} {label}", message, label)
    seen: dict[str, Place] = {}
    for node in model.nodes:
        if node.label in seen:
            message = f"node {node.label} has coordinates at {seen[node.label]} already"
            yield Fault(node.place, f"NODE {node.label}", message, node.label)
        seen.setdefault(node.label, node.place)


def _bends(model: Model, broken: Set[str]) -> Iterator[Fault]:
    """Check that every bend joins two pipes and is wider than they are."""
    ends: dict[str, list[Pipe]] = {bend.node: [] for bend in model.bends}
    for pipe in model.pipes:
        for label in (pipe.start, pipe.end):
            if label in ends:
                ends[label].append(pipe)
    seen: dict[str, Bend] = {}
    for bend in model.bends:
        first = seen.setdefault(bend.node, bend)
        if first is not bend:
            message = f"node {bend.node} has a bend at {first.place} already"
            yield Fault(bend.place, f"BEND {bend.node}", message, bend.node)
        elif bend.node not in broken:
            yield from _legs(bend, ends[bend.node], model)


def _legs(bend: Bend, pipes: list[Pipe], model: Model) -> Iterator[Fault]:
    """Check the pipes that end at a bend."""
    head, node = f"BEND {bend.node}", bend.node
    if len(pipes) != 2:
        some = {0: "no pipe ends", 1: "one pipe ends"}.get(len(pipes), f"{len(pipes)} pipes end")
        hint = f"; a branch starts at {node}N, {node}M or {node}F" if len(pipes) > 2 else ""
        message = f"{some} at node {node}; a bend joins two{hint}"
        yield Fault(bend.place, head, message, node)
    elif card := next((pipe.card for pipe in pipes if pipe.card != "PIPE"), None):
        message = f"a {card} ends at node {node}; a bend joins two pipes"
        yield Fault(bend.place, head, message, node)
    elif bend.radius is not None:
        for name in dict.fromkeys(pipe.section for pipe in pipes):
            section = model.sections.get(name)
            if section and bend.radius < 0.5 * section.od:
                message = f"R is less than half the outside diameter of {name}"
                yield Fault(bend.place, head, message, "R=")


def _nodes(model: Model, broken: Set[str]) -> Iterator[Fault]:
    """Check that nodes on all other cards exist."""
    known = known_labels(model)
    uses: list[tuple[str, Place, str, Mark]] = []
    uses += [(m.node, m.place, "MASS", m.node) for m in model.masses]
    uses += [(s.node, s.place, s.kind.upper(), s.node) for s in model.supports]
    uses += [(s.cnode, s.place, s.kind.upper(), "CNODE=") for s in model.supports if s.cnode]
    uses += [
        (n, s.place, s.kind.upper(), "FREE=")
        for s in model.supports
        if s.design is not None
        for n in s.design.freed
    ]
    uses += [(d.node, d.place, "DISPLACEMENT", d.node) for d in model.displacements]
    uses += [(f.node, f.place, "FORCE", f.node) for f in model.forces]
    uses += [(n, g.place, f"GROUP {g.name}", n) for g in model.groups for n in g.nodes]
    for label, place, word, mark in uses:
        if label in known or not broken.isdisjoint((label, label[:-1])):
            continue
        if label[-1] in "NMF" and label[:-1] in known:
            why = f": {label[:-1]} is no bend"
        else:
            why = nearest(label, known)
        head = f"{word} {label}" if mark not in ("CNODE=", "FREE=") else word
        yield Fault(place, head, f"node {label} is not defined{why}", mark)


def _supports(model: Model, broken: Set[str]) -> Iterator[Fault]:
    """Check CNODE and ALONG."""
    guided: list[tuple[Support, str]] = []
    for support in model.supports:
        if support.cnode == support.node:
            head = f"{support.kind.upper()} {support.node}"
            yield Fault(support.place, head, "CNODE is the node itself", "CNODE=")
        alongs = dict.fromkeys(d.along for d in support.directions)
        guided += [(support, along) for along in alongs if along is not None]
    if not guided:
        return
    pipes = {f"{p.start}-{p.end}" for p in model.pipes}
    turned = {f"{p.end}-{p.start}" for p in model.pipes}
    corner = {bend.node + point: bend.node for bend in model.bends for point in "NMF"}
    for support, along in guided:
        ends = along.split("-")
        if not broken.isdisjoint((support.node, *ends)):
            continue
        if along not in pipes and along not in turned:
            message = f"ALONG={along} is no pipe{nearest(along, pipes)}"
        elif corner.get(support.node, support.node) not in [corner.get(e, e) for e in ends]:
            message = f"pipe {along} does not end at node {support.node}"
        else:
            continue
        yield Fault(support.place, f"SUPPORT {support.node}", message, "ALONG=")


def _pipes(model: Model, broken: Set[str]) -> Iterator[Fault]:
    """Check sections and materials of pipes, and that there is something to solve."""
    if not (model.pipes or model.springs or model.supports or broken):
        message = "no PIPE, SPRING or SUPPORT card: there is nothing to solve"
        yield Fault(Place("", 0), "", message)
    told = {"", *broken}
    used = {(pipe.section, pipe.material) for pipe in model.pipes}
    used |= {(p.reducer.section, p.material) for p in model.pipes if p.reducer}
    if all(a in model.sections and b in model.materials for a, b in used):
        return
    for pipe in model.pipes:
        for what, name, known in (
            ("section", pipe.section, model.sections),
            ("material", pipe.material, model.materials),
        ):
            if name not in known and name not in told:
                told.add(name)
                head = f"{pipe.card} {pipe.start} {pipe.end}"
                message = f"{what} {name} is not defined{nearest(name, known)}"
                yield Fault(pipe.place, head, message, f"{what.upper()}=")


def _support_names(model: Model) -> Iterator[Fault]:
    """Check that names of supports are used once."""
    seen: dict[str, Support] = {}
    for support in model.supports:
        if support.name and seen.setdefault(support.name, support) is not support:
            head = f"{support.kind.upper()} {support.node}"
            message = f"name {support.name} is already used at {seen[support.name].place}"
            yield Fault(support.place, head, message, "NAME=")
