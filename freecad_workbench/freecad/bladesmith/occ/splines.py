"""Splines of the core to and from FreeCAD: ``Part.BSplineCurve``, ``Part.BSplineSurface``.

Both ways are exact: poles, weights and knots are carried over. Periodic splines of Open CASCADE
become unclamped ones over the same period, with the poles that wrap around repeated.
"""

from ..native import Curve, Surface
from ..native.errors import InputError
from .runtime import part_module

_LIFTED = ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0))


def curve_from_part(curve) -> Curve:
    """The ``Part.BSplineCurve`` as a curve of the core, over the same domain."""
    import numpy

    knots = numpy.array(curve.KnotSequence)
    chosen = _wrapped(len(knots) - curve.Degree - 1, curve.NbPoles)
    poles = numpy.array([tuple(pole) for pole in curve.getPoles()])[chosen]
    weights = numpy.array(curve.getWeights())[chosen] if curve.isRational() else None
    return Curve(curve.Degree, knots, poles, weights)


def curve_to_part(curve: Curve):
    """The curve as a ``Part.BSplineCurve``, clamped; one in the plane lies at z = 0.

    Raises :class:`InputError` for a curve that jumps, which Open CASCADE does not have.
    """
    part = part_module()
    curve = curve.clamped().mapped(_LIFTED, 3)
    made = part.BSplineCurve()
    knots, multiplicities = _distinct(curve.knots, curve.degree)
    poles = [tuple(pole) for pole in curve.poles.tolist()]
    weights = [] if curve.weights is None else [curve.weights.tolist()]
    made.buildFromPolesMultsKnots(poles, multiplicities, knots, False, curve.degree, *weights)
    return made


def surface_from_part(surface) -> Surface:
    """The ``Part.BSplineSurface`` as a surface of the core, over the same domain."""
    import numpy

    degrees = surface.UDegree, surface.VDegree
    knots = numpy.array(surface.UKnotSequence), numpy.array(surface.VKnotSequence)
    counts = surface.NbUPoles, surface.NbVPoles
    chosen = numpy.ix_(*(_wrapped(len(k) - p - 1, n) for k, p, n in zip(knots, degrees, counts)))
    poles = numpy.array([[tuple(pole) for pole in row] for row in surface.getPoles()])[chosen]
    rational = surface.isURational() or surface.isVRational()
    weights = numpy.array(surface.getWeights())[chosen] if rational else None
    return Surface(degrees, *knots, poles, weights)


def surface_to_part(surface: Surface):
    """The surface as a ``Part.BSplineSurface``, clamped.

    Raises :class:`InputError` for a surface that jumps, which Open CASCADE does not have.
    """
    part = part_module()
    surface = surface.clamped()
    made = part.BSplineSurface()
    pairs = [_distinct(knots, degree) for knots, degree in zip(surface.knots, surface.degrees)]
    (knots_u, multiplicities_u), (knots_v, multiplicities_v) = pairs
    poles = [[tuple(pole) for pole in row] for row in surface.poles.tolist()]
    weights = [] if surface.weights is None else [surface.weights.tolist()]
    made.buildFromPolesMultsKnots(
        poles,
        multiplicities_u,
        multiplicities_v,
        knots_u,
        knots_v,
        False,
        False,
        *surface.degrees,
        *weights,
    )
    return made


def _wrapped(functions: int, poles: int):
    """Which pole belongs to each basis function: the first ones again at the end of a period."""
    import numpy

    return numpy.arange(functions) % poles


def _distinct(knots, degree: int) -> tuple[list, list]:
    """Distinct knots and their multiplicities."""
    import numpy

    breaks, multiplicities = numpy.unique(knots, return_counts=True)
    inner = multiplicities[1:-1]
    if (inner > degree).any():
        at = breaks[1:-1][inner > degree][0]
        raise InputError(f"the spline jumps at its knot {at}: split it there for Open CASCADE")
    return breaks.tolist(), multiplicities.tolist()
