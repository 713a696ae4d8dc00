"""NURBS curves of the core: :class:`Curve`."""

import ctypes
from collections.abc import Sequence
from ctypes import byref, c_size_t, c_uint32
from typing import NamedTuple, Optional

from .api import _core
from .arrays import (
    Several,
    Spline,
    Table,
    address,
    first_hits,
    handles,
    line,
    matrix,
    places,
    row,
    rows,
    table,
)

SPACINGS = ("uniform", "chord", "centripetal", "affine_chord", "affine_angle")
"""How :func:`parameters` may space, in the order of the core's numbers."""

_FACTORS = {"centripetal": 0.5, "affine_angle": 1.5}


class Fillet(NamedTuple):
    """A circular arc tangent to two curves."""

    centre: list[float]
    """(2,)."""
    parameters: list[float]
    """Of the points of contact on both curves."""
    sides: list[float]
    """1 where the centre is to the left of the curve, -1 to the right."""
    angle: float
    """From the first curve to the second, in rad, positive to the left."""
    first: Optional["Curve"]
    """What is left of the first curve."""
    arc: Optional["Curve"]
    """None where both points of contact are one."""
    second: Optional["Curve"]
    """What is left of the second curve."""


def parameters(points, spacing: str = "chord", factor: Optional[float] = None):
    """Parameters (n,), ascending from 0 to 1, for points (n, 2) or (n, 3) that a curve shall pass.

    ``factor`` is the power of the distances for "centripetal" (0.5), and how much turning widens
    for "affine_angle" (1.5).
    """
    import numpy

    points = _points(points, "points")
    if spacing not in SPACINGS:
        raise ValueError(f"spacing is '{spacing}'; give one of {', '.join(SPACINGS)}")
    factor = _FACTORS.get(spacing, 0.0) if factor is None else factor
    out = numpy.empty(len(points))
    _core().bladesmith_parameters(
        points.shape[1], address(points), len(points), SPACINGS.index(spacing), factor, address(out)
    )
    return out


def averaged_knots(degree: int, t):
    """Clamped knots (n + degree + 1,) for a curve through points at ascending parameters (n,)."""
    import numpy

    t = line(t, "t")
    out = numpy.empty(len(t) + degree + 1)
    _core().bladesmith_averaged_knots(degree, address(t), len(t), address(out))
    return out


def compatible(curves: Sequence["Curve"]) -> list["Curve"]:
    """The same curves with one degree, one domain (the first's) and the same clamped knots."""
    made = Curves._made("compatible", handles(curves), len(curves))
    return made.all()


def _points(values, name: str):
    """(n, 2) or (n, 3) doubles."""
    import numpy

    array = numpy.ascontiguousarray(values, dtype=float)
    if array.ndim != 2 or array.shape[1] not in (2, 3):
        raise ValueError(f"{name} must have the shape (n, 2) or (n, 3), not {array.shape}")
    return array


