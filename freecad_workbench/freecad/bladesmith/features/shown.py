"""What a computed morph offers to be shown: its report, both solids, and arrays by node."""

from ..model import Report
from ..native import InputError
from ..occ.step import nearest_solid

NODE_ARRAYS = ("ids", "faces", "feet", "displacements", "deviations")
"""Numbers (n,) of nodes and of their faces from 1; vectors (n, 3)."""

_OUTPUTS = ("ReportJson", *(f"Node{name.capitalize()}" for name in NODE_ARRAYS))


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
    if not found:
        raise InputError(
            f"{obj.Label}: the source of this result is gone; choose one and morph again"
        )
    before = found[nearest_solid(found, after)]
    if not _alike(before, after):
        raise InputError(
            f"{obj.Label}: its source is not the solid it was computed from; recompute it"
        )
    return before, after


def node_array(obj, name: str):
    """One of :data:`NODE_ARRAYS`, row by row for each node on a face; lengths in mm."""
    import numpy

    from ..occ.tessellation import vectors

    rows = getattr(obj, f"Node{name.capitalize()}")
    return numpy.array(rows, dtype=int) if name in ("ids", "faces") else vectors(rows)


def nodes(obj) -> dict:
    """All of :data:`NODE_ARRAYS` by name."""
    return {name: node_array(obj, name) for name in NODE_ARRAYS}


def _alike(before, after) -> bool:
    counts = [(len(s.Faces), len(s.Edges), len(s.Vertexes)) for s in (before, after)]
    return counts[0] == counts[1]
