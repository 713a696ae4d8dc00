"""``Bladesmith_OpenReport``: the page about the selected morph in the browser."""

import tempfile
from pathlib import Path

import FreeCADGui
from PySide import QtCore, QtGui

from ..features import morph
from ..model import Report
from ..native import InputError
from .names import icon
from .report_error import reporting


class OpenReport:
    """Writes the page into a temporary folder and opens it."""

    def GetResources(self):
        """Texts and icon."""
        return {
            "Pixmap": icon("Bladesmith_OpenReport"),
            "MenuText": "Open report",
            "ToolTip": "Opens the page about a morph: verdict, figures and pictures",
        }

    def IsActive(self):
        """With one morph selected that has been computed."""
        chosen = FreeCADGui.Selection.getSelection()
        return len(chosen) == 1 and morph.is_morph(chosen[0]) and bool(chosen[0].ReportJson)

    @reporting
    def Activated(self):
        """Opens the page of the selected morph."""
        obj = FreeCADGui.Selection.getSelection()[0]
        QtGui.QApplication.setOverrideCursor(QtCore.Qt.WaitCursor)
        try:
            page = write(obj, tempfile.mkdtemp(prefix="bladesmith-report-"))
        finally:
            QtGui.QApplication.restoreOverrideCursor()
        QtGui.QDesktopServices.openUrl(QtCore.QUrl.fromLocalFile(page))


def write(obj, folder: str) -> str:
    """Writes the page about ``obj`` into ``folder``; returns its path.

    Raises :class:`InputError` where source and result are no longer those of the report.
    """
    import numpy

    from ..report import write_page

    report = Report.of_text(obj.ReportJson)
    source = obj.Source.Shape.Solids if obj.Source else []
    if not source:
        raise InputError(f"{obj.Label}: the source of this result is gone; morph again")
    from ..occ.step import nearest_solid

    nodes = {
        "ids": numpy.array(obj.NodeIds),
        "faces": numpy.array(obj.NodeFaces),
        "feet": numpy.array(obj.NodeFeet).reshape(-1, 3),
        "displacements": numpy.array(obj.NodeDisplacements).reshape(-1, 3),
        "deviations": numpy.array(obj.NodeDeviations).reshape(-1, 3),
    }
    shapes = (source[nearest_solid(source, obj.Shape)], obj.Shape)
    write_page(folder, report, shapes, nodes, float(obj.Tolerance))
    return str(Path(folder, "report.html"))
