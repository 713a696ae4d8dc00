"""Equations of the pages as MathML, which browsers draw without a script: ``$…$`` within a line,
``$$…$$`` as a paragraph. They stay out of Markdown's sight: it would read their underscores."""

import re

from latex2mathml.converter import convert

_CODE = re.compile(r"(^```.*?^```|`[^`\n]*`)", re.DOTALL | re.MULTILINE)
_BLOCK = re.compile(r"\$\$(.+?)\$\$", re.DOTALL)
_INLINE = re.compile(r"\$(?=\S)([^$]+?)(?<=\S)\$")
_PLACE = re.compile(r"equation(\d+)noitauqe")

_equations: list[str] = []


def _set_aside(display: str):
    def place(match: re.Match) -> str:
        _equations.append(convert(match[1].strip(), display=display))
        return f"equation{len(_equations) - 1}noitauqe"

    return place


def on_page_markdown(markdown: str, **_) -> str:
    """Called by MkDocs with the source of each page; code is left alone."""
    parts = _CODE.split(markdown)
    for k in range(0, len(parts), 2):
        parts[k] = _BLOCK.sub(_set_aside("block"), parts[k])
        parts[k] = _INLINE.sub(_set_aside("inline"), parts[k])
    return "".join(parts)


def on_page_content(html: str, **_) -> str:
    """Called by MkDocs with each page's HTML."""
    return _PLACE.sub(lambda match: _equations[int(match[1])], html)
