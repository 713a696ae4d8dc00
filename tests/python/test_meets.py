"""Where curves and surfaces meet, and offsets, against Open CASCADE and closed forms."""

import math
import unittest

import common
import numpy
from common import Part
from freecad.bladesmith import native
from freecad.bladesmith.native import Curve, Surface
from freecad.bladesmith.occ import splines

Vector = common.FreeCAD.Vector

TURN = math.tau


def circle(radius, centre=(0.0, 0.0)):
    return Curve.arc(centre, (radius, 0), (0, radius), 0, TURN)


def polygon(points):
    count = len(points)
    return Curve(1, [0, *range(count), count - 1], points)


def wavy(rng, count=9):
    """A cubic through random heights above a line."""
    x = numpy.linspace(0.0, 80.0, count)
    points = numpy.column_stack([x, rng.uniform(-10.0, 10.0, count)])
    return Curve.interpolate(3, native.parameters(points), points)


def cylinder(radius, height):
    profile = Curve(1, [0, 0, 1, 1], [(radius, 0, 0), (radius, 0, height)])
    return Surface.revolved(profile, (0, 0, 0), (0, 0, 1), TURN)


class Crossings(unittest.TestCase):
    def test_random_curves_cross_where_open_cascade_finds_it(self):
        rng = numpy.random.default_rng(31)
        total = 0
        for case in range(20):
            with self.subTest(case=case):
                first, second = wavy(rng), wavy(rng)
                found, overlaps = first.intersect(second, 1e-7)
                parts = [
                    splines.curve_to_part(c.mapped(numpy.eye(3, 4), 3)) for c in (first, second)
                ]
                expected = sorted((p.X, p.Y) for p in parts[0].intersect(parts[1], 1e-7))
                self.assertEqual(len(overlaps), 0)
                self.assertEqual(len(found), len(expected))
                points = sorted(map(tuple, found[:, 2:4]))
                numpy.testing.assert_allclose(points, expected, atol=1e-5)
                total += len(found)
                for t, curve in ((found[:, 0], first), (found[:, 1], second)):
                    numpy.testing.assert_allclose(curve.points(t), found[:, 2:4], atol=1e-7)
        self.assertGreater(total, 40, "the curves hardly cross")

    def test_touches_and_overlaps_are_told_from_crossings(self):
        touch, none = circle(1.0).intersect(circle(2.0, (3.0, 0.0)), 1e-6)
        self.assertEqual((len(touch), touch[0, 6], len(none)), (1, 1.0, 0))
        first = polygon([(0, 0), (10, 0)])
        single, overlaps = first.intersect(polygon([(14, 0), (4, 0)]), 1e-6)
        self.assertEqual(len(single), 0)
        numpy.testing.assert_allclose(overlaps, [[0.4, 1.0, 1.0, 0.4]], atol=1e-6)

    def test_a_loop_crosses_itself_once(self):
        bow = polygon([(0, 0), (10, 10), (10, 0), (0, 10)])
        found, _ = bow.self_intersect(1e-9)
        numpy.testing.assert_allclose(found[:, :5], [[0.5, 2.5, 5, 5, 0]], atol=1e-9)

    def test_curves_of_different_dimensions_are_refused(self):
        space = Curve(1, [0, 0, 1, 1], [(0, 0, 0), (1, 1, 1)])
        with self.assertRaisesRegex(native.ArgumentError, "other dimension"):
            circle(1.0).intersect(space, 1e-6)


