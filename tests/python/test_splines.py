"""Curves and surfaces of the core against Open CASCADE: random, rational, periodic, unclamped."""

import math
import unittest

import common
import numpy
from common import Part
from freecad.bladesmith import native
from freecad.bladesmith.native import Curve, Surface
from freecad.bladesmith.occ import splines

Vector = common.FreeCAD.Vector


def random_knots(rng, degree, spans):
    """Clamped flat knots, some of the inner ones repeated."""
    breaks = numpy.cumsum(rng.uniform(0.2, 1.0, spans - 1))
    inner = numpy.repeat(breaks, rng.integers(1, degree + 1, spans - 1))
    end = (breaks[-1] if spans > 1 else 0.0) + 0.7
    return numpy.concatenate([[0.0] * (degree + 1), inner, [end] * (degree + 1)])


def random_weights(rng, shape):
    return numpy.exp(rng.uniform(-1.5, 1.5, shape))


def random_curve(rng, rational):
    degree = int(rng.integers(1, 7))
    knots = random_knots(rng, degree, int(rng.integers(1, 6)))
    count = len(knots) - degree - 1
    weights = random_weights(rng, count) if rational else None
    return Curve(degree, knots, rng.normal(0.0, 30.0, (count, 3)), weights)


def random_surface(rng, rational):
    degrees = [int(d) for d in rng.integers(1, 5, 2)]
    knots = [random_knots(rng, degree, int(rng.integers(1, 5))) for degree in degrees]
    shape = tuple(len(k) - p - 1 for k, p in zip(knots, degrees))
    weights = random_weights(rng, shape) if rational else None
    return Surface(degrees, *knots, rng.normal(0.0, 30.0, (*shape, 3)), weights)


def periodic_curve(rng, rational):
    """A closed curve of Open CASCADE with knots of several multiplicities."""
    curve = Part.BSplineCurve()
    points = [Vector(*p) for p in rng.normal(0.0, 20.0, (7, 3))]
    curve.interpolate(points, PeriodicFlag=True)
    curve.insertKnot(curve.getKnot(3), 2)
    curve.setOrigin(int(rng.integers(1, curve.NbKnots)))
    if rational:
        for index, weight in enumerate(random_weights(rng, curve.NbPoles), 1):
            curve.setWeight(index, weight)
    return curve


def periodic_surface(rng, rational):
    """A surface of Open CASCADE that is closed along both directions."""
    degrees = [int(d) for d in rng.integers(1, 5, 2)]
    shape = [int(n) for n in rng.integers(5, 9, 2)]
    knots = [numpy.cumsum(rng.uniform(0.3, 1.0, n + 1)).tolist() for n in shape]
    poles = [[Vector(*p) for p in row] for row in rng.normal(0.0, 30.0, (*shape, 3))]
    weights = [random_weights(rng, shape).tolist()] if rational else []
    multiplicities = [[1] * (n + 1) for n in shape]
    surface = Part.BSplineSurface()
    surface.buildFromPolesMultsKnots(poles, *multiplicities, *knots, True, True, *degrees, *weights)
    return surface


def inside(rng, domain, count=40):
    return rng.uniform(*domain, count)


