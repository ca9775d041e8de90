"""Restraints as direction words of the model: what each code holds, and along what."""

from dataclasses import replace

from trunnion.formats.caesar.codes import STAND_INS, WORDS, name_of
from trunnion.formats.caesar.geometry import Labels, size
from trunnion.formats.caesar.job import Element, Job, Restraint, Vec
from trunnion.formats.findings import Findings
from trunnion.model import Direction

_AXES = "XYZ"
MOST_FRICTION = 2.0  # as in a deck
FLAT = 1e-4  # an element with less of its length in the plane of the ground is a riser
_X, _Y, _Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


class Directions:
    """Makes the direction words of restraints."""

    def __init__(self, job: Job, labels: Labels, findings: Findings) -> None:
        self.job = job
        self.labels = labels
        self.findings = findings

    def of(self, i: int, e: Element, r: Restraint, label: str) -> list[Direction]:
        """Make direction words: one, or two for a guide on a riser at the end of a bend."""
        word = WORDS.get(r.code)
        if word is None:
            word, r = self._stand_in(r)
            if not word:
                return []
        if r.mu > MOST_FRICTION:
            text = f"node {r.node}: a friction coefficient of {r.mu:g} is above {MOST_FRICTION:g}"
            self.findings.fault(r.line, text)
        if word in ("+LIM", "-LIM"):
            return self._one_sided(e, r, word)
        node = int(label.rstrip("NMF"))
        alone = node not in self.labels.at
        if word in ("GUIDE", "LIMIT") and not alone and self._follows_owner(i, e, label):
            return self._along_owner(e, r, word)
        if word in ("GUIDE", "LIMIT") and not self._has_pipe(node):
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
        An owner that a stiff link joins to the node has lost that end.
        """
        node = int(label.rstrip("NMF"))
        if node not in (e.start, e.end):
            return size(e.delta) > 0.0
        corner = self.labels.corners.get(node)
        at_end = corner is not None and corner.before == i and label[-1] not in "N"
        return (at_end or not self._has_pipe(node)) and size(e.delta) > 0.0

    def _has_pipe(self, node: int) -> bool:
        """Tell whether a pipe ends at a node itself, without an offset, or has it on its arc."""
        here = self.labels.at.get(node)
        if here is None:  # of CNODEs alone
            return False
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
            return None if alone else self.labels.pipe_at(corner.after, node)
        if not size(e.delta):
            return None
        others = [self.job.elements[j].delta for j in self.labels.at[node]]
        if all(_parallel(e.delta, other) for other in others if size(other)):
            return None
        return self.labels.pipe_at(i, node)


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
