"""Cuts long triangles, so that colours follow the nodes on large or narrow faces too.

A side is cut into a power of two of equal pieces that depends on its length alone, so that the
triangles on both of its sides still meet.
"""

from dataclasses import replace

import numpy

from ..occ.tessellation import Tessellation

_ROUNDS = 12


def refined(mesh: Tessellation, longest_mm: float) -> Tessellation:
    """The mesh with every side longer than ``longest_mm`` cut into shorter ones.

    Triangles that are long both ways are halved, a dozen times at most; then narrow ones are cut
    across, where sides up to twice as long may remain. Edge lines keep their points.
    """
    for _ in range(_ROUNDS):
        lengths = _side_lengths(mesh)
        wide = lengths.min(axis=1) > longest_mm
        if not wide.any():
            break
        mesh = _halved(mesh, wide, lengths[wide].argmax(axis=1))
    return _cut_across(mesh, longest_mm)


def _side_lengths(mesh: Tessellation) -> numpy.ndarray:
    """(m, 3) lengths of the sides, each from a corner to the next."""
    corners = mesh.points[mesh.triangles]
    return numpy.linalg.norm(numpy.roll(corners, -1, axis=1) - corners, axis=2)


def _halved(mesh: Tessellation, chosen: numpy.ndarray, side: numpy.ndarray) -> Tessellation:
    """Cuts side ``side`` (k: from corner k to the next) of each chosen triangle."""
    a, b, c = _turned(mesh.triangles[chosen], side)
    pairs, middle = _unique_pairs(a, b)
    middle = middle + len(mesh.points)
    halves = (numpy.stack((a, middle, c), 1), numpy.stack((middle, b, c), 1))
    triangles = numpy.concatenate((mesh.triangles[~chosen], *halves))
    return _with_points(mesh, pairs, numpy.full(len(pairs), 0.5), triangles)


def _cut_across(mesh: Tessellation, longest_mm: float) -> Tessellation:
    """Cuts both long sides of narrow triangles into pieces, and joins these crosswise."""
    lengths = _side_lengths(mesh)
    long = lengths.max(axis=1) > longest_mm
    a, b, tip = _turned(mesh.triangles[long], lengths[long].argmin(axis=1))
    pairs, which = _unique_pairs(numpy.concatenate((tip, tip)), numpy.concatenate((a, b)))
    spans = numpy.linalg.norm(mesh.points[pairs[:, 0]] - mesh.points[pairs[:, 1]], axis=1)
    doublings = numpy.ceil(numpy.log2(numpy.maximum(spans / longest_mm, 1)))
    pieces = (2**doublings).astype(int)
    owner = numpy.repeat(numpy.arange(len(pairs)), pieces - 1)
    first = numpy.cumsum(pieces - 1) - (pieces - 1)
    number = numpy.arange(len(owner)) - first[owner] + 1

    def along(rows, side, corner, count):
        """(t, count + 1) points along sides from the tip to ``corner``."""
        inner = len(mesh.points) + first[side][:, None] + numpy.arange(count - 1)
        inner = numpy.where((pairs[side, 0] == corner)[:, None], inner[:, ::-1], inner)
        return numpy.hstack((tip[rows][:, None], inner, corner[:, None]))

    left, right = numpy.split(which, 2)
    cut = []
    for p, q in numpy.unique(numpy.stack((pieces[left], pieces[right]), 1), axis=0).tolist():
        rows = (pieces[left] == p) & (pieces[right] == q)
        rails = along(rows, left[rows], a[rows], p), along(rows, right[rows], b[rows], q)
        cut.append(numpy.hstack(rails)[:, _rungs(p, q)].reshape(-1, 3))
    triangles = numpy.concatenate((mesh.triangles[~long], *cut))
    return _with_points(mesh, pairs[owner], number / pieces[owner], triangles)


def _rungs(p: int, q: int) -> numpy.ndarray:
    """Triangles between two rails of p and q pieces that start at one tip.

    Columns: the points of the first rail from the tip, then those of the second.
    """
    second = p + 1
    found, i, j = [(1, second + 1, 0)], 1, 1
    while i < p or j < q:
        if j == q or (i < p and (i + 1) * q <= (j + 1) * p):
            found.append((i + 1, second + j, i))
            i += 1
        else:
            found.append((i, second + j + 1, second + j))
            j += 1
    return numpy.array(found)


def _turned(triangles: numpy.ndarray, side: numpy.ndarray) -> tuple:
    """Corners of each triangle, the one from which ``side`` goes to the next first."""
    rows = numpy.arange(len(side))
    return tuple(triangles[rows, (side + k) % 3] for k in range(3))


def _unique_pairs(a: numpy.ndarray, b: numpy.ndarray) -> tuple:
    """Pairs of points (n, 2), the lower number first, and which of them each input is."""
    pairs = numpy.sort(numpy.stack((a, b), 1), axis=1)
    pairs, which = numpy.unique(pairs, axis=0, return_inverse=True)
    return pairs, which.reshape(-1)


def _with_points(mesh: Tessellation, pairs, parts, triangles) -> Tessellation:
    """The mesh with other triangles and more points: ``parts`` of the way between ``pairs``."""

    def extended(values):
        first, second = values[pairs[:, 0]], values[pairs[:, 1]]
        return numpy.concatenate((values, first + parts[:, None] * (second - first)))

    return replace(
        mesh,
        points=extended(mesh.points),
        normals=extended(mesh.normals),
        faces=numpy.concatenate((mesh.faces, mesh.faces[pairs[:, 0]])),
        parameters=extended(mesh.parameters),
        triangles=triangles,
    )