class Curves(unittest.TestCase):
    def assert_same(self, curve, peer, rng):
        """Points, derivatives and lengths agree, relative to the size of each."""
        t = inside(rng, curve.domain)
        found = curve.evaluate(t, 4)
        for order in range(5):
            values = [peer.value(s) if order == 0 else peer.getDN(s, order) for s in t]
            expected = numpy.array([tuple(value) for value in values])
            size = max(1.0, numpy.abs(expected).max())
            numpy.testing.assert_allclose(found[:, order], expected, atol=1e-10 * size, rtol=0)
        a, b = numpy.sort(inside(rng, curve.domain, 2))
        length = numpy.subtract(*curve.lengths([b, a], 1e-9))
        self.assertAlmostEqual(length / peer.length(a, b), 1.0, delta=1e-6)

    def test_random_curves_agree_with_open_cascade(self):
        rng = numpy.random.default_rng(1)
        for case in range(60):
            with self.subTest(case=case):
                curve = random_curve(rng, case % 2 == 1)
                self.assert_same(curve, splines.curve_to_part(curve), rng)

    def test_periodic_curves_agree_with_open_cascade(self):
        rng = numpy.random.default_rng(2)
        for case in range(30):
            with self.subTest(case=case):
                peer = periodic_curve(rng, case % 2 == 1)
                curve = splines.curve_from_part(peer)
                self.assertEqual(curve.domain, (peer.FirstParameter, peer.LastParameter))
                self.assert_same(curve, peer, rng)
                self.assert_same(curve, splines.curve_to_part(curve), rng)

    def test_curves_come_back_from_open_cascade_to_the_last_bit(self):
        rng = numpy.random.default_rng(3)
        for case in range(20):
            curve = random_curve(rng, case % 2 == 1)
            again = splines.curve_from_part(splines.curve_to_part(curve))
            numpy.testing.assert_array_equal(again.knots, curve.knots)
            numpy.testing.assert_array_equal(again.poles, curve.poles)
            if curve.weights is not None:
                numpy.testing.assert_array_equal(again.weights, curve.weights)

    def test_what_reshapes_a_curve_keeps_it_for_open_cascade(self):
        rng = numpy.random.default_rng(4)
        for case in range(30):
            curve = random_curve(rng, case % 2 == 1)
            a, b = curve.domain
            middle = 0.5 * (a + b) + 1e-3
            for name, other in {
                "refined": curve.refined([middle]),
                "elevated": curve.elevated(2),
                "reversed twice": curve.reversed().reversed(),
                "joined": curve.part(a, middle).joined(curve.part(middle, b), 1e-6),
            }.items():
                with self.subTest(case=case, change=name):
                    peer = splines.curve_to_part(other)
                    shift = other.domain[0] - a
                    t = inside(rng, curve.domain)
                    expected = numpy.array([tuple(peer.value(s + shift)) for s in t])
                    numpy.testing.assert_allclose(curve.points(t), expected, atol=1e-11 * 100)

    def test_frames_and_curvatures_agree_with_open_cascade(self):
        rng = numpy.random.default_rng(5)
        for case in range(20):
            curve = random_curve(rng, True)
            if curve.degree == 1:
                continue
            peer = splines.curve_to_part(curve)
            t = inside(rng, curve.domain, 10)
            axes, curvatures, _torsions = curve.frames(t)
            for s, frame, curvature in zip(t, axes, curvatures):
                with self.subTest(case=case, t=s):
                    numpy.testing.assert_allclose(frame[0], tuple(peer.tangent(s)[0]), atol=1e-9)
                    numpy.testing.assert_allclose(frame[1], tuple(peer.normal(s)), atol=1e-7)
                    self.assertAlmostEqual(curvature / peer.curvature(s), 1.0, delta=1e-8)
                    numpy.testing.assert_allclose(frame @ frame.T, numpy.eye(3), atol=1e-13)

    def test_no_point_of_open_cascade_is_nearer(self):
        rng = numpy.random.default_rng(6)
        for case in range(20):
            curve = random_curve(rng, case % 2 == 1)
            shape = splines.curve_to_part(curve).toShape()
            points = rng.normal(0.0, 40.0, (20, 3))
            t, feet, distances = curve.nearest(points)
            numpy.testing.assert_allclose(curve.points(t), feet, atol=1e-11 * 100)
            for point, distance in zip(points, distances):
                peer = shape.distToShape(Part.Vertex(*point))[0]
                self.assertLessEqual(distance, peer + 1e-9)

    def test_lengths_and_parameters_go_back_and_forth(self):
        curve = Curve.arc((1, 2, 3), (5, 0, 0), (0, 5, 0), 0.0, math.tau)
        self.assertAlmostEqual(curve.length(), 10 * math.pi, places=9)
        s = numpy.linspace(0, curve.length(), 33)
        numpy.testing.assert_allclose(curve.lengths(curve.at_lengths(s)), s, atol=1e-9)


