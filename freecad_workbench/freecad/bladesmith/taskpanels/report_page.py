"""The report's HTML page, written beside the window and opened in the user's browser."""

import tempfile
from importlib.util import find_spec
from pathlib import Path

from FreeCAD import Qt
from PySide import QtCore, QtGui

from ..features import shown
from ..native import BladesmithError, SetupError
from .worker import Worker


class ReportPage:
    """Opens pages on demand; ``button`` rests while one is drawn."""

    def __init__(self, button):
        self._button = button
        self._text = button.text()
        self._worker = Worker()
        self._worker.done.connect(self._open)
        self._worker.failed.connect(self._complain)

    def open(self, obj) -> None:
        """Draws the page of a result and opens it."""
        try:
            solids = [solid.copy(True, True) for solid in shown.solids(obj)]
            report, nodes = shown.report(obj), shown.nodes(obj)
        except BladesmithError as error:
            self._complain(error)
            return
        tolerance = obj.Tolerance.Value
        self._button.setEnabled(False)
        self._button.setText(Qt.translate("Bladesmith", "Drawing the report …"))
        self._worker.start(lambda _progress: write(report, solids, nodes, tolerance))

    def forget(self) -> None:
        """Lets a page that is being drawn go unopened."""
        self._worker.forget()

    def _rest(self) -> None:
        self._button.setEnabled(True)
        self._button.setText(self._text)

    def _open(self, path: str) -> None:
        self._rest()
        QtGui.QDesktopServices.openUrl(QtCore.QUrl.fromLocalFile(path))

    def _complain(self, error: BladesmithError) -> None:
        self._rest()
        title = Qt.translate("Bladesmith", "Report")
        QtGui.QMessageBox.warning(self._button.window(), title, str(error))


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
