"""Restraints and hangers of the job as supports of the model."""

import re
from collections import Counter
from collections.abc import Iterator
from dataclasses import replace

from trunnion.formats.caesar.codes import STAND_INS, WORDS, name_of
from trunnion.formats.caesar.geometry import Labels, size
from trunnion.formats.caesar.job import Element, HangerData, Job, Restraint, Vec
from trunnion.formats.findings import Findings
from trunnion.model import Direction, HangerDesign, Model, Place, Support

_AXES = "XYZ"
ANVIL = (0, 1)  # numbers of hanger tables: the default, which is the maker's of number 1
FLAT = 1e-4  # an element with less of its length in the plane of the ground is a riser
_X, _Y, _Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)
_TAG = re.compile(r"[^\s=!&(),\"']{1,64}")


class Restraints:
    """Collects the restraints of all elements; those of a node and CNODE make one support."""

    def __init__(self, job: Job, labels: Labels, model: Model, findings: Findings) -> None:
        self.job = job
        self.labels = labels
        self.model = model
        self.findings = findings
        self._seen: set[tuple[object, ...]] = set()
        self._tags = Counter(r.tag for e in job.elements for r in e.restraints)
        self._tags.update(h.tag for h in job.hangers)

    def element(self, i: int) -> None:
        """Add the supports of one element's restraints."""
        e = self.job.elements[i]
        groups: dict[tuple[str, str | None], list[tuple[Restraint, Direction]]] = {}
        for r in e.restraints:
            for label, cnode in self._places(e, r):
                for direction in self._directions(i, e, r, label):
                    groups.setdefault((label, cnode), []).append((r, direction))
        for (label, cnode), members in groups.items():
            self._support(e, label, cnode, members)

    def _places(self, e: Element, r: Restraint) -> Iterator[tuple[str, str | None]]:
        """Give the labels of the node and CNODE, once for each different restraint."""
        label = self.labels.node(r.node)
        key = (r.node, r.code, r.stiffness, r.gap, r.mu, r.cnode, r.cosines)
        if label is None:
            text = f"restraint {name_of(r.code)} at node {r.node}, which no element has"
            self.findings.leave_out(r.line, f"node {r.node}", text)
        elif key not in self._seen:
            self._seen.add(key)
            other = self.labels.node(r.cnode) or str(r.cnode)
            yield label, other if r.cnode else None
        else:
            text = "restraints that are given twice, with equal values, are one support"
            self.findings.assume(text, r.line)

    def _directions(self, i: int, e: Element, r: Restraint, label: str) -> list[Direction]:
        """Make direction words: one, or two for a guide on a riser at the end of a bend."""
        word = WORDS.get(r.code)
        if word is None:
            word, r = self._stand_in(r)
            if not word:
                return []
        if word in ("+LIM", "-LIM"):
            return self._one_sided(e, r, word)
        if word in ("GUIDE", "LIMIT") and self._follows_owner(i, e, label):
            return self._along_owner(e, r, word)
        if word in ("GUIDE", "LIMIT") and not self._has_pipe(int(label.rstrip("NMF"))):
            text = f"{name_of(r.code)} where no element has a length; left out"
            self.findings.leave_out(r.line, f"node {r.node}", text)
            return []
        return [self._direction(i, e, r, label, word)]

    def _direction(self, i: int, e: Element, r: Restraint, label: str, word: str) -> Direction:
        """Make a direction word; anchors and snubbers are words of their own here."""
        if word == "ANC":
            if r.gap or r.mu:
                text = "an anchor with a gap or friction; taken without"
                self.findings.leave_out(r.line, f"node {r.node}", text)
            return Direction("ANC", k=r.stiffness)
        if word.endswith("SNB"):
            return self._along(r, word[0], Direction(f"SNB{word[0]}", k=r.stiffness))
        if word in ("GUIDE", "LIMIT"):
            along = self._pipe_of(i, label, e)
            return Direction(word, None, (r.gap, r.gap), r.stiffness, None, r.mu or None, along)
        gap = (r.gap, r.gap)
        if word.lstrip("+-")[0] == "R":
            if r.mu:
                text = f"friction on {word}; a rotational support has none"
                self.findings.leave_out(r.line, f"node {r.node}", text)
            if not _is_axis(r.cosines, word[-1]):
                text = f"{word} along a skewed axis; taken about {word[-1]}"
                self.findings.leave_out(r.line, f"node {r.node}", text)
            return Direction(word, None, gap, r.stiffness)
        return self._along(r, word[-1], Direction(word, None, gap, r.stiffness, None, r.mu or None))

    def _stand_in(self, r: Restraint) -> tuple[str, Restraint]:
        """Say that a model has no such support; give the word that stands in for it."""
        word, lost = STAND_INS.get(r.code, ("", ""))
        text = lost or "a model has no such support; left out"
        self.findings.leave_out(r.line, f"node {r.node}", f"restraint {name_of(r.code)}: {text}")
        # its other values are a length, a second stiffness, a load
        return word, replace(r, gap=0.0, mu=0.0)

    def _follows_owner(self, i: int, e: Element, label: str) -> bool:
        """Tell whether a guide or stop stands where the arc has left its element's direction.

        The program takes both from the element that owns them, at the end of its bend as well.
        """
        node = int(label.rstrip("NMF"))
        corner = self.labels.corners.get(node)
        at_end = corner is not None and corner.before == i and label[-1] not in "N"
        return (at_end or not self._has_pipe(node)) and size(e.delta) > 0.0

    def _has_pipe(self, node: int) -> bool:
        """Tell whether a pipe ends at a node itself, without an offset, or has it on its arc."""
        here = self.labels.at.get(node)
        if here is None:
            return True
        return any(
            size(e.delta) and not _arm(e, node) for e in map(self.job.elements.__getitem__, here)
        )

    def _along_owner(self, e: Element, r: Restraint, word: str) -> list[Direction]:
        """Make directions along or across an element, as words of the axes where they are."""
        x, y, z = e.delta
        if word == "LIMIT":
            ways: list[Vec] = [e.delta]
        elif self.job.up == "Y":
            ways = [(-z, 0.0, x)] if abs(x) + abs(z) > FLAT * size(e.delta) else [_X, _Z]
        else:
            ways = [(y, -x, 0.0)] if abs(x) + abs(y) > FLAT * size(e.delta) else [_X, _Y]
        gap, mu = (r.gap, r.gap), r.mu or None
        made = []
        for way in ways:
            unit = _unit(way)
            axis = next((a for k, a in enumerate(_AXES) if abs(unit[k]) == 1.0), None)
            word = axis or f"({','.join(f'{x:g}' for x in unit)})"
            vector = None if axis else unit
            made.append(Direction(word, vector, gap, r.stiffness, None, mu))
        return made

    def _one_sided(self, e: Element, r: Restraint, word: str) -> list[Direction]:
        """Make a line stop of one side: free along its element from FROM to TO, or against it."""
        if size(e.delta) == 0.0:
            text = f"{word} on an element without length; left out"
            self.findings.leave_out(r.line, f"node {r.node}", text)
            return []
        x, y, z = _unit(e.delta)
        text = (
            f"node {r.node}: {word} lets the pipe move {'along' if word[0] == '+' else 'against'}"
        )
        self.findings.assume(f"{text} {e.start}-{e.end} and stops it the other way", r.line)
        vector = f"{word[0]}({x:g},{y:g},{z:g})"
        return [Direction(vector, (x, y, z), (r.gap, r.gap), r.stiffness, None, r.mu or None)]

    def _along(self, r: Restraint, axis: str, made: Direction) -> Direction:
        """Give a direction its own vector where the cosines do not lie along its axis."""
        if _is_axis(r.cosines, axis):
            return made
        c = r.cosines
        length = size(c)
        sign = made.word[0] if made.word[0] in "+-" else ""
        word = f"{sign}({','.join(f'{x:g}' for x in c)})"
        if made.word.startswith("SNB"):
            word = f"SNB{word}"
        if abs(length - 1.0) > 1e-3:
            text = f"direction cosines of length {length:.4g} are taken as a direction"
            self.findings.assume(text, r.line)
        return Direction(word, c, made.gap, made.k, made.kf, made.mu)

    def _pipe_of(self, i: int, label: str, e: Element) -> str | None:
        """Name the element that GUIDE and LIM follow, where others leave in other directions."""
        if label[-1] in "NMF" or label not in (str(e.start), str(e.end)):
            return None
        node = int(label)
        corner = self.labels.corners.get(node)
        if corner is not None:  # the far end of a bend: others than the leaving pipe may turn
            alone = len(self.labels.at[node]) == 2
            return None if alone else "-".join(self.labels.ends(corner.after))
        if not size(e.delta):
            return None
        others = [self.job.elements[j].delta for j in self.labels.at[node]]
        if all(_parallel(e.delta, other) for other in others if size(other)):
            return None
        return "-".join(self.labels.ends(i))

    def _support(
        self, e: Element, label: str, cnode: str | None, members: list[tuple[Restraint, Direction]]
    ) -> None:
        """Make the supports of one node: anchors and snubbers alone, all others together."""
        place = self.findings.place(e.line)
        name = self._name(members[0][0].tag)
        together: list[tuple[Restraint, Direction]] = []
        for r, d in members:
            if d.word == "ANC":
                kr = d.k  # one number for all six freedoms
                made = Support(label, "anchor", (), cnode, name, d.k, kr, place=place)
            elif d.word.startswith("SNB"):
                free = Direction(d.word[3:], d.vector)
                made = Support(label, "snubber", (free,), cnode, name, d.k, place=place)
            elif any(old.word == d.word for _, old in together):
                made = Support(label, "support", (d,), cnode, None, place=place)
            else:
                together.append((r, d))
                continue
            name = None
            self.model.supports.append(made)
            self._note(made, [r])
        if together:
            words = tuple(d for _, d in together)
            made = Support(label, "support", words, cnode, name, place=place)
            self.model.supports.append(made)
            self._note(made, [r for r, _ in together])

    def _note(self, made: Support, members: list[Restraint]) -> None:
        what = ", ".join(f"{name_of(r.code)} (line {r.line})" for r in members)
        tags = dict.fromkeys(r.tag for r in members if r.tag and r.tag != made.name)
        self.findings.note(made, f"restraints {what}" + "".join(f", tag {t}" for t in tags))

    def hanger(self, h: HangerData) -> None:
        """Add a spring hanger; one without rate and load waits for its design."""
        label = self.labels.node(h.node)
        name = f"node {h.node}"
        if label is None:
            self.findings.leave_out(h.line, name, "hanger at a node that no element has")
            return
        cnode = None if not h.cnode else self.labels.node(h.cnode) or str(h.cnode)
        n = max(1, h.number)  # the program multiplies rate and load by the number of hangers
        load = n * (h.constant or h.cold_load)
        line = self.job.elements[self.labels.at[h.node][0]].line if h.node in self.labels.at else 0
        place = self.findings.place(line or h.line)
        if not load:
            self._designed(h, label, cnode, n, place)
            return
        rate = 0.0 if h.constant else n * h.rate
        made = Support(label, "hanger", (), cnode, self._name(h.tag), rate, load=load, place=place)
        self.model.supports.append(made)
        self.findings.note(made, f"hanger of line {h.line}" + f", {n} of them" * (n > 1))

    def _designed(self, h: HangerData, label: str, cnode: str | None, n: int, place: Place) -> None:
        """Add a hanger that the program selects."""
        if h.rate or h.hot_load:
            text = "hanger with a rate or an operating load, but no cold load; designed anew"
            self.findings.leave_out(h.line, f"node {h.node}", text)
        method = "COLD" if h.cold_design else "HOT"
        variation = h.variation / 100.0
        known = h.table in ANVIL
        design = HangerDesign(variation, h.rod, h.most, min(n, 100), method)
        design = replace(design, table="ANVIL") if known else design
        free = [*self._freed(h), None, None]
        design = replace(design, free=free[0], free2=free[1])
        name = self._name(h.tag)
        made = Support(label, "hanger", (), cnode, name, 0.0, place=place, design=design)
        self.model.supports.append(made)
        self.findings.note(made, f"hanger of line {h.line}, to be designed; table {h.table}")
        text = f"hanger table {h.table} is not here: springs are of a generic table, of no maker"
        if known:
            text = "springs of hangers are selected from the program's default table (ANVIL)"
        self.findings.assume(text, h.line)

    def _freed(self, h: HangerData) -> list[str]:
        """Labels of the anchors that the design of a hanger frees."""
        found = []
        for node, code in h.free:
            label = self.labels.node(node)
            if label is None:
                text = f"hanger that frees node {node}, which no element has"
                self.findings.leave_out(h.line, f"node {h.node}", text)
                continue
            found.append(label)
            if code > 1:
                text = f"the hanger at {h.node} frees more than the vertical of {node}: that alone"
                self.findings.assume(f"{text} is freed while the weight is balanced", h.line)
        return found

    def _name(self, tag: str) -> str | None:
        """Take a tag as the name of a support where it can be one and is the only one."""
        fits = _TAG.fullmatch(tag) is not None and tag.isprintable()
        return tag if fits and self._tags[tag] == 1 else None


def _arm(e: Element, node: int) -> bool:
    """Tell whether an element stands off its node."""
    if e.offsets is None:
        return False
    return any(e.offsets.start if node == e.start else e.offsets.end)


def _unit(v: Vec) -> Vec:
    """Unit vector without the noise of the last digits."""
    x, y, z = (round(x / size(v), 12) + 0.0 for x in v)
    return x, y, z


def _is_axis(c: Vec, axis: str) -> bool:
    """Tell whether cosines lie along an axis, either way, or are not given."""
    length = size(c)
    return length == 0.0 or abs(abs(c[_AXES.index(axis)]) / length - 1.0) < 1e-9


def _parallel(a: Vec, b: Vec) -> bool:
    """Tell whether two elements are in line, as Trunnion does for ALONG=."""
    cross = (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )
    return size(cross) <= 5e-4 * size(a) * size(b)
