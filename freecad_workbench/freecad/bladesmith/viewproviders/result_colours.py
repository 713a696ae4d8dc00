"""A coloured, movable copy of a result over the 3-D view, with legend, marks and edge lines.

Nothing of it belongs to the document: it hangs in the view's scene only, and while it is there the
objects it covers are switched off in the scene, not in their properties.
"""

from typing import Optional

import numpy
from pivy import coin

from .legend import to_coin

NAME = "BladesmithResult"
"""Name of the node that holds all that is shown."""

_TEXTURE_WIDTH = 1024
_KNOWN, _UNKNOWN = 0.25, 0.75
"""Rows of the texture: colours of values, and grey where no value is known."""

_LINE, _GHOST, _CHOSEN = (0.10, 0.12, 0.15), (0.95, 0.25, 0.20), (1.0, 0.0, 0.5)
_LEGEND_PLACE = (-0.975, 0.0, 0.0)


class Overlay:
    """The scene; hidden until :meth:`attach`. All points are arrays (n, 3), mm."""

    def __init__(self):
        self.root = coin.SoSeparator()
        self.root.setName(NAME)
        unpickable = coin.SoPickStyle()
        unpickable.style = coin.SoPickStyle.UNPICKABLE
        self._surface = _Surface()
        self._edges = _Lines(_LINE, 1.5)
        self._ghost = _Lines(_GHOST, 1.2)
        self._chosen = _Lines(_CHOSEN, 5, in_front=True)
        self._mark = _Mark()
        self._legend = _Legend()
        # The legend comes first: its end empties the extent gathered so far.
        parts = (self._legend, self._surface, self._edges, self._ghost, self._chosen, self._mark)
        for node in (unpickable, *(part.root for part in parts)):
            self.root.addChild(node)
        self._scene = None
        self._hidden: list = []

    @property
    def attached(self) -> bool:
        """Whether it hangs in a view."""
        return self._scene is not None

    def attach(self, view, covered: list) -> None:
        """Shows it in a 3-D view in place of the view providers ``covered``."""
        self._scene = view.getSceneGraph()
        self._scene.ref()
        self._scene.addChild(self.root)
        for provider in covered:
            switch = _mode_switch(provider)
            self._hidden.append((provider, switch, switch.whichChild.getValue()))
            switch.whichChild = coin.SO_SWITCH_NONE

    def detach(self) -> None:
        """Takes it out of the view and shows what it covered, as far as that still exists."""
        if self._scene is None:
            return
        self._scene.removeChild(self.root)
        self._scene.unref()
        self._scene = None
        for provider, switch, child in self._hidden:
            try:
                visible = provider.Visibility
            except ReferenceError:  # its object was deleted
                continue
            switch.whichChild = child if visible else coin.SO_SWITCH_NONE
        self._hidden = []

    def set_triangles(self, triangles: numpy.ndarray) -> None:
        """Corners (m, 3) by index into the points of :meth:`move`."""
        self._surface.set_triangles(triangles)

    def move(self, points: numpy.ndarray, normals: numpy.ndarray, edges: list) -> None:
        """Places the surface and its edge lines."""
        self._surface.move(points, normals)
        self._edges.set(edges)

    def colour(self, places: numpy.ndarray, bar: numpy.ndarray, legend) -> None:
        """Colours the points by places on the colour bar (n, 3), NaN in grey; shows the legend.

        ``legend`` is its picture.
        """
        self._surface.colour(places, bar)
        self._legend.set(legend)

    def show_input(self, edges: list) -> None:
        """Lines of the input over the moved shape; none to hide them."""
        self._ghost.set(edges)

    def choose(self, edges: list) -> None:
        """Edges to be emphasised."""
        self._chosen.set(edges)

    def mark(self, point: Optional[numpy.ndarray], picture=None) -> None:
        """Puts ``picture`` in front of the part with its centre at ``point``; None: no mark."""
        self._mark.set(point, picture)


