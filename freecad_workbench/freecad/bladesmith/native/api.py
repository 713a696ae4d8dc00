"""The core's C interface as three classes: :class:`Part`, :class:`Field`, :class:`Morphed`.

Each owns one handle of the core and frees it with itself. Calls raise the exceptions of
:mod:`.errors`. Lengths are millimetres; faces count from 1.
"""

import ctypes
import json
import logging
import os
from collections.abc import Sequence
from contextlib import contextmanager
from ctypes import (
    POINTER,
    byref,
    c_char_p,
    c_double,
    c_int32,
    c_size_t,
    c_uint32,
    c_void_p,
)
from typing import Callable, Optional

from .. import log
from . import spline_calls
from .errors import Cancelled, from_status
from .finder import load

_LOG = logging.getLogger(__name__)

ProgressFunction = ctypes.CFUNCTYPE(c_int32, c_void_p, c_char_p, c_double)


class MorphOptions(ctypes.Structure):
    """``bladesmith_morph_options`` of the C header, field for field."""

    _fields_ = [
        ("size", c_size_t),
        ("factor", c_double),
        ("tolerance_mm", c_double),
        ("match_tolerance_mm", c_double),
        ("field_unit_mm", c_double),
        ("displacement_scale", c_double),
        ("solid", c_uint32),
        ("extrapolate", c_uint32),
        ("holdout", c_uint32),
        ("threads", c_uint32),
        ("moving_faces", POINTER(c_uint32)),
        ("moving_count", c_size_t),
        ("fixed_faces", POINTER(c_uint32)),
        ("fixed_count", c_size_t),
        ("face_names", POINTER(c_char_p)),
        ("face_names_count", c_size_t),
        ("solid_name", c_char_p),
    ]


_SCALARS = [name for name, kind in MorphOptions._fields_ if kind in (c_double, c_uint32)]

_TEXT = (c_void_p, c_char_p, c_size_t, POINTER(c_size_t))

STATUS_CALLS = {
    "bladesmith_field_read": (c_char_p, c_char_p, c_uint32, POINTER(c_void_p)),
    "bladesmith_field_from_arrays": (
        c_char_p,
        c_void_p,
        c_void_p,
        c_void_p,
        c_size_t,
        POINTER(c_void_p),
    ),
    "bladesmith_field_info": _TEXT,
    "bladesmith_part_read": (c_char_p, c_size_t, c_char_p, POINTER(c_void_p)),
    "bladesmith_part_info": _TEXT,
    "bladesmith_part_write": _TEXT,
    "bladesmith_part_evaluate": (c_void_p, c_uint32, c_void_p, c_size_t, c_uint32, c_void_p),
    "bladesmith_check": (
        c_void_p,
        c_void_p,
        POINTER(MorphOptions),
        ProgressFunction,
        c_void_p,
        *_TEXT[1:],
    ),
    "bladesmith_morph": (
        c_void_p,
        c_void_p,
        POINTER(MorphOptions),
        ProgressFunction,
        c_void_p,
        POINTER(c_void_p),
    ),
    "bladesmith_morphed_part": (c_void_p, POINTER(c_void_p)),
    "bladesmith_morphed_report": _TEXT,
    "bladesmith_morphed_nodes": (
        c_void_p,
        c_size_t,
        c_void_p,
        c_void_p,
        c_void_p,
        c_void_p,
        c_void_p,
        POINTER(c_size_t),
    ),
    **spline_calls.STATUS_CALLS,
}
"""Argument types of the calls that return a status."""

OTHER_CALLS = {
    "bladesmith_abi_version": (c_uint32, ()),
    "bladesmith_version": (c_char_p, ()),
    "bladesmith_last_error": (c_char_p, ()),
    "bladesmith_field_free": (None, (c_void_p,)),
    "bladesmith_part_free": (None, (c_void_p,)),
    "bladesmith_morph_options_init": (None, (POINTER(MorphOptions), c_size_t)),
    "bladesmith_morphed_free": (None, (c_void_p,)),
    **spline_calls.OTHER_CALLS,
}
"""Result and argument types of the other calls."""

_CHECK_BYTES = 1 << 20
"""Room for the answer of a check: its lists of numbers are short."""

_library: Optional[ctypes.CDLL] = None


def _core() -> ctypes.CDLL:
    global _library
    if _library is None:
        library = load({*STATUS_CALLS, *OTHER_CALLS})
        for name, arguments in STATUS_CALLS.items():
            function = getattr(library, name)
            function.argtypes, function.restype, function.errcheck = arguments, c_int32, _errcheck
        for name, (result, arguments) in OTHER_CALLS.items():
            function = getattr(library, name)
            function.argtypes, function.restype = arguments, result
        _library = library
    return _library


