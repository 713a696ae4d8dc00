"""Work beside the window: in a thread, with progress, and cancelled within moments.

The core leaves Python's lock free while it works, so that the window goes on. Signals come in the
window's thread.
"""

import threading

from PySide import QtCore

from ..native import BladesmithError, Cancelled, InternalError

_INTERVAL_MS = 30


class Worker(QtCore.QObject):
    """Runs one call at a time; the call gets a progress function as its only argument."""

    progressed = QtCore.Signal(str, float)
    done = QtCore.Signal(object)
    failed = QtCore.Signal(object)
    """Gets the :class:`BladesmithError`, :class:`Cancelled` where it was asked to stop."""

    def __init__(self):
        super().__init__()
        self._timer = QtCore.QTimer(self)
        self._timer.setInterval(_INTERVAL_MS)
        self._timer.timeout.connect(self._poll)
        self._run = None

    @property
    def running(self) -> bool:
        """Whether a call is under way."""
        return self._run is not None

    def start(self, call) -> None:
        """Starts ``call``; one that is still under way is cancelled and forgotten."""
        self.forget()
        self._run = _Run(call)
        self._timer.start()

    def cancel(self) -> None:
        """Asks to stop; ``failed`` follows."""
        if self._run:
            self._run.cancelled = True

    def forget(self) -> None:
        """Asks to stop; no signal follows."""
        self.cancel()
        self._run = None
        self._timer.stop()

    def _poll(self):
        run = self._run
        if not run.finished.is_set():
            self.progressed.emit(*run.stage)
            return
        self.forget()
        if run.error is None:
            self.done.emit(run.result)
        else:
            self.failed.emit(run.error)


class _Run:
    """One call in its thread."""

    def __init__(self, call):
        self.stage = ("", 0.0)
        self.cancelled = False
        self.finished = threading.Event()
        self.result = self.error = None
        threading.Thread(target=self._work, args=(call,), daemon=True).start()

    def _work(self, call):
        try:
            self.result = call(self._progress)
            if self.cancelled:
                self.error = Cancelled("cancelled")
        except BladesmithError as error:
            self.error = error
        except Exception as error:
            self.error = InternalError(f"{type(error).__name__}: {error}")
        finally:
            self.finished.set()

    def _progress(self, stage: str, fraction: float) -> bool:
        self.stage = (stage, fraction)
        return not self.cancelled
