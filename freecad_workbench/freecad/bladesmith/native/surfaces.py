"""NURBS surfaces of the core: :class:`Surface`."""

from collections.abc import Sequence
from ctypes import byref, c_size_t, c_uint32

from .arrays import (
    Several,
    Spline,
    address,
    first_hits,
    handles,
    line,
    matrix,
    row,
    rows,
    table,
)
from .curves import Curve
from .sections import Projection, Section, projected, section

_DIRECTIONS = {"u": 0, "v": 1}


def _direction(name: str) -> int:
    if name not in _DIRECTIONS:
        raise ValueError(f"direction is '{name}'; give 'u' or 'v'")
    return _DIRECTIONS[name]


class Surface(Spline):
    """A NURBS surface; it never changes.

    Poles are (n, m, 3), the second index along v. Directions are "u" and "v". Methods that end in
    "-ed" return new surfaces. Lengths are in the unit of the poles, mm by convention.
    """

    _free = "bladesmith_surface_free"
    _noun = "surface"

    def __init__(self, degrees, knots_u, knots_v, poles, weights=None):
        import numpy

        super().__init__()
        knots_u, knots_v = line(knots_u, "knots_u"), line(knots_v, "knots_v")
        poles = numpy.ascontiguousarray(poles, dtype=float)
        shape = tuple(len(k) - d - 1 for k, d in zip((knots_u, knots_v), degrees))
        if poles.shape != (*shape, 3):
            raise ValueError(f"poles must have the shape {(*shape, 3)}, not {poles.shape}")
        if weights is not None:
            weights = numpy.ascontiguousarray(weights, dtype=float)
            if weights.shape != shape:
                raise ValueError(f"weights must have the shape {shape}, not {weights.shape}")
        self._call(
            "new",
            *degrees,
            address(knots_u),
            len(knots_u),
            address(knots_v),
            len(knots_v),
            address(poles),
            address(weights),
            poles.size // 3,
            byref(self._handle),
        )

    @classmethod
    def ruled(cls, first: Curve, second: Curve) -> "Surface":
        """Of the lines between points of two curves at equal parameters."""
        return cls._made("ruled", first._handle, second._handle)

    @classmethod
    def revolved(cls, curve: Curve, origin, axis, angle: float) -> "Surface":
        """What a curve sweeps when it turns about an axis, by an angle in rad."""
        origin, axis = row(origin, 3, "origin"), row(axis, 3, "axis")
        return cls._made("revolved", curve._handle, address(origin), address(axis), angle)

    @classmethod
    def coons(cls, along_u: Sequence[Curve], along_v: Sequence[Curve]) -> "Surface":
        """The bilinearly blended patch between two and two curves that meet in four corners."""
        curves = [*along_u, *along_v]
        if len(along_u) != 2 or len(along_v) != 2:
            raise ValueError(f"a Coons patch has 2 and 2 curves, not {len(curves)}")
        return cls._made("coons", handles(curves))

    @classmethod
    def skin(cls, sections: Sequence[Curve], parameters, degree: int = 3) -> "Surface":
        """Through sections, which it holds at ascending parameters of v."""
        parameters = line(parameters, "parameters", len(sections))
        return cls._made("skin", handles(sections), address(parameters), len(sections), degree)

    def _size(self) -> tuple[tuple[int, int], tuple[int, int], bool]:
        """Degrees, numbers of poles, whether rational."""
        size = c_uint32(), c_uint32(), c_size_t(), c_size_t(), c_uint32()
        self._call("size", self._handle, *map(byref, size))
        p, q, n, m, rational = (value.value for value in size)
        return (p, q), (n, m), bool(rational)

    def _data(self):
        """Knots along u and v, poles and weights."""
        import numpy

        (p, q), (n, m), rational = self._size()
        knots = numpy.empty(n + p + 1), numpy.empty(m + q + 1)
        poles, weights = numpy.empty((n, m, 3)), numpy.empty((n, m)) if rational else None
        self._call("data", self._handle, n * m, *map(address, (*knots, poles, weights)))
        return (*knots, poles, weights)

    @property
    def degrees(self) -> tuple[int, int]:
        """Along u and v."""
        return self._size()[0]

    @property
    def knots(self):
        """All knots along u, and along v."""
        return self._data()[:2]

    @property
    def poles(self):
        """(n, m, 3)."""
        return self._data()[2]

    @property
    def weights(self):
        """(n, m), or None for a polynomial surface."""
        return self._data()[3]

    @property
    def domain(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """First and last parameter along u, and along v."""
        ends = [(k[d], k[-1 - d]) for k, d in zip(self.knots, self.degrees)]
        (a, b), (c, d) = ends
        return (float(a), float(b)), (float(c), float(d))

    def evaluate(self, uv, order: int = 0, *, below: tuple[bool, bool] = (False, False)):
        """(n, (order + 1)(order + 2) / 2, 3): S; S_u, S_v; S_uu, S_uv, S_vv ... at (n, 2).

        ``below`` takes derivatives from smaller u, smaller v where a knot makes them jump.
        """
        import numpy

        uv = rows(uv, 2, "uv")
        out = numpy.empty((len(uv), (order + 1) * (order + 2) // 2, 3))
        self._call("evaluate", self._handle, address(uv), len(uv), order, *below, address(out))
        return out

    def points(self, uv):
        """(n, 3) at parameters (n, 2)."""
        return self.evaluate(uv)[:, 0]

    def evaluate_grid(self, u, v, order: int = 0):
        """(n, m, (order + 1)(order + 2) / 2, 3) on the grid of u (n,) and v (m,); order to 2."""
        import numpy

        u, v = line(u, "u"), line(v, "v")
        out = numpy.empty((len(u), len(v), (order + 1) * (order + 2) // 2, 3))
        given = address(u), len(u), address(v), len(v)
        self._call("evaluate_grid", self._handle, *given, order, address(out))
        return out

    def curvatures(self, uv):
        """Normals (n, 3), principal curvatures (n, 2), ascending, and directions (n, 2, 3)."""
        import numpy

        uv = rows(uv, 2, "uv")
        n = len(uv)
        out = numpy.empty((n, 3)), numpy.empty((n, 2)), numpy.empty((n, 2, 3))
        self._call("curvatures", self._handle, address(uv), n, *map(address, out))
        return out

    def refined(self, direction: str, knots) -> "Surface":
        """With knots, ascending, inserted."""
        knots = line(knots, "knots")
        return self._changed("refine", _direction(direction), address(knots), len(knots))

    def without_knot(
        self, direction: str, t: float, times: int, tolerance: float
    ) -> tuple["Surface", float]:
        """With a knot removed as often as the tolerance allows; and by how much it moved."""
        return self._changed_within("remove_knot", _direction(direction), t, times, tolerance)

    def elevated(self, direction: str, by: int = 1) -> "Surface":
        """With a higher degree."""
        return self._changed("elevate", _direction(direction), by)

    def reduced(self, direction: str, tolerance: float) -> tuple["Surface", float]:
        """With the degree lower by one; and by how much it moved."""
        return self._changed_within("reduce", _direction(direction), tolerance)

    def part(self, direction: str, start: float, end: float) -> "Surface":
        """Between two parameters."""
        return self._changed("part", _direction(direction), start, end)

    def split(self, direction: str, t: float) -> tuple["Surface", "Surface"]:
        """Before and after a parameter."""
        start, end = self.domain[_direction(direction)]
        return self.part(direction, start, t), self.part(direction, t, end)

    def reversed(self, direction: str) -> "Surface":
        """Run backwards."""
        return self._changed("reverse", _direction(direction))

    def over(self, direction: str, start: float, end: float) -> "Surface":
        """Over another domain along a direction."""
        return self._changed("over", _direction(direction), start, end)

    def bezier_patches(self) -> list["Surface"]:
        """Between neighbouring knots, those along v next to each other."""
        made = _Surfaces()
        self._call("bezier", self._handle, byref(made._handle))
        return made.all()

    def swapped(self) -> "Surface":
        """With u and v exchanged."""
        return self._changed("swap")

    def clamped(self) -> "Surface":
        """With end knots repeated degree + 1 times."""
        return self._changed("clamp")

    def mapped(self, affine) -> "Surface":
        """Under an affine map (3, 4)."""
        affine = matrix(affine)
        return self._changed("map", address(affine))

    def isocurve(self, direction: str, t: float) -> Curve:
        """Along which the parameter of ``direction`` is ``t``."""
        curve = Curve.__new__(Curve)
        Spline.__init__(curve)
        self._call("isocurve", self._handle, _direction(direction), t, byref(curve._handle))
        return curve

    def nearest(self, points):
        """Parameters (n, 2), nearest points (n, 3), distances (n,), always the global ones."""
        import numpy

        points = rows(points, 3, "points")
        n = len(points)
        out = numpy.empty((n, 2)), numpy.empty((n, 3)), numpy.empty(n)
        self._call("nearest", self._handle, address(points), n, *map(address, out))
        return out

    def nearest_all(self, point, tie: float = 1e-9):
        """Rows u, v, x, y, z, distance of all points as near as the nearest to within ``tie``."""
        point = row(point, 3, "point")
        return table("nearest_all", "surface", self._handle, address(point), tie)

    def ray(self, origin, direction, tolerance: float, *, both: bool = False):
        """Where a ray, or a line to both sides, meets it.

        Rows length, from, to, u, v, x, y, z, distance, tangential (0 or 1), the first on the ray
        first; from and to are lengths between which the ray grazes the surface or runs on it.
        """
        where = row(origin, 3, "origin"), row(direction, 3, "direction")
        return table("ray", "surface", self._handle, *map(address, where), both, tolerance)

    def first_hits(self, origins, directions, tolerance: float):
        """Lengths (n,), parameters (n, 2) and points (n, 3) where rays first meet it, or NaN."""
        return first_hits(self, 3, (2,), origins, directions, tolerance)

    def section(self, origin, normal, tolerance: float) -> Section:
        """Where it meets the plane through a point across a direction."""
        where = row(origin, 3, "origin"), row(normal, 3, "normal")
        return section(self, "section", *map(address, where), tolerance, in_plane=True)

    def intersect(self, other: "Surface", tolerance: float) -> Section:
        """Where it meets another surface."""
        return section(self, "intersect", other._handle, tolerance)

    def project(self, curve: Curve, tolerance: float, *, direction=None) -> list[Projection]:
        """A curve in space projected to its nearest points, or along a direction."""
        direction = None if direction is None else row(direction, 3, "direction")
        return projected(self, curve, address(direction), tolerance)

    def offset(self, distance: float, tolerance: float) -> tuple["Surface", float]:
        """Along the normals, over the same domain; and how far from the true offset it was seen."""
        return self._changed_within("offset", distance, tolerance)


class _Surfaces(Several):
    """Several surfaces that a call made."""

    _free = "bladesmith_surfaces_free"
    _noun = "surfaces"
    _one_kind = Surface