def _errcheck(status, _function, _arguments):
    if status != 0:
        raise from_status(status, _core().bladesmith_last_error().decode("utf-8", "replace"))
    return status


def library_version() -> str:
    """Release of the loaded core."""
    return _core().bladesmith_version().decode()


def _text(call, handle) -> str:
    length = c_size_t()
    call(handle, None, 0, byref(length))
    buffer = ctypes.create_string_buffer(length.value + 1)
    call(handle, buffer, len(buffer), byref(length))
    return buffer.raw[: length.value].decode()


class _Handle:
    """Owner of one handle; ``_free`` names the call that gives it back."""

    _free = ""

    def __init__(self):
        self._core = _core()
        self._handle = c_void_p()

    def __del__(self):
        core = getattr(self, "_core", None)
        if core is not None and self._handle:
            getattr(core, self._free)(self._handle)


class Field(_Handle):
    """Nodes and displacements of a finite-element result."""

    _free = "bladesmith_field_free"

    @classmethod
    def read(cls, path: str, mesh: Optional[str] = None, step: int = 0) -> "Field":
        """Reads results; ``mesh`` is the deck with full-precision nodes, ``step`` 0 the last."""
        _LOG.info("field: %s, step %s", log.sizes(path, mesh), step or "the last")
        field = cls()
        mesh_bytes = None if mesh is None else os.fsencode(mesh)
        field._core.bladesmith_field_read(os.fsencode(path), mesh_bytes, step, byref(field._handle))
        return field

    @classmethod
    def from_arrays(cls, name: str, ids, points, displacements) -> "Field":
        """From ids (n), points (n, 3) and displacements (n, 3), in mm; the arrays are copied."""
        import numpy

        ids = numpy.ascontiguousarray(ids, dtype=numpy.int64)
        points = numpy.ascontiguousarray(points, dtype=float)
        displacements = numpy.ascontiguousarray(displacements, dtype=float)
        if ids.ndim != 1 or not points.shape == displacements.shape == (len(ids), 3):
            raise ValueError(
                f"{ids.shape} ids need as many points and displacements of three components, "
                f"not {points.shape} and {displacements.shape}"
            )
        _LOG.info("field: %d nodes in arrays", len(ids))
        field = cls()
        field._core.bladesmith_field_from_arrays(
            name.encode(),
            ids.ctypes.data,
            points.ctypes.data,
            displacements.ctypes.data,
            len(ids),
            byref(field._handle),
        )
        return field

    def info(self) -> dict:
        """What the file holds: blocks, steps, nodes, elements, extent, largest displacement."""
        return json.loads(_text(self._core.bladesmith_field_info, self._handle))


