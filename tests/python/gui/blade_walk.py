"""A user's walk through the window with the compressor blade. Runs inside FreeCAD, see run.py."""

import json
import tempfile
import unittest
from pathlib import Path

import FreeCAD
import FreeCADGui
from freecad.bladesmith.commands import exchange
from PySide import QtGui
from window import (
    EXAMPLE,
    Starvation,
    child,
    press,
    press_dialog,
    press_toolbar,
    screenshot,
    settle,
    wait_until,
)

OK, CANCEL = QtGui.QDialogButtonBox.Ok, QtGui.QDialogButtonBox.Cancel
TICKS = 10
"""Turns of the window's timer during a morph at least; one that blocks it leaves none."""


class Walk(unittest.TestCase):
    def setUp(self):
        FreeCADGui.activateWorkbench("BladesmithWorkbench")
        self.document = exchange.open(str(EXAMPLE / "hot.step.gz"))
        view = FreeCADGui.activeDocument().activeView()
        view.viewIsometric()
        view.fitAll()
        self.source = self.document.Objects[0]
        for dock in FreeCADGui.getMainWindow().findChildren(QtGui.QDockWidget):
            if dock.objectName() in ("Python console", "Report view"):
                dock.hide()

    def tearDown(self):
        if FreeCADGui.Control.activeDialog():
            press_dialog(CANCEL)
            wait_until(lambda: self.panel is None or not self.panel.busy)
        if FreeCADGui.Control.activeDialog():
            press_dialog(CANCEL)
        FreeCAD.closeDocument(self.document.Name)

    @property
    def morph(self):
        return self.document.getObject("Morph")

    @property
    def panel(self):
        return self.morph.ViewObject.Proxy.panel if self.morph else None

    def open_panel(self):
        press_toolbar("Morph")
        self.assertIsNotNone(self.morph)

    def choose_files(self):
        child(QtGui.QLineEdit, "fieldFile").setText(str(EXAMPLE / "blade.frd.gz"))
        child(QtGui.QLineEdit, "meshFile").setText(str(EXAMPLE / "blade.inp.gz"))
        check = child(QtGui.QLabel, "check")
        wait_until(lambda: "nodes lie on the part" in check.text() or self.panel.error, 30)
        self.assertIsNone(self.panel.error)
        self.assertRegex(check.text(), r"\d+ nodes with a displacement, step 1 of 1")
        self.assertRegex(check.text(), r"Largest displacement [\d.]+ at node \d+")

    def morph_now(self):
        press("morph")
        self.assertTrue(self.panel.busy, self.panel.error)
        wait_until(lambda: not self.panel.busy)
        self.assertIsNone(self.panel.error)

    def test_1_from_toolbar_to_saved_document(self):
        screenshot("1-part")
        self.open_panel()
        screenshot("2-panel")
        self.choose_files()
        screenshot("3-input-checked")
        self.morph_now()
        self.assert_result(self.morph)
        child(QtGui.QLabel, "result").parent().ensurePolished()
        screenshot("4-morphed")
        press_dialog(OK)
        wait_until(lambda: not FreeCADGui.Control.activeDialog())
        screenshot("5-result")
        self.assertEqual(self.document.UndoNames, ["Morph"])
        self.document.undo()
        self.assertIsNone(self.morph)
        self.document.redo()
        self.assert_result(self.morph)
        self.assertEqual(self.source.ViewObject.DisplayMode, "Wireframe")
        for layout in ("Beside its source", "Alone"):
            self.morph.ViewObject.Layout = layout
            self.assertEqual(self.source.ViewObject.DisplayMode, "Flat Lines")
            self.assertEqual(self.source.ViewObject.LineWidth, 2.0)
            FreeCADGui.SendMsgToActiveView("ViewFit")
            screenshot(f"6-{layout.split()[0].lower()}")
        self.assertFalse(self.source.ViewObject.Visibility)
        self.reopen()

    def reopen(self):
        with tempfile.TemporaryDirectory() as folder:
            path = str(Path(folder, "blade.FCStd"))
            volume = self.morph.Shape.Volume
            self.document.saveAs(path)
            FreeCAD.closeDocument(self.document.Name)
            self.document = FreeCAD.openDocument(path)
            self.assert_result(self.morph)
            self.assertEqual(self.morph.ViewObject.Layout, "Alone")
            self.morph.touch()
            self.document.recompute()
            self.assert_result(self.morph)
            self.assertAlmostEqual(self.morph.Shape.Volume / volume, 1.0, places=9)
            self.edit_again()

    def edit_again(self):
        self.morph.ViewObject.Proxy.doubleClicked(self.morph.ViewObject)
        self.assertTrue(FreeCADGui.Control.activeDialog())
        factor = child(QtGui.QDoubleSpinBox, "factor")
        self.assertEqual(factor.value(), -1.0)
        way, result = child(QtGui.QLabel, "direction"), child(QtGui.QLabel, "result")
        self.assertEqual(way.text(), "hot to cold")
        self.assertNotIn("changed since", result.text())
        factor.setValue(1.0)
        self.assertEqual(way.text(), "cold to hot")
        wait_until(lambda: not self.panel.checking)
        self.assertIn("changed since", result.text())
        self.assertNotIn("#2e7d32", result.text(), "an old verdict is still green")
        self.morph_now()
        self.assertNotIn("changed since", result.text())
        self.assertEqual(self.morph.Factor, 1.0)
        press_dialog(CANCEL)
        self.assertFalse(FreeCADGui.Control.activeDialog())
        self.assertEqual(self.morph.Factor, -1.0)
        self.assert_result(self.morph)

    def assert_result(self, morph):
        self.assertTrue(morph.isValid(), morph.getStatusString())
        self.assertTrue(morph.Shape.isValid() and morph.Shape.isClosed())
        self.assertEqual(len(morph.Shape.Faces), len(self.source_faces(morph)))
        report = json.loads(morph.ReportJson)
        self.assertLess(report["deviation_mm"]["max"], 1e-3)
        self.assertEqual(len(morph.NodeFeet), len(morph.NodeIds))
        moved = morph.Shape.CenterOfMass.distanceToPoint(morph.Source.Shape.CenterOfMass)
        self.assertGreater(moved, 1e-3)

    def source_faces(self, morph):
        return morph.Source.Shape.Faces

    def test_2_the_window_answers_all_the_time(self):
        self.open_panel()
        self.choose_files()
        settle()
        with Starvation() as starvation:
            self.morph_now()
        starvation.keep("responsiveness")
        self.assertGreater(starvation.ticks, TICKS)

    def test_3_a_run_is_stopped(self):
        self.open_panel()
        self.choose_files()
        press("morph")
        stage = child(QtGui.QLabel, "stage")
        wait_until(lambda: "fitting" in stage.text() or not self.panel.busy)
        screenshot("7-progress")
        self.assertTrue(self.panel.busy, "it was over before it could be stopped")
        press("stop")
        wait_until(lambda: not self.panel.busy)
        self.assertIn("Stopped", child(QtGui.QLabel, "check").text())
        self.assertTrue(self.morph.Shape.isNull())
        press_dialog(CANCEL)
        self.assertIsNone(self.morph)
        self.assertEqual(self.document.UndoCount, 0)
