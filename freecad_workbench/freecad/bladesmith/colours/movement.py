"""How each point of a mesh moves between two solids that share their parameters, with its tangents.

Exact where a point's parameters are known, faces without nodes included.
"""

import numpy

from ..occ.tessellation import Tessellation, frames
from .nodes import weighted

_FAR = 1 / 100
"""Distance of a point from the one at its parameters, relative to the shape's diagonal, from which
the parameters are not believed: between the two sides of a seam they jump."""

_FLAT = 1e-9


def movement(mesh: Tessellation, before, after, size: float) -> tuple[numpy.ndarray, numpy.ndarray]:
    """Frames (n, 3, 3) before, and their change, at the points of a mesh of one face.

    A frame is S, Su, Sv. ``before`` and ``after`` are the face, ``size`` the diagonal of the whole
    shape in mm.
    """
    start = frames(before, mesh.parameters)
    change = frames(after, mesh.parameters) - start
    believed = numpy.linalg.norm(start[:, 0] - mesh.points, axis=1) <= size * _FAR
    if believed.any() and not believed.all():
        both = numpy.stack((start, change), axis=1).reshape(-1, 18)
        doubted = mesh.points[~believed]
        carried = weighted(doubted, mesh.points[believed], both[believed]).reshape(-1, 2, 3, 3)
        start[~believed], change[~believed] = carried[:, 0], carried[:, 1]
        start[~believed, 0] = doubted
    return start, change


def normals(mesh: Tessellation, moved: numpy.ndarray) -> numpy.ndarray:
    """Unit normals (n, 3) of moved frames, on the side of the mesh's own; its own at poles."""
    found = numpy.cross(moved[:, 1], moved[:, 2])
    lengths = numpy.linalg.norm(found, axis=1, keepdims=True)
    sides = numpy.linalg.norm(moved[:, 1:], axis=2).prod(axis=1)[:, None]
    flat = lengths <= _FLAT * numpy.maximum(sides, 1e-300)
    agreement = numpy.einsum("ij,ij->i", found, mesh.normals) / numpy.where(flat, 1, lengths)[:, 0]
    turned = numpy.bincount(mesh.faces, agreement) < 0
    sign = numpy.where(turned[mesh.faces], -1, 1)[:, None]
    return numpy.where(flat, mesh.normals, sign * found / numpy.where(flat, 1, lengths))
