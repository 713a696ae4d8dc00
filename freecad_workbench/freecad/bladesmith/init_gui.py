"""Bladesmith in FreeCAD's window: the workbench with its toolbar and menu."""

from pathlib import Path

import FreeCADGui

from .commands import COMMANDS, register

_ICONS = Path(__file__).parent / "resources" / "icons"


class BladesmithWorkbench(FreeCADGui.Workbench):
    """Toolbar and menu *Bladesmith*."""

    MenuText = "Bladesmith"
    ToolTip = "Hot-to-cold morphing of CAD solids by a finite-element displacement field"
    Icon = str(_ICONS / "Bladesmith.svg")

    def Initialize(self):
        """Called by FreeCAD when the workbench is first chosen."""
        self.appendToolbar("Bladesmith", COMMANDS)
        self.appendMenu("Bladesmith", COMMANDS)

    def GetClassName(self):
        """The kind of workbench that is written in Python."""
        return "Gui::PythonWorkbench"


register()
FreeCADGui.addWorkbench(BladesmithWorkbench())
