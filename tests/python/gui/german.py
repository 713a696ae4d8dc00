"""The window in German. Runs inside FreeCAD, see run.py."""

import unittest

import FreeCADGui
from freecad.bladesmith.commands import exchange
from freecad.bladesmith.taskpanels import words
from PySide import QtGui
from window import EXAMPLE, child, press_dialog, press_toolbar, screenshot


class German(unittest.TestCase):
    def test_commands_and_panel_speak_german(self):
        FreeCADGui.activateWorkbench("BladesmithWorkbench")
        exchange.open(str(EXAMPLE / "hot.step.gz"))
        press_toolbar("Morphen")
        self.assertEqual(child(QtGui.QGroupBox, "fieldGroup").title(), "Verschiebungen")
        self.assertEqual(child(QtGui.QPushButton, "morph").text(), "Morphen")
        self.assertEqual(child(QtGui.QComboBox, "fieldObject").currentText(), "einer Datei")
        kept = "the field holds Face2 still; its gradient jumps at the edges there"
        self.assertIn("Das Feld hält Face2 fest", words.for_panel(kept))
        screenshot("9-german")
        press_dialog(QtGui.QDialogButtonBox.Cancel)
