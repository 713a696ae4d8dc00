"""The command that shows the chosen morph's result."""

import FreeCADGui

from ..features import shown
from ..taskpanels.result import ResultPanel

NAME = "Bladesmith_ShowResult"


class ShowResult:
    """Colours on the solid, enlarged movement, edges and report of the selected morph."""

    def GetResources(self):
        """Called by FreeCAD: icon and texts."""
        return {
            "Pixmap": NAME,
            "MenuText": "Show result",
            "ToolTip": "Displacement and deviation as colours, enlarged movement, joints by edge",
        }

    def IsActive(self):
        """Called by FreeCAD: with one computed morph selected, or a single one in the document."""
        return not FreeCADGui.Control.activeDialog() and _chosen() is not None

    def Activated(self):
        """Called by FreeCAD: opens the panel."""
        show(_chosen())


def show(obj) -> ResultPanel:
    """Opens the panel for a computed morph, in its document's 3-D view."""
    panel = ResultPanel(obj, FreeCADGui.getDocument(obj.Document.Name).ActiveView)
    FreeCADGui.Control.showDialog(panel)
    return panel


def _chosen():
    selected = FreeCADGui.Selection.getSelection()
    document = FreeCADGui.ActiveDocument
    if document is None or not hasattr(document.ActiveView, "getSceneGraph"):
        return None
    among = selected or document.Document.Objects
    found = [obj for obj in among if shown.has_result(obj)]
    return found[0] if len(found) == 1 else None