class Surfaces(unittest.TestCase):
    def assert_same(self, surface, peer, rng):
        uv = numpy.column_stack([inside(rng, domain) for domain in surface.domain])
        found = surface.evaluate(uv, 3)
        orders = [(total - k, k) for total in range(4) for k in range(total + 1)]
        for index, (k, m) in enumerate(orders):
            values = [peer.value(*at) if k + m == 0 else peer.getDN(*at, k, m) for at in uv]
            expected = numpy.array([tuple(value) for value in values])
            size = max(1.0, numpy.abs(expected).max())
            numpy.testing.assert_allclose(found[:, index], expected, atol=1e-10 * size, rtol=0)

    def test_random_surfaces_agree_with_open_cascade(self):
        rng = numpy.random.default_rng(7)
        for case in range(40):
            with self.subTest(case=case):
                surface = random_surface(rng, case % 2 == 1)
                peer = splines.surface_to_part(surface)
                self.assert_same(surface, peer, rng)
                again = splines.surface_from_part(peer)
                numpy.testing.assert_array_equal(again.poles, surface.poles)

    def test_periodic_surfaces_agree_with_open_cascade(self):
        rng = numpy.random.default_rng(8)
        for case in range(20):
            with self.subTest(case=case):
                peer = periodic_surface(rng, case % 2 == 1)
                surface = splines.surface_from_part(peer)
                self.assertEqual(surface.domain, (peer.bounds()[:2], peer.bounds()[2:]))
                self.assert_same(surface, peer, rng)
                self.assert_same(surface, splines.surface_to_part(surface), rng)

    def test_areas_agree_with_open_cascade(self):
        # Open CASCADE's own area has few Gauss points: it is off by 1e-3 and more over inner knots
        # or with very uneven weights.
        rng = numpy.random.default_rng(9)
        for case in range(4):
            knots = random_knots(rng, 3, 3)
            n = len(knots) - 4
            at = numpy.linspace(0.0, 40.0, n)
            x, y = numpy.meshgrid(at, at, indexing="ij")
            poles = numpy.stack([x, y, rng.normal(0.0, 3.0, (n, n))], axis=-1)
            surface = Surface((3, 3), knots, knots, poles, random_weights(rng, (n, n)) ** 0.25)
            peer = sum(splines.surface_to_part(piece).toShape().Area for piece in patches(surface))
            self.assertAlmostEqual(area(surface, 20) / peer, 1.0, delta=1e-5, msg=f"case {case}")

    def test_normals_and_curvatures_agree_with_open_cascade(self):
        rng = numpy.random.default_rng(10)
        for case in range(10):
            surface = random_surface(rng, True)
            if min(surface.degrees) == 1:
                continue
            peer = splines.surface_to_part(surface)
            uv = numpy.column_stack([inside(rng, domain, 10) for domain in surface.domain])
            normals, curvatures, _directions = surface.curvatures(uv)
            for at, normal, found in zip(uv, normals, curvatures):
                with self.subTest(case=case, at=at):
                    numpy.testing.assert_allclose(normal, tuple(peer.normal(*at)), atol=1e-8)
                    expected = sorted(peer.curvature(*at, kind) for kind in ("Max", "Min"))
                    size = numpy.abs(expected).max()
                    numpy.testing.assert_allclose(found, expected, atol=1e-7 * size, rtol=0)

    def test_isocurves_and_halves_lie_on_the_surface(self):
        rng = numpy.random.default_rng(11)
        surface = random_surface(rng, True)
        (a, b), _ = surface.domain
        u = 0.4 * a + 0.6 * b
        line = surface.isocurve("u", u)
        v = inside(rng, line.domain)
        uv = numpy.column_stack([numpy.full(len(v), u), v])
        numpy.testing.assert_allclose(line.points(v), surface.points(uv), atol=1e-12 * 100)
        for half in surface.split("u", u):
            numpy.testing.assert_allclose(half.points(uv), surface.points(uv), atol=1e-12 * 100)

    def test_no_point_of_open_cascade_is_nearer(self):
        rng = numpy.random.default_rng(12)
        for case in range(6):
            surface = random_surface(rng, case % 2 == 1)
            face = splines.surface_to_part(surface).toShape()
            points = rng.normal(0.0, 40.0, (6, 3))
            uv, feet, distances = surface.nearest(points)
            numpy.testing.assert_allclose(surface.points(uv), feet, atol=1e-11 * 100)
            for point, distance in zip(points, distances):
                peer = face.distToShape(Part.Vertex(*point))[0]
                self.assertLessEqual(distance, peer + 1e-9, f"case {case}")


