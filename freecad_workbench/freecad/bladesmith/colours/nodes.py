"""Values at the finite-element nodes carried over to the points of a picture's triangles."""

import numpy

from ..occ.tessellation import Tessellation

_NEIGHBOURS = 4
_BLOCK = 256
"""Points looked at together: few enough to lie close to each other."""


def at_mesh_points(mesh: Tessellation, nodes: dict, values: numpy.ndarray) -> numpy.ndarray:
    """Values, given by node and face, at the points of ``mesh``.

    Inverse squared distance to the nearest nodes of the same face; NaN on faces without nodes.
    """
    out = numpy.full((len(mesh.points), *values.shape[1:]), numpy.nan)
    for face in numpy.unique(mesh.faces):
        here = numpy.flatnonzero(mesh.faces == face)
        there = numpy.flatnonzero(nodes["faces"] == face)
        if len(there):
            out[here] = weighted(mesh.points[here], nodes["feet"][there], values[there])
    return out


def weighted(points: numpy.ndarray, feet: numpy.ndarray, values: numpy.ndarray) -> numpy.ndarray:
    """Values given at ``feet`` (n, 3), at least one, at ``points``: as :func:`at_mesh_points`."""
    out = numpy.empty((len(points), *values.shape[1:]))
    offset = 1e-9 * max(float((numpy.ptp(feet, axis=0) ** 2).sum()), 1e-300)
    for block in _blocks(points):
        near = _candidates(points[block], feet)
        out[block] = _weighted_block(points[block], feet[near], values[near], offset)
    return out


def _blocks(points: numpy.ndarray):
    """Index arrays of points that lie close together, halved along the longest side."""
    open_blocks = [numpy.arange(len(points))]
    while open_blocks:
        block = open_blocks.pop()
        if len(block) <= _BLOCK:
            if len(block):
                yield block
            continue
        inside = points[block]
        along = inside[:, int(numpy.argmax(numpy.ptp(inside, axis=0)))]
        half = len(block) // 2
        order = numpy.argpartition(along, half)
        open_blocks += [block[order[:half]], block[order[half:]]]


def _candidates(points: numpy.ndarray, feet: numpy.ndarray) -> numpy.ndarray:
    """The feet among which the nearest ones of every point are sure to be."""
    centre = (points.min(axis=0) + points.max(axis=0)) / 2
    radius = numpy.linalg.norm(points - centre, axis=1).max()
    distances = numpy.linalg.norm(feet - centre, axis=1)
    count = min(_NEIGHBOURS, len(feet))
    # A point's own nearest are at most one radius farther from it than the centre's are from the
    # centre, and at most another radius farther from the centre.
    reach = numpy.partition(distances, count - 1)[count - 1] + 2 * radius
    return numpy.flatnonzero(distances <= reach * (1 + 1e-12))


def _weighted_block(points, feet, values, offset: float) -> numpy.ndarray:
    centre = points.mean(axis=0)
    points, feet = points - centre, feet - centre
    squares = (points**2).sum(1)[:, None] + (feet**2).sum(1) - 2 * points @ feet.T
    count = min(_NEIGHBOURS, len(feet))
    nearest = numpy.argpartition(squares, count - 1, axis=1)[:, :count]
    weights = 1 / (numpy.maximum(numpy.take_along_axis(squares, nearest, 1), 0) + offset)
    weights /= weights.sum(axis=1, keepdims=True)
    if values.ndim == 2:
        weights = weights[..., None]
    return (values[nearest] * weights).sum(axis=1)
