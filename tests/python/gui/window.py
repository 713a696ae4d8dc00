"""FreeCAD's window in a test: waiting, pressing, looking. Runs inside FreeCAD."""

import json
import os
import time
from pathlib import Path

import FreeCADGui
from PySide import QtCore, QtGui

ROOT = Path(__file__).resolve().parents[3]
SHOTS = Path(os.environ.get("BLADESMITH_SCREENSHOTS", ROOT / "build" / "screenshots"))
EXAMPLE = ROOT / "examples" / "compressor_blade"

_SETTLE_S = 0.3


def wait_until(condition, seconds: float = 120.0) -> None:
    """Lets the window's own event loop run until ``condition`` holds; fails after ``seconds``."""
    loop, timer, end = QtCore.QEventLoop(), QtCore.QTimer(), time.monotonic() + seconds
    timer.timeout.connect(lambda: loop.quit() if condition() or time.monotonic() > end else None)
    timer.start(10)
    loop.exec_()
    timer.stop()
    if not condition():
        raise AssertionError(f"waited {seconds:g} s in vain")


def settle() -> None:
    """Lets everything be drawn."""
    end = time.monotonic() + _SETTLE_S
    wait_until(lambda: time.monotonic() > end)


def screenshot(name: str) -> None:
    """Keeps the screen, 3-D view included, as ``name.png``."""
    settle()
    SHOTS.mkdir(parents=True, exist_ok=True)
    QtGui.QApplication.primaryScreen().grabWindow(0).save(str(SHOTS / f"{name}.png"))


def press_toolbar(text: str) -> None:
    """Presses the button of Bladesmith's toolbar that is called ``text``."""
    bar = child(QtGui.QToolBar, "Bladesmith")
    found = [action for action in bar.actions() if action.text().replace("&", "") == text]
    if not found:
        raise AssertionError(f"no button '{text}' among {[a.text() for a in bar.actions()]}")
    wait_until(found[0].isEnabled, 5)
    found[0].trigger()


def child(kind, name: str):
    """The widget of the main window with this class and object name."""
    found = FreeCADGui.getMainWindow().findChildren(kind, name)
    if len(found) != 1:
        raise AssertionError(f"the window has {len(found)} {kind.__name__} called {name}, not 1")
    return found[0]


def press(name: str) -> None:
    """Clicks a button by its object name."""
    child(QtGui.QPushButton, name).click()


def press_dialog(which) -> None:
    """Clicks OK or Cancel of the task view."""
    for box in FreeCADGui.getMainWindow().findChildren(QtGui.QDialogButtonBox):
        button = box.button(which)
        if button is not None and button.isVisible():
            button.click()
            return
    raise AssertionError("the task view has no such button")


class Starvation:
    """How long a 20 ms timer of the window waited for its turn while inside, at most; in seconds.

    ``wall`` by the clock. ``own`` counts of each wait no more than the processor time that this
    process used in it: what is left when others keep the machine busy. ``ticks`` is how often the
    timer had its turn.
    """

    def __enter__(self):
        self.wall = self.own = 0.0
        self.ticks = 0
        self._last = self._now()
        self._timer = QtCore.QTimer()
        self._timer.timeout.connect(self._tick)
        self._timer.start(20)
        return self

    @staticmethod
    def _now():
        return time.perf_counter(), time.process_time()

    def _tick(self):
        now = self._now()
        wall, used = (b - a for a, b in zip(self._last, now))
        self.wall, self.own = max(self.wall, wall), max(self.own, min(wall, used))
        self._last = now
        self.ticks += 1

    def keep(self, name: str) -> None:
        """Writes the figures beside the screenshots."""
        SHOTS.mkdir(parents=True, exist_ok=True)
        figures = {"wall_s": self.wall, "own_s": self.own, "ticks": self.ticks}
        (SHOTS / f"{name}.json").write_text(json.dumps(figures) + "\n")

    def __exit__(self, *_exception):
        self._tick()
        self._timer.stop()
