"""Formulas as MathML, which browsers draw themselves: no script, no font and no picture."""

from typing import Any

from docutils.nodes import SkipNode
from docutils.utils.math.latex2mathml import tex2mathml


def _inline(visitor: Any, node: Any) -> None:
    visitor.body.append(tex2mathml(node.astext()))
    raise SkipNode


def _display(visitor: Any, node: Any) -> None:
    visitor.body.append(f'<div class="formula">{tex2mathml(node.astext(), as_block=True)}</div>\n')
    raise SkipNode


def setup(app: Any) -> dict[str, bool]:
    """Hand the renderer to Sphinx."""
    app.add_html_math_renderer("mathml", (_inline, None), (_display, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
