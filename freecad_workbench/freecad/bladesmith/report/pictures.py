"""The pictures of a morph: part before and after, colour maps, histograms."""

from dataclasses import dataclass, replace

import numpy
from matplotlib import cm, colors, rc_context
from matplotlib.figure import Figure

from ..colours import palette
from ..colours.nodes import at_mesh_points
from ..colours.refinement import refined
from ..colours.result import round_down
from ..colours.scale import automatic
from ..occ.tessellation import Tessellation
from . import raster, shading

_SIZE = (640, 620)
"""Largest width and height of one view, in pixels of the finished picture."""

_DPI = 130
_AZIMUTHS = 24
_ELEVATION = 0.42
_GAP, _TITLE, _FOOT = 24, 26, 30
"""Pixels between panels, above and below them."""

_SMALLEST_MM = 1e-9
_LONGEST_SIDE = 1 / 80
"""Longest side of a triangle that carries colours, relative to the part's diagonal."""

_FONT = {
    "font.family": "DejaVu Sans",
    "font.size": 9,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.edgecolor": "#5a6470",
    "axes.titlesize": 10,
    "axes.titlelocation": "left",
}


@dataclass
class Scene:
    """Meshes of the part before and after, with what the nodes say, seen from two sides."""

    hot: Tessellation
    cold: Tessellation
    displacement_mm: numpy.ndarray
    """(n, 3) at the hot mesh's points."""
    deviation_mm: numpy.ndarray
    """(n,) at the hot mesh's points."""

    @classmethod
    def of(cls, hot: Tessellation, cold: Tessellation, nodes: dict) -> "Scene":
        deviation = numpy.linalg.norm(nodes["deviations"], axis=1)
        size = float(numpy.linalg.norm(numpy.ptp(hot.points, axis=0)))
        hot = refined(hot, size * _LONGEST_SIDE)
        values = numpy.column_stack((nodes["displacements"], deviation))
        carried = at_mesh_points(hot, nodes, values)
        return cls(hot, cold, carried[:, :3], carried[:, 3])

    def cameras(self) -> list:
        """Two opposite views, turned so that they show most of what moves; the longest side up."""
        both = numpy.concatenate((self.hot.points, self.cold.points))
        extent = numpy.ptp(both, axis=0)
        up = numpy.zeros(3)
        up[int(numpy.argmax(extent)) if extent.max() > 1.2 * numpy.median(extent) else 2] = 1
        towards = self._best_direction(up)
        size = tuple(n * shading.OVERSAMPLING for n in _SIZE)
        return [
            raster.Camera.looking(both, sign * towards + _ELEVATION * up, up, size)
            for sign in (1, -1)
        ]

    def _best_direction(self, up) -> numpy.ndarray:
        """The level direction that sees the largest area, weighted by its displacement."""
        side = numpy.roll(up, 1)
        angles = numpy.arange(_AZIMUTHS) * 2 * numpy.pi / _AZIMUTHS
        directions = numpy.outer(numpy.cos(angles), side)
        directions += numpy.outer(numpy.sin(angles), numpy.cross(up, side))
        a, b, c = (self.hot.points[self.hot.triangles[:, k]] for k in range(3))
        moved = numpy.linalg.norm(numpy.nan_to_num(self.displacement_mm), axis=1)
        weights = moved[self.hot.triangles].mean(axis=1) + 0.2 * moved.mean()
        seen = numpy.maximum(numpy.cross(b - a, c - a) @ (directions + _ELEVATION * up).T, 0)
        return directions[int(numpy.argmax(weights @ seen + weights @ numpy.roll(seen, 12, 1)))]


def part_picture(scene: Scene):
    """A figure of the part before and after, in the same view."""
    camera = scene.cameras()[0]
    before = shading.part_image(raster.draw(scene.hot, camera))
    after = shading.part_image(raster.draw(scene.cold, camera))
    return _panels([(before, "before"), (after, "after")], camera)


def exaggerated_picture(scene: Scene) -> tuple:
    """A figure of the moved part, the movement enlarged, with the input's edges; and the scale."""
    moved = numpy.nan_to_num(scene.displacement_mm)
    size = numpy.linalg.norm(numpy.ptp(scene.hot.points, axis=0))
    largest = numpy.linalg.norm(moved, axis=1).max(initial=0)
    scale = round_down(0.08 * size / largest) if largest > 0 else 1.0
    mesh = replace(scene.hot, points=scene.hot.points + scale * moved)
    both = Scene(scene.hot, mesh, scene.displacement_mm, scene.deviation_mm)
    panels = []
    for camera in both.cameras():
        drawing = raster.draw(mesh, camera)
        title = f"movement × {scale:g}, red: edges of the input"
        panels.append((shading.part_image(drawing, ghost=raster.draw(scene.hot, camera)), title))
    return _panels(panels, both.cameras()[0]), scale


