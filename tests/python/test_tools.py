"""Sections, projections, wall offsets, fillets, areas and lengths against Open CASCADE."""

import math
import unittest

import common
import numpy
from common import Part
from freecad.bladesmith import native
from freecad.bladesmith.native import Curve, Surface
from freecad.bladesmith.occ import splines
from test_meets import circle, cylinder, polygon, wavy
from test_splines import area, patches

Vector = common.FreeCAD.Vector
LIFT = numpy.eye(3, 4)


def hills(rng, height=4.0, rational=False):
    """A smooth bicubic surface over the square [0, 40] x [0, 40] with random heights."""
    ends = numpy.cumsum(rng.uniform(0.4, 1.0, (2, 4)), axis=1)
    knots = [numpy.concatenate([[0.0] * 4, e[:3], [e[3]] * 4]) for e in ends]
    x, y = (40.0 * (k[1:-3] + k[2:-2] + k[3:-1]) / (3.0 * k[-1]) for k in knots)
    shape = len(x), len(y)
    poles = numpy.stack([*numpy.meshgrid(x, y, indexing="ij"), rng.uniform(0, height, shape)], -1)
    weights = numpy.exp(rng.uniform(-0.4, 0.4, shape)) if rational else None
    return Surface((3, 3), *knots, poles, weights)


def inside(rng, surface, count):
    return numpy.column_stack([rng.uniform(*domain, count) for domain in surface.domain])


def along(curve, count=60):
    return curve.points(numpy.linspace(*curve.domain, count))


def farthest(points, shape):
    """The largest distance of points from a shape of Open CASCADE."""
    return max(shape.distToShape(Part.Vertex(*p))[0] for p in points)


def edge(curve):
    """A planar curve as an edge of Open CASCADE."""
    return splines.curve_to_part(curve.mapped(LIFT, 3)).toShape()


class Sections(unittest.TestCase):
    def assert_section(self, section, tool, surfaces, peer):
        """The branches hold the edges that Open CASCADE finds, and lie where they say.

        Open CASCADE's edges are off by up to 1e-3, and it misses some at corners.
        """
        self.assertEqual((len(section.uncertain), len(section.overlaps)), (0, 0))
        self.assertGreater(len(section.branches), 0)
        self.assertGreater(len(peer.Edges), 0)
        length = sum(branch.curve.length() for branch in section.branches)
        self.assertGreater(length / sum(e.Length for e in peer.Edges), 1.0 - 1e-4)
        ours = Part.Compound([splines.curve_to_part(b.curve).toShape() for b in section.branches])
        for other in peer.Edges:
            self.assertLess(farthest(map(tuple, other.discretize(15)), ours), 1e-3)
        for branch in section.branches:
            self.assertLessEqual(branch.deviation, 1e-6)
            points = along(branch.curve, 25)
            self.assertLess(farthest(points, tool), 2e-6)
            for on, surface in zip(branch.parameters, surfaces):
                apart = surface.points(along(on, 25)) - points
                self.assertLess(numpy.linalg.norm(apart, axis=1).max(), 2e-6)

    def test_random_surfaces_are_cut_by_planes_where_open_cascade_does(self):
        rng = numpy.random.default_rng(41)
        for case in range(8):
            surface = hills(rng, rational=case % 2 == 1)
            origin = (20.0, 20.0, 2.0)
            normal = rng.normal(0.0, 1.0, 3) * (1.0, 1.0, 0.3 + 4.0 * (case % 3 == 2))
            plane = Part.Plane(Vector(*origin), Vector(*normal))
            tool = plane.toShape(-99, 99, -99, 99)
            face = splines.surface_to_part(surface).toShape()
            with self.subTest(case=case):
                section = surface.section(origin, normal, 1e-6)
                self.assert_section(section, tool, [surface], face.section(tool))
                first, second = section.branches[0].parameters
                where = along(second) @ section.axes[1:] + section.axes[0]
                numpy.testing.assert_allclose(where, surface.points(along(first)), atol=2e-6)

    def test_random_surfaces_meet_each_other_where_open_cascade_says(self):
        rng = numpy.random.default_rng(42)
        for case in range(5):
            first = hills(rng)
            turned = numpy.array([[0, 0, 1, 14 + case], [0, 1, 0, 0], [1, 0, 0, -20]], dtype=float)
            second = hills(rng, rational=case % 2 == 1).mapped(turned)
            faces = [splines.surface_to_part(s).toShape() for s in (first, second)]
            with self.subTest(case=case):
                section = first.intersect(second, 1e-6)
                self.assertIsNone(section.axes)
                self.assert_section(section, faces[1], [first, second], faces[0].section(faces[1]))

    def test_loops_are_closed_and_touches_told(self):
        tube = cylinder(5.0, 20.0)
        cut = tube.section((0, 0, 10), (0, 1, 2), 1e-7)
        ellipse = Part.Ellipse(Vector(), 5.0 * math.hypot(1.0, 0.5), 5.0)
        length = sum(branch.curve.length() for branch in cut.branches)
        self.assertAlmostEqual(length, ellipse.length(0.0, math.tau), delta=1e-5)
        touched = tube.section((0, 5, 0), (0, 1, 0), 1e-7)
        self.assertEqual([branch.touching for branch in touched.branches], [True])
        self.assertAlmostEqual(touched.branches[0].curve.length(), 20.0, delta=1e-6)

    def test_what_cannot_be_cut_is_refused(self):
        with self.assertRaisesRegex(native.ArgumentError, "plane"):
            cylinder(1.0, 1.0).section((0, 0, 0), (0, 0, 0), 1e-6)
        with self.assertRaisesRegex(native.ArgumentError, "tolerance"):
            cylinder(1.0, 1.0).section((0, 0, 0), (0, 0, 1), 1e-17)


