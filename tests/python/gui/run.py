"""Runs a module of tests inside FreeCAD: ``freecad run.py`` with BLADESMITH_GUI_TESTS=module.

The words of unittest go to the file BLADESMITH_GUI_LOG; the exit code says whether all passed.
"""

import os
import sys
import traceback
import unittest

from PySide import QtCore

_START_MS = 500


def run() -> None:
    """Runs the tests and ends the process: FreeCAD itself would end with 0 whatever happened."""
    code = 1
    sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
    with open(os.environ["BLADESMITH_GUI_LOG"], "w", encoding="utf-8") as log:
        try:
            suite = unittest.defaultTestLoader.loadTestsFromName(os.environ["BLADESMITH_GUI_TESTS"])
            done = unittest.TextTestRunner(log, verbosity=2).run(suite)
            code = 0 if done.wasSuccessful() and done.testsRun else 1
        except BaseException:
            traceback.print_exc(file=log)
    os._exit(code)


QtCore.QTimer.singleShot(_START_MS, run)
