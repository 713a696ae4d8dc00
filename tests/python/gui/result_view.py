"""A result in the 3-D view: colours, scale, movement, edges, and the view left as it was found.

Runs inside FreeCAD, see run.py.
"""

import tempfile
import unittest
import zipfile
from pathlib import Path
from unittest import mock

import FreeCAD
import FreeCADGui
from freecad.bladesmith.features import morph
from freecad.bladesmith.occ import step
from freecad.bladesmith.taskpanels import report_page
from freecad.bladesmith.viewproviders.morph import MorphView
from freecad.bladesmith.viewproviders.result_colours import NAME
from PySide import QtCore, QtGui
from window import (
    EXAMPLE,
    ROOT,
    Starvation,
    child,
    press,
    press_dialog,
    press_toolbar,
    screenshot,
    settle,
    wait_until,
)

TICKS = 10
"""Turns that the window's timer has at least while colours are made."""

SIZE = (600, 500)


def morphed(source: Path, field: Path, mesh: Path):
    """A new document with a part and its computed morph."""
    document = FreeCAD.newDocument("result")
    part = document.addObject("Part::Feature", "Hot")
    part.Shape = step.read(str(source)).shape.Solids[0]
    obj = morph.create(document, part)
    MorphView(obj.ViewObject)
    obj.FieldFile, obj.MeshFile, obj.Factor = str(field), str(mesh), -1
    document.recompute()
    FreeCADGui.Selection.clearSelection()
    FreeCADGui.activeView().viewAxonometric()
    FreeCADGui.activeView().fitAll()
    return obj


def picture() -> QtGui.QImage:
    """The 3-D view as it is drawn now."""
    settle()
    with tempfile.TemporaryDirectory() as folder:
        path = str(Path(folder, "view.png"))
        FreeCADGui.activeView().saveImage(path, *SIZE, "Current")
        return QtGui.QImage(path).convertToFormat(QtGui.QImage.Format_RGB32)