class Projections(unittest.TestCase):
    def path(self, rng):
        """A curve over the inside of the square of the hills, 9 mm above."""
        x = numpy.linspace(6.0, 34.0, 6)
        points = numpy.column_stack([x, rng.uniform(12.0, 28.0, 6), numpy.full(6, 9.0)])
        return Curve.interpolate(3, native.parameters(points), points)

    def test_points_nearest_to_a_curve_are_those_of_open_cascade(self):
        rng = numpy.random.default_rng(43)
        for case in range(5):
            surface, curve = hills(rng, height=1.5), self.path(rng)
            peer = splines.surface_to_part(surface)
            with self.subTest(case=case):
                parts = surface.project(curve, 1e-6)
                self.assertEqual(len(parts), 1)
                t = numpy.linspace(*parts[0].curve.domain, 40)
                above, found = curve.points(t), parts[0].curve.points(t)
                on_surface = surface.points(parts[0].parameters.points(t))
                numpy.testing.assert_allclose(on_surface, found, atol=2e-6)
                for p, q in zip(above, found):
                    nearest = peer.projectPoint(Vector(*p), "NearestPoint")
                    numpy.testing.assert_allclose(q, tuple(nearest), atol=1e-5)

    def test_shadows_along_a_direction_are_those_of_open_cascade(self):
        rng = numpy.random.default_rng(44)
        for case in range(5):
            surface, curve = hills(rng), self.path(rng)
            direction = (0.2, -0.1, -1.0)
            face = splines.surface_to_part(surface).toShape()
            line = splines.curve_to_part(curve).toShape()
            peer = face.makeParallelProjection(line, Vector(*direction))
            with self.subTest(case=case):
                parts = surface.project(curve, 1e-6, direction=direction)
                length = sum(part.curve.length() for part in parts)
                expected = sum(e.Length for e in peer.Edges)
                self.assertAlmostEqual(length / expected, 1.0, delta=1e-5)
                for part in parts:
                    self.assertLess(farthest(along(part.curve, 20), peer), 1e-4)
                    uv = along(part.parameters, 20)
                    numpy.testing.assert_allclose(
                        surface.points(uv), along(part.curve, 20), atol=2e-6
                    )


class Walls(unittest.TestCase):
    def test_offsets_are_those_of_open_cascade_at_every_parameter(self):
        rng = numpy.random.default_rng(45)
        for case, distance in enumerate((0.5, -0.8, 2.0)):
            x, y = numpy.meshgrid(*[numpy.linspace(0, 40, 6)] * 2, indexing="ij")
            heights = rng.uniform(0.0, 2.0, x.shape)
            knots = [0, 0, 0, 0, 1, 2, 3, 3, 3, 3]
            surface = Surface((3, 3), knots, knots, numpy.stack([x, y, heights], -1))
            peer = Part.OffsetSurface(splines.surface_to_part(surface), distance)
            with self.subTest(case=case):
                wall, deviation = surface.offset(distance, 1e-5)
                self.assertLessEqual(deviation, 1e-5)
                uv = inside(rng, surface, 200)
                expected = [tuple(peer.value(*at)) for at in uv]
                numpy.testing.assert_allclose(wall.points(uv), expected, atol=2e-5)
                # Open CASCADE integrates areas with few points: patch by patch it is good.
                pieces = [splines.surface_to_part(piece) for piece in patches(surface)]
                total = sum(Part.OffsetSurface(p, distance).toShape().Area for p in pieces)
                self.assertAlmostEqual(area(wall, 10) / total, 1.0, delta=1e-5)


