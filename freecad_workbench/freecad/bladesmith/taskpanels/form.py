"""The morph panel's form: its widgets filled from an object's properties, and back."""

import csv

import FreeCADGui
from PySide import QtCore, QtGui

from ..features import fem, morph
from ..model import FIELD_UNITS_MM
from ..model.words import way
from .words import translate

_PATTERNS = {
    "fieldFile": "*.frd *.csv *.txt *.frd.gz *.csv.gz *.txt.gz",
    "meshFile": "*.inp *.inp.gz",
}
_TEXTS = {"fieldFile": "FieldFile", "meshFile": "MeshFile"}
_NAMES = {"moving": "MovingFaces", "fixed": "FixedFaces"}
_NUMBERS = {
    "solid": "Solid",
    "step": "Step",
    "factor": "Factor",
    "displacementScale": "DisplacementScale",
    "tolerance": "Tolerance",
    "matchTolerance": "MatchTolerance",
}
_SHOWN_DIGIT = 1e-6
"""The last digit of a number; what a property has beyond it is kept."""
_TICKS = {"extrapolate": "Extrapolate", "holdout": "Holdout"}


class Form(QtCore.QObject):
    """Widgets of ``morph.ui`` and one object; ``changed`` after the user changed something."""

    changed = QtCore.Signal()

    def __init__(self, widget, obj):
        super().__init__()
        self.widget, self._obj = widget, obj
        self._fill_choices()
        self.read()
        self._connect()

    def _fill_choices(self):
        widget, document = self.widget, self._obj.Document
        others = [o for o in document.Objects if o not in self._obj.InListRecursive]
        self._sources = [o for o in others if o is not self._obj and _has_faces(o)]
        self._results = [None, *filter(fem.is_result, others)]
        widget.source.addItems([o.Label for o in self._sources])
        widget.fieldObject.addItem(translate("a file"))
        widget.fieldObject.addItems([o.Label for o in self._results[1:]])
        widget.fieldUnit.addItems([translate("mm, assumed"), *FIELD_UNITS_MM])

    def read(self):
        """Shows the object's properties."""
        widget, obj = self.widget, self._obj
        widget.source.setCurrentIndex(_index(self._sources, obj.Source))
        widget.fieldObject.setCurrentIndex(max(_index(self._results, obj.FieldObject), 0))
        widget.fieldUnit.setCurrentIndex(
            obj.getEnumerationsOfProperty("FieldUnit").index(obj.FieldUnit)
        )
        for name, prop in _TEXTS.items():
            getattr(widget, name).setText(getattr(obj, prop))
        for name, prop in _NAMES.items():
            quoted = [f'"{n}"' if "," in n else n for n in getattr(obj, prop)]
            getattr(widget, name).setText(", ".join(quoted))
        for name, prop in _NUMBERS.items():
            box = getattr(widget, name)
            box.setValue(type(box.value())(getattr(obj, prop)))
        for name, prop in _TICKS.items():
            getattr(widget, name).setChecked(getattr(obj, prop))
        self._enable()

    def write(self):
        """Puts what is shown into the object; properties that stay the same are not touched."""
        widget, obj = self.widget, self._obj
        found = {
            "Source": _chosen(self._sources, widget.source),
            "FieldObject": _chosen(self._results, widget.fieldObject),
            "FieldUnit": [morph.NOT_STATED, *FIELD_UNITS_MM][widget.fieldUnit.currentIndex()],
        }
        found.update((p, getattr(widget, n).text().strip()) for n, p in _TEXTS.items())
        found.update((p, _listed(getattr(widget, n).text())) for n, p in _NAMES.items())
        found.update((p, getattr(widget, n).value()) for n, p in _NUMBERS.items())
        found.update((p, getattr(widget, n).isChecked()) for n, p in _TICKS.items())
        for prop, value in found.items():
            if prop in _NUMBERS.values():
                same = abs(float(getattr(obj, prop)) - value) < _SHOWN_DIGIT / 2
            else:
                same = getattr(obj, prop) == value
            if not same:
                setattr(obj, prop, value)

    def _connect(self):
        widget = self.widget
        for name in ("source", "fieldObject", "fieldUnit"):
            getattr(widget, name).currentIndexChanged.connect(self._on_change)
        for name in (*_TEXTS, *_NAMES):
            getattr(widget, name).textChanged.connect(self._on_change)
        for name in _NUMBERS:
            getattr(widget, name).valueChanged.connect(self._on_change)
        for name in _TICKS:
            getattr(widget, name).toggled.connect(self._on_change)
        for name in _TEXTS:
            button = getattr(widget, f"{name}Button")
            button.clicked.connect(lambda _=False, n=name: self._browse(n))
        for name in _NAMES:
            button = getattr(widget, f"{name}Button")
            button.clicked.connect(lambda _=False, n=name: self._take_selection(n))

    def _on_change(self, *_value):
        self._enable()
        self.changed.emit()

    def _enable(self):
        self.widget.direction.setText(translate(way(self.widget.factor.value())))
        from_file = self.widget.fieldObject.currentIndex() == 0
        for name in (
            "fieldFile",
            "fieldFileButton",
            "meshFile",
            "meshFileButton",
            "step",
            "fieldUnit",
        ):
            getattr(self.widget, name).setEnabled(from_file)

    def _browse(self, name: str):
        edit = getattr(self.widget, name)
        title = translate("Choose a file")
        kind = translate("Displacements") if name == "fieldFile" else translate("Mesh")
        filters = f"{kind} ({_PATTERNS[name]});;{translate('All files')} (*)"
        path = QtGui.QFileDialog.getOpenFileName(self.widget, title, edit.text(), filters)[0]
        if path:
            edit.setText(path)

    def _take_selection(self, name: str):
        source = _chosen(self._sources, self.widget.source)
        names = [
            sub
            for chosen in FreeCADGui.Selection.getSelectionEx(self._obj.Document.Name)
            if chosen.Object in (source, self._obj)
            for sub in chosen.SubElementNames
            if sub.startswith("Face")
        ]
        getattr(self.widget, name).setText(", ".join(dict.fromkeys(names)))


def _has_faces(obj) -> bool:
    shape = getattr(obj, "Shape", None)
    return shape is not None and hasattr(shape, "Faces") and not shape.isNull() and shape.Faces


def _index(objects, wanted) -> int:
    return objects.index(wanted) if wanted in objects else -1


def _chosen(objects, combo):
    index = combo.currentIndex()
    return objects[index] if 0 <= index < len(objects) else None


def _listed(text: str) -> list[str]:
    words = next(csv.reader([text], skipinitialspace=True), [])
    return [word.strip() for word in words if word.strip()]
