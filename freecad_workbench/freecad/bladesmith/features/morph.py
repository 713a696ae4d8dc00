"""The morph as a document object: source and field in, morphed shape and report out.

Outputs that others show: ``ReportJson`` (the report's text) and, row by row for each node on a
face, ``NodeIds``, ``NodeFaces`` (from 1), ``NodeFeet`` (mm, on the source), ``NodeDisplacements``
(mm, factor included) and ``NodeDeviations`` (mm). Where an input is wrong the object turns
invalid, says why, and keeps what it showed before.
"""

import math
from dataclasses import dataclass
from typing import Optional

import FreeCAD

from ..model import FIELD_UNITS_MM, MorphOptions
from ..model.words import counted
from ..native import BladesmithError, InputError
from ..occ.step import no_solid
from ..operations.faces import selected
from ..operations.morph import FieldFile, Job, Progress, Result, complete
from . import attributes, fem, preferences
from .naming import in_property_names
from .properties import Property, add_missing

SCHEMA_VERSION = 1

NOT_STATED = "Not stated"
"""Unit of a field of which nothing is said: millimetres, refused where its size shows another."""

_PART, _FIELD, _FIT, _OUT = "Part", "Field", "Fit", "Result"
_FILE, _NAMES = "App::PropertyFile", "App::PropertyStringList"
_LENGTH, _VECTORS = "App::PropertyDistance", "App::PropertyVectorList"


def _output(kind: str, name: str, tip: str) -> Property:
    return Property(kind, name, _OUT, tip, hidden=True)


def _table() -> tuple[Property, ...]:
    units = [NOT_STATED, *FIELD_UNITS_MM]
    return (
        Property("App::PropertyLink", "Source", _PART, "The object whose solid is morphed"),
        Property("App::PropertyInteger", "Solid", _PART, "Solid of the source; 0: the covered one"),
        Property(_NAMES, "MovingFaces", _PART, "Only these faces move; none: all"),
        Property(_NAMES, "FixedFaces", _PART, "These faces stay where they are"),
        Property(_FILE, "FieldFile", _FIELD, "Displacements: .frd or CSV, gzipped or not"),
        Property(_FILE, "MeshFile", _FIELD, "Deck of the mesh, for all digits of its nodes"),
        Property("App::PropertyLink", "FieldObject", _FIELD, "A result of the FEM workbench"),
        Property("App::PropertyInteger", "Step", _FIELD, "Step of the file; 0: the last"),
        Property(
            "App::PropertyFloat",
            "Factor",
            _FIELD,
            "1 adds the displacements, -1 takes them away",
            preferences.factor(),
        ),
        Property(
            "App::PropertyEnumeration", "FieldUnit", _FIELD, "Length unit of the field", units
        ),
        Property(
            "App::PropertyFloat", "DisplacementScale", _FIELD, "On the displacements alone", 1.0
        ),
        Property(
            _LENGTH,
            "Tolerance",
            _FIT,
            "Largest deviation that counts as success",
            preferences.tolerance_mm(),
        ),
        Property(_LENGTH, "MatchTolerance", _FIT, "How far a node may lie off; 0: by the size"),
        Property("App::PropertyBool", "Extrapolate", _FIT, "Move areas far from any node too"),
        Property("App::PropertyBool", "Holdout", _FIT, "Also fit without a tenth of the nodes"),
        _output("App::PropertyString", "ReportJson", "All figures, as JSON"),
        _output("App::PropertyIntegerList", "NodeIds", "Number of the node"),
        _output("App::PropertyIntegerList", "NodeFaces", "Its face, from 1"),
        _output(_VECTORS, "NodeFeet", "Its foot on the source, mm"),
        _output(_VECTORS, "NodeDisplacements", "Its displacement, mm, factor included"),
        _output(_VECTORS, "NodeDeviations", "By how much the result misses it, mm"),
        *attributes.PROPERTIES,
        Property("App::PropertyInteger", "SchemaVersion", _OUT, "", SCHEMA_VERSION, True),
    )


@dataclass
class Computed:
    """The result of a job, with the lists that the object will show."""

    job: Job
    state: tuple
    result: Result
    lists: dict[str, list]


def computed(job: Job, progress: Optional[Progress] = None) -> Computed:
    """Runs a job; any thread may call it. Raises :class:`BladesmithError`."""
    state = job.state()
    result = complete(job, progress)
    nodes = result.nodes()
    lists = {"NodeIds": nodes["ids"].tolist(), "NodeFaces": nodes["faces"].tolist()}
    for name in ("feet", "displacements", "deviations"):
        rows = nodes[name].tolist()
        lists[f"Node{name.capitalize()}"] = [FreeCAD.Vector(*row) for row in rows]
    return Computed(job, state, result, lists)