class Rounded(unittest.TestCase):
    def assert_tangent(self, curve, other, fillet):
        """The arc starts and ends on both curves in the direction in which they run there."""
        ends = along(fillet.arc, 2)
        jets = fillet.arc.evaluate([0.0, 1.0], 1)[:, 1]
        for c, t, point, tangent in zip((curve, other), fillet.parameters, ends, jets):
            at, speed = c.evaluate([t], 1)[0]
            numpy.testing.assert_allclose(point, at, atol=1e-7)
            sine = numpy.cross(speed, tangent) / numpy.linalg.norm(speed)
            self.assertLess(abs(sine / numpy.linalg.norm(tangent)), 1e-6)

    def test_random_corners_get_the_arc_of_open_cascade(self):
        rng = numpy.random.default_rng(46)
        compared = 0
        for case in range(12):
            first = wavy(rng, 5)
            turn = rng.uniform(0.6, 2.2)
            c, s = math.cos(turn), math.sin(turn)
            start = first.points(first.domain[1])[0]
            second = wavy(rng, 5)
            begin = second.points(0.0)[0]
            x, y = start - numpy.array([[c, -s], [s, c]]) @ begin
            second = second.mapped([[c, -s, 0, x], [s, c, 0, y], [0, 0, 1, 0]])
            found = first.fillet(second, 3.0, 1e-7)
            peer = Part.ChFi2d.FilletAlgo(edge(first), edge(second), Part.Plane())
            if found is None or not peer.perform(3.0):
                continue
            arc = peer.result(Vector(*start, 0.0))[0]
            with self.subTest(case=case):
                compared += 1
                self.assert_tangent(first, second, found)
                centre = arc.Curve.Center
                numpy.testing.assert_allclose(found.centre, (centre.x, centre.y), atol=1e-4)
                self.assertAlmostEqual(found.arc.length(), arc.Length, delta=1e-3)
        self.assertGreater(compared, 5, "hardly a corner could be compared")

    def test_every_choice_of_sides_touches_and_none_cuts(self):
        rng = numpy.random.default_rng(47)
        sides = set()
        for case in range(10):
            first = wavy(rng)
            second = wavy(rng).mapped([[0, 1, 0, 40], [1, 0, 0, -40], [0, 0, 1, 0]])
            for fillet in first.fillets(second, 2.0, 1e-7):
                sides.add(tuple(fillet.sides))
                self.assert_tangent(first, second, fillet)
                for curve in (first, second):
                    _, _, distance = curve.nearest([fillet.centre])
                    self.assertAlmostEqual(distance[0], 2.0, delta=1e-6, msg=f"case {case}")
        self.assertEqual(sides, {(a, b) for a in (1, -1) for b in (1, -1)})

    def test_what_is_left_of_a_corner_goes_on_into_the_arc(self):
        first, second = polygon([(0, 0), (30, 0)]), polygon([(30, 0), (30, 20)])
        fillet = first.fillet(second, 4.0, 1e-9)
        path = fillet.first.joined(fillet.arc, 1e-9).joined(fillet.second, 1e-9)
        self.assertAlmostEqual(path.length(), 26 + 2 * math.pi + 16, places=8)
        self.assertIsNone(first.fillet(second, 40.0, 1e-9))
        near = first.fillet(second, 4.0, 1e-9, near=(0, 0))
        numpy.testing.assert_allclose(near.centre, fillet.centre)
        with self.assertRaisesRegex(native.ArgumentError, "an end of one must meet"):
            first.fillet(circle(1.0, (90.0, 0.0)), 4.0, 1e-9)


