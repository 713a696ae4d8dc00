"""What a check and a result come to, in a few lines for a panel (rich text)."""

import re
from html import escape

from FreeCAD import Qt

from ..features.naming import in_property_names
from ..model import Report
from ..model.words import way
from ..report import words
from .core_texts import localised

_GOOD, _ODD, _BAD, _GREY = "#2e7d32", "#b26a00", "#c62828", "#808080"
TRANSLATED = (
    "placing nodes on faces",
    "fitting each face",
    "fitting all faces together",
    "fitting without every tenth node",
    "rebuilding the solid",
    "measuring the result",
    "drawing",
    "cold to hot",
    "hot to cold",
    "nothing moves",
)
"""Stages of a morph, as the core names them, and which way it goes."""


def translate(text: str) -> str:
    """``text`` in the user's language."""
    return Qt.translate("Bladesmith", text)


def for_panel(text: str) -> str:
    """A message with the panel's fields in place of properties and options."""
    text = in_property_names(localised(text, translate))
    fields = {
        "FieldUnit": translate("Length unit:"),
        "DisplacementScale": translate("Scale"),
        "MatchTolerance": translate("a larger value at Match within"),
        "Extrapolate": translate("a tick at Extrapolate"),
    }
    return re.sub("|".join(fields), lambda found: fields[found.group()], text)


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
    if placement["unmatched_nodes"] and info["surface_nodes"] is not None:
        text = translate("{0} nodes of the mesh's surface lie on no face")
        lines.append(_line(text.format(placement["unmatched_nodes"]), _ODD))
    bare = placement["faces_without_nodes"]
    if bare:
        names = ", ".join(f"Face{face}" for face in bare[:8]) + (" …" if len(bare) > 8 else "")
        lines.append(_line(translate("Faces without nodes: {0}").format(names), _ODD))
    return "".join([*lines, *(_warning(text) for text in placement["warnings"])])


def result(report: Report, tolerance_mm: float, current: bool) -> str:
    """The verdict of a report, and its warnings; all in grey where the input is another by now."""
    text = "".join([verdict(report, tolerance_mm), *map(_warning, report.warnings)])
    if current:
        return text
    grey = re.sub(r"color:#\w+", f"color:{_GREY}", text)
    return f'{outdated()}<div style="color:{_GREY}">{grey}</div>'


def outdated() -> str:
    """That a result is not that of the input as it is."""
    return _line(translate("The input has changed since. The result before the change:"), _ODD)


def verdict(report: Report, tolerance_mm: float) -> str:
    """How well a result meets the field, its solid, its gaps and tangent joints."""
    worst, solid = report.worst_face(), report.solid
    if report.misses(tolerance_mm):
        text = translate("Largest deviation {0} mm, on {1}: beyond the tolerance of {2} mm")
    else:
        text = translate("Largest deviation {0} mm, on {1}: within the tolerance of {2} mm")
    text = text.format(words.length(report.deviation_mm.max), worst.name, f"{tolerance_mm:g}")
    lines = [_line(text, _BAD if report.misses(tolerance_mm) else _GOOD)]
    if solid["folded"]:
        lines.insert(0, _line(translate("The result is folded: not to be used"), _BAD))
    sound = solid["valid"] and solid["closed"]
    lines.append(
        _line(translate("The solid is valid and closed"), _GOOD)
        if sound
        else _line(translate("The solid is not valid, or open"), _BAD)
    )
    factor = report.input["factor"]
    lines.append(_line(translate("Factor {0}").format(f"{factor:g}: {translate(way(factor))}")))
    if report.holdout_mm:
        text = translate("Hold-out error: mean {0} mm, largest {1} mm, on {2}")
        figures = (words.length(value) for value in (report.holdout_mm.mean, report.holdout_mm.max))
        lines.append(_line(text.format(*figures, report.worst_holdout_face().name)))
    edge = report.widest_edge()
    if edge:
        text = translate("Largest gap {0} mm, at Edge{1}; {2} mm before")
        gap = edge.gap_mm
        lines.append(
            _line(text.format(words.length(gap.after), edge.index, words.length(gap.before)))
        )
    opened, tangent = words.opened(report), [edge for edge in report.edges if edge.tangent]
    if tangent:
        text = translate("{0} of {1} tangent joints opened")
        colour = _ODD if opened else ""
        lines.append(_line(text.format(len(opened), len(tangent)), colour))
    return "".join(lines)


def _warning(text: str) -> str:
    return _line(translate("Warning: {0}").format(for_panel(text)), _ODD)


def _line(text: str, colour: str = "") -> str:
    style = f"margin:2px 0;color:{colour}" if colour else "margin:2px 0"
    return f'<p style="{style}">{escape(text)}</p>'
