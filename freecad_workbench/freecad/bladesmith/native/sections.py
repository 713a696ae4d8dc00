"""Intersections of surfaces and curves projected onto them, as plain values.

:class:`Surface` makes them.
"""

from typing import Any, NamedTuple, Optional

from .arrays import Spline, Table, address, places
from .curves import Curve, Curves


class Branch(NamedTuple):
    """One branch of an intersection."""

    curve: Curve
    """In space, over its length."""
    parameters: tuple[Curve, Curve]
    """Its parameters on the surface, and on the other or in the plane."""
    closed: bool
    """Whether the end is the start."""
    touching: bool
    """Whether the surfaces touch along it rather than cross."""
    deviation: float
    """How far from the true branch it was seen."""


class Section(NamedTuple):
    """Where a surface meets a plane or another surface."""

    branches: list[Branch]
    touching: Any
    """Rows x, y, z, u, v, s, t, gap, crossing of points in which the tangent planes agree."""
    overlaps: Any
    """Rows u0, v0, u1, v1: where both are one."""
    uncertain: Any
    """Rows u, v: around which the contact is too close to decide."""
    axes: Optional[Any]
    """(3, 3) origin and unit vectors of a plane, to which its parameters refer."""


class Projection(NamedTuple):
    """A part of a curve on a surface."""

    curve: Curve
    """In space."""
    parameters: Curve
    """Its parameters on the surface."""
    deviation: float
    """How far from the true projection it was seen."""


class _Section(Spline):
    _free = "bladesmith_section_free"
    _noun = "section"

    def branches(self) -> list[Branch]:
        """All branches."""
        lists, table = [Curves() for _ in range(3)], Table()
        self._call("branches", self._handle, *places(*lists, table))
        pieces = zip(*(several.all() for several in lists), table.values().tolist())
        return [Branch(c, (a, b), bool(r[0]), bool(r[1]), r[2]) for c, a, b, r in pieces]

    def contacts(self) -> list:
        """Touching points, overlaps and uncertain places."""
        tables = [Table() for _ in range(3)]
        self._call("contacts", self._handle, *places(*tables))
        return [table.values() for table in tables]

    def axes(self):
        """Those of the plane."""
        import numpy

        out = numpy.empty((3, 3))
        self._call("axes", self._handle, address(out))
        return out


def section(surface: Spline, verb: str, *arguments, in_plane: bool = False) -> Section:
    """What the call of a surface gives."""
    found = _Section()
    surface._call(verb, surface._handle, *arguments, *places(found))
    return Section(found.branches(), *found.contacts(), found.axes() if in_plane else None)


def projected(surface: Spline, curve: Curve, direction, tolerance: float) -> list[Projection]:
    """A curve on a surface, along a direction unless that is None."""
    curves, parameters, deviations = Curves(), Curves(), Table()
    given = surface._handle, curve._handle, direction, tolerance
    surface._call("project", *given, *places(curves, parameters, deviations))
    off = deviations.values()[:, 0].tolist()
    return [Projection(*part) for part in zip(curves.all(), parameters.all(), off)]
