"""The OpenSeesPy script of a job: a text that stands alone, its data at its end."""

import ast
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from trunnion.exports.opensees.tables import job_lines

if TYPE_CHECKING:
    from trunnion.exports import Job

HERE = Path(__file__).parent
PARTS = (
    *("../agreement.py", "parts/vectors.py", "parts/frame.py", "parts/structure.py"),
    *("parts/loads.py", "parts/laws.py", "parts/friction.py", "parts/answer.py"),
    "parts/command.py",
)


def files(job: "Job", stem: str) -> dict[str, bytes]:
    """Write the script under the deck's name."""
    return {f"{stem}_opensees.py": script(job, stem).encode("ascii")}


def script(job: "Job", stem: str) -> str:
    """Write the script: what it is, the program, then the job's own numbers."""
    about = _in_docstring("\n".join(_header(job, stem)))
    data = ["JOB = {", *job_lines(job.scene, job.source), "}"]
    return "\n".join(
        (
            f'"""{about}\n"""\n',
            program([HERE / part for part in PARTS]),
            "\n\n# " + "-" * 70 + " the job",
            *data,
            '\nif __name__ == "__main__":\n    sys.exit(main(JOB))\n',
        )
    )


def program(modules: Sequence[Path]) -> str:
    """Join modules to one: imports of Python's library on top, those of each other left out."""
    imports: dict[str, set[str]] = {}
    bodies: list[str] = []
    for path in modules:
        text = path.read_text(encoding="utf-8")
        lines, tree = text.splitlines(), ast.parse(text)
        for node in reversed(tree.body):
            if isinstance(node, ast.ImportFrom):
                own = (node.module or "").startswith("trunnion.")
                names = set() if own else {alias.name for alias in node.names}
                imports.setdefault(f"from {node.module} import", set()).update(names)
            elif isinstance(node, ast.Import):
                imports.setdefault("import", set()).update(alias.name for alias in node.names)
            elif not isinstance(node, ast.Expr):
                continue
            assert node.end_lineno is not None
            del lines[node.lineno - 1 : node.end_lineno]
        title = (ast.get_docstring(tree) or "").partition("\n")[0]
        bodies.append(f"# {'-' * 8} {title}\n" + "\n".join(lines).strip())
    top = [f"import {name}" for name in sorted(imports.pop("import"))]
    top += [f"{name} {', '.join(sorted(what))}" for name, what in sorted(imports.items()) if what]
    return "\n\n\n".join(["\n".join(top), *bodies])


def _header(job: "Job", stem: str) -> Iterable[str]:
    """What the script came from, what it represents and what not."""
    from trunnion._version import VERSION

    yield f"{job.title or job.source}: a piping job for OpenSees (OpenSeesPy)."
    yield ""
    yield f"Written by Trunnion {VERSION} from {job.source}.  Needs: pip install openseespy"
    yield ""
    yield f"    python {stem}_opensees.py"
    yield "        solves and prints every case, and writes the answers beside the script"
    yield f"    python {stem}_opensees.py --compare {stem}.json"
    yield "        compares them with a report of trunnion run, too"
    yield ""
    yield "From Trunnion are: geometry, section properties, flexibility factors of bends, loads by"
    yield "weight, free strains by temperature and pressure.  From OpenSees are: the stiffness of"
    yield "every element, the equations and their solution, and the state of every support with one"
    yield "side or a gap.  Units: N, m, rad.  Rigid supports are springs as in Trunnion."
    yield "Forces of supports act on the pipe, end forces on the element.  Data stand at the end."
    for text in (*job.notes, *(f"LEFT OUT: {problem.text}" for problem in job.left_out)):
        yield f"- {text}"


def _in_docstring(text: str) -> str:
    """Text without what could end a docstring or start an escape."""
    plain = text.encode("ascii", "replace").decode()
    return plain.replace("\\", "/").replace('"', "'")
