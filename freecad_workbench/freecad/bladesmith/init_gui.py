"""Bladesmith in FreeCAD's window: workbench, file types and preferences page."""

from pathlib import Path

import FreeCADGui

from . import log
from .commands import exchange
from .commands.morph import Morph
from .commands.names import COMMANDS, icon
from .commands.report import OpenReport
from .commands.result import ShowResult
from .commands.step import ExportStep, ImportStep
from .taskpanels.morph import MorphPanel
from .viewproviders.morph import MorphView

_RESOURCES = Path(__file__).parent / "resources"

_REGISTERED = {
    "Bladesmith_ImportStep": ImportStep,
    "Bladesmith_Morph": Morph,
    "Bladesmith_ShowResult": ShowResult,
    "Bladesmith_OpenReport": OpenReport,
    "Bladesmith_ExportStep": ExportStep,
}


class BladesmithWorkbench(FreeCADGui.Workbench):
    """Toolbar and menu *Bladesmith*."""

    MenuText = "Bladesmith"
    ToolTip = "Hot-to-cold morphing of CAD solids by a finite-element displacement field"
    Icon = icon("Bladesmith")

    def Initialize(self):
        """Called by FreeCAD when the workbench is first chosen."""
        known = {"Separator", *FreeCADGui.listCommands()}
        commands = [name for name in COMMANDS if name in known]
        self.appendToolbar("Bladesmith", commands)
        self.appendMenu("Bladesmith", commands)

    def GetClassName(self):
        """The kind of workbench that is written in Python."""
        return "Gui::PythonWorkbench"


log.start("FreeCAD")
FreeCADGui.addLanguagePath(str(_RESOURCES / "translations"))
FreeCADGui.updateLocale()
FreeCADGui.addIconPath(str(_RESOURCES / "icons"))
FreeCADGui.addPreferencePage(str(_RESOURCES / "panels" / "preferences.ui"), "Bladesmith")
for name, command in _REGISTERED.items():
    FreeCADGui.addCommand(name, command())
exchange.register()
MorphView.make_panel = staticmethod(MorphPanel)
FreeCADGui.addWorkbench(BladesmithWorkbench())
