"""The report's HTML page, drawn beside the window and opened in the user's browser."""

import tempfile
from importlib.util import find_spec
from pathlib import Path

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

from ..features import shown
from ..native import BladesmithError, SetupError
from .words import for_panel
from .worker import Worker


class ReportPage(QtCore.QObject):
    """Draws pages on demand, one at a time, and opens them."""

    busy = QtCore.Signal(bool)
    """Gets whether a page is being drawn, when that changes."""

    def __init__(self):
        super().__init__()
        self._worker = Worker()
        self._worker.done.connect(self._open)
        self._worker.failed.connect(self._complain)

    def draw(self, obj) -> None:
        """Draws and opens the page about a computed morph."""
        try:
            # Copies with their triangles: drawing must neither wait for nor change the document's.
            solids = [solid.copy(True, True) for solid in shown.solids(obj)]
        except BladesmithError as error:
            self._complain(error)
            return
        report, nodes, tolerance = shown.report(obj), shown.nodes(obj), float(obj.Tolerance)
        self._worker.start(lambda _progress: write(report, solids, nodes, tolerance))
        self.busy.emit(True)

    def forget(self) -> None:
        """Lets a page that is being drawn go unopened."""
        if self._worker.running:
            self._worker.forget()
            self.busy.emit(False)

    def _open(self, path: str) -> None:
        self.busy.emit(False)
        show_in_browser(path)

    def _complain(self, error: BladesmithError) -> None:
        self.busy.emit(False)
        text = for_panel(str(error))
        FreeCAD.Console.PrintError(f"Bladesmith: {text}\n")
        QtGui.QMessageBox.warning(FreeCADGui.getMainWindow(), "Bladesmith", text)


def show_in_browser(path: str) -> None:
    """Opens a file with what the desktop has for it."""
    QtGui.QDesktopServices.openUrl(QtCore.QUrl.fromLocalFile(path))


def write(report, solids, nodes: dict, tolerance_mm: float) -> str:
    """Writes the page into a new folder; returns its path. Raises :class:`SetupError`."""
    if find_spec("matplotlib") is None:
        raise SetupError(
            "the report needs matplotlib: install it ('apt-get install python3-matplotlib' on "
            "Debian)"
        )
    from ..report import write_page

    folder = tempfile.mkdtemp(prefix="bladesmith-report-")
    write_page(folder, report, tuple(solids), nodes, tolerance_mm)
    return str(Path(folder, "report.html"))
