"""A shape as triangles and edge lines for pictures.

Import only after FreeCAD: numpy before it crashes on Debian 12.
"""

from dataclasses import dataclass

import numpy

_RELATIVE_DEFLECTION = 1 / 250
"""Chords of triangles relative to the shape's diagonal."""


@dataclass
class Tessellation:
    """Triangles with a normal at each corner; corners of different faces are kept apart."""

    points: numpy.ndarray
    """(n, 3), mm."""
    normals: numpy.ndarray
    """(n, 3), unit."""
    faces: numpy.ndarray
    """(n,) the face of each point, from 1."""
    triangles: numpy.ndarray
    """(m, 3) indices of points."""
    lines: numpy.ndarray
    """(k, 2) indices of points: the sides of triangles along the edges of faces."""


def tessellate(shape) -> Tessellation:
    """Triangles of every face, fine enough for a picture of the whole shape."""
    size = shape.BoundBox.DiagonalLength
    points, normals, faces, triangles, lines = [], [], [], [], []
    count = 0
    for index, face in enumerate(shape.Faces, 1):
        corners, indices = face.tessellate(size * _RELATIVE_DEFLECTION)
        if not indices:
            continue
        corners = numpy.array([(p.x, p.y, p.z) for p in corners])
        indices = numpy.array(indices)
        points.append(corners)
        normals.append(_normals(corners, indices))
        faces.append(numpy.full(len(corners), index))
        triangles.append(indices + count)
        lines.append(_border(indices) + count)
        count += len(corners)
    return Tessellation(
        numpy.concatenate(points),
        numpy.concatenate(normals),
        numpy.concatenate(faces),
        numpy.concatenate(triangles),
        numpy.concatenate(lines),
    )


def _normals(points: numpy.ndarray, triangles: numpy.ndarray) -> numpy.ndarray:
    """Mean of the adjoining triangles' normals, weighted by area."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    areas = numpy.cross(b - a, c - a)
    sums = numpy.zeros_like(points)
    for k in range(3):
        numpy.add.at(sums, triangles[:, k], areas)
    lengths = numpy.linalg.norm(sums, axis=1, keepdims=True)
    return sums / numpy.where(lengths > 0, lengths, 1)


def _border(triangles: numpy.ndarray) -> numpy.ndarray:
    """The sides that belong to one triangle only."""
    sides = numpy.sort(triangles[:, ((0, 1), (1, 2), (2, 0))].reshape(-1, 2), axis=1)
    sides, uses = numpy.unique(sides, axis=0, return_counts=True)
    return sides[uses == 1]
