"""Equations of the pages as MathML, which browsers draw without a script: ``$…$`` within a line,
``$$…$$`` as a paragraph. They stay out of Markdown's sight: it would read their underscores."""

import re

from latex2mathml.converter import convert

_CODE = re.compile(r"(^```.*?^```|`[^`\n]*`)", re.DOTALL | re.MULTILINE)
_BLOCK = re.compile(r"\$\$(.+?)\$\$", re.DOTALL)
_INLINE = re.compile(r"\$(?=\S)([^$]+?)(?<=\S)\$")
_PLACE = re.compile(r"equation(\d+)noitauqe")

_BOLD = re.compile(r'<mi mathvariant="bold">([A-Za-z])</mi>')
_PRIMED = re.compile(r"<msup>(<mi.*?</mi>)<mi>&#x02032;</mi></msup>")

_equations: list[str] = []


def _bold(match: re.Match) -> str:
    """A letter of Unicode's bold alphabet: browsers know no other bold in equations."""
    letter, code = ("A", 0x1D400) if match[1].isupper() else ("a", 0x1D41A)
    return f"<mi>&#x{ord(match[1]) - ord(letter) + code:X};</mi>"


def _mathml(latex: str, display: str) -> str:
    mathml = _BOLD.sub(_bold, convert(latex, display=display))
    # The sign is small and raised by itself: as an exponent it would be so twice.
    return _PRIMED.sub(r'\1<mo lspace="0" rspace="0">&#x02032;</mo>', mathml)


def _set_aside(display: str):
    def place(match: re.Match) -> str:
        _equations.append(_mathml(match[1].strip(), display))
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
