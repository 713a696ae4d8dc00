"""Broken and awkward inputs in the panel: each in words a user can act on. Runs inside FreeCAD."""

import unittest

import FreeCAD
import FreeCADGui
import Part
from freecad.bladesmith.commands import exchange
from freecad.bladesmith.native import InputError
from freecad.bladesmith.occ import step
from PySide import QtGui
from window import ROOT, child, press, press_dialog, press_toolbar, screenshot, settle, wait_until

PACKED = ROOT / "tests" / "data" / "p5"
AWKWARD = ROOT / "target" / "tmp" / "p5"

REFUSED = {
    "partial_face": r"areas without nodes.*give a tick at Extrapolate",
    "partial_disp": r"(areas without nodes|without a (result|displacement)).*Extrapolate",
    "no_disp": r"no_disp.frd: .*(no displacement|DISP).*",
    "metres": r"Length unit: m\b",
    "huge_disp": r"larger than the (part|model)|folded",
    "truncated": r"truncated.frd.*\d+ of 2425",
    "mirrored": r"does not lie on the geometry.*[\d.]+ mm.*Match within",
    "other_frame": r"does not lie on the geometry.*[\d.]+ mm",
    "empty": r"empty.frd.*empty",
    "not_frd": r"not_frd.frd.*results",
    "nan": r"nan.frd.*\b7\b.*\b418\b",
}
"""By file: what the check must say in red."""

WARNED = {
    "disp_metres_only": r"give Scale 1000",
    "zero_disp": r"all displacements are zero",
    "duplicate_nodes": r"\b3\b.*\b50\b.*\b300\b",
    "two_steps": r"step 2 of 2",
    "gaps_shuffled": r"no elements",
    "crlf": r"nodes lie on the part",
}
"""By file: what the check must say without refusing it."""


class Panel(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        FreeCADGui.activateWorkbench("BladesmithWorkbench")
        cls.document = FreeCAD.newDocument()
        for name in ("base", "sphere"):
            path = str(PACKED / f"{name}.step.gz")
            exchange.insert(path, cls.document.Name)[0].Label = name
        two = step.read(str(PACKED / "two_solids.step.gz")).shape
        for name, shape in (("two solids", two), ("faces", Part.Shell(two.Solids[0].Faces[:5]))):
            cls.document.addObject("Part::Feature", "Part").Shape = shape
            cls.document.Objects[-1].Label = name
        cls.document.recompute()
        FreeCADGui.activeDocument().activeView().viewIsometric()
        FreeCADGui.SendMsgToActiveView("ViewFit")
        FreeCADGui.Selection.addSelection(cls.document.Objects[0])
        press_toolbar("Morph")
        cls.morph = cls.document.getObject("Morph")
        cls.panel = cls.morph.ViewObject.Proxy.panel
        child(QtGui.QDoubleSpinBox, "factor").setValue(1.0)

    @classmethod
    def tearDownClass(cls):
        press_dialog(QtGui.QDialogButtonBox.Cancel)
        FreeCAD.closeDocument(cls.document.Name)

    def checked(self, path, source="base") -> str:
        """What the panel says of these two, as plain text."""
        box = child(QtGui.QComboBox, "source")
        box.setCurrentIndex(box.findText(source))
        child(QtGui.QLineEdit, "fieldFile").setText(str(path))
        wait_until(lambda: not self.panel.checking, 30)
        document = QtGui.QTextDocument()
        document.setHtml(child(QtGui.QLabel, "check").text())
        text = document.toPlainText()
        self.assertNotIn("--", text, "an option of the command line")
        return text

    def test_what_is_refused_is_refused_at_once_and_again_when_run(self):
        for name, pattern in REFUSED.items():
            with self.subTest(name):
                said = self.checked(AWKWARD / f"{name}.frd")
                self.assertIsInstance(self.panel.error, InputError, said)
                self.assertRegex(said, pattern)
                press("morph")
                wait_until(lambda: not self.panel.busy)
                self.assertIsInstance(self.panel.error, InputError)
                self.assertTrue(self.morph.Shape.isNull())
                if name in ("metres", "mirrored"):
                    child(QtGui.QWidget, "checkGroup").setFocus()
                    screenshot(f"8-refused-{name}")

    def test_what_is_odd_is_told_and_can_be_run(self):
        for name, pattern in WARNED.items():
            with self.subTest(name):
                said = self.checked(AWKWARD / f"{name}.frd")
                self.assertIsNone(self.panel.error, said)
                self.assertRegex(said, pattern)

    def test_lengths_are_plain_millimetres(self):
        tolerance, match = (
            child(QtGui.QDoubleSpinBox, name) for name in ("tolerance", "matchTolerance")
        )
        self.assertEqual((tolerance.text(), match.text()), ("0.001000 mm", "automatic"))
        match.setValue(0.02)
        self.checked(PACKED / "base.frd.gz")
        self.assertAlmostEqual(float(self.morph.MatchTolerance), 0.02)
        match.setValue(0)
        self.morph.Tolerance = 0.0010004
        self.checked(PACKED / "coarse.frd.gz")
        self.assertEqual(
            float(self.morph.Tolerance), 0.0010004, "digits that are not shown are lost"
        )
        self.assertEqual(float(self.morph.MatchTolerance), 0.0)
        self.morph.Tolerance = 0.001

    def test_what_is_told_to_do_helps(self):
        unit = child(QtGui.QComboBox, "fieldUnit")
        self.checked(AWKWARD / "metres.frd")
        self.assertIsNotNone(self.panel.error)
        unit.setCurrentIndex(unit.findText("m"))
        self.checked(AWKWARD / "metres.frd")
        self.assertIsNone(self.panel.error)
        unit.setCurrentIndex(0)
        tick = child(QtGui.QCheckBox, "extrapolate")
        self.checked(AWKWARD / "partial_face.frd")
        self.assertIsNotNone(self.panel.error)
        tick.setChecked(True)
        self.assertIn("extrapolated", self.checked(AWKWARD / "partial_face.frd"))
        self.assertIsNone(self.panel.error)
        tick.setChecked(False)

    def test_parts_that_are_not_one_solid(self):
        field = PACKED / "base.frd.gz"
        self.assertIn("only solid 1 is morphed", self.checked(field, "two solids"))
        self.assertIsNone(self.panel.error)
        self.assertRegex(self.checked(field, "faces"), "no solid, it holds 5 faces only; sew")
        self.assertIsNotNone(self.panel.error)
        with self.assertRaisesRegex(InputError, "no solid in this file"):
            exchange.insert(str(PACKED / "faces_only.step.gz"), self.document.Name)
        self.assertIn("lie on the part", self.checked(PACKED / "sphere.frd.gz", "sphere"))

    def test_few_nodes_are_warned_of_after_the_run(self):
        self.checked(PACKED / "coarse.frd.gz")
        press("morph")
        wait_until(lambda: not self.panel.busy)
        self.assertIsNone(self.panel.error)
        self.assertRegex(child(QtGui.QLabel, "result").text(), r"empty knot spans: \d+ of \d+")
        self.document.getObject("Morph").Shape = Part.Shape()
        settle()
