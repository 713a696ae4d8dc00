"""How a morph looks: its icon, its source below it in the tree, and where the source is shown."""

import json
from pathlib import Path

import FreeCADGui
from pivy import coin

from ..features import attributes, preferences

_ICON = str(Path(__file__).parents[1] / "resources" / "icons" / "Bladesmith_Morph.svg")

OVER, BESIDE, ALONE = LAYOUTS = ("Over its source", "Beside its source", "Alone")
_LINES = {"DisplayMode": "Wireframe", "LineColor": (0.80, 0.12, 0.10, 0.0), "LineWidth": 1.0}
"""How a source is seen that its result lies over: as lines, because two surfaces that nearly
coincide show through each other in patches."""
_COLD = (0.55, 0.71, 0.86)
"""Colour of a result whose source has none of its own."""
_APART = 1.2
"""Shift of a result beside its source, in widths of the part."""


class MorphView:
    """View provider; nothing of it is saved but its properties."""

    make_panel = None
    """Makes the panel of an object; panels know views, so the workbench sets it."""

    def __init__(self, view):
        view.Proxy = self
        _add_properties(view)
        view.ShapeColor = _COLD
        view.Layout = LAYOUTS[min(max(preferences.layout(), 0), len(LAYOUTS) - 1)]

    def attach(self, view):
        """Called when the object appears, also after a document was opened."""
        self.Object = view.Object
        self.panel = None
        self._place = coin.SoTranslation()
        view.RootNode.insertChild(self._place, 0)
        _add_properties(view)

    def getIcon(self):
        """Path of the icon in the tree."""
        return _ICON

    def claimChildren(self):
        """The source stands below its result."""
        return [self.Object.Source] if self.Object.Source else []

    def setEdit(self, view, _mode=0):
        """Opens the panel."""
        document = view.Object.Document
        if not document.HasPendingTransaction:
            document.openTransaction("Edit morph")
        self.panel = self.make_panel(view.Object)
        FreeCADGui.Control.showDialog(self.panel)
        return True

    def unsetEdit(self, _view, _mode=0):
        """Closes the panel."""
        self.panel = None
        FreeCADGui.Control.closeDialog()
        return True

    def doubleClicked(self, view):
        """Edits the object."""
        FreeCADGui.getDocument(view.Object.Document.Name).setEdit(view.Object.Name)
        return True

    def updateData(self, obj, name):
        """A new shape takes the colours of its source, and its place beside it."""
        if name == "Shape" and obj.Shape.Faces:
            _colour(obj)
            self._arrange(obj)

    def onChanged(self, view, name):
        """Follows the choice of the layout."""
        if name in ("Layout", "Visibility") and hasattr(self, "Object"):
            self._arrange(view.Object)

    def onDelete(self, view, _subelements):
        """Leaves the source as it was."""
        _restore(view)
        return True

    def _arrange(self, obj):
        view, source = obj.ViewObject, obj.Source
        if source is None or not hasattr(view, "Layout") or not obj.Shape.Faces:
            return
        box = obj.Shape.BoundBox
        shift = _APART * max(box.XLength, box.DiagonalLength / 3) if view.Layout == BESIDE else 0.0
        self._place.translation.setValue(shift, 0.0, 0.0)
        if not view.Visibility:
            return
        _restore(view)
        source.ViewObject.Visibility = view.Layout != ALONE
        if view.Layout == OVER:
            shown = source.ViewObject
            view.SourceLook = json.dumps({name: getattr(shown, name) for name in _LINES})
            _set(shown, _LINES)

    def dumps(self):
        """Nothing: the properties hold all."""

    def loads(self, _state):
        """Nothing to take back."""

    __getstate__, __setstate__ = dumps, loads


def _add_properties(view):
    if "Layout" not in view.PropertiesList:
        tip = "Where the result stands to its source"
        view.addProperty("App::PropertyEnumeration", "Layout", "Bladesmith", tip)
        view.Layout = list(LAYOUTS)
    if "SourceLook" not in view.PropertiesList:
        tip = "How the source was shown before, as JSON; empty: as it is"
        view.addProperty("App::PropertyString", "SourceLook", "Bladesmith", tip, 0, False, True)


def _restore(view):
    """Shows the source as it was before the result lay over it."""
    source = view.Object.Source
    if source is not None and view.SourceLook:
        _set(source.ViewObject, json.loads(view.SourceLook))
        source.ViewObject.Visibility = True
    view.SourceLook = ""


def _set(view, values: dict):
    for name, value in values.items():
        setattr(view, name, tuple(value) if isinstance(value, list) else value)


def _colour(obj):
    """The face colours of the STEP file; those of the source's view where no file says any."""
    count = len(obj.Shape.Faces)
    said = attributes.load(obj, count)[1]
    if said.colour or any(said.face_colours):
        obj.ViewObject.DiffuseColor = diffuse(said, obj.ViewObject.ShapeColor)
    elif obj.Source and len(obj.Source.ViewObject.DiffuseColor) == count > 1:
        obj.ViewObject.DiffuseColor = obj.Source.ViewObject.DiffuseColor


def diffuse(said, plain) -> list:
    """Colours by face for a view; ``plain`` where nothing is said."""
    return [(*(colour or said.colour or plain[:3]), 0.0) for colour in said.face_colours]
