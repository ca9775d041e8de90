"""Restraints of the job as supports of the model."""

import re
from collections import Counter
from collections.abc import Iterator
from math import pi

from trunnion.formats.caesar.codes import name_of
from trunnion.formats.caesar.directions import Directions
from trunnion.formats.caesar.geometry import Labels
from trunnion.formats.caesar.job import Element, Job, Restraint
from trunnion.formats.caesar.units import INCH, clean
from trunnion.formats.findings import Findings
from trunnion.model import Direction, Model, Support

BY_DEGREE = INCH**2 * 180.0 / pi  # in-lb/deg for lb/in, in SI [m2]
_TAG = re.compile(r"[^\s=!&(),\"']{1,64}")


class Restraints:
    """Collects the restraints of all elements; those of a node and CNODE make one support."""

    def __init__(self, job: Job, labels: Labels, model: Model, findings: Findings) -> None:
        self.job = job
        self.labels = labels
        self.model = model
        self.findings = findings
        self.directions = Directions(job, labels, findings)
        self._seen: set[tuple[object, ...]] = set()
        self._tags = Counter(r.tag for e in job.elements for r in e.restraints)
        self._tags.update(h.tag for h in job.hangers)

    def element(self, i: int) -> None:
        """Add the supports of one element's restraints."""
        e = self.job.elements[i]
        groups: dict[tuple[str, str | None], list[tuple[Restraint, Direction]]] = {}
        for r in e.restraints:
            for label, cnode in self._places(e, r):
                for direction in self.directions.of(i, e, r, label):
                    groups.setdefault((label, cnode), []).append((r, direction))
        for (label, cnode), members in groups.items():
            self._support(e, label, cnode, members)

    def _places(self, e: Element, r: Restraint) -> Iterator[tuple[str, str | None]]:
        """Give the labels of the node and CNODE, once for each different restraint."""
        label = self.labels.standing(r.node)
        key = (r.node, r.code, r.stiffness, r.gap, r.mu, r.cnode, r.cosines)
        if label is None:
            text = f"restraint {name_of(r.code)} at node {r.node}, which no element has"
            self.findings.leave_out(r.line, f"node {r.node}", text)
        elif key not in self._seen:
            self._seen.add(key)
            yield label, self.labels.cnode(r.cnode, r.line, f"restraint {name_of(r.code)}")
        else:
            text = "restraints that are given twice, with equal values, are one support"
            self.findings.assume(text, r.line)

    def _support(
        self, e: Element, label: str, cnode: str | None, members: list[tuple[Restraint, Direction]]
    ) -> None:
        """Make the supports of one node: anchors and snubbers alone, all others together."""
        place = self.findings.place(e.line)
        name = self.name(members[0][0].tag)
        together: list[tuple[Restraint, Direction]] = []
        for r, d in members:
            if d.word == "ANC":
                kr = None if d.k is None else clean(BY_DEGREE * d.k)
                if kr is not None:
                    text = "the stiffness of an anchor is that of all six freedoms, one number in "
                    self.findings.assume(f"{text}lb/in and in-lb/deg", r.line)
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

    def name(self, tag: str) -> str | None:
        """Take a tag as the name of a support where it can be one and is the only one."""
        fits = _TAG.fullmatch(tag) is not None and tag.isprintable()
        return tag if fits and self._tags[tag] == 1 else None
