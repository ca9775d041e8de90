"""Docstrings as the house writes them: "name : what it is", in sections and straight below a class.

numpydoc reads what stands behind the colon as a type; here it is the meaning, with shape and unit.
"""

import inspect
import re
from typing import Any

ENTRY = re.compile(r"^([A-Za-z_][\w, ]{0,60}?) : (.+)$")
RULE = re.compile(r"^-{3,}$")


def rewritten(lines: list[str]) -> list[str]:
    """Sections become bold heads, entries bullets with the name as code; text stays text."""
    out: list[str] = []
    section = False
    for line, following in zip(lines, [*lines[1:], ""], strict=True):
        entry = ENTRY.match(line)
        if RULE.match(line):
            continue
        if RULE.match(following) and line.strip():
            section = True
            out += ["", f"**{line.strip()}**", ""]
        elif entry:
            out += ["", f"- {_code(entry[1])}: {_safe(entry[2])}"]
        elif section and line.strip() and not line.startswith(" "):
            head = following.startswith("    ")  # a name with its meaning below
            out += ["", f"- {_code(line) + ':' if head else _safe(line)}"]
        elif line.startswith("    ") and out and out[-1].startswith(("- ", "  ")):
            out.append(f"  {_safe(line.strip())}")
        elif not line.startswith((" ", ">>>")) and out and out[-1].startswith(("- ", "  ")):
            out += ["", _safe(line)]
        else:
            out.append(_safe(line))
    return out


def _code(names: str) -> str:
    return ", ".join(f"``{name.strip()}``" for name in names.split(","))


def _safe(text: str) -> str:
    """Set `this` as code, and take their meaning from bars, stars and underlines outside of it."""
    parts = re.split(r"``?([^`]+)``?", text)
    for i, part in enumerate(parts):
        parts[i] = f"``{part}``" if i % 2 else re.sub(r"([|*]|_(?=\W|$))", r"\\\1", part)
    return "".join(parts)


ARRAY = re.compile(r"~?numpy\.ndarray\[tuple\[~?typing\.Any, \.\.\.\], ~?numpy\.dtype\[[^\]]+\]\]")
FIELD = re.compile(r"^    (\w+): ([^=#]+?)(?: = [^#]*?)?(?:  # (.+))?$", re.MULTILINE)
OWN = ("Model",)  # its fields are records that its methods make


def fields(obj: Any, said: list[str]) -> list[str]:
    """List the fields of a data class that its docstring does not explain, with their comments."""
    known = {name for line in said for name in re.findall(r"``(\w+)``", line)}
    found = [
        f"- ``{name}`` (``{kind.strip()}``)" + (f": {_safe(comment)}" if comment else "")
        for name, kind, comment in FIELD.findall(inspect.getsource(obj).split("\n    def ")[0])
        if name in obj.__dataclass_fields__ and name not in known
    ]
    return ["", "**Fields**", "", *found, ""] if found else []


def _process(app: Any, what: str, name: str, obj: Any, options: Any, lines: list[str]) -> None:
    lines[:] = rewritten(lines)
    if what == "class" and _is_data(obj) and obj.__name__ not in OWN:
        lines[:] = ["**Fields**" if line == "**Parameters**" else line for line in lines]
        lines += fields(obj, lines)


def _is_data(obj: Any) -> bool:
    return hasattr(obj, "__dataclass_fields__")


def _signature(
    app: Any, what: str, name: str, obj: Any, options: Any, words: str | None, back: str | None
) -> tuple[str | None, str | None]:
    """Leave out what makes a result, which a user never does, and what arrays are made of."""
    if what == "class" and _is_data(obj):
        return "", ""
    return _short(words), _short(back)


def _short(text: str | None) -> str | None:
    return text and ARRAY.sub("~numpy.ndarray", text)


def setup(app: Any) -> dict[str, bool]:
    """Hand the rewriting to autodoc."""
    app.connect("autodoc-process-docstring", _process)
    app.connect("autodoc-process-signature", _signature)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
