"""A shape as triangles and edge lines for pictures.

Import only after FreeCAD: numpy before it crashes on Debian 12.
"""

from dataclasses import dataclass, fields

import FreeCAD
import numpy

_RELATIVE_DEFLECTION = 1 / 250
"""Chords of triangles relative to the shape's diagonal."""

_LINE_POINTS = 65


@dataclass
class Tessellation:
    """Triangles with a normal at each corner; corners of different faces are kept apart."""

    points: numpy.ndarray
    """(n, 3), mm."""
    normals: numpy.ndarray
    """(n, 3), unit."""
    faces: numpy.ndarray
    """(n,) the face of each point, from 1."""
    parameters: numpy.ndarray
    """(n, 2) each point's place u, v on its face; on a seam, that of one of its sides."""
    triangles: numpy.ndarray
    """(m, 3) indices of points."""
    lines: numpy.ndarray
    """(k, 2) indices of points: the sides of triangles along the edges of faces."""


def tessellate(shape) -> Tessellation:
    """Triangles of every face, fine enough for a picture of the whole shape."""
    size = shape.BoundBox.DiagonalLength
    return joined([tessellate_face(face, k, size) for k, face in enumerate(shape.Faces, 1)])


def tessellate_face(face, index: int, size: float) -> Tessellation:
    """Triangles of one face, number ``index`` of a shape of the diagonal ``size`` (mm)."""
    corners, triangles = face.tessellate(size * _RELATIVE_DEFLECTION)
    points = vectors(corners)
    triangles = numpy.array(triangles, dtype=int).reshape(-1, 3)
    return Tessellation(
        points,
        _corner_normals(points, triangles),
        numpy.full(len(points), index),
        _parameters(face, points),
        triangles,
        _border(triangles),
    )


def joined(parts: list[Tessellation]) -> Tessellation:
    """Several meshes as one."""
    counts = [0, *numpy.cumsum([len(part.points) for part in parts])]
    arrays = {}
    for field in fields(Tessellation):
        shift = counts if field.name in ("triangles", "lines") else [0] * len(counts)
        moved = [getattr(part, field.name) + start for part, start in zip(parts, shift)]
        arrays[field.name] = numpy.concatenate(moved)
    return Tessellation(**arrays)


def vectors(found) -> numpy.ndarray:
    """FreeCAD's vectors as an array (n, 3)."""
    return numpy.array([(p.x, p.y, p.z) for p in found], dtype=float).reshape(-1, 3)


def frames(face, parameters: numpy.ndarray) -> numpy.ndarray:
    """Point and the two first derivatives, (n, 3, 3), of a face at parameters u, v (n, 2)."""
    surface, places = face.Surface, parameters.tolist()
    return numpy.stack(
        (
            vectors([surface.value(u, v) for u, v in places]),
            vectors([surface.getDN(u, v, 1, 0) for u, v in places]),
            vectors([surface.getDN(u, v, 0, 1) for u, v in places]),
        ),
        axis=1,
    )


def parameters_of(face, points: numpy.ndarray) -> numpy.ndarray:
    """u, v (n, 2) of the points of a face's surface nearest to ``points``, within its range."""
    surface, bounds = face.Surface, face.ParameterRange
    found = numpy.array([surface.parameter(FreeCAD.Vector(*p)) for p in points.tolist()])
    periods = (
        surface.UPeriod() if surface.isUPeriodic() else 0.0,
        surface.VPeriod() if surface.isVPeriodic() else 0.0,
    )
    for column, period in enumerate(periods):
        if period:
            first = bounds[2 * column]
            found[:, column] = first + (found[:, column] - first) % period
    return found


def edge_lines(before, after) -> list:
    """Points (k, 3) along each edge of two solids that share their parameters: pairs in order.

    A degenerate edge has none.
    """
    lines = []
    for edge, moved in zip(before.Edges, after.Edges):
        first, last = edge.ParameterRange
        count = 0 if edge.Degenerated else _LINE_POINTS
        places = numpy.linspace(first, last, count).tolist()
        lines.append(tuple(vectors([e.valueAt(t) for t in places]) for e in (edge, moved)))
    return lines


def _corner_normals(points: numpy.ndarray, triangles: numpy.ndarray) -> numpy.ndarray:
    """Mean of the adjoining triangles' normals, weighted by area."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    areas = numpy.tile(numpy.cross(b - a, c - a), (3, 1))
    corners = triangles.T.reshape(-1)
    sums = [numpy.bincount(corners, areas[:, k], minlength=len(points)) for k in range(3)]
    sums = numpy.stack(sums, axis=1)
    lengths = numpy.linalg.norm(sums, axis=1, keepdims=True)
    return sums / numpy.where(lengths > 0, lengths, 1)


def _parameters(face, points: numpy.ndarray) -> numpy.ndarray:
    """u, v of a face's mesh points, which come in another order than its mesh's u, v."""
    if not len(points):
        return numpy.empty((0, 2))
    places, surface = face.getUVNodes(), face.Surface
    found = vectors([surface.value(u, v) for u, v in places])
    return numpy.array(places, dtype=float)[_nearest(points, found)]


_DIRECTION = numpy.array([0.6017, 0.5393, 0.5891])
_NEIGHBOURS = 6
_SAME = 1e-3
"""Distance, mm, up to which a neighbour along the direction is taken for the point itself."""


def _nearest(points: numpy.ndarray, among: numpy.ndarray) -> numpy.ndarray:
    """Index of the nearest of ``among`` for each point: first by the order along a direction."""
    order = numpy.argsort(among @ _DIRECTION)
    start = numpy.searchsorted(among @ _DIRECTION, points @ _DIRECTION, sorter=order)
    near = start[:, None] + numpy.arange(-_NEIGHBOURS, _NEIGHBOURS)
    near = order[numpy.clip(near, 0, len(among) - 1)]
    distances = numpy.linalg.norm(among[near] - points[:, None], axis=2)
    found = numpy.take_along_axis(near, distances.argmin(axis=1)[:, None], 1)[:, 0]
    for missed in numpy.flatnonzero(distances.min(axis=1) > _SAME):
        found[missed] = ((among - points[missed]) ** 2).sum(axis=1).argmin()
    return found


def _border(triangles: numpy.ndarray) -> numpy.ndarray:
    """The sides that belong to one triangle only."""
    sides = numpy.sort(triangles[:, ((0, 1), (1, 2), (2, 0))].reshape(-1, 2), axis=1)
    sides, uses = numpy.unique(sides, axis=0, return_counts=True)
    return sides[uses == 1]