class Part(_Handle):
    """A part as Open CASCADE's B-rep text describes it."""

    _free = "bladesmith_part_free"

    @classmethod
    def read(cls, text: str, name: str) -> "Part":
        """Parses B-rep text; ``name`` stands for it in messages."""
        part = cls()
        data = text.encode()
        _LOG.info("part: %s, %d bytes of B-rep", os.path.basename(name), len(data))
        part._core.bladesmith_part_read(data, len(data), name.encode(), byref(part._handle))
        return part

    def info(self) -> dict:
        """Solids, faces, edges and extent."""
        return json.loads(_text(self._core.bladesmith_part_info, self._handle))

    def write(self) -> str:
        """The part as B-rep text."""
        return _text(self._core.bladesmith_part_write, self._handle)

    def evaluate(self, face: int, parameters, order: int = 0):
        """Points, and derivatives up to ``order`` (0 to 2), at the (n, 2) parameters of a face.

        Returns (n, k, 3) with k = 1, 3 or 6: S, Su, Sv, Suu, Suv, Svv.
        """
        import numpy

        parameters = numpy.ascontiguousarray(parameters, dtype=float)
        if parameters.ndim != 2 or parameters.shape[1] != 2:
            raise ValueError(f"parameters must have the shape (n, 2), not {parameters.shape}")
        out = numpy.empty((len(parameters), (order + 1) * (order + 2) // 2, 3))
        self._core.bladesmith_part_evaluate(
            self._handle, face, parameters.ctypes.data, len(parameters), order, out.ctypes.data
        )
        return out


class Morphed(_Handle):
    """A morphed part with its report."""

    _free = "bladesmith_morphed_free"

    @classmethod
    def morph(
        cls,
        part: Part,
        field: Field,
        settings: dict,
        progress: Optional[Callable[[str, float], bool]] = None,
    ) -> "Morphed":
        """Morphs ``part`` by ``field``.

        ``settings`` has the names of :class:`MorphOptions`, lists in place of pointers and counts.
        ``progress`` gets the stage and the fraction done; returning False cancels, and an
        exception it raises comes out of this call.
        """
        morphed = cls()
        with _call_of(morphed._core, settings, progress) as (options, call):
            morphed._core.bladesmith_morph(
                part._handle, field._handle, options, call, None, byref(morphed._handle)
            )
        return morphed

    def part(self) -> Part:
        """The morphed part."""
        part = Part()
        self._core.bladesmith_morphed_part(self._handle, byref(part._handle))
        return part

    def report(self) -> dict:
        """The figures, under the names of the JSON report."""
        report = json.loads(_text(self._core.bladesmith_morphed_report, self._handle))
        _LOG.info("largest deviation %.2e mm", report["deviation_mm"]["max"])
        for warning in report["warnings"]:
            _LOG.warning("%s", warning)
        return report

    def nodes(self) -> dict:
        """Arrays by node and face: ids, faces, feet, displacements, deviations (mm)."""
        import numpy

        count = c_size_t()
        call = self._core.bladesmith_morphed_nodes
        call(self._handle, 0, None, None, None, None, None, byref(count))
        n = count.value
        arrays = {
            "ids": numpy.empty(n, dtype=numpy.int64),
            "faces": numpy.empty(n, dtype=numpy.uint32),
            "feet": numpy.empty((n, 3)),
            "displacements": numpy.empty((n, 3)),
            "deviations": numpy.empty((n, 3)),
        }
        call(self._handle, n, *(a.ctypes.data for a in arrays.values()), byref(count))
        return arrays


def check(part: Part, field: Field, settings: dict, progress: Optional[Callable] = None) -> dict:
    """How ``field`` lies on ``part``: the first stages of :meth:`Morphed.morph`, same arguments.

    Raises what the morph would refuse the input for.
    """
    core = _core()
    length = c_size_t()
    buffer = ctypes.create_string_buffer(_CHECK_BYTES)
    with _call_of(core, settings, progress) as (options, call):
        arguments = (part._handle, field._handle, options, call, None)
        core.bladesmith_check(*arguments, buffer, len(buffer), byref(length))
    return json.loads(buffer.raw[: length.value].decode())


@contextmanager
def _call_of(core: ctypes.CDLL, settings: dict, progress: Optional[Callable[[str, float], bool]]):
    """Options and callback for one call of the core; what ``progress`` raises comes out of it."""
    options, kept = _options(core, settings)
    _LOG.info("settings: %s", {name: getattr(options, name) for name in _SCALARS})
    stages = log.Stages(_LOG)
    raised = []

    def call(_user, stage, fraction):
        try:
            name = stage.decode()
            stages.enter(name)
            return 0 if progress is None or progress(name, fraction) else 1
        except BaseException as exception:  # must not cross the C frames
            raised.append(exception)
            return 1

    try:
        yield byref(options), ProgressFunction(call)
    except Cancelled:
        if raised:
            raise raised[0] from None
        raise
    finally:
        stages.end()
        del kept


def _options(core: ctypes.CDLL, settings: dict):
    """The C struct of ``settings``, and the arrays that must outlive its use."""
    options = MorphOptions()
    core.bladesmith_morph_options_init(byref(options), ctypes.sizeof(options))
    settings = dict(settings)
    moving = _numbers(settings.pop("moving_faces", ()))
    fixed = _numbers(settings.pop("fixed_faces", ()))
    encoded = [name.encode() for name in settings.pop("face_names", ())]
    names = (c_char_p * len(encoded))(*encoded)
    solid_name = settings.pop("solid_name", "").encode()
    options.moving_faces, options.moving_count = moving, len(moving)
    options.fixed_faces, options.fixed_count = fixed, len(fixed)
    options.face_names, options.face_names_count = names, len(names)
    options.solid_name = solid_name
    for name, value in settings.items():
        if name not in _SCALARS:
            raise TypeError(f"a morph has no setting '{name}'")
        setattr(options, name, value)
    return options, (moving, fixed, names, encoded, solid_name)


def _numbers(values: Sequence[int]):
    return (c_uint32 * len(values))(*values)
