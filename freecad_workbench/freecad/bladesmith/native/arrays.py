"""Numpy arrays on their way into and out of the core, and what its splines share.

Arrays that are already double and contiguous are passed as they lie in memory, without a copy.
"""

import ctypes
from ctypes import byref, c_size_t, c_void_p

from .api import _Handle


def rows(values, width: int, name: str):
    """``values`` as (n, width) doubles."""
    import numpy

    array = numpy.ascontiguousarray(values, dtype=float)
    if array.ndim != 2 or array.shape[1] != width:
        raise ValueError(f"{name} must have the shape (n, {width}), not {array.shape}")
    return array


def row(values, width: int, name: str):
    """``values`` as (width,) doubles."""
    import numpy

    array = numpy.ascontiguousarray(values, dtype=float)
    if array.shape != (width,):
        raise ValueError(f"{name} must have the shape ({width},), not {array.shape}")
    return array


def line(values, name: str, count=None):
    """``values`` as (n,) doubles; a single number is an array of one."""
    import numpy

    array = numpy.atleast_1d(numpy.ascontiguousarray(values, dtype=float))
    if array.ndim != 1 or count not in (None, len(array)):
        expected = "n" if count is None else count
        raise ValueError(f"{name} must have the shape ({expected},), not {array.shape}")
    return array


def matrix(values):
    """An affine map as (3, 4) doubles: its linear part and, in the last column, its shift."""
    import numpy

    array = numpy.ascontiguousarray(values, dtype=float)
    if array.shape != (3, 4):
        raise ValueError(f"matrix must have the shape (3, 4), not {array.shape}")
    return array


def address(array):
    """Where an array begins; None stands for NULL."""
    return None if array is None else array.ctypes.data


def handles(splines):
    """The handles of several curves as an array of C; ``splines`` must outlive its use."""
    return (c_void_p * len(splines))(*(spline._handle.value for spline in splines))


class Spline(_Handle):
    """What curves and surfaces share."""

    _noun = ""

    @classmethod
    def _made(cls, verb: str, *arguments):
        """What the call of this noun with ``verb`` makes."""
        made = cls.__new__(cls)
        _Handle.__init__(made)
        made._call(verb, *arguments, byref(made._handle))
        return made

    @classmethod
    def _taken(cls, several: "Several", index: int):
        """One of several as a spline of its own."""
        made = cls.__new__(cls)
        _Handle.__init__(made)
        several._call("get", several._handle, index, byref(made._handle))
        return made

    def _call(self, verb: str, *arguments):
        getattr(self._core, f"bladesmith_{self._noun}_{verb}")(*arguments)

    def _changed(self, verb: str, *arguments):
        """What the call makes of this spline."""
        return self._made(verb, self._handle, *arguments)

    def _changed_within(self, verb: str, *arguments):
        """What the call makes of this spline, and by how much it moved at most."""
        moved = ctypes.c_double()
        return self._changed(verb, *arguments, byref(moved)), moved.value


class Several(Spline):
    """Several splines that a call made; ``_one_kind`` is their class."""

    _one_kind: type

    def all(self) -> list:
        """Each as a spline of its own."""
        count = c_size_t()
        self._call("count", self._handle, byref(count))
        return [self._one_kind._taken(self, index) for index in range(count.value)]


class Table(Spline):
    """Rows of numbers that a call found."""

    _free = "bladesmith_table_free"
    _noun = "table"

    def values(self):
        """(n, columns)."""
        import numpy

        size = c_size_t(), c_size_t()
        self._call("size", self._handle, *map(byref, size))
        out = numpy.empty((size[0].value, size[1].value))
        self._call("data", self._handle, len(out), out.ctypes.data)
        return out


def places(*outputs):
    """Where a call writes handles."""
    return [byref(output._handle) for output in outputs]


def table(verb: str, noun: str, *arguments):
    """The (n, columns) array that a call returns as a table."""
    found = Table()
    getattr(found._core, f"bladesmith_{noun}_{verb}")(*arguments, byref(found._handle))
    return found.values()


def first_hits(spline: Spline, width: int, parameters: tuple, origins, directions, tolerance):
    """Lengths, parameters (of this shape each) and points where rays first meet a spline."""
    import numpy

    origins, directions = rows(origins, width, "origins"), rows(directions, width, "directions")
    n = len(origins)
    if len(directions) != n:
        raise ValueError(f"directions must be as many as origins, {n}, not {len(directions)}")
    out = numpy.empty(n), numpy.empty((n, *parameters)), numpy.empty((n, width))
    given = address(origins), address(directions), n, tolerance
    spline._call("first_hits", spline._handle, *given, *map(address, out))
    return out
