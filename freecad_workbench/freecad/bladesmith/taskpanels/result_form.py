"""The fields of the panel that shows a result; what they mean is in :mod:`.result`."""

from contextlib import contextmanager
from dataclasses import dataclass
from typing import Optional

from PySide import QtCore, QtGui

from ..colours.result import QUANTITIES
from ..colours.scale import Scale
from .edges_table import EdgesView
from .words import translate

UNITS_MM = {"mm": 1.0, "µm": 1e-3}
_MOST_STEPS = 24
_LARGEST_FACTOR = 1e6
_NARROW = 40
_NOTE = "color: #b3261e;"


def titles() -> dict:
    """Names of the quantities for people."""
    return {
        "displacement": translate("Displacement"),
        "displacement_x": translate("Displacement X"),
        "displacement_y": translate("Displacement Y"),
        "displacement_z": translate("Displacement Z"),
        "deviation": translate("Deviation"),
    }


@dataclass(frozen=True)
class ScaleWish:
    """What the fields ask of the scale; ends in mm, or None where they are not numbers."""

    automatic: bool
    low: Optional[float]
    high: Optional[float]
    steps: int
    logarithmic: bool

    def scale(self) -> Scale:
        """The scale between the ends given. Raises ValueError where there is none."""
        if self.low is None or self.high is None:
            raise ValueError("the ends of a scale are numbers")
        return Scale(self.low, self.high, self.steps, self.logarithmic)