class Curve(Spline):
    """A NURBS curve in the plane or in space; it never changes.

    ``knots`` are all knots, repeated by multiplicity (flat); they need not be clamped. Methods that
    end in "-ed" return new curves. Lengths are in the unit of the poles, mm by convention.
    """

    _free = "bladesmith_curve_free"
    _noun = "curve"

    def __init__(self, degree: int, knots, poles, weights=None):
        super().__init__()
        knots, poles = line(knots, "knots"), _points(poles, "poles")
        weights = None if weights is None else line(weights, "weights", len(poles))
        self._call(
            "new",
            poles.shape[1],
            degree,
            address(knots),
            len(knots),
            address(poles),
            address(weights),
            len(poles),
            byref(self._handle),
        )

    @classmethod
    def arc(cls, centre, x, y, start: float, end: float) -> "Curve":
        """``centre + x cos a + y sin a`` for angles (rad) from one to another, exactly."""
        n = len(centre)
        where = [row(value, n, name) for value, name in ((centre, "centre"), (x, "x"), (y, "y"))]
        return cls._made("arc", n, *map(address, where), start, end)

    @classmethod
    def periodic(cls, degree: int, breaks, poles, weights=None) -> "Curve":
        """The closed curve, smooth over its seam, with a pole for each span between breaks."""
        breaks, poles = line(breaks, "breaks"), _points(poles, "poles")
        if len(poles) != len(breaks) - 1:
            raise ValueError(f"poles must be {len(breaks) - 1} points, not {len(poles)}")
        weights = None if weights is None else line(weights, "weights", len(poles))
        given = address(breaks), len(breaks), address(poles), address(weights)
        return cls._made("periodic", poles.shape[1], degree, *given)

    @classmethod
    def conic(cls, start, corner, end, *, weight: float = 1.0, through=None) -> "Curve":
        """The conic tangent to the legs of a corner, by its weight or through a point."""
        n = len(start)
        named = ((start, "start"), (corner, "corner"), (end, "end"))
        where = [row(value, n, name) for value, name in named]
        where.append(None if through is None else row(through, n, "through"))
        return cls._made("conic", n, *map(address, where), weight)

    @classmethod
    def interpolate(cls, degree: int, t, values, *, orders=None, knots=None) -> "Curve":
        """The curve that has ``values`` (n, d) at parameters ``t``.

        ``orders`` tells which derivative each value is (0, the point, by default). Without
        ``knots`` means of neighbouring parameters are used.
        """
        import numpy

        values = _points(values, "values")
        t = line(t, "t", len(values))
        if orders is not None:
            orders = numpy.ascontiguousarray(orders, dtype=numpy.uint32)
            if orders.shape != t.shape:
                raise ValueError(f"orders must have the shape {t.shape}, not {orders.shape}")
        knots = None if knots is None else line(knots, "knots")
        return cls._made(
            "interpolate",
            values.shape[1],
            degree,
            address(t),
            address(orders),
            address(values),
            len(t),
            address(knots),
            0 if knots is None else len(knots),
        )

    @classmethod
    def interpolate_closed(cls, degree: int, t, points) -> "Curve":
        """The closed curve, smooth at its seam, that passes ``points`` (n, d) at ``t`` (n + 1).

        The last of ``t`` is where the first point is passed again.
        """
        points = _points(points, "points")
        t = line(t, "t", len(points) + 1)
        given = address(t), address(points), len(points)
        return cls._made("interpolate_closed", points.shape[1], degree, *given)

    @classmethod
    def fit(cls, degree: int, knots, t, points, *, weights=None, ends=((), ())) -> "Curve":
        """The weighted least squares curve over ``knots``.

        ``ends`` are what it shall have at its start and its end: the point, the first derivative
        and so on (k, d), or nothing.
        """
        import numpy

        samples, points, _kept = _samples(degree, knots, t, points, weights)
        width = points.shape[1]
        start, end = (rows(e, width, "ends") if len(e) else numpy.empty((0, width)) for e in ends)
        return cls._made("fit", *samples, address(start), len(start), address(end), len(end))

    @classmethod
    def smooth(cls, degree: int, knots, t, points, smoothing: float, *, weights=None) -> "Curve":
        """Least squares plus ``smoothing`` times the integral of the squared second derivative."""
        samples, _points, _kept = _samples(degree, knots, t, points, weights)
        return cls._made("smooth", *samples, smoothing)

    @classmethod
    def smooth_within(cls, degree: int, knots, t, points, residual: float, *, weights=None):
        """The smoothest curve with a sum of squares up to ``residual``; and its smoothing."""
        samples, _points, _kept = _samples(degree, knots, t, points, weights)
        smoothing = ctypes.c_double()
        curve = cls._made("smooth_within", *samples, residual, byref(smoothing))
        return curve, smoothing.value

    def _size(self) -> tuple[int, int, int, bool]:
        """Dimension, degree, number of poles, whether rational."""
        size = c_uint32(), c_uint32(), c_size_t(), c_uint32()
        self._call("size", self._handle, *map(byref, size))
        dimension, degree, count, rational = (value.value for value in size)
        return dimension, degree, count, bool(rational)

    def _data(self):
        """Knots, poles and weights."""
        import numpy

        dimension, degree, count, rational = self._size()
        knots, poles = numpy.empty(count + degree + 1), numpy.empty((count, dimension))
        weights = numpy.empty(count) if rational else None
        self._call("data", self._handle, count, address(knots), address(poles), address(weights))
        return knots, poles, weights

    @property
    def dimension(self) -> int:
        """2 or 3."""
        return self._size()[0]

    @property
    def degree(self) -> int:
        """1 to 25."""
        return self._size()[1]

    @property
    def knots(self):
        """(n + degree + 1) all knots."""
        return self._data()[0]

    @property
    def poles(self):
        """(n, dimension)."""
        return self._data()[1]

    @property
    def weights(self):
        """(n), or None for a polynomial curve."""
        return self._data()[2]

    @property
    def domain(self) -> tuple[float, float]:
        """First and last parameter."""
        knots, degree = self.knots, self.degree
        return float(knots[degree]), float(knots[-1 - degree])

    def evaluate(self, t, order: int = 0, *, below: bool = False):
        """(n, order + 1, dimension): the point and its derivatives at parameters (n,).

        ``below`` takes the derivatives from smaller parameters where a knot makes them jump.
        """
        import numpy

        t = line(t, "t")
        out = numpy.empty((len(t), order + 1, self.dimension))
        self._call("evaluate", self._handle, address(t), len(t), order, below, address(out))
        return out

    def points(self, t):
        """(n, dimension) at parameters (n,)."""
        return self.evaluate(t)[:, 0]

    def frames(self, t):
        """Axes (n, d, d), curvatures (n,) and torsions (n,); NaN where the curve stands still."""
        import numpy

        t = line(t, "t")
        axes = numpy.empty((len(t), self.dimension, self.dimension))
        bends = numpy.empty((2, len(t)))
        places = address(axes), address(bends[0]), address(bends[1])
        self._call("frames", self._handle, address(t), len(t), *places)
        return axes, bends[0], bends[1]

    def lengths(self, t, tolerance: float = 1e-9):
        """Arc lengths (n,) from the start to parameters (n,), to a tolerance in mm."""
        return self._measured("lengths", line(t, "t"), tolerance)

    def at_lengths(self, lengths, tolerance: float = 1e-9):
        """Parameters (n,) at arc lengths (n,) from the start."""
        return self._measured("at_lengths", line(lengths, "lengths"), tolerance)

    def _measured(self, verb: str, values, tolerance: float):
        import numpy

        out = numpy.empty(len(values))
        self._call(verb, self._handle, tolerance, address(values), len(values), address(out))
        return out

    def length(self, tolerance: float = 1e-9) -> float:
        """The whole arc length, to a tolerance in mm."""
        return float(self.lengths(self.domain[1], tolerance)[0])

    def refined(self, knots) -> "Curve":
        """With knots, ascending, inserted."""
        knots = line(knots, "knots")
        return self._changed("refine", address(knots), len(knots))

    def without_knot(self, t: float, times: int, tolerance: float) -> tuple["Curve", float]:
        """With a knot removed as often as the tolerance allows; and by how much it moved."""
        return self._changed_within("remove_knot", t, times, tolerance)

    def elevated(self, by: int = 1) -> "Curve":
        """With a higher degree."""
        return self._changed("elevate", by)

    def reduced(self, tolerance: float) -> tuple["Curve", float]:
        """With the degree lower by one; and by how much it moved."""
        return self._changed_within("reduce", tolerance)

    def part(self, start: float, end: float) -> "Curve":
        """Between two parameters."""
        return self._changed("part", start, end)

    def split(self, t: float) -> tuple["Curve", "Curve"]:
        """Before and after a parameter."""
        start, end = self.domain
        return self.part(start, t), self.part(t, end)

    def reversed(self) -> "Curve":
        """Run backwards."""
        return self._changed("reverse")

    def over(self, start: float, end: float) -> "Curve":
        """Over another domain."""
        return self._changed("over", start, end)

    def clamped(self) -> "Curve":
        """With end knots repeated degree + 1 times."""
        return self._changed("clamp")

    def mapped(self, affine, dimension: Optional[int] = None) -> "Curve":
        """Under an affine map (3, 4); ``dimension`` 2 leaves z out, 3 begins with z = 0."""
        affine = matrix(affine)
        return self._changed("map", address(affine), dimension or self.dimension)

    def joined(self, after: "Curve", gap: float, *, smooth: bool = False) -> "Curve":
        """With another behind it, whose start may be ``gap`` away."""
        return self._changed("join", after._handle, gap, smooth)

    def bezier_segments(self) -> list["Curve"]:
        """One by one, each over the span it came from."""
        made = Curves()
        self._call("bezier", self._handle, byref(made._handle))
        return made.all()

    def nearest(self, points):
        """Parameters (n,), nearest points (n, d) and distances (n,), always the global ones."""
        import numpy

        points = rows(points, self.dimension, "points")
        n = len(points)
        out = numpy.empty(n), numpy.empty_like(points), numpy.empty(n)
        self._call("nearest", self._handle, address(points), n, *map(address, out))
        return out

    def nearest_all(self, point, tie: float = 1e-9):
        """Rows t, x, y, z, distance of all points as near as the nearest to within ``tie``."""
        point = row(point, self.dimension, "point")
        return table("nearest_all", "curve", self._handle, address(point), tie)

    def intersect(self, other: "Curve", tolerance: float):
        """Where it is not further than ``tolerance`` from another: crossings and overlaps.

        Crossings are rows t, s, x, y, z, distance, tangential (0 or 1), overlaps rows t0, t1, s0,
        s1; t are parameters of this curve, s of the other.
        """
        return self._met("intersect", other._handle, tolerance)

    def self_intersect(self, tolerance: float):
        """Where it passes a place twice, as :meth:`intersect`; s and t are both its own."""
        return self._met("self_intersect", tolerance)

    def _met(self, verb: str, *arguments):
        crossings, overlaps = Table(), Table()
        self._call(verb, self._handle, *arguments, *places(crossings, overlaps))
        return crossings.values(), overlaps.values()

    def ray(self, origin, direction, tolerance: float, *, both: bool = False):
        """Where a ray, or a line to both sides, meets it.

        Rows length, from, to, t, x, y, z, distance, tangential (0 or 1), the first on the ray
        first; from and to are lengths between which the ray runs along the curve.
        """
        n = self.dimension
        where = row(origin, n, "origin"), row(direction, n, "direction")
        return table("ray", "curve", self._handle, *map(address, where), both, tolerance)

    def first_hits(self, origins, directions, tolerance: float):
        """Lengths (n,), parameters (n,) and points (n, d) where rays first meet it, or NaN."""
        return first_hits(self, self.dimension, (), origins, directions, tolerance)

    def offset(self, distance: float, tolerance: float, *, limit: float = 0.0):
        """The points at a distance, positive to the left, that are nowhere nearer: curves, pieces.

        Around outward corners go arcs, or straight lines that meet within ``limit`` times the
        distance. Pieces are rows curve, from, to, source_from, source_to.
        """
        return self._moved("offset", distance, tolerance, limit)

    def offset_raw(self, distance: float, tolerance: float, *, limit: float = 0.0):
        """The whole offset, loops and all, as :meth:`offset`."""
        return self._moved("offset_raw", distance, tolerance, limit)

    def _moved(self, verb: str, *arguments):
        curves, pieces = Curves(), Table()
        self._call(verb, self._handle, *arguments, *places(curves, pieces))
        return curves.all(), pieces.values()

    def offset_map(self, pieces, t):
        """Parameters (n,) mapped to those that have a point in an offset, by its pieces."""
        import numpy

        pieces, t = rows(pieces, 5, "pieces"), line(t, "t")
        out = numpy.empty(len(t))
        given = address(pieces), len(pieces), address(t), len(t)
        self._call("offset_map", self._handle, *given, address(out))
        return out

    def fillets(self, other: "Curve", radius: float, tolerance: float) -> list[Fillet]:
        """All arcs of a radius that touch it and another curve in the plane, and cut neither."""
        return self._rounded("fillets", other, radius, tolerance)

    def fillet(self, other: "Curve", radius: float, tolerance: float, *, near=None):
        """The :class:`Fillet` of the corner where ends meet, or the nearest to a point, or None."""
        near = None if near is None else row(near, 2, "near")
        found = self._rounded("fillet", other, radius, tolerance, address(near))
        return found[0] if found else None

    def _rounded(self, verb: str, other: "Curve", *arguments) -> list[Fillet]:
        curves, found = Curves(), Table()
        given = self._handle, other._handle, *arguments
        self._call(verb, *given, *places(curves, found))
        every = [*curves.all(), None]
        numbers = found.values().tolist()
        return [
            Fillet(r[:2], r[2:4], r[4:6], r[6], *(every[int(k)] for k in r[7:])) for r in numbers
        ]


def _samples(degree: int, knots, t, points, weights):
    """What every fit passes, the points, and the arrays that must outlive the call."""
    knots, points = line(knots, "knots"), _points(points, "points")
    t = line(t, "t", len(points))
    weights = None if weights is None else line(weights, "weights", len(points))
    arrays = (knots, t, points, weights)
    sizes = (points.shape[1], degree, address(knots), len(knots))
    return (*sizes, *map(address, arrays[1:]), len(points)), points, arrays


class Curves(Several):
    """Several curves that a call made."""

    _free = "bladesmith_curves_free"
    _noun = "curves"
    _one_kind = Curve
