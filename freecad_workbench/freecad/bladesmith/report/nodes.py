"""Values at the finite-element nodes carried over to the points of a picture's triangles."""

import numpy

from ..occ.tessellation import Tessellation

_NEIGHBOURS = 4
_BATCH = 4_000_000


def at_mesh_points(mesh: Tessellation, nodes: dict, values: numpy.ndarray) -> numpy.ndarray:
    """Values, given by node and face, at the points of ``mesh``.

    Inverse squared distance to the nearest nodes of the same face; NaN on faces without nodes.
    """
    out = numpy.full((len(mesh.points), *values.shape[1:]), numpy.nan)
    for face in numpy.unique(mesh.faces):
        here = numpy.flatnonzero(mesh.faces == face)
        there = numpy.flatnonzero(nodes["faces"] == face)
        if len(there):
            out[here] = _weighted(mesh.points[here], nodes["feet"][there], values[there])
    return out


def _weighted(points, feet, values) -> numpy.ndarray:
    step = max(1, _BATCH // len(feet))
    parts = [
        _weighted_batch(points[start : start + step], feet, values)
        for start in range(0, len(points), step)
    ]
    return numpy.concatenate(parts)


def _weighted_batch(points, feet, values) -> numpy.ndarray:
    centre = feet.mean(axis=0)
    points, feet = points - centre, feet - centre
    squares = (points**2).sum(1)[:, None] + (feet**2).sum(1) - 2 * points @ feet.T
    count = min(_NEIGHBOURS, len(feet))
    nearest = numpy.argpartition(squares, count - 1, axis=1)[:, :count]
    found = numpy.maximum(numpy.take_along_axis(squares, nearest, 1), 0)
    weights = 1 / (found + 1e-9 * max(float((feet**2).sum(1).max()), 1e-300))
    weights /= weights.sum(axis=1, keepdims=True)
    if values.ndim == 2:
        weights = weights[..., None]
    return (values[nearest] * weights).sum(axis=1)
