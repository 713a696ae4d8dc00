"""``Bladesmith_Morph``: a new morph of the selected object, and its panel."""

import FreeCAD
import FreeCADGui

from ..features import morph
from ..viewproviders.morph import MorphView
from .names import icon


class Morph:
    """Makes the object within a transaction that the panel ends."""

    def GetResources(self):
        """Texts and icon; FreeCAD translates them by the command's name."""
        return {
            "Pixmap": icon("Bladesmith_Morph"),
            "MenuText": "Morph",
            "ToolTip": "Moves a solid by the displacements of a finite-element analysis",
        }

    def IsActive(self):
        """With a document and no other panel."""
        return FreeCAD.ActiveDocument is not None and not FreeCADGui.Control.activeDialog()

    def Activated(self):
        """Edits the selected morph, or makes one of what is selected."""
        document = FreeCAD.ActiveDocument
        chosen = FreeCADGui.Selection.getSelection(document.Name)
        solids = [o for o in chosen if getattr(o, "Shape", None) and o.Shape.Solids]
        FreeCADGui.Selection.clearSelection()
        document.openTransaction("Morph")
        obj = morph.create(document, solids[0] if solids else _only_solid(document))
        MorphView(obj.ViewObject)
        FreeCADGui.getDocument(document.Name).setEdit(obj.Name)


def _only_solid(document):
    found = [o for o in document.Objects if getattr(o, "Shape", None) and o.Shape.Solids]
    return found[0] if len(found) == 1 else None