class Rays(unittest.TestCase):
    def test_a_ray_meets_what_open_cascade_finds_on_its_line(self):
        """Open CASCADE misses some: changes of side tell how many there are."""
        rng = numpy.random.default_rng(32)
        for case in range(20):
            curve = wavy(rng)
            height, slope = rng.uniform(-4.0, 4.0), rng.uniform(-0.2, 0.2)
            hits = curve.ray((0, height), (1, slope), 1e-7, both=True)
            x, y = curve.points(numpy.linspace(*curve.domain, 20001)).T
            changes = numpy.count_nonzero(numpy.diff(y > height + slope * x))
            line = Part.LineSegment(
                Vector(-200, height - 200 * slope), Vector(300, height + 300 * slope)
            )
            peer = splines.curve_to_part(curve.mapped(numpy.eye(3, 4), 3))
            with self.subTest(case=case):
                self.assertEqual(len(hits), changes)
                numpy.testing.assert_allclose(
                    hits[:, 0], hits[:, 4] * math.hypot(1, slope), atol=1e-6
                )
                for point in peer.intersect(line.toBSpline(), 1e-7):
                    apart = numpy.linalg.norm(hits[:, 4:6] - (point.X, point.Y), axis=1)
                    self.assertLess(apart.min(), 1e-5)

    def test_rays_begin_at_their_origin_and_lines_do_not(self):
        tube = cylinder(5.0, 20.0)
        for both, lengths in ((False, [5.0]), (True, [-5.0, 5.0])):
            hits = tube.ray((0, 0, 7), (0, 3, 0), 1e-9, both=both)
            numpy.testing.assert_allclose(hits[:, 0], lengths, atol=1e-9)
            numpy.testing.assert_allclose(hits[:, 5:8], [(0, s, 7) for s in lengths], atol=1e-9)
            numpy.testing.assert_allclose(tube.points(hits[:, 3:5]), hits[:, 5:8], atol=1e-9)
        self.assertEqual(len(tube.ray((0, 0, 21), (1, 0, 0), 1e-9)), 0)

    def test_a_ray_without_direction_is_refused(self):
        with self.assertRaisesRegex(native.ArgumentError, "direction"):
            circle(1.0).ray((0, 0), (0, 0), 1e-6)


class Offsets(unittest.TestCase):
    def test_an_outward_offset_of_a_path_is_that_of_open_cascade(self):
        corners = [(0, 0), (40, 0), (40, 30), (10, 55)]
        curves, _ = polygon(corners).offset(-3.0, 1e-6)
        wire = Part.makePolygon([Vector(*c) for c in corners])
        peer = wire.makeOffset2D(3.0, 0, False, True, False)
        self.assertEqual(len(curves), 1)
        length = sum(curve.length() for curve in curves)
        self.assertAlmostEqual(length, peer.Length, delta=1e-4)

    def test_pieces_tell_where_the_offset_comes_from(self):
        source = polygon([(0, 0), (40, 0), (40, 30)])
        curves, pieces = source.offset(-3.0, 1e-6)
        for index, a, b, s, e in pieces:
            middle, foot = curves[int(index)].points([(a + b) / 2]), source.points([(s + e) / 2])
            self.assertAlmostEqual(numpy.linalg.norm(middle - foot), 3.0, delta=1e-5)
        numpy.testing.assert_allclose(pieces[:, 3:], [(0, 1), (1, 1), (1, 2)], atol=1e-9)

    def test_lines_meet_beyond_corners_when_asked(self):
        curves, _ = polygon([(0, 0), (40, 0), (40, 30)]).offset(-3.0, 1e-6, limit=2.0)
        self.assertAlmostEqual(curves[0].length(), 43.0 + 33.0, delta=1e-6)

    def test_nothing_is_left_inside_a_small_circle(self):
        curves, pieces = circle(2.0).offset(3.0, 1e-6)
        self.assertEqual((curves, pieces.shape), ([], (0, 5)))

    def test_the_offset_of_a_cylinder_is_one(self):
        tube = cylinder(5.0, 20.0)
        outside = math.copysign(
            1.0, tube.curvatures([[0.1, 0.5]])[0][0] @ tube.points([[0.1, 0.5]])[0]
        )
        moved, deviation = tube.offset(2.0 * outside, 1e-6)
        uv = numpy.random.default_rng(33).uniform(0.0, 1.0, (50, 2))
        radii = numpy.linalg.norm(moved.points(uv)[:, :2], axis=1)
        numpy.testing.assert_allclose(radii, 7.0, atol=2e-6)
        self.assertLessEqual(deviation, 1e-6)
        with self.assertRaises(native.ArgumentError):
            tube.offset(-6.0 * outside, 1e-6)


if __name__ == "__main__":
    unittest.main()
