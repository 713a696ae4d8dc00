"""How each point of a mesh moves between two solids that share their parameters, with its tangents.

Exact on every face, those without nodes included.
"""

import numpy

from ..occ.tessellation import Tessellation, frames, parameters_of

_FAR = 1 / 200
"""Distance of a point from the one at its parameters, relative to the shape's diagonal, from which
they are sought anew: between the two sides of a seam they jump."""

_FLAT = 1e-9


def movement(mesh: Tessellation, before, after, size: float) -> tuple[numpy.ndarray, numpy.ndarray]:
    """Frames (n, 3, 3) before, and their change, at the points of a mesh of one face.

    A frame is S, Su, Sv. ``before`` and ``after`` are the face, ``size`` the diagonal of the whole
    shape in mm.
    """
    parameters = mesh.parameters.copy()
    start = frames(before, parameters)
    far = numpy.linalg.norm(start[:, 0] - mesh.points, axis=1) > size * _FAR
    if far.any():
        parameters[far] = parameters_of(before, mesh.points[far])
        start[far] = frames(before, parameters[far])
    return start, frames(after, parameters) - start


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