class Lengths(unittest.TestCase):
    def test_lengths_of_offsets_and_isocurves_are_those_of_open_cascade(self):
        rng = numpy.random.default_rng(48)
        for case in range(5):
            curve = wavy(rng)
            raw, _ = curve.offset_raw(0.4, 1e-7)
            with self.subTest(case=case):
                # Open CASCADE's offset in space lies to the right, seen against its direction.
                peer = Part.OffsetCurve(edge(curve).Curve, -0.4, Vector(0, 0, 1))
                expected = peer.length(*curve.domain)
                self.assertAlmostEqual(sum(c.length() for c in raw) / expected, 1.0, delta=1e-5)
            surface = hills(rng, rational=True)
            (a, b), _ = surface.domain
            line = surface.isocurve("u", 0.3 * a + 0.7 * b)
            expected = splines.surface_to_part(surface).uIso(0.3 * a + 0.7 * b)
            length = expected.length(expected.FirstParameter, expected.LastParameter)
            self.assertAlmostEqual(line.length() / length, 1.0, delta=1e-6)


class Batches(unittest.TestCase):
    def test_first_hits_are_the_first_rows_of_rays(self):
        rng = numpy.random.default_rng(49)
        surface, curve = hills(rng), wavy(rng)
        for spline, width, count in ((surface, 3, 2), (curve, 2, 1)):
            origins = rng.uniform(0.0, 40.0, (60, width)) + [*[0.0] * (width - 1), 10.0]
            directions = rng.normal(0.0, 1.0, (60, width))
            lengths, at, points = spline.first_hits(origins, directions, 1e-7)
            missed = 0
            for k in range(60):
                rows = spline.ray(origins[k], directions[k], 1e-7)
                if len(rows) == 0:
                    missed += 1
                    self.assertTrue(numpy.isnan([lengths[k], *points[k]]).all())
                    continue
                self.assertAlmostEqual(lengths[k], rows[0, 0], delta=1e-9)
                numpy.testing.assert_allclose(at[k], rows[0, 3 : 3 + count].squeeze(), atol=1e-9)
            self.assertTrue(0 < missed < 60)

    def test_grids_patches_and_domains_hold_the_surface(self):
        rng = numpy.random.default_rng(50)
        surface = hills(rng, rational=True)
        (a, b), (c, d) = surface.domain
        u, v = numpy.linspace(a, b, 7), numpy.linspace(c, d, 5)
        uv = numpy.stack(numpy.meshgrid(u, v, indexing="ij"), -1).reshape(-1, 2)
        grid = surface.evaluate_grid(u, v, 2)
        numpy.testing.assert_allclose(grid.reshape(-1, 6, 3), surface.evaluate(uv, 2), atol=1e-10)
        wide = surface.over("v", 10.0, 20.0)
        scaled = numpy.column_stack([uv[:, 0], 10.0 + 10.0 * (uv[:, 1] - c) / (d - c)])
        numpy.testing.assert_allclose(wide.points(scaled), surface.points(uv), atol=1e-11)
        pieces = surface.bezier_patches()
        self.assertEqual(len(pieces), len(list(patches(surface))))
        for piece in pieces:
            at = inside(rng, piece, 5)
            numpy.testing.assert_allclose(piece.points(at), surface.points(at), atol=1e-11)

    def test_closed_curves_are_periodic_for_open_cascade(self):
        rng = numpy.random.default_rng(51)
        breaks = numpy.cumsum(rng.uniform(0.5, 1.0, 8))
        poles, weights = rng.normal(0.0, 10.0, (7, 3)), numpy.exp(rng.uniform(-1.0, 1.0, 7))
        curve = Curve.periodic(3, breaks, poles, weights)
        a, b = curve.domain
        start, end = curve.evaluate(a, 2)[0], curve.evaluate(b, 2)[0]
        numpy.testing.assert_allclose(start, end, atol=1e-10)
        peer = splines.curve_to_part(curve)
        for t in rng.uniform(a, b, 20):
            numpy.testing.assert_allclose(curve.points(t)[0], tuple(peer.value(t)), atol=1e-11)

    def test_parameters_are_mapped_to_what_an_offset_keeps(self):
        source = polygon([(0, 0), (10, 0), (10, 10)])
        _, pieces = source.offset(2.0, 1e-6)
        found = source.offset_map(pieces, [0.0, 0.5, 1.0 - 1e-9, 1.0, 2.0])
        numpy.testing.assert_allclose(found, [0.0, 0.4, 0.8, 1.2, 2.0], atol=1e-6)

    def test_averaged_knots_are_those_of_the_interpolation(self):
        t = [0.0, 0.2, 0.5, 0.6, 1.0]
        points = numpy.random.default_rng(52).normal(0.0, 1.0, (5, 2))
        knots = native.averaged_knots(3, t)
        numpy.testing.assert_array_equal(knots, Curve.interpolate(3, t, points).knots)


if __name__ == "__main__":
    unittest.main()
