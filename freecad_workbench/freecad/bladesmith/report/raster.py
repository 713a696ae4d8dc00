"""Draws triangles into pixels with a depth buffer, in numpy.

Parallel projection. Each pixel keeps the triangle it shows and the place in it, so that colours and
normals are interpolated smoothly and one drawing serves several colourings.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy

from ..occ.tessellation import Tessellation

_FLAT = 1e-9
"""Twice the area, in pixels, of a triangle that is seen from its side and not drawn."""

_BATCH = 4_000_000
"""About how many pixels are worked on at a time."""


@dataclass(frozen=True)
class Camera:
    """A parallel view: rows of ``axes`` point right, up and towards the viewer."""

    axes: numpy.ndarray
    origin: numpy.ndarray
    """(2,) lower left corner of the picture along right and up, mm."""
    pixel_mm: float
    width: int
    height: int

    @classmethod
    def looking(cls, points, towards_viewer, up, size: tuple[int, int]) -> "Camera":
        """A view that shows all ``points`` in a picture of at most ``size`` pixels, tightly.

        ``size`` is width and height.
        """
        toward = numpy.asarray(towards_viewer, float)
        toward = toward / numpy.linalg.norm(toward)
        right = numpy.cross(up, toward)
        right /= numpy.linalg.norm(right)
        axes = numpy.array([right, numpy.cross(toward, right), toward])
        flat = points @ axes[:2].T
        low, high = flat.min(axis=0), flat.max(axis=0)
        extent = numpy.maximum(high - low, 1e-9)
        pixel = float((extent / (0.96 * numpy.array(size))).max())
        width, height = (int(n) for n in numpy.ceil(extent / pixel / 0.96))
        margin = (numpy.array([width, height]) * pixel - extent) / 2
        return cls(axes, low - margin, pixel, width, height)

    def project(self, points: numpy.ndarray) -> numpy.ndarray:
        """(n, 3): column, row from the top, and height above the picture in pixels."""
        seen = points @ self.axes.T
        seen[:, :2] -= self.origin
        seen /= self.pixel_mm
        seen[:, 1] = self.height - seen[:, 1]
        return seen


@dataclass
class Drawing:
    """What each pixel shows: a triangle (-1: nothing) and its height."""

    camera: Camera
    mesh: Tessellation
    triangle: numpy.ndarray
    height: numpy.ndarray

    @property
    def shown(self) -> numpy.ndarray:
        """(height, width) whether a pixel shows the part."""
        return self.triangle >= 0

    @cached_property
    def _weights(self) -> tuple:
        """Corners of the triangles at the shown pixels, and how much each counts there."""
        row, column = numpy.nonzero(self.shown)
        corners = self.mesh.triangles[self.triangle[row, column]].T
        flat = self.camera.project(self.mesh.points)[:, :2]
        a, b, c = (flat[corner] for corner in corners)
        centre = numpy.stack((column, row), 1) + 0.5
        area = _cross(b - a, c - a)
        first = _cross(b - centre, c - centre) / area
        second = _cross(c - centre, a - centre) / area
        return corners, numpy.stack((first, second, 1 - first - second)).astype(numpy.float32)

    def interpolate(self, values: numpy.ndarray) -> numpy.ndarray:
        """Values given at the mesh's points, at the pixels in :attr:`shown`."""
        values = values.astype(numpy.float32)
        corners, weights = self._weights
        found = 0
        for corner, weight in zip(corners, weights):
            found = found + values[corner] * (weight[:, None] if values.ndim == 2 else weight)
        return found


def draw(mesh: Tessellation, camera: Camera) -> Drawing:
    """Finds the nearest triangle for every pixel."""
    shape = (camera.height, camera.width)
    drawing = Drawing(
        camera, mesh, numpy.full(shape, -1), numpy.full(shape, -numpy.inf, numpy.float32)
    )
    corners = camera.project(mesh.points)[mesh.triangles]
    kept = numpy.flatnonzero(numpy.abs(_cross(*_sides(corners))) > _FLAT)
    corners = corners[kept]
    rows = numpy.ceil(corners[:, :, 1].max(axis=1)) - numpy.floor(corners[:, :, 1].min(axis=1))
    columns = numpy.ceil(numpy.ptp(corners[:, :, 0], axis=1)) + 1
    batches = numpy.cumsum(rows * columns) // _BATCH
    for batch in numpy.unique(batches):
        chosen = batches == batch
        _draw_batch(drawing, corners[chosen], kept[chosen])
    return drawing


def _draw_batch(drawing: Drawing, corners, numbers) -> None:
    """Fills the rows of pixels between the sides of each triangle."""
    camera = drawing.camera
    which, row = _ranges(corners[:, :, 1].min(axis=1), corners[:, :, 1].max(axis=1), camera.height)
    start, end = _crossings(corners[which], row + 0.5)
    span, column = _ranges(start, end, camera.width)
    which, row = which[span], row[span]
    rise = _slopes(corners)[which]
    first = corners[which, 0]
    height = (
        first[:, 2]
        + rise[:, 0] * (column + 0.5 - first[:, 0])
        + rise[:, 1] * (row + 0.5 - first[:, 1])
    )
    _keep_nearest(drawing, numbers[which], row * camera.width + column, height)


