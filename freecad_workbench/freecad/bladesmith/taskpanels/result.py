"""The panel that shows a result: colours, enlarged movement, the worst spot, edges, the page."""

import FreeCAD
import FreeCADGui
import numpy
from PySide import QtCore, QtGui

from ..colours import palette
from ..colours.result import QUANTITIES, Spot, prepare
from ..colours.scale import Scale, labels, number
from ..features import shown
from ..model import Report
from ..native import BladesmithError
from ..report import words
from ..viewproviders.legend import LegendText, legend_image, mark_image
from ..viewproviders.result_colours import Overlay, zoom
from .report_page import ReportPage
from .result_form import UNITS_MM, ResultForm, titles
from .words import error as error_line
from .words import outdated, translate, verdict

_SMALL_MM = 0.01
"""A scale that ends below is better read in micrometres."""

_SPOT_PART, _EDGE_PART = 0.25, 0.15
"""How much of the part's diagonal is seen at least after a zoom."""


class ResultPanel:
    """The panel and what it shows in the view, until it is closed."""

    def __init__(self, obj, view):
        self.form = ResultForm()
        self._obj, self._view = obj, view
        self._overlay = Overlay()
        self._page = ReportPage()
        self._turn = QtCore.QTimer(interval=0)
        self._turn.timeout.connect(self._go_on)
        self._steps = self._result = self._scale = None
        self._connect()
        self._watch = _Watch(self)
        FreeCAD.addDocumentObserver(self._watch)
        self.load()

    @property
    def ready(self) -> bool:
        """Whether the colours are shown."""
        return self._result is not None

    def load(self) -> None:
        """Shows the object's result as it is now; the colours follow within moments."""
        self._result = None
        report = shown.report(self._obj)
        self._say_verdict(report)
        self.form.edges.show_edges(report.edges, words.opened(report))
        self._steps = self._prepared()
        self.form.busy.setValue(0)
        self.form.busy.show()
        self._turn.start()

    def getStandardButtons(self):
        """Called by FreeCAD: a button that closes the panel."""
        return int(QtGui.QDialogButtonBox.Close)

    def isAllowedAlterDocument(self):
        """Called by FreeCAD: the document may change meanwhile; the panel follows."""
        return True

    def reject(self) -> bool:
        """Called by FreeCAD when the panel is to be closed."""
        self.leave()
        FreeCADGui.Control.closeDialog()
        return True

    def leave(self) -> None:
        """Brings the view back to what it was."""
        FreeCAD.removeDocumentObserver(self._watch)
        self._turn.stop()
        self._page.forget()
        self._overlay.detach()

    def _connect(self) -> None:
        form = self.form
        form.quantity_chosen.connect(self._take_quantity)
        form.scale_changed.connect(self._colour)
        form.shape_changed.connect(self._move)
        form.edges.chosen.connect(self._choose_edges)
        form.input_shape.clicked.connect(lambda: form.set_factor(0))
        form.result_shape.clicked.connect(lambda: form.set_factor(1))
        form.enlarged_shape.clicked.connect(self._enlarge)
        form.zoom_worst.clicked.connect(self._zoom_worst)
        self._page.busy.connect(form.show_drawing)
        form.report.clicked.connect(lambda: self._page.draw(self._obj))

    def _say_verdict(self, report: Report) -> None:
        said = verdict(report, float(self._obj.Tolerance))
        if not shown.is_current(self._obj):
            said = outdated() + said
        self.form.verdict.setText(said)

    def _prepared(self):
        """What :func:`prepare` gives, in its steps."""
        solids = shown.solids(self._obj)
        yield 0.0
        nodes = {}
        for name in shown.NODE_ARRAYS:
            nodes[name] = shown.node_array(self._obj, name)
            yield 0.0
        result = yield from prepare(*solids, nodes)
        yield 1.0
        return result

    def _go_on(self) -> None:
        """Prepares a little more."""
        try:
            self.form.busy.setValue(round(100 * next(self._steps)))
            return
        except StopIteration as stop:
            result = stop.value
        except BladesmithError as error:
            result = None
            self._overlay.detach()
            self.form.verdict.setText(error_line(str(error)))
        self._turn.stop()
        self.form.busy.hide()
        if result is not None:
            self._show(result)

    def _show(self, result) -> None:
        self._result = result
        self._overlay.set_triangles(result.mesh.triangles)
        self._take_quantity()
        if not self._overlay.attached:
            covered = [self._obj.ViewObject, self._obj.Source.ViewObject]
            self._overlay.attach(self._view, covered)

    def _take_quantity(self) -> None:
        """Sets unit and kind of scale as the quantity suggests."""
        if not self.ready:
            return
        quantity = QUANTITIES[self.form.quantity]
        self.form.set_logarithmic(quantity.logarithmic, possible=not quantity.signed)
        scale = self._result.automatic_scale(self.form.quantity)
        self.form.set_unit("mm" if scale.high >= _SMALL_MM else "µm")
        self._colour()

    def _colour(self) -> None:
        if not self.ready:
            return
        wish = self.form.wish()
        try:
            self._scale = self._wished(wish)
        except ValueError:
            self.form.complain(
                translate(
                    "A scale needs two numbers, the smaller one first, and both above zero where "
                    "it is logarithmic.",
                )
            )
            return
        self.form.show_scale(self._scale)
        self._move()

    def _wished(self, wish) -> Scale:
        if wish.automatic:
            return self._result.automatic_scale(self.form.quantity, wish.steps, wish.logarithmic)
        return wish.scale()

    def _move(self) -> None:
        """Places and colours everything for the fields as they are."""
        if not self.ready:
            return
        result, factor, scale = self._result, self.form.factor, self._scale
        numbers = range(1, len(result.edges) + 1)
        points, normals = result.positions(factor)
        self._overlay.move(points, normals, [result.edge(k, factor) for k in numbers])
        outline = self.form.outline.isChecked()
        self._overlay.show_input([result.edge(k, 0) for k in numbers] if outline else [])
        bar = scale.bar(palette.colours(QUANTITIES[self.form.quantity].palette))
        places = scale.places(result.values(self.form.quantity))
        self._overlay.colour(places, bar, legend_image(bar, self._legend_text(scale)))
        self._mark()
        self._emphasise(self.form.edges.chosen_edges())

    def _legend_text(self, scale: Scale) -> LegendText:
        unit = self.form.unit
        places = scale.places(numpy.array(scale.ticks()))
        subtitle = unit
        if self.form.factor != 1:
            movement = translate("movement × {0}")
            subtitle += " · " + movement.format(f"{self.form.factor:g}")
        title = titles()[self.form.quantity]
        return LegendText(title, subtitle, list(zip(places, labels(scale, UNITS_MM[unit]))))

    def _worst(self) -> Spot:
        return self._result.worst(self.form.quantity)

    def _mark(self) -> None:
        spot = self._worst()
        if spot is None or not self.form.worst.isChecked():
            self._overlay.mark(None)
            return
        unit = self.form.unit
        place = translate("Face{0}, node {1}").format(spot.face, spot.node)
        text = f"{number(spot.value / UNITS_MM[unit])} {unit}\n{place}"
        self._overlay.mark(self._at(spot), mark_image(text))

    def _at(self, spot: Spot) -> numpy.ndarray:
        return spot.foot + self.form.factor * spot.displacement

    def _enlarge(self) -> None:
        if self.ready:
            self.form.set_factor(self._result.enlargement())

    def _zoom_worst(self) -> None:
        if self.ready and self._worst() is not None:
            self.form.worst.setChecked(True)
            zoom(self._view, self._at(self._worst())[None], _SPOT_PART * self._result.size)

    def _choose_edges(self, numbers: list) -> None:
        """Selects edges in the document, emphasises them in the view, and may zoom there."""
        name, document = self._obj.Name, self._obj.Document.Name
        FreeCADGui.Selection.clearSelection(document)
        for number_ in numbers:
            FreeCADGui.Selection.addSelection(document, name, f"Edge{number_}")
        if self.ready:
            lines = [line for line in self._emphasise(numbers) if len(line)]
            if lines and self.form.zoom_edges.isChecked():
                least = _EDGE_PART * self._result.size
                zoom(self._view, numpy.concatenate(lines), least)

    def _emphasise(self, numbers: list) -> list:
        lines = [self._result.edge(k, self.form.factor) for k in numbers]
        self._overlay.choose(lines)
        return lines


class _Watch:
    """Tells the panel what happens to its object."""

    def __init__(self, panel: ResultPanel):
        self._panel = panel
        self._name = panel._obj.Name
        self._document = panel._obj.Document.Name

    def slotRecomputedObject(self, obj):
        """Called by FreeCAD."""
        if obj.Name == self._name and obj.Document.Name == self._document:
            QtCore.QTimer.singleShot(0, self._panel.load)

    def slotDeletedObject(self, obj):
        """Called by FreeCAD."""
        if obj.Name == self._name and obj.Document.Name == self._document:
            self._panel.reject()

    def slotDeletedDocument(self, document):
        """Called by FreeCAD."""
        if document.Name == self._document:
            self._panel.reject()