class _Surface:
    """Triangles coloured through a texture: values, not colours, are interpolated between
    points, so steps have sharp borders."""

    def __init__(self):
        self.root = coin.SoSeparator()
        hints = coin.SoShapeHints()
        hints.vertexOrdering = coin.SoShapeHints.COUNTERCLOCKWISE
        material = coin.SoMaterial()
        # Some light from all sides keeps colours close to the legend's.
        material.emissiveColor = (0.38, 0.38, 0.38)
        material.diffuseColor = (0.62, 0.62, 0.62)
        material.specularColor = (0.12, 0.12, 0.12)
        material.shininess = 0.3
        behind = coin.SoPolygonOffset()
        sharp = coin.SoComplexity()
        sharp.textureQuality = 0.1
        self._texture = coin.SoTexture2()
        self._texture.wrapS = self._texture.wrapT = coin.SoTexture2.CLAMP
        self._places = coin.SoTextureCoordinate2()
        self._points = coin.SoCoordinate3()
        self._normals = coin.SoNormal()
        binding = coin.SoNormalBinding()
        binding.value = coin.SoNormalBinding.PER_VERTEX_INDEXED
        self._faces = coin.SoIndexedFaceSet()
        for node in (hints, material, behind, sharp, self._texture, self._places, self._points):
            self.root.addChild(node)
        for node in (self._normals, binding, self._faces):
            self.root.addChild(node)

    def set_triangles(self, triangles: numpy.ndarray) -> None:
        ends = numpy.full((len(triangles), 1), -1)
        _fill(self._faces.coordIndex, numpy.hstack((triangles, ends)).reshape(-1), numpy.int32)

    def move(self, points: numpy.ndarray, normals: numpy.ndarray) -> None:
        _fill(self._points.point, points)
        _fill(self._normals.vector, normals)

    def colour(self, places: numpy.ndarray, bar: numpy.ndarray) -> None:
        known = numpy.isfinite(places)
        # Half a pixel is kept free at both ends, where rounding could reach the other one.
        column = (0.5 + numpy.where(known, places, 0) * (_TEXTURE_WIDTH - 1)) / _TEXTURE_WIDTH
        row = numpy.where(known, _KNOWN, _UNKNOWN)
        _fill(self._places.point, numpy.stack((column, row), axis=1))
        chosen = numpy.arange(_TEXTURE_WIDTH) * len(bar) // _TEXTURE_WIDTH
        picture = numpy.full((2, _TEXTURE_WIDTH, 3), 168, dtype=numpy.uint8)
        picture[0] = (numpy.clip(bar[chosen], 0, 1) * 255).round()
        size = coin.SbVec2s(_TEXTURE_WIDTH, 2)
        self._texture.image.setValue(size, 3, picture.tobytes())


class _Lines:
    """Polylines in one colour, not lit."""

    def __init__(self, colour: tuple, width: float, in_front: bool = False):
        self.root = coin.SoAnnotation() if in_front else coin.SoSeparator()
        light = coin.SoLightModel()
        light.model = coin.SoLightModel.BASE_COLOR
        base = coin.SoBaseColor()
        base.rgb = colour
        style = coin.SoDrawStyle()
        style.lineWidth = width
        self._points = coin.SoCoordinate3()
        self._lines = coin.SoLineSet()
        self._switch = coin.SoSwitch()
        self._switch.addChild(self._lines)
        for node in (light, base, style, self._points, self._switch):
            self.root.addChild(node)

    def set(self, lines: list) -> None:
        lines = [line for line in lines if len(line)]
        self._switch.whichChild = coin.SO_SWITCH_ALL if lines else coin.SO_SWITCH_NONE
        if lines:
            _fill(self._points.point, numpy.concatenate(lines))
            counts = numpy.array([len(line) for line in lines])
            _fill(self._lines.numVertices, counts, numpy.int32)


class _Mark:
    """A picture whose centre stays at a point of the part, in front of everything."""

    def __init__(self):
        self.root = coin.SoAnnotation()
        self._place = coin.SoTranslation()
        self._image = coin.SoImage()
        self._image.horAlignment = coin.SoImage.CENTER
        self._image.vertAlignment = coin.SoImage.HALF
        self._switch = coin.SoSwitch()
        self._switch.addChild(self._place)
        self._switch.addChild(self._image)
        self.root.addChild(self._switch)

    def set(self, point, picture) -> None:
        self._switch.whichChild = coin.SO_SWITCH_NONE if point is None else coin.SO_SWITCH_ALL
        if point is not None:
            self._place.translation = tuple(map(float, point))
            to_coin(picture, self._image)


class _Legend:
    """A picture at the left border of the view, which takes no part in its extent."""

    def __init__(self):
        self.root = coin.SoSeparator()
        self.root.boundingBoxCaching = coin.SoSeparator.ON
        front = coin.SoAnnotation()
        camera = coin.SoOrthographicCamera()
        camera.viewportMapping = coin.SoCamera.LEAVE_ALONE
        camera.position = (0, 0, 1)
        camera.nearDistance, camera.farDistance, camera.height = 0.5, 1.5, 2
        place = coin.SoTranslation()
        place.translation = _LEGEND_PLACE
        self._image = coin.SoImage()
        self._image.vertAlignment = coin.SoImage.HALF
        for node in (camera, place, self._image):
            front.addChild(node)
        forget = coin.SoResetTransform()
        forget.whatToReset = coin.SoResetTransform.BBOX
        self.root.addChild(front)
        self.root.addChild(forget)

    def set(self, picture) -> None:
        to_coin(picture, self._image)


def _fill(field, values: numpy.ndarray, kind=numpy.float32) -> None:
    """Gives a field of many values exactly these."""
    field.setNum(len(values))
    field.setValues(0, len(values), numpy.ascontiguousarray(values, dtype=kind))


def _mode_switch(provider):
    """The node with which a view provider chooses among its display modes."""
    root = provider.RootNode
    children = [root.getChild(k) for k in range(root.getNumChildren())]
    return next(child for child in children if child.isOfType(coin.SoSwitch.getClassTypeId()))


def zoom(view, points: numpy.ndarray, least: float) -> None:
    """Turns the camera's centre to ``points`` and shows at least ``least`` mm around them."""
    centre = (points.min(axis=0) + points.max(axis=0)) / 2
    half = numpy.maximum(numpy.ptp(points, axis=0) * 0.75, least / 2 / 3**0.5)
    box = coin.SbBox3f(*map(float, centre - half), *map(float, centre + half))
    width, height = view.getSize()
    view.getCameraNode().viewBoundingBox(box, width / max(height, 1), 1.0)
