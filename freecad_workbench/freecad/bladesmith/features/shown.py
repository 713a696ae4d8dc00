"""What a computed morph offers to be shown: its report, both solids, and arrays by node."""

from ..model import Report
from ..native import InputError
from ..occ.step import nearest_solid

_OUTPUTS = ("ReportJson", "NodeIds", "NodeFaces", "NodeFeet", "NodeDisplacements", "NodeDeviations")


def has_result(obj) -> bool:
    """Whether ``obj`` is a morph that was computed."""
    return all(hasattr(obj, name) for name in _OUTPUTS) and bool(obj.ReportJson)


def is_current(obj) -> bool:
    """Whether its result belongs to its inputs as they are now."""
    return not {"Touched", "Invalid"} & set(obj.State)


def report(obj) -> Report:
    """The figures of the last computation."""
    return Report.of_text(obj.ReportJson)


def solids(obj) -> tuple:
    """The solid before and after. Raises :class:`InputError` where they no longer match."""
    after = obj.Shape
    found = obj.Source.Shape.Solids if obj.Source else []
    before = found[nearest_solid(found, after)] if found else None
    if before is None or not _alike(before, after):
        raise InputError(
            f"{obj.Label}: its source is not the solid it was computed from; recompute it"
        )
    return before, after


def nodes(obj) -> dict:
    """Arrays by node and face: ids, faces from 1, feet, displacements, deviations (mm)."""
    import numpy

    from ..occ.tessellation import vectors

    return {
        "ids": numpy.array(obj.NodeIds, dtype=numpy.int64),
        "faces": numpy.array(obj.NodeFaces, dtype=numpy.int64),
        "feet": vectors(obj.NodeFeet),
        "displacements": vectors(obj.NodeDisplacements),
        "deviations": vectors(obj.NodeDeviations),
    }


def _alike(before, after) -> bool:
    counts = [(len(s.Faces), len(s.Edges), len(s.Vertexes)) for s in (before, after)]
    return counts[0] == counts[1]
