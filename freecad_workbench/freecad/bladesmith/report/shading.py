"""Turns a drawing into an image: light, colour maps, edge lines, smoothing."""

from typing import Optional

import numpy

from .raster import Drawing, visible_lines

OVERSAMPLING = 2
"""Pixels drawn for each pixel of the finished image, each way."""

STEEL = numpy.array([0.70, 0.745, 0.79])
_LINE = numpy.array([0.13, 0.16, 0.20])
_GHOST = numpy.array([0.80, 0.12, 0.10])
_LIGHTS = (((0.35, 0.55, 0.75), 0.66), ((-0.70, 0.15, 0.45), 0.26))
_AMBIENT = 0.34


def part_image(drawing: Drawing, ghost: Optional[Drawing] = None) -> numpy.ndarray:
    """The part in one colour; the edges seen in ``ghost`` are drawn over it in red."""
    image = _background(drawing)
    light, shine = _light(drawing)
    image[drawing.shown, :3] = numpy.clip(STEEL * light + shine, 0, 1)
    image[drawing.shown, 3] = 1
    _add_lines(image, visible_lines(drawing, OVERSAMPLING), _LINE, 0.85)
    if ghost is not None:
        _add_lines(image, visible_lines(ghost, OVERSAMPLING), _GHOST, 0.75)
    return _smoothed(image)


def map_image(drawing: Drawing, values: numpy.ndarray, colour_map) -> numpy.ndarray:
    """The part coloured by ``colour_map`` of values at the mesh's points; NaN stays grey."""
    image = _background(drawing)
    light, _ = _light(drawing)
    seen = drawing.interpolate(values)
    colours = colour_map(seen)[:, :3]
    colours[~numpy.isfinite(seen)] = 0.8
    image[drawing.shown, :3] = numpy.clip(colours * (0.62 + 0.42 * light), 0, 1)
    image[drawing.shown, 3] = 1
    _add_lines(image, visible_lines(drawing, OVERSAMPLING), _LINE, 0.55)
    return _smoothed(image)


def _background(drawing: Drawing) -> numpy.ndarray:
    image = numpy.ones((*drawing.shown.shape, 4))
    image[..., 3] = 0
    return image


def _light(drawing: Drawing):
    """Brightness (n, 1) and shine (n, 1) of the shown pixels, lights fixed to the viewer."""
    normals = drawing.interpolate(drawing.mesh.normals) @ drawing.camera.axes.T
    normals /= numpy.maximum(numpy.linalg.norm(normals, axis=1, keepdims=True), 1e-9)
    normals *= numpy.sign(normals[:, 2:]) + (normals[:, 2:] == 0)
    light = numpy.full(len(normals), _AMBIENT)
    shine = numpy.zeros(len(normals))
    for direction, strength in _LIGHTS:
        direction = numpy.array(direction) / numpy.linalg.norm(direction)
        light += strength * numpy.maximum(normals @ direction, 0)
        halfway = direction + (0, 0, 1)
        halfway /= numpy.linalg.norm(halfway)
        shine += 0.22 * strength * numpy.maximum(normals @ halfway, 0) ** 30
    return light[:, None], shine[:, None]


def _add_lines(image, mask, colour, strength: float) -> None:
    opaque = numpy.where(image[mask, 3:] > 0, image[mask, :3], 1)
    image[mask, :3] = (1 - strength) * opaque + strength * colour
    image[mask, 3] = 1


def _smoothed(image: numpy.ndarray) -> numpy.ndarray:
    """The mean over the drawn pixels of each finished one, on white."""
    n = OVERSAMPLING
    height, width = (size - size % n for size in image.shape[:2])
    image = image[:height, :width]
    solid = image[..., :3] * image[..., 3:] + (1 - image[..., 3:])
    return solid.reshape(height // n, n, width // n, n, 3).mean(axis=(1, 3))