def share(image: QtGui.QImage, hues: range) -> float:
    """Part of the picture, right of the legend, in lively colours of these hues (degrees)."""
    colours = [
        QtGui.QColor(image.pixel(x, y))
        for x in range(SIZE[0] // 3, SIZE[0], 3)
        for y in range(0, SIZE[1], 3)
    ]
    return sum(c.hue() in hues and c.saturation() > 110 for c in colours) / len(colours)


def shown_nodes() -> int:
    """How many results hang in the view's scene."""
    scene = FreeCADGui.activeView().getSceneGraph()
    children = [scene.getChild(k) for k in range(scene.getNumChildren())]
    return sum(node.getName().getString() == NAME for node in children)


def choose(name: str) -> None:
    """Chooses a quantity by its key."""
    box = child(QtGui.QComboBox, "result_quantity")
    box.setCurrentIndex(box.findData(name))


def number(name: str) -> QtGui.QDoubleSpinBox:
    """A field of the panel."""
    return child(QtGui.QDoubleSpinBox, f"result_{name}")


def tick(name: str, on: bool = True) -> None:
    """Ticks a box of the panel."""
    child(QtGui.QCheckBox, f"result_{name}").setChecked(on)


def type_into(name: str, text: str) -> None:
    """Types into a field of the panel and leaves it."""
    field = child(QtGui.QLineEdit, f"result_{name}")
    field.setText(text)
    field.editingFinished.emit()


class ResultView(unittest.TestCase):
    source = tuple(EXAMPLE / name for name in ("hot.step.gz", "blade.frd.gz", "blade.inp.gz"))

    @classmethod
    def setUpClass(cls):
        FreeCADGui.activateWorkbench("BladesmithWorkbench")
        for dock in FreeCADGui.getMainWindow().findChildren(QtGui.QDockWidget):
            if dock.objectName() in ("Python console", "Report view"):
                dock.hide()
        cls.morph = morphed(*cls.source)

    @classmethod
    def tearDownClass(cls):
        FreeCAD.closeDocument(cls.morph.Document.Name)

    def setUp(self):
        self.camera = FreeCADGui.activeView().getCamera()
        self.open()

    def tearDown(self):
        self.close()
        FreeCADGui.activeView().setCamera(self.camera)
        FreeCADGui.Selection.clearSelection()

    def open(self):
        press_toolbar("Show result")
        wait_until(shown_nodes, 30)

    def close(self):
        if FreeCADGui.Control.activeDialog():
            press_dialog(QtGui.QDialogButtonBox.Close)
            wait_until(lambda: not FreeCADGui.Control.activeDialog(), 5)

    def test_displacement_and_deviation_are_colours_with_a_legend(self):
        screenshot("result-displacement")
        image = picture()
        violet, green = share(image, range(220, 275)), share(image, range(70, 200))
        self.assertTrue(violet > 0.05 and green > 0.01, (violet, green))
        card = QtGui.QColor(image.pixel(14, SIZE[1] // 2))
        self.assertGreater(card.lightness(), 230, "the legend's card is light")
        choose("deviation")
        screenshot("result-deviation")
        self.assertGreater(share(picture(), range(5, 50)), 0.05)
        self.assertEqual(child(QtGui.QComboBox, "result_unit").currentText(), "µm")
        choose("displacement_x")
        screenshot("result-signed")

    def test_the_scale_can_be_set_and_says_what_is_wrong_with_it(self):
        largest = float(child(QtGui.QLineEdit, "result_high").text())
        self.assertAlmostEqual(largest, 0.5447, delta=2e-3)
        tick("automatic", False)
        type_into("high", "0,05")
        child(QtGui.QSpinBox, "result_steps").setValue(5)
        screenshot("result-steps")
        image = picture()
        self.assertGreater(share(image, range(45, 70)), 0.02, "most of the blade is beyond")
        complaint = child(QtGui.QLabel, "result_complaint")
        self.assertFalse(complaint.isVisible())
        for wrong in ("", "mm", "-1", "nan", "1e999"):
            type_into("high", wrong)
            self.assertTrue(complaint.isVisible(), repr(wrong))
        self.assertEqual(picture(), image, "the last good scale stays")
        tick("automatic")
        self.assertFalse(complaint.isVisible())

    def test_movement_is_enlarged_over_the_edges_of_the_input(self):
        close = picture()
        press("result_enlarged_shape")
        tick("outline")
        self.assertEqual(number("factor").value(), 10)
        screenshot("result-enlarged")
        self.assertNotEqual(picture(), close)
        press("result_result_shape")
        tick("outline", False)
        self.assertEqual(picture(), close)
        press("result_input_shape")
        self.assertEqual(number("factor").value(), 0)

    def test_the_worst_spot_is_marked_and_can_be_seen_closely(self):
        pink = range(315, 335)
        marked = share(picture(), pink)
        tick("worst", False)
        self.assertLess(share(picture(), pink), marked / 4)
        choose("deviation")
        height = FreeCADGui.activeView().getCameraNode().height.getValue()
        press("result_zoom_worst")
        screenshot("result-worst-spot")
        self.assertLess(FreeCADGui.activeView().getCameraNode().height.getValue(), height / 2)
        self.assertGreater(share(picture(), pink), marked / 4)

    def test_edges_are_listed_widest_gap_first_and_chosen_in_the_view(self):
        table = child(QtGui.QTableView, "result_edges")
        rows = range(table.model().rowCount())
        self.assertEqual(len(rows), len(self.morph.Shape.Edges))
        gaps = [float(table.model().index(row, 1).data()) for row in rows if row < 9]
        self.assertEqual(gaps, sorted(gaps, reverse=True))
        tick("zoom_edges")
        table.selectRow(1)
        screenshot("result-edge")
        edge = f"Edge{table.model().index(1, 0).data()}"
        (chosen,) = FreeCADGui.Selection.getSelectionEx()
        self.assertEqual((chosen.Object, chosen.SubElementNames), (self.morph, (edge,)))
        table.sortByColumn(0, QtCore.Qt.AscendingOrder)
        numbers = [table.model().index(row, 0).data() for row in range(3)]
        self.assertEqual(numbers, ["1", "2", "3"])

    def test_the_view_and_the_document_are_left_as_they_were(self):
        self.close()
        before = picture()
        self.open()
        with tempfile.TemporaryDirectory() as folder:
            paths = [Path(folder, name) for name in ("shown.FCStd", "closed.FCStd")]
            press("result_enlarged_shape")
            self.morph.Document.saveAs(str(paths[0]))
            FreeCADGui.runCommand("Std_Save")
            self.assertFalse(FreeCADGui.ActiveDocument.Modified)
            self.close()
            self.open()
            press("result_enlarged_shape")
            self.close()
            self.assertEqual(shown_nodes(), 0)
            self.assertFalse(FreeCADGui.ActiveDocument.Modified)
            self.assertEqual(picture(), before)
            self.morph.Document.saveAs(str(paths[1]))
            views = [zipfile.ZipFile(path).read("GuiDocument.xml") for path in paths]
            self.assertEqual(*views)

    def test_it_follows_a_recompute(self):
        self.morph.Factor = -0.5
        self.morph.Document.recompute()
        high = child(QtGui.QLineEdit, "result_high")
        wait_until(lambda: abs(float(high.text()) - 0.272) < 2e-3, 30)
        self.morph.Factor = -1
        self.morph.Document.recompute()
        wait_until(lambda: abs(float(high.text()) - 0.5447) < 2e-3, 30)

    def test_the_window_answers_while_colours_are_made(self):
        self.close()
        with Starvation() as starvation:
            self.open()
            settle()
        starvation.keep("result-responsiveness")
        self.assertGreater(starvation.ticks, TICKS)


class SmallResult(unittest.TestCase):
    def setUp(self):
        FreeCADGui.activateWorkbench("BladesmithWorkbench")
        data = ROOT / "tests" / "data" / "p5"
        self.morph = morphed(*(data / f"base.{kind}.gz" for kind in ("step", "frd", "inp")))
        self.name = self.morph.Document.Name
        press_toolbar("Show result")
        wait_until(shown_nodes, 30)

    def tearDown(self):
        if self.name in FreeCAD.listDocuments():
            if FreeCADGui.Control.activeDialog():
                press_dialog(QtGui.QDialogButtonBox.Close)
            FreeCAD.closeDocument(self.name)

    def test_the_page_is_drawn_and_opened(self):
        with mock.patch.object(report_page, "show_in_browser") as opened:
            press("result_report")
            self.assertFalse(child(QtGui.QPushButton, "result_report").isEnabled())
            wait_until(lambda: opened.called)
            (path,) = opened.call_args.args
        self.assertIn("Morph of", Path(path).read_text("utf-8"))
        self.assertTrue(child(QtGui.QPushButton, "result_report").isEnabled())

    def test_the_panel_goes_with_its_object(self):
        self.morph.Document.removeObject(self.morph.Name)
        wait_until(lambda: not FreeCADGui.Control.activeDialog(), 5)
        self.assertEqual(shown_nodes(), 0)

    def test_the_panel_goes_with_its_document(self):
        FreeCAD.closeDocument(self.name)
        wait_until(lambda: not FreeCADGui.Control.activeDialog(), 5)