class ResultForm(QtGui.QWidget):
    """Widgets and their signals. Lengths go in and out in mm."""

    quantity_chosen = QtCore.Signal()
    scale_changed = QtCore.Signal()
    shape_changed = QtCore.Signal()

    def __init__(self):
        super().__init__()
        self.setWindowTitle(translate("Result of a morph"))
        layout = QtGui.QVBoxLayout(self)
        layout.setContentsMargins(0, 4, 0, 4)
        self.verdict = QtGui.QLabel(wordWrap=True)
        self.busy = QtGui.QProgressBar(maximum=100, textVisible=False, maximumHeight=6)
        self.report = QtGui.QPushButton()
        self.show_drawing(False)
        layout.addWidget(self.verdict)
        layout.addWidget(self.busy)
        layout.addWidget(self._colours())
        layout.addWidget(self._shape())
        layout.addWidget(self._edges(), 1)
        layout.addWidget(self.report)
        self._name_widgets()

    @property
    def quantity(self) -> str:
        """Key of the quantity to show."""
        return self._quantity.currentData()

    @property
    def unit(self) -> str:
        """Name of the unit of scale and mark."""
        return self._unit.currentText()

    @property
    def factor(self) -> float:
        """By what the movement is multiplied."""
        return self._factor.value()

    def show_drawing(self, busy: bool) -> None:
        """Says on the button whether the report is being drawn."""
        drawing, idle = translate("Drawing the report …"), translate("Open report")
        self.report.setEnabled(not busy)
        self.report.setText(drawing if busy else idle)

    def set_factor(self, factor: float) -> None:
        """Multiplies the movement, as if it were typed."""
        self._factor.setValue(factor)

    def set_quantity(self, name: str) -> None:
        """Shows a quantity, as if it were chosen."""
        self._quantity.setCurrentIndex(self._quantity.findData(name))

    def set_unit(self, name: str) -> None:
        """Chooses a unit without a signal."""
        with _quiet(self._unit):
            self._unit.setCurrentText(name)

    def set_logarithmic(self, wanted: bool, possible: bool) -> None:
        """Ticks and enables the field of a logarithmic scale, without a signal."""
        with _quiet(self._logarithmic):
            self._logarithmic.setChecked(wanted)
            self._logarithmic.setEnabled(possible)

    def wish(self) -> ScaleWish:
        """What the fields ask of the scale."""
        unit = UNITS_MM[self.unit]
        ends = [_length(field, unit) for field in (self._low, self._high)]
        return ScaleWish(
            self._automatic.isChecked(), *ends, self._steps.value(), self._logarithmic.isChecked()
        )

    def show_scale(self, scale: Scale) -> None:
        """Writes the ends of a scale into their fields."""
        for field, value in ((self._low, scale.low), (self._high, scale.high)):
            with _quiet(field):
                field.setText(f"{value / UNITS_MM[self.unit]:.4g}")
        self.complain("")

    def complain(self, text: str) -> None:
        """Says what is wrong with the scale's fields; nothing hides it."""
        self._complaint.setText(text)
        self._complaint.setVisible(bool(text))

    def _colours(self) -> QtGui.QGroupBox:
        box, grid = _group(translate("Colours"))
        self._quantity = QtGui.QComboBox()
        names = titles()
        for name in QUANTITIES:
            self._quantity.addItem(names[name], name)
        self._quantity.setSizeAdjustPolicy(QtGui.QComboBox.AdjustToMinimumContentsLength)
        self._quantity.setMinimumContentsLength(12)
        self._unit = QtGui.QComboBox()
        self._unit.addItems(list(UNITS_MM))
        self._unit.setMinimumWidth(_NARROW)
        self._automatic = QtGui.QCheckBox(translate("Automatic scale"), checked=True)
        self._low, self._high = QtGui.QLineEdit(enabled=False), QtGui.QLineEdit(enabled=False)
        self._steps = QtGui.QSpinBox(maximum=_MOST_STEPS)
        self._steps.setSpecialValueText(translate("smooth"))
        self._logarithmic = QtGui.QCheckBox(translate("Logarithmic"))
        self._complaint = QtGui.QLabel(wordWrap=True, styleSheet=_NOTE, visible=False)
        for field in (self._low, self._high, self._steps):
            field.setMinimumWidth(_NARROW)
        grid.addWidget(self._quantity, 0, 0, 1, 3)
        grid.addWidget(self._unit, 0, 3)
        grid.addWidget(self._automatic, 1, 0, 1, 4)
        grid.addWidget(QtGui.QLabel(translate("From")), 2, 0)
        grid.addWidget(self._low, 2, 1)
        grid.addWidget(QtGui.QLabel(translate("to")), 2, 2)
        grid.addWidget(self._high, 2, 3)
        grid.addWidget(QtGui.QLabel(translate("Steps")), 3, 0)
        grid.addWidget(self._steps, 3, 1)
        grid.addWidget(self._logarithmic, 3, 2, 1, 2)
        grid.addWidget(self._complaint, 4, 0, 1, 4)
        self._quantity.currentIndexChanged.connect(lambda _: self.quantity_chosen.emit())
        self._automatic.toggled.connect(self._let_type)
        for signal in (
            self._unit.currentIndexChanged,
            self._steps.valueChanged,
            self._automatic.toggled,
            self._logarithmic.toggled,
        ):
            signal.connect(lambda _: self.scale_changed.emit())
        for field in (self._low, self._high):
            field.editingFinished.connect(self.scale_changed.emit)
        return box

    def _shape(self) -> QtGui.QGroupBox:
        box, grid = _group(translate("Shape"))
        self._factor = QtGui.QDoubleSpinBox(maximum=_LARGEST_FACTOR, decimals=2, value=1.0)
        self._factor.setPrefix("× ")
        self._factor.setKeyboardTracking(False)
        self.input_shape = QtGui.QPushButton(translate("Input"))
        self.result_shape = QtGui.QPushButton(translate("Result"))
        self.enlarged_shape = QtGui.QPushButton(translate("Enlarged"))
        self.outline = QtGui.QCheckBox(translate("Edges of the input"))
        self.worst = QtGui.QCheckBox(translate("Mark the worst spot"), checked=True)
        self.zoom_worst = QtGui.QPushButton(translate("Zoom"), minimumWidth=_NARROW)
        grid.addWidget(QtGui.QLabel(translate("Movement")), 0, 0)
        grid.addWidget(self._factor, 0, 1, 1, 2)
        buttons = (self.input_shape, self.result_shape, self.enlarged_shape)
        for column, button in enumerate(buttons):
            button.setMinimumWidth(_NARROW)
            grid.addWidget(button, 1, column)
        grid.addWidget(self.outline, 2, 0, 1, 3)
        grid.addWidget(self.worst, 3, 0, 1, 2)
        grid.addWidget(self.zoom_worst, 3, 2)
        self._factor.valueChanged.connect(lambda _: self.shape_changed.emit())
        for box_ in (self.outline, self.worst):
            box_.toggled.connect(lambda _: self.shape_changed.emit())
        return box

    def _edges(self) -> QtGui.QGroupBox:
        box, grid = _group(translate("Gaps and tangency by edge"))
        self.edges = EdgesView()
        self.zoom_edges = QtGui.QCheckBox(translate("Zoom to the chosen edge"))
        grid.addWidget(self.edges, 0, 0)
        grid.addWidget(self.zoom_edges, 1, 0)
        return box

    def _name_widgets(self) -> None:
        """Gives every field its attribute's name, under which others find it in the window."""
        for name, widget in vars(self).items():
            if isinstance(widget, QtGui.QWidget):
                widget.setObjectName(f"result_{name.strip('_')}")

    def _let_type(self, automatic: bool):
        for field in (self._low, self._high):
            field.setEnabled(not automatic)


def _group(title: str):
    box = QtGui.QGroupBox(title)
    grid = QtGui.QGridLayout(box)
    grid.setContentsMargins(4, 6, 4, 8)
    grid.setVerticalSpacing(5)
    return box, grid


def _length(field: QtGui.QLineEdit, unit_mm: float):
    try:
        return float(field.text().strip().replace(",", ".")) * unit_mm
    except ValueError:
        return None


@contextmanager
def _quiet(widget):
    """While it lasts the widget sends no signals."""
    before = widget.blockSignals(True)
    yield
    widget.blockSignals(before)
