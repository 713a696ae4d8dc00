"""Errors of commands as a message box in plain words."""

import functools

import FreeCAD
import FreeCADGui
from PySide import QtGui

from ..native import BladesmithError
from ..taskpanels.words import for_panel


def reporting(method):
    """A method whose :class:`BladesmithError` is shown to the user instead of a traceback."""

    @functools.wraps(method)
    def guarded(self):
        try:
            return method(self)
        except BladesmithError as error:
            text = for_panel(str(error))
            FreeCAD.Console.PrintError(f"Bladesmith: {text}\n")
            QtGui.QMessageBox.warning(FreeCADGui.getMainWindow(), "Bladesmith", text)
            return None

    return guarded
