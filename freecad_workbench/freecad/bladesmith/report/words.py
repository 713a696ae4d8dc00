"""What a report comes to, in words."""

from ..model import Report
from ..model.words import counted, direction

_TANGENT_DEG = 0.1
"""A tangent joint opened by more than this is named."""


def state(report: Report, tolerance_mm: float) -> str:
    """``bad``: not to be used as it is; ``odd``: with warnings or opened joints; else ``good``."""
    solid = report.solid
    unsound = not solid["closed"] or solid["valid"] is False or solid["folded"]
    if unsound or report.misses(tolerance_mm):
        return "bad"
    return "odd" if report.warnings or opened(report) else "good"


def way(report: Report) -> str:
    """The factor and which way it moved the part."""
    factor = report.input["factor"]
    return f"factor {factor:g}: {direction(factor)}"


def opened(report: Report) -> list:
    """Tangent edges whose angle grew beyond what still counts as tangent."""
    return [
        edge
        for edge in report.edges
        if edge.tangent and edge.angle_deg.after > edge.angle_deg.before + _TANGENT_DEG
    ]


def sentences(report: Report, tolerance_mm: float) -> list[str]:
    """The verdict: the main sentence first."""
    solid = report.solid
    deviation = report.deviation_mm
    worst = report.worst_face()
    place = f" (on {worst.name})" if worst else ""
    said = f"The largest deviation at the nodes is {length(deviation.max)} mm{place}"
    if report.misses(tolerance_mm):
        found = [f"{said}: beyond the tolerance of {tolerance_mm:g} mm."]
    else:
        found = [f"{said}, within the tolerance of {tolerance_mm:g} mm."]
    if solid["folded"]:
        found.insert(0, f"The result is folded, not to be used: {_folds(solid)}.")
    found.append(_solid_sentence(solid))
    edge = report.widest_edge()
    if edge:
        found.append(
            f"No edge is open by more than {length(edge.gap_mm.after)} mm "
            f"(Edge{edge.index}; {length(edge.gap_mm.before)} mm before)."
        )
    found += _tangency_sentences(report)
    if report.unmatched:
        nodes = counted(report.unmatched, "node")
        found.append(f"On no face: {nodes} of the mesh's surface.")
    return found


def _solid_sentence(solid: dict) -> str:
    judged = {
        True: "Open CASCADE finds the solid valid",
        False: "Open CASCADE finds the solid not valid",
        None: "The solid was not judged",
    }[solid["valid"]]
    closed = "closed" if solid["closed"] else "open"
    folds = "" if solid["folded"] else ", and nothing is folded"
    return f"{judged}; it is {closed}, has {counted(solid['faces'], 'face')}{folds}."


def _folds(solid: dict) -> str:
    return f"{counted(solid['folded'], 'sampled normal')} turned against the input's"


def _tangency_sentences(report: Report) -> list[str]:
    """Joints beside held faces apart: a face that stays beside one that moves asks for a kink."""
    tangent = [edge for edge in report.edges if edge.tangent]
    if not tangent:
        return ["The part has no tangent joints."]
    bad = opened(report)
    free, held = ([edge for edge in bad if edge.held == side] for side in (False, True))
    kept = f"stay tangent within {_TANGENT_DEG:g}°."
    found = []
    if free:
        found.append(f"{len(free)} of {len(tangent)} tangent joints opened: {_names(free)}.")
    elif held:
        found.append(f"All tangent joints but those beside held faces {kept}")
    else:
        found.append(f"All {len(tangent)} tangent joints {kept}")
    if held:
        most = max(edge.angle_deg.after - edge.angle_deg.before for edge in held)
        found.append(f"Beside held faces, {_names(held)} opened by up to {most:.2g}°.")
    return found


def _names(edges: list) -> str:
    names = [f"Edge{edge.index}" for edge in edges[:8]]
    return ", ".join(names) + (" and others" if len(edges) > 8 else "")


def length(value: float) -> str:
    """A small length: two digits, as a power of ten where it is short of 0.001."""
    return f"{value:.1e}" if 0 < abs(value) < 1e-3 else f"{value:.4g}"