def _sides(corners):
    """The sides from the first corner to the other two, in the picture's plane."""
    return corners[:, 1, :2] - corners[:, 0, :2], corners[:, 2, :2] - corners[:, 0, :2]


def _slopes(corners) -> numpy.ndarray:
    """(n, 2) change of height by column and by row."""
    a, b = _sides(corners)
    up, over = corners[:, 1, 2] - corners[:, 0, 2], corners[:, 2, 2] - corners[:, 0, 2]
    area = _cross(a, b)
    by_column = (up * b[:, 1] - over * a[:, 1]) / area
    by_row = (over * a[:, 0] - up * b[:, 0]) / area
    return numpy.stack((by_column, by_row), -1)


def _ranges(low, high, limit: int):
    """Pixels whose centres lie between ``low`` and ``high``: which range, and the pixel."""
    first = numpy.maximum(numpy.ceil(low - 0.5), 0).astype(int)
    last = numpy.minimum(numpy.floor(high - 0.5), limit - 1).astype(int)
    counts = numpy.maximum(last - first + 1, 0)
    which = numpy.repeat(numpy.arange(len(counts)), counts)
    starts = numpy.cumsum(counts) - counts
    return which, first[which] + numpy.arange(len(which)) - starts[which]


def _crossings(corners, rows):
    """Where a row of pixels enters and leaves each triangle."""
    start, end = numpy.full(len(rows), numpy.inf), numpy.full(len(rows), -numpy.inf)
    for k in range(3):
        a, b = corners[:, k], corners[:, (k + 1) % 3]
        rise = b[:, 1] - a[:, 1]
        level = numpy.abs(rise) < 1e-12
        part = (rows - a[:, 1]) / numpy.where(level, 1, rise)
        column = a[:, 0] + part * (b[:, 0] - a[:, 0])
        crossed = ~level & (part >= 0) & (part <= 1)
        start = numpy.where(crossed, numpy.minimum(start, column), start)
        end = numpy.where(crossed, numpy.maximum(end, column), end)
    missed = start > end
    start[missed], end[missed] = 0, -1
    return start, end


def _keep_nearest(drawing: Drawing, triangle, place, height) -> None:
    order = numpy.argsort(height)
    place, height, triangle = place[order], height[order], triangle[order]
    nearer = height > drawing.height.reshape(-1)[place]
    place, height, triangle = place[nearer], height[nearer], triangle[nearer]
    # Of several values for one place the last assigned stays: the highest.
    drawing.height.reshape(-1)[place] = height
    drawing.triangle.reshape(-1)[place] = triangle


def visible_lines(drawing: Drawing, thickness: int) -> numpy.ndarray:
    """(height, width) the pixels of the mesh's edge lines and of its outline, as far as seen."""
    column, row, height = _line_pixels(drawing.camera, drawing.mesh)
    # Beside the part there is nothing to hide a line, but nothing to show one inside it either.
    surface = numpy.where(drawing.shown, drawing.height, numpy.inf)
    seen = height + 1.5 * thickness >= _lowest_nearby(surface)[row, column]
    seen |= ~drawing.shown[row, column]
    mask = _outline(drawing.shown)
    mask[row[seen], column[seen]] = True
    return _thickened(mask, thickness)


def _line_pixels(camera: Camera, mesh: Tessellation):
    """Column, row and height of points at most half a pixel apart along the edge lines."""
    ends = camera.project(mesh.points)[mesh.lines]
    along = ends[:, 1] - ends[:, 0]
    counts = (2 * numpy.linalg.norm(along, axis=1)).astype(int) + 2
    which = numpy.repeat(numpy.arange(len(counts)), counts)
    starts = numpy.cumsum(counts) - counts
    part = (numpy.arange(len(which)) - starts[which]) / (counts[which] - 1)
    points = ends[which, 0] + part[:, None] * along[which]
    column, row = (numpy.floor(points[:, k]).astype(int) for k in range(2))
    inside = (column >= 0) & (column < camera.width) & (row >= 0) & (row < camera.height)
    return column[inside], row[inside], points[inside, 2]


def _outline(shown: numpy.ndarray) -> numpy.ndarray:
    """Pixels of the part that have the background beside them."""
    inner = shown.copy()
    inner[1:] &= shown[:-1]
    inner[:-1] &= shown[1:]
    inner[:, 1:] &= shown[:, :-1]
    inner[:, :-1] &= shown[:, 1:]
    return shown & ~inner


def _lowest_nearby(height: numpy.ndarray) -> numpy.ndarray:
    """The least height among a pixel and those around it, so that outlines count as seen."""
    out = height
    for axis in (0, 1):
        ahead, behind = numpy.roll(out, 1, axis), numpy.roll(out, -1, axis)
        out = numpy.minimum(out, numpy.minimum(ahead, behind))
    return out


def _thickened(mask: numpy.ndarray, thickness: int) -> numpy.ndarray:
    out = mask.copy()
    for _ in range(thickness - 1):
        grown = out.copy()
        grown[1:] |= out[:-1]
        grown[:, 1:] |= out[:, :-1]
        out = grown
    return out


def _cross(a: numpy.ndarray, b: numpy.ndarray) -> numpy.ndarray:
    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]