class Made(unittest.TestCase):
    def test_a_revolved_surface_has_the_area_of_guldin(self):
        profile = Curve(1, [0, 0, 1, 1], [(2, 0, 0), (5, 0, 4)])
        surface = Surface.revolved(profile, (0, 0, 0), (0, 0, 1), math.tau)
        self.assertAlmostEqual(area(surface, 20), math.tau * 3.5 * 5.0, places=9)

    def test_a_skin_holds_its_sections(self):
        sections = [Curve.arc((0, 0, z), (2 + z, 0, 0), (0, 2 + z, 0), 0, 2) for z in range(4)]
        surface = Surface.skin(sections, [0, 1, 2, 3])
        t = numpy.linspace(0, 1, 21)
        for v, section in enumerate(sections):
            uv = numpy.column_stack([t, numpy.full(21, float(v))])
            numpy.testing.assert_allclose(surface.points(uv), section.points(t), atol=1e-13 * 10)

    def test_interpolation_passes_points_and_derivatives(self):
        points = [(0, 0), (1, 2), (3, 1), (4, 4)]
        for spacing in native.SPACINGS:
            t = native.parameters(points, spacing)
            values = [*points, (0, 1)]
            curve = Curve.interpolate(3, [*t, 0.0], values, orders=[0, 0, 0, 0, 1])
            numpy.testing.assert_allclose(curve.points(t), points, atol=1e-13)
            numpy.testing.assert_allclose(curve.evaluate(0.0, 1)[0, 1], (0, 1), atol=1e-12)

    def test_a_closed_curve_passes_its_points_and_is_smooth_at_the_seam(self):
        points = [(3, 0, 0), (1, 2, 1), (-2, 1, 0), (-1, -2, 2), (2, -2, 1)]
        t = native.parameters([*points, points[0]])
        for degree in range(1, 5):
            curve = Curve.interpolate_closed(degree, t, points)
            start, end = curve.domain
            self.assertAlmostEqual(end - start, t[-1], 14)
            there = numpy.where(t[:-1] < start, t[:-1] + t[-1], t[:-1])
            numpy.testing.assert_allclose(curve.points(there), points, atol=1e-12)
            seam = (
                curve.evaluate([start], degree - 1),
                curve.evaluate([end], degree - 1, below=True),
            )
            numpy.testing.assert_allclose(*seam, atol=1e-9)

    def test_fits_keep_their_ends(self):
        t = numpy.linspace(0, 1, 50)
        points = numpy.column_stack([t, numpy.sin(3 * t)])
        knots = [0, 0, 0, 0, 0.25, 0.5, 0.75, 1, 1, 1, 1]
        curve = Curve.fit(3, knots, t, points, ends=([(0, 0), (1, 3)], [points[-1]]))
        numpy.testing.assert_allclose(curve.points(t), points, atol=1e-3)
        numpy.testing.assert_allclose(curve.evaluate(0.0, 1)[0], [(0, 0), (1, 3)], atol=1e-12)
        smooth, smoothing = Curve.smooth_within(3, knots, t, points, 1e-3)
        self.assertLessEqual(((smooth.points(t) - points) ** 2).sum(), 1e-3)
        again = Curve.smooth(3, knots, t, points, smoothing)
        numpy.testing.assert_allclose(again.poles, smooth.poles, atol=1e-12)

    def test_ties_are_all_found(self):
        curve = Curve(1, [0, 0, 1, 2, 2], [(-1, 0), (0, 1), (1, 0)])
        found = curve.nearest_all((0, 0))
        numpy.testing.assert_allclose(sorted(found[:, 0]), [0.5, 1.5])
        numpy.testing.assert_allclose(found[:, 4], math.sqrt(0.5))

    def test_segments_and_compatible_curves_are_curves_of_their_own(self):
        circle = Curve.arc((0, 0), (1, 0), (0, 1), 0, math.tau)
        segments = circle.bezier_segments()
        del circle
        self.assertEqual([s.domain for s in segments], [(k / 4, k / 4 + 0.25) for k in range(4)])
        first, second = native.compatible([segments[0], Curve(1, [0, 0, 1, 1], [(0, 0), (1, 1)])])
        self.assertEqual((first.degree, second.degree), (2, 2))
        numpy.testing.assert_array_equal(first.knots, second.knots)

    def test_what_cannot_be_is_refused_with_its_reason(self):
        cases = {
            "shape": (ValueError, lambda: Curve(1, [0, 0, 1, 1], [1, 2])),
            "3 poles where the knots ask for 2": (
                native.InputError,
                lambda: Curve(1, [0, 0, 1, 1], [(0, 0)] * 3),
            ),
            "knots": (native.InputError, lambda: Curve(1, [0, 1, 0, 1], [(0, 0)] * 2)),
            "'t': value 1 of point 1 is nan|'t'": (
                native.ArgumentError,
                lambda: Curve(1, [0, 0, 1, 1], [(0, 0), (1, 1)]).points(math.nan),
            ),
            "spacing": (ValueError, lambda: native.parameters([(0, 0), (1, 1)], "even")),
        }
        for text, (kind, call) in cases.items():
            with self.subTest(text), self.assertRaisesRegex(kind, text):
                call()

    def test_arrays_are_passed_without_a_copy(self):
        from freecad.bladesmith.native import arrays

        points = numpy.zeros((5, 3))
        self.assertIs(arrays.rows(points, 3, "points"), points)
        self.assertEqual(arrays.address(points), points.ctypes.data)


def patches(surface):
    """The pieces of a surface between neighbouring knots."""
    breaks = [numpy.unique(k[p : len(k) - p]) for k, p in zip(surface.knots, surface.degrees)]
    for a, b in zip(breaks[0], breaks[0][1:]):
        for c, d in zip(breaks[1], breaks[1][1:]):
            yield surface.part("u", a, b).part("v", c, d)


def area(surface, order):
    """By Gauss points on each patch."""
    x, weight = numpy.polynomial.legendre.leggauss(order)
    total = 0.0
    for patch in patches(surface):
        (a, b), (c, d) = patch.domain
        u, v = numpy.meshgrid((a + b + (b - a) * x) / 2, (c + d + (d - c) * x) / 2)
        jet = patch.evaluate(numpy.column_stack([u.ravel(), v.ravel()]), 1)
        size = numpy.linalg.norm(numpy.cross(jet[:, 1], jet[:, 2]), axis=1)
        total += (b - a) * (d - c) / 4 * (numpy.outer(weight, weight).ravel() @ size)
    return total


if __name__ == "__main__":
    unittest.main()
