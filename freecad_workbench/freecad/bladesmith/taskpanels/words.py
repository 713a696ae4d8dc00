"""What a check and a result come to, in a few lines for a panel (rich text)."""

import re
from html import escape

from FreeCAD import Qt

from ..model import Report
from ..report import words

_GOOD, _ODD, _BAD = "#2e7d32", "#b26a00", "#c62828"
_STATES = {"good": _GOOD, "odd": _ODD, "bad": _BAD}


def translate(text: str) -> str:
    """``text`` in the user's language."""
    return Qt.translate("Bladesmith", text)


def for_panel(text: str) -> str:
    """A message of the core with the panel's fields in place of the command line's options."""
    fields = {
        r"--field-unit (\w+)": translate("Length unit: {0}"),
        r"--displacement-scale (\d+)": translate("Scale: {0}"),
        r"--displacement-scale": translate("the field Scale"),
        r"--solid N": translate("the field Solid"),
        r"--match-tolerance": translate("a larger value at Match within"),
        r"--extrapolate": translate("a tick at Extrapolate"),
    }
    for option, field in fields.items():
        text = re.sub(option, lambda found, f=field: f.format(*found.groups()), text)
    return text


def error(text: str) -> str:
    """An error: the reason and what to do, as the core says it."""
    return _line(for_panel(text), _BAD)


def plain(text: str) -> str:
    """A line without a judgement."""
    return _line(text)


def check(info: dict, placement: dict) -> str:
    """What the field holds, how it lies on the part, and what to expect."""
    largest = info["largest_displacement"]
    place = ", ".join(f"{c:.4g}" for c in largest["at"])
    steps = translate("step {0} of {1}").format(info["step"], max(len(info["steps"]), 1))
    foot = placement["foot_mm"]
    lines = [
        _line(
            translate("{0}: {1} nodes with a displacement, {2}").format(
                info["format"], info["nodes_with_result"], steps
            )
        ),
        _line(
            translate("Largest displacement {0} at node {1} ({2})").format(
                f"{largest['value']:.4g}", largest["node"], place
            )
        ),
        _line(
            translate("{0} nodes lie on the part, within {1} mm").format(
                placement["nodes_on_faces"], words.length(foot["max"])
            ),
            _GOOD,
        ),
    ]
    if placement["unmatched_nodes"]:
        text = translate("{0} nodes of the mesh's surface lie on no face")
        lines.append(_line(text.format(placement["unmatched_nodes"]), _ODD))
    bare = placement["faces_without_nodes"]
    if bare:
        names = ", ".join(f"Face{face}" for face in bare[:8]) + (" …" if len(bare) > 8 else "")
        lines.append(_line(translate("Faces without nodes: {0}").format(names), _ODD))
    return "".join([*lines, *(_warning(text) for text in placement["warnings"])])


def result(report: Report, tolerance_mm: float) -> str:
    """The verdict of a report, and its warnings."""
    said = words.sentences(report, tolerance_mm)
    first = _line(f"<b>{escape(said[0])}</b>", _STATES[words.state(report, tolerance_mm)], False)
    return "".join([first, *map(_line, said[1:]), *map(_warning, report.warnings)])


def _warning(text: str) -> str:
    return _line(translate("Warning: {0}").format(for_panel(text)), _ODD)


def _line(text: str, colour: str = "", plain: bool = True) -> str:
    style = f"margin:2px 0;{f'color:{colour}' if colour else ''}"
    return f'<p style="{style}">{escape(text) if plain else text}</p>'