class Morph:
    """Proxy of the object; its data are the object's properties."""

    def __init__(self, obj):
        self._ready = None
        obj.Proxy = self
        add_missing(obj, _table())

    def onDocumentRestored(self, obj):
        """Brings objects of older documents up to date."""
        self._ready = None
        add_missing(obj, _table())
        obj.SchemaVersion = SCHEMA_VERSION

    def execute(self, obj):
        """Called by FreeCAD to recompute. Raises what the inputs are refused for."""
        ready, self._ready = self._ready, None
        try:
            job = job_of(obj)
            fits = ready is not None and ready.state == job.state()
            _store(obj, ready if fits else computed(job))
        except BladesmithError as error:
            raise type(error)(in_property_names(str(error))) from None

    def offer(self, ready: "Computed") -> None:
        """Takes what was computed elsewhere: the next recompute uses it if the input is its own."""
        self._ready = ready

    def dumps(self):
        """Nothing: the properties hold all."""

    def loads(self, _state):
        """Nothing to take back."""

    __getstate__, __setstate__ = dumps, loads


def create(document, source=None):
    """A new morph in ``document``, of ``source``; it is not computed yet."""
    obj = document.addObject("Part::FeaturePython", "Morph")
    Morph(obj)
    obj.Source = source
    if source is not None:
        obj.Label = f"{source.Label} morphed"
    return obj


def is_morph(obj) -> bool:
    """Whether ``obj`` is one of these."""
    return isinstance(getattr(obj, "Proxy", None), Morph)


def job_of(obj) -> Job:
    """What the properties ask for. Raises :class:`InputError` for those that cannot be used."""
    shape = _source_shape(obj)
    name = obj.Source.Label
    several = shape.ShapeType != "Solid" and len(shape.Solids) > 1
    faces = [] if several else list(attributes.load(obj.Source, len(shape.Faces))[1].face_names)
    if several and (obj.MovingFaces or obj.FixedFaces):
        raise InputError(
            f"{name}: moving and fixed faces count within one solid, and this has "
            f"{len(shape.Solids)}; choose one by Solid"
        )
    options = MorphOptions(
        factor=_finite(obj, "Factor"),
        tolerance_mm=_above_zero(obj, "Tolerance"),
        match_tolerance_mm=_not_negative(obj, "MatchTolerance"),
        field_unit_mm=0.0 if obj.FieldObject else FIELD_UNITS_MM.get(obj.FieldUnit, 0.0),
        displacement_scale=_above_zero(obj, "DisplacementScale"),
        moving_faces=selected("MovingFaces", _quoted(obj.MovingFaces), faces),
        fixed_faces=selected("FixedFaces", _quoted(obj.FixedFaces), faces),
        extrapolate=obj.Extrapolate,
        holdout=obj.Holdout,
        threads=preferences.threads(),
        face_names=tuple(faces),
        solid_name=name,
    )
    return Job(shape, name, _field(obj), options)


def _source_shape(obj):
    """The solid to morph, or all of a source whose covered solid the core is to find."""
    if obj.Source is None:
        raise InputError("Source: choose the object whose solid is to be morphed")
    name = obj.Source.Label
    shape = getattr(obj.Source, "Shape", None)
    if shape is None or shape.isNull():
        raise InputError(f"{name}: this object has no shape; choose one with a closed solid")
    if not shape.Solids:
        raise InputError(
            f"{name}: no solid, it holds {counted(len(shape.Faces), 'face')} only; "
            "sew its faces to a closed one first"
        )
    if not 0 <= obj.Solid <= len(shape.Solids):
        raise InputError(f"{name}: {no_solid(obj.Solid, len(shape.Solids), 'Solid')}")
    if obj.Solid or len(shape.Solids) == 1:
        return shape.Solids[max(obj.Solid, 1) - 1]
    return shape


def _field(obj):
    if obj.FieldObject is not None:
        return fem.field_nodes(obj.FieldObject)
    if not obj.FieldFile:
        raise InputError(
            "FieldFile: choose the file with the displacements, or a result of the FEM workbench"
        )
    if obj.Step < 0:
        raise InputError(f"Step: expected a number from 1, or 0 for the last, not {obj.Step}")
    return FieldFile(obj.FieldFile, obj.MeshFile or None, obj.Step)


def _quoted(names) -> list[str]:
    """Names as the command line's lists take them: those with a comma in quotes."""
    return [f'"{name}"' if "," in name and not name.startswith('"') else name for name in names]


def _finite(obj, name: str) -> float:
    value = float(getattr(obj, name))
    if not math.isfinite(value):
        raise InputError(f"{name}: expected a finite number, not {value}")
    return value


def _above_zero(obj, name: str) -> float:
    value = _finite(obj, name)
    if value <= 0:
        raise InputError(f"{name}: expected a value above zero, not {value:g}")
    return value


def _not_negative(obj, name: str) -> float:
    value = _finite(obj, name)
    if value < 0:
        raise InputError(f"{name}: expected zero or more, not {value:g}")
    return value


def _store(obj, ready: Computed) -> None:
    result = ready.result
    product, said = attributes.load(obj.Source, len(result.shape.Faces))
    result.report.name_faces(said.face_names)
    obj.Shape = result.shape
    attributes.store(obj, product, said)
    obj.ReportJson = result.report.to_json()
    for name, values in ready.lists.items():
        setattr(obj, name, values)
