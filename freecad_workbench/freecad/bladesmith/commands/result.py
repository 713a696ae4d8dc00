"""``Bladesmith_ShowResult``: the selected morph's result in the 3-D view, and its panel."""

import FreeCADGui

from ..features import shown
from .names import icon


class ShowResult:
    """Colours on the solid, enlarged movement, worst spot, joints by edge."""

    def GetResources(self):
        """Texts and icon."""
        return {
            "Pixmap": icon("Bladesmith_ShowResult"),
            "MenuText": "Show result",
            "ToolTip": "Shows displacement and deviation as colours, and the joints edge by edge",
        }

    def IsActive(self):
        """With one computed morph, a 3-D view, and no other panel."""
        return (
            not FreeCADGui.Control.activeDialog()
            and hasattr(FreeCADGui.activeView(), "getSceneGraph")
            and chosen_result() is not None
        )

    def Activated(self):
        """Opens the panel."""
        from ..taskpanels.result import ResultPanel

        FreeCADGui.Control.showDialog(ResultPanel(chosen_result(), FreeCADGui.activeView()))


def chosen_result():
    """The selected computed morph, or the only one of the document; None without."""
    if FreeCADGui.ActiveDocument is None:
        return None
    document = FreeCADGui.ActiveDocument.Document
    among = FreeCADGui.Selection.getSelection(document.Name) or document.Objects
    found = [obj for obj in among if shown.has_result(obj)]
    return found[0] if len(found) == 1 else None
