"""Splits long triangles, so that colours follow the nodes on large flat faces too."""

from dataclasses import replace

import numpy

from ..occ.tessellation import Tessellation

_ROUNDS = 12


def refined(mesh: Tessellation, longest_mm: float) -> Tessellation:
    """The mesh with every side cut in half, longest first, until none exceeds ``longest_mm``.

    Stops after a dozen rounds; edge lines keep their points.
    """
    for _ in range(_ROUNDS):
        ends = mesh.triangles[:, ((0, 1), (1, 2), (2, 0))]
        lengths = numpy.linalg.norm(mesh.points[ends[:, :, 0]] - mesh.points[ends[:, :, 1]], axis=2)
        long = lengths.max(axis=1) > longest_mm
        if not long.any():
            break
        mesh = _halved(mesh, long, lengths[long].argmax(axis=1))
    return mesh


def _halved(mesh: Tessellation, chosen: numpy.ndarray, side: numpy.ndarray) -> Tessellation:
    """Cuts side ``side`` (k: from corner k to the next) of each chosen triangle."""
    rows = numpy.arange(len(side))
    a, b, c = (mesh.triangles[chosen][rows, (side + k) % 3] for k in range(3))
    pairs, middle = numpy.unique(
        numpy.sort(numpy.stack((a, b), 1), axis=1), axis=0, return_inverse=True
    )
    middle = middle.reshape(-1) + len(mesh.points)
    first, second = pairs.T
    halves = (numpy.stack((a, middle, c), 1), numpy.stack((middle, b, c), 1))
    return replace(
        mesh,
        points=_extended(mesh.points, first, second),
        normals=_extended(mesh.normals, first, second),
        faces=numpy.concatenate((mesh.faces, mesh.faces[first])),
        parameters=_extended(mesh.parameters, first, second),
        triangles=numpy.concatenate((mesh.triangles[~chosen], *halves)),
    )


def _extended(values, first, second) -> numpy.ndarray:
    return numpy.concatenate((values, (values[first] + values[second]) / 2))