def map_pictures(scene: Scene) -> dict:
    """Colour maps of displacement and deviation, each from two sides."""
    drawings = [raster.draw(scene.hot, camera) for camera in scene.cameras()]
    moved = numpy.linalg.norm(scene.displacement_mm, axis=1)
    missed = scene.deviation_mm
    return {
        "displacement": _map_figure(drawings, moved, "sequential", "displacement, mm"),
        "deviation": _map_figure(drawings, missed, "severity", "deviation, mm"),
    }


def histogram_picture(nodes: dict, tolerance_mm: float):
    """Numbers of nodes by deviation and by displacement."""
    with rc_context(_FONT):
        figure = Figure(figsize=(10, 2.9), dpi=_DPI)
        left, right = figure.subplots(1, 2)
        deviation = numpy.linalg.norm(nodes["deviations"], axis=1)
        deviation = numpy.maximum(deviation, _SMALLEST_MM)
        edges = numpy.geomspace(deviation.min() * 0.99, max(deviation.max() * 1.01, 1e-8), 60)
        left.hist(deviation, edges, color="#3b6ea5")
        left.set_xscale("log")
        left.axvline(tolerance_mm, color="#b3261e", linewidth=1.2)
        left.annotate(
            f"tolerance {tolerance_mm:g}",
            (tolerance_mm, 1),
            xycoords=("data", "axes fraction"),
            xytext=(-4, -10),
            textcoords="offset points",
            ha="right",
            color="#b3261e",
        )
        left.set(title="Deviation at the nodes", xlabel="mm", ylabel="nodes")
        moved = numpy.linalg.norm(nodes["displacements"], axis=1)
        right.hist(moved, 60, color="#3b6ea5")
        right.set(title="Displacement of the nodes", xlabel="mm", ylabel="nodes")
        figure.tight_layout()
    return figure


def _figure(images, colour_bar: bool):
    """A figure with a panel as large as each image, side by side, and room for a colour bar."""
    widths = [image.shape[1] for image in images]
    height = max(image.shape[0] for image in images) + _FOOT + _TITLE
    bar = 140 if colour_bar else 0
    total = sum(widths) + _GAP * (len(images) - 1) + bar
    figure = Figure(figsize=(total / _DPI, height / _DPI), dpi=_DPI)
    left, axes = 0, []
    for width, image in zip(widths, images):
        place = (left / total, _FOOT / height, width / total, image.shape[0] / height)
        axis = figure.add_axes(place)
        axis.imshow(image, interpolation="none", aspect="auto")
        axis.set_axis_off()
        axes.append(axis)
        left += width + _GAP
    bar_axis = figure.add_axes((left / total, 0.14, 18 / total, 0.7)) if colour_bar else None
    return figure, axes, bar_axis


def _panels(panels, camera: raster.Camera):
    with rc_context(_FONT):
        figure, axes, _ = _figure([image for image, _title in panels], colour_bar=False)
        for axis, (_image, title) in zip(axes, panels):
            axis.set_title(title, loc="center", color="#39424e")
        _scale_bar(axes[0], camera)
    return figure


def _map_figure(drawings, values, name: str, label: str):
    colour_map = colors.ListedColormap(palette.colours(name))
    ends = automatic(values, signed=False, logarithmic=name == "severity")
    normalise = colors.LogNorm if ends.logarithmic else colors.Normalize
    scale = normalise(ends.low, ends.high, clip=True)
    images = [
        shading.map_image(drawing, values, lambda v: colour_map(scale(v))) for drawing in drawings
    ]
    with rc_context(_FONT):
        figure, axes, bar_axis = _figure(images, colour_bar=True)
        _scale_bar(axes[0], drawings[0].camera)
        figure.colorbar(cm.ScalarMappable(scale, colour_map), cax=bar_axis, label=label)
    return figure


def _scale_bar(axis, camera: raster.Camera) -> None:
    """A bar of a round length below the picture."""
    pixel = camera.pixel_mm * shading.OVERSAMPLING
    width, height = camera.width / shading.OVERSAMPLING, camera.height / shading.OVERSAMPLING
    length = round_down(0.25 * width * pixel)
    start, row = 0.03 * width, height + 0.45 * _FOOT
    end = start + length / pixel
    axis.plot((start, end), (row, row), color="#39424e", linewidth=2, clip_on=False)
    axis.text(end + 8, row, f"{length:g} mm", color="#39424e", va="center", fontsize=8)
    axis.set(xlim=(-0.5, width - 0.5), ylim=(height - 0.5, -0.5))


def save(figure, path: str) -> None:
    """Writes a figure as PNG, the same bytes for the same picture."""
    figure.savefig(path, metadata={"Software": None})
