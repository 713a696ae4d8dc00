"""The panel of a morph: input with a live check, the run with progress, the verdict.

All that the panel does to the document is one step of undo. The work is done beside the window;
when it is finished, the object's recompute takes the result.
"""

from pathlib import Path

import FreeCAD
import FreeCADGui
from PySide import QtCore, QtGui

from ..features import morph, shown
from ..model import Report
from ..native import BladesmithError, Cancelled
from ..occ.drawing import with_triangles
from ..operations.morph import Job, check
from . import words
from .form import Form
from .words import translate
from .worker import Worker
from .wrapping import Wrapping

_UI = Path(__file__).parents[1] / "resources" / "panels" / "morph.ui"
_PAUSE_MS = 250
"""The check waits this long for further typing."""
_LAYOUT_MS = 50
"""Time for widgets that have just been shown to find their place."""


class MorphPanel:
    """What FreeCAD's task view asks of a panel, for one morph object."""

    def __init__(self, obj):
        self.obj = obj
        self.form = FreeCADGui.PySideUic.loadUi(str(_UI))
        self.error = None
        """The :class:`BladesmithError` that is shown, or None."""
        self._fields = Form(self.form, obj)
        self._texts = Wrapping(self.form.check, self.form.result)
        self._worker, self._checker = Worker(), Worker()
        self._close_after = False
        self._pause = QtCore.QTimer(self.form)
        self._pause.setSingleShot(True)
        self._pause.setInterval(_PAUSE_MS)
        self._connect()
        self._enable(True)
        self._show_result()
        self._wait()

    def _connect(self):
        self._fields.changed.connect(self._wait)
        self._pause.timeout.connect(self._check)
        self._checker.done.connect(lambda found: self._say(words.check(*found)))
        self._checker.failed.connect(self._refuse)
        self._worker.progressed.connect(self._progress)
        self._worker.done.connect(self._finish)
        self._worker.failed.connect(self._fail)
        self.form.morph.clicked.connect(self.run)
        self.form.stop.clicked.connect(self._worker.cancel)
        self.form.showResult.clicked.connect(lambda: self._command("Bladesmith_ShowResult"))
        self.form.openReport.clicked.connect(lambda: self._command("Bladesmith_OpenReport"))

    def getStandardButtons(self):
        """OK morphs if need be and closes, Cancel takes everything back."""
        return int(QtGui.QDialogButtonBox.Ok | QtGui.QDialogButtonBox.Cancel)

    def accept(self):
        """Closes where the result is that of the input; morphs first where it is not."""
        self._fields.write()
        if "Touched" in self.obj.State or not self.obj.isValid() or self.obj.Shape.isNull():
            self._close_after = True
            self.run()
            return False
        self._stop_all()
        self.obj.Document.commitTransaction()
        _leave(self.obj.Document)
        return True

    def reject(self):
        """Stops a run; where there is none, takes back what was done since the panel opened."""
        if self._worker.running:
            self._worker.cancel()
            return False
        document = self.obj.Document
        self._stop_all()
        document.abortTransaction()
        _leave(document)
        return True

    @property
    def busy(self) -> bool:
        """Whether a morph is being computed."""
        return self._worker.running

    @property
    def checking(self) -> bool:
        """Whether the input is being checked, or about to be."""
        return self._pause.isActive() or self._checker.running

    def run(self):
        """Starts to morph what the form shows."""
        if self.busy:
            return
        self._checker.forget()
        self._pause.stop()
        try:
            job = self._job()
        except BladesmithError as error:
            self._fail(error)
            return
        deviation = self.obj.ViewObject.Deviation
        self._enable(False)
        self._reveal(self.form.running)
        self._worker.start(lambda progress: _completed(job, progress, deviation))

    def _job(self) -> Job:
        self._fields.write()
        return morph.job_of(self.obj)

    def _wait(self):
        self._checker.forget()
        self._say(words.plain(translate("Checking …")))
        self._pause.start()

    def _check(self):
        if self.busy:
            return
        self._fields.write()
        self._show_result()
        if not self.obj.FieldFile and self.obj.FieldObject is None:
            text = translate("Choose a file with displacements, or a result of the FEM workbench.")
            self._say(words.plain(text))
            return
        try:
            job = self._job()
        except BladesmithError as error:
            self._checker.forget()
            self._refuse(error)
            return
        self._checker.start(lambda progress: check(job, progress))

    def _say(self, text: str):
        self.error = None
        self._texts.set_text(self.form.check, text)

    def _refuse(self, error: BladesmithError):
        self.error = error
        self._texts.set_text(self.form.check, words.error(str(error)))

    def _progress(self, stage: str, fraction: float):
        self.form.progress.setValue(round(1000 * fraction))
        self.form.stage.setText(translate(stage))

    def _finish(self, ready: morph.Computed):
        self._enable(True)
        self.error = None
        self.obj.Proxy.offer(ready)
        self.obj.Document.recompute()
        if not self.obj.isValid():
            self._refuse(BladesmithError(self.obj.getStatusString()))
            return
        self._show_result()
        self._reveal(self.form.resultGroup)
        if self._close_after:
            self.accept()

    def _fail(self, error: BladesmithError):
        self._enable(True)
        self._close_after = False
        if isinstance(error, Cancelled):
            self._say(words.error(translate("Stopped; the object stays as it was.")))
            return
        self._refuse(error)
        self._show_result()
        FreeCAD.Console.PrintError(f"Bladesmith: {words.for_panel(str(error))}\n")

    def _enable(self, enabled: bool):
        for name in ("partGroup", "fieldGroup", "fitGroup"):
            getattr(self.form, name).setEnabled(enabled)
        self.form.morph.setVisible(enabled)
        self.form.running.setVisible(not enabled)

    def _show_result(self):
        text = self.obj.ReportJson
        self.form.resultGroup.setVisible(bool(text))
        if text:
            report, tolerance = Report.of_text(text), float(self.obj.Tolerance)
            current = shown.is_current(self.obj)
            self._texts.set_text(self.form.result, words.result(report, tolerance, current))
        known = FreeCADGui.listCommands()
        self.form.showResult.setVisible("Bladesmith_ShowResult" in known)

    def _reveal(self, widget):
        """Scrolls to a widget, once it has its place."""
        for area in FreeCADGui.getMainWindow().findChildren(QtGui.QScrollArea):
            if area.isAncestorOf(widget):
                QtCore.QTimer.singleShot(_LAYOUT_MS, lambda a=area: a.ensureWidgetVisible(widget))

    def _command(self, name: str):
        FreeCADGui.Selection.clearSelection()
        FreeCADGui.Selection.addSelection(self.obj)
        FreeCADGui.runCommand(name)

    def _stop_all(self):
        self._checker.forget()
        self._worker.forget()
        self._pause.stop()


def _leave(document):
    """Ends the editing; before it, the transaction must be over, or FreeCAD commits it."""
    FreeCADGui.getDocument(document.Name).resetEdit()
    FreeCADGui.Control.closeDialog()


def _completed(job: Job, progress, deviation: float) -> morph.Computed:
    """The result of a job, with triangles, so that the window need not make them."""
    ready = morph.computed(job, progress)
    result = ready.result
    result.shape = with_triangles(result.brep, deviation, lambda: progress("drawing", 1.0))
    return ready
