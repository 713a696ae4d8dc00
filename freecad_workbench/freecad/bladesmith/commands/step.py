"""``Bladesmith_ImportStep`` and ``Bladesmith_ExportStep``: STEP with names and colours of faces."""

import FreeCAD
import FreeCADGui
from PySide import QtGui

from . import exchange
from .names import icon
from .report_error import reporting


class ImportStep:
    """Asks for a file and puts its solids into the document."""

    def GetResources(self):
        """Texts and icon."""
        return {
            "Pixmap": icon("Bladesmith_ImportStep"),
            "MenuText": "Import STEP with names",
            "ToolTip": "Reads solids from a STEP file; names and colours of faces are kept",
        }

    def IsActive(self):
        """Whenever no panel is open."""
        return not FreeCADGui.Control.activeDialog()

    @reporting
    def Activated(self):
        """Imports the file the user chooses."""
        window = FreeCADGui.getMainWindow()
        path = QtGui.QFileDialog.getOpenFileName(window, "", "", exchange.IMPORT_FILTER)[0]
        if not path:
            return
        if FreeCAD.ActiveDocument is None:
            exchange.open(path)
            return
        document = FreeCAD.ActiveDocument
        document.openTransaction("Import STEP")
        try:
            exchange.insert(path, document.Name)
        except Exception:
            document.abortTransaction()
            raise
        document.commitTransaction()


class ExportStep:
    """Asks for a name and writes the selected solid."""

    def GetResources(self):
        """Texts and icon."""
        return {
            "Pixmap": icon("Bladesmith_ExportStep"),
            "MenuText": "Export STEP with names",
            "ToolTip": "Writes the selected solid as STEP; names and colours of faces are kept",
        }

    def IsActive(self):
        """With one object selected that has a solid."""
        chosen = FreeCADGui.Selection.getSelection()
        return len(chosen) == 1 and bool(
            getattr(chosen[0], "Shape", None) and chosen[0].Shape.Solids
        )

    @reporting
    def Activated(self):
        """Writes to the file the user names."""
        obj = FreeCADGui.Selection.getSelection()[0]
        window = FreeCADGui.getMainWindow()
        name = f"{obj.Label}.step"
        path = QtGui.QFileDialog.getSaveFileName(window, "", name, exchange.EXPORT_FILTER)[0]
        if path:
            exchange.export([obj], path)
