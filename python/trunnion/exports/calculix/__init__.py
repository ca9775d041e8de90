"""The CalculiX input of a job: beams of type U1, springs on equations, one step a case.

CalculiX makes solids of its ordinary beams, which are another model of the pipe; its element U1
is a beam.
"""

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from trunnion.arrays import CaseResult
from trunnion.exports.calculix.model import model_cards
from trunnion.exports.calculix.numbering import Deck, add_supports, build
from trunnion.exports.calculix.steps import step_cards
from trunnion.exports.scene import Scene, Stand, modulus_ratio, stand

if TYPE_CHECKING:
    from trunnion.exports import Job


def files(job: "Job", stem: str) -> dict[str, bytes]:
    """Write one input file for all cases of a modulus."""
    made = {}
    for name, cases in groups(job.scene, stem).items():
        deck, stands = numbered(job.scene, cases)
        lines = [*_header(job, cases), *model_cards(deck)]
        for case, found in zip(cases, stands, strict=True):
            lines += step_cards(deck, case, found)
        made[f"{name}.inp"] = ("\n".join(lines) + "\n").encode("ascii")
    return made


def groups(scene: Scene, stem: str) -> dict[str, list[CaseResult]]:
    """Cases by the file they go to: those with the same moduli share one."""
    found: dict[bytes, list[CaseResult]] = {}
    for case in scene.cases:
        found.setdefault(modulus_ratio(scene, case).tobytes(), []).append(case)
    names = [f"{stem}_calculix{'' if i == 0 else f'_{i + 1}'}" for i in range(len(found))]
    return dict(zip(names, found.values(), strict=True))


def numbered(scene: Scene, cases: Sequence[CaseResult]) -> tuple[Deck, list[Stand]]:
    """Number pipe and supports of the cases of one file; give the supports of each case."""
    deck, stands = build(scene, cases[0]), [stand(case) for case in cases]
    for found in stands:
        add_supports(deck, found)
    return deck, stands


def _header(job: "Job", cases: Sequence[CaseResult]) -> Iterator[str]:
    from trunnion._version import VERSION

    yield f"** {_plain(job.title or job.source)}: a piping job for CalculiX."
    yield f"** Written by Trunnion {VERSION} from {_plain(job.source)}."
    yield "** From Trunnion are geometry, section properties, flexibility factors of bends, loads,"
    yield "** free strains as forces, and which supports are open, closed, stick or slide."
    yield "** From CalculiX are the stiffness of the beams, the equations and their solution."
    yield "** The shear coefficients make the stiffness of U1 that of Timoshenko's beam, from which"
    yield "** the element departs: it has (1 + f)/(1 - f)^2 where 1/(1 + f) belongs."
    for text in (*job.notes, *(f"LEFT OUT: {problem.text}" for problem in job.left_out)):
        yield f"** {_plain(text)}"
    for i, case in enumerate(cases, 1):
        yield f"** step {i}: {_plain(case.name)} = {_plain(case.text)}"


def _plain(text: str) -> str:
    """One printable line; a comment ends with it."""
    return ascii(text)[1:-1]
