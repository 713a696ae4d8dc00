"""STEP through FreeCAD's menus, the report, a FEM result in the panel. Runs inside FreeCAD."""

import importlib
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import FreeCAD
import FreeCADGui
from freecad.bladesmith import log
from freecad.bladesmith.commands import exchange
from freecad.bladesmith.features import fem, morph, shown
from freecad.bladesmith.native import InputError
from freecad.bladesmith.occ import step
from freecad.bladesmith.occ.attributes import SolidAttributes
from freecad.bladesmith.taskpanels import report_page
from freecad.bladesmith.viewproviders.morph import MorphView
from PySide import QtGui
from window import ROOT, child, press_dialog, press_toolbar, wait_until

PACKED = ROOT / "tests" / "data" / "p5"
NAMES = ["root", "tip", "", "pressure side", "x", "y"]
COLOURS = [(1.0, 0.0, 0.0), None, None, (0.25, 0.5, 0.75), None, None]


class Exchange(unittest.TestCase):
    def setUp(self):
        FreeCADGui.activateWorkbench("BladesmithWorkbench")
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.hot = str(self.folder / "hot.step")
        shape = step.read(str(PACKED / "base.step.gz")).shape
        said = SolidAttributes("bar", (0.5, 0.5, 0.5), NAMES, COLOURS, [])
        step.write(shape, self.hot, "Riegel", said, "test")
        self.document = FreeCAD.newDocument()

    def tearDown(self):
        FreeCAD.closeDocument(self.document.Name)

    def menu_module(self, kinds):
        """The module that FreeCAD's menus use for our file type."""
        self.assertEqual(kinds.count("freecad.bladesmith.commands.exchange"), 1, kinds)
        return importlib.import_module("freecad.bladesmith.commands.exchange")

    def morphed(self):
        source = self.menu_module(FreeCAD.getImportType("step")).insert(
            self.hot, self.document.Name
        )
        obj = morph.create(self.document, source[0])
        MorphView(obj.ViewObject)
        obj.FieldFile = str(PACKED / "base.frd.gz")
        self.document.recompute()
        self.assertTrue(obj.isValid(), obj.getStatusString())
        return obj

    def test_names_and_colours_go_from_menu_to_menu(self):
        obj = self.morphed()
        for view in (obj.Source.ViewObject, obj.ViewObject):
            shown = [tuple(round(c, 3) for c in colour[:3]) for colour in view.DiffuseColor]
            self.assertEqual(shown, [colour or (0.5, 0.5, 0.5) for colour in COLOURS])
        cold = str(self.folder / "cold.step")
        self.menu_module(FreeCAD.getExportType("step")).export([obj], cold)
        found = step.read(cold)
        self.assertEqual(found.product, "cold")
        self.assertEqual(found.solids[0].face_names, NAMES)
        self.assertEqual(found.solids[0].face_colours, COLOURS)
        with self.assertRaisesRegex(InputError, "select one solid"):
            exchange.export([obj, obj.Source], cold)

    def test_what_ends_an_import_or_export_is_in_the_log(self):
        missing = str(self.folder / "missing.step")
        with self.assertRaisesRegex(InputError, "No such file"):
            exchange.insert(missing, self.document.Name)
        with self.assertRaisesRegex(InputError, "not 0 objects"):
            exchange.export([], missing)
        text = log.path().read_text()
        for expected in (r"FreeCAD: Bladesmith \d", "missing.step: No such file", "not 0 objects"):
            self.assertRegex(text, expected)

    def test_colours_of_the_view_are_exported_where_no_file_said_any(self):
        box = self.document.addObject("Part::Box", "Box")
        self.document.recompute()
        colours = [(k / 8, 0.5, 0.25, 0.0) for k in range(6)]
        box.ViewObject.DiffuseColor = colours
        target = str(self.folder / "box.step")
        exchange.export([box], target)
        found = step.read(target).solids[0].face_colours
        self.assertEqual(found, [colour[:3] for colour in colours])

    def test_the_report_is_a_page_with_pictures(self):
        obj = self.morphed()
        FreeCADGui.Selection.addSelection(obj)
        with mock.patch.object(report_page, "show_in_browser") as opened:
            press_toolbar("Open report")
            wait_until(lambda: opened.called)
        text = Path(opened.call_args.args[0]).read_text("utf-8")
        self.assertIn("Morph of", text)
        self.assertIn("pressure side", text)
        self.assertGreater(text.count("data:image/png"), 3)
        obj.Source = None
        with self.assertRaisesRegex(InputError, "the source of this result is gone"):
            shown.solids(obj)

    def test_a_fem_result_is_chosen_in_the_panel(self):
        import ObjectsFem

        exchange.insert(self.hot, self.document.Name)
        result = ObjectsFem.makeResultMechanical(self.document, "CCX_Results")
        self.assertTrue(fem.is_result(result))
        press_toolbar("Morph")
        box = child(QtGui.QComboBox, "fieldObject")
        box.setCurrentIndex(box.findText("CCX_Results"))
        panel = self.document.getObject("Morph").ViewObject.Proxy.panel
        wait_until(lambda: not panel.checking)
        self.assertRegex(str(panel.error), "CCX_Results: the result has no mesh")
        self.assertFalse(child(QtGui.QLineEdit, "fieldFile").isEnabled())
        press_dialog(QtGui.QDialogButtonBox.Cancel)
