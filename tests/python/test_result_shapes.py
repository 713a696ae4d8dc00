"""A result made ready to be shown: exact movement on faces and edges, normals, the worst node."""

import unittest

import common
import numpy
from common import FreeCAD, Part
from freecad.bladesmith.colours.refinement import refined
from freecad.bladesmith.colours.result import prepare
from freecad.bladesmith.features import morph, shown
from freecad.bladesmith.native import InputError
from freecad.bladesmith.occ import step
from freecad.bladesmith.occ.tessellation import tessellate

NO_NODES = {
    "ids": numpy.empty(0, dtype=int),
    "faces": numpy.empty(0, dtype=int),
    "feet": numpy.empty((0, 3)),
    "displacements": numpy.empty((0, 3)),
    "deviations": numpy.empty((0, 3)),
}


def finished(steps):
    """What a generator returns."""
    while True:
        try:
            next(steps)
        except StopIteration as stop:
            return stop.value


def areas(mesh):
    """Area vectors (m, 3) of triangles."""
    a, b, c = (mesh.points[mesh.triangles[:, k]] for k in range(3))
    return numpy.cross(b - a, c - a) / 2


def border(mesh) -> float:
    """Length of all sides that only one triangle has: those of the faces, and of cracks."""
    places, number = numpy.unique(mesh.points.round(9), axis=0, return_inverse=True)
    number = number.reshape(-1) + len(places) * mesh.faces
    ends = number[mesh.triangles[:, ((0, 1), (1, 2), (2, 0))].reshape(-1, 2)]
    pairs, uses = numpy.unique(numpy.sort(ends, axis=1), axis=0, return_counts=True)
    ends = places[pairs[uses == 1] % len(places)]
    return numpy.linalg.norm(ends[:, 0] - ends[:, 1], axis=1).sum()


def solids():
    """One solid of each kind of face, one with a hole, so with faces turned inside out."""
    box = Part.makeBox(8, 5, 3).cut(Part.makeCylinder(1, 3, FreeCAD.Vector(4, 2.5, 0)))
    return {
        "box with a hole": box,
        "sphere": Part.makeSphere(3),
        "torus": Part.makeTorus(5, 1),
        "cone": Part.makeCone(3, 0, 4),
    }


class Movement(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.motion = FreeCAD.Matrix()
        cls.motion.rotateZ(0.3)
        cls.motion.move(FreeCAD.Vector(1, 2, 3))
        cls.shown = {
            name: finished(prepare(solid, solid.transformed(cls.motion), NO_NODES))
            for name, solid in solids().items()
        }

    def moved(self, points):
        rows = numpy.array(self.motion.A).reshape(4, 4)
        return points @ rows[:3, :3].T + rows[:3, 3]

    def test_points_move_as_their_faces_do_on_both_sides_of_seams(self):
        for name, result in self.shown.items():
            before, _ = result.positions(0)
            after, _ = result.positions(1)
            off = numpy.linalg.norm(after - self.moved(before), axis=1)
            self.assertLess(off.max(), 1e-9, name)

    def test_a_factor_multiplies_the_movement(self):
        result = self.shown["cone"]
        (zero, _), (one, _), (ten, _) = (result.positions(factor) for factor in (0, 1, 10))
        numpy.testing.assert_allclose(ten - zero, 10 * (one - zero), atol=1e-9)

    def test_normals_are_unit_and_point_out_of_the_material(self):
        for name, solid in solids().items():
            result = self.shown[name]
            points, normals = result.positions(0)
            numpy.testing.assert_allclose(numpy.linalg.norm(normals, axis=1), 1, atol=1e-9)
            chosen = result.mesh.triangles[:: max(1, len(result.mesh.triangles) // 60)]
            for triangle in chosen:
                centre = points[triangle].mean(axis=0) + 0.1 * normals[triangle].mean(axis=0)
                inside = solid.isInside(FreeCAD.Vector(*centre), 1e-7, False)
                self.assertFalse(inside, f"{name} at {centre}")

    def test_edges_move_as_a_whole_and_keep_their_order(self):
        for name, solid in solids().items():
            result = self.shown[name]
            self.assertEqual(len(result.edges), len(solid.Edges), name)
            for k, edge in enumerate(solid.Edges, 1):
                line = result.edge(k, 0)
                numpy.testing.assert_allclose(result.edge(k, 1), self.moved(line), atol=1e-9)
                for point in line[:: max(1, len(line) // 3)]:
                    away = edge.distToShape(Part.Vertex(*point))[0]
                    self.assertLess(away, 1e-6, f"{name}, Edge{k}")

    def test_triangles_are_short_and_cover_the_same_without_cracks(self):
        for name, solid in solids().items():
            size = solid.BoundBox.DiagonalLength
            coarse = tessellate(solid)
            fine = refined(coarse, size / 50)
            corners = fine.points[fine.triangles]
            sides = numpy.linalg.norm(corners - numpy.roll(corners, 1, axis=1), axis=2)
            self.assertLess(sides.max(), 2 * size / 50, name)
            # No side is longer than the part, so none has more than 64 pieces.
            self.assertLess(len(fine.triangles), 2 * 64 * len(coarse.triangles), name)
            before, after = areas(coarse), areas(fine)
            numpy.testing.assert_allclose(after.sum(axis=0), before.sum(axis=0), atol=1e-9)
            lengths = [numpy.linalg.norm(a, axis=1).sum() for a in (before, after)]
            self.assertAlmostEqual(*lengths, delta=1e-9, msg=name)
            self.assertAlmostEqual(border(fine), border(coarse), delta=1e-9, msg=name)

    def test_faces_without_nodes_have_no_deviation_and_no_worst_spot(self):
        result = self.shown["box with a hole"]
        self.assertTrue(numpy.isnan(result.values("deviation")).all())
        self.assertIsNone(result.worst("deviation"))
        self.assertGreater(result.values("displacement").min(), 3)


class ComputedMorph(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.document = FreeCAD.newDocument("shown")
        source = cls.document.addObject("Part::Feature", "Source")
        source.Shape = step.read(str(common.packed("base.step"))).shape
        cls.morph = morph.create(cls.document, source)
        cls.morph.FieldFile = str(common.packed("base.frd"))
        cls.document.recompute()
        cls.result = finished(prepare(*shown.solids(cls.morph), shown.nodes(cls.morph)))

    @classmethod
    def tearDownClass(cls):
        FreeCAD.closeDocument(cls.document.Name)

    def test_it_has_a_result_and_its_source_has_none(self):
        self.assertTrue(self.morph.isValid(), self.morph.getStatusString())
        self.assertTrue(shown.has_result(self.morph))
        self.assertFalse(shown.has_result(self.morph.Source))
        self.assertTrue(shown.is_current(self.morph))

    def test_the_worst_node_is_the_report_s(self):
        report = shown.report(self.morph)
        spot = self.result.worst("deviation")
        self.assertAlmostEqual(spot.value, report.deviation_mm.max, delta=1e-12)
        self.assertEqual(spot.face, report.worst_face().index)

    def test_scales_reach_the_worst_node(self):
        for name in ("displacement", "displacement_z", "deviation"):
            logarithmic = name == "deviation"
            scale = self.result.automatic_scale(name, logarithmic=logarithmic)
            self.assertGreaterEqual(scale.high, abs(self.result.worst(name).value), name)

    def test_shown_displacement_is_the_nodes_own(self):
        nodes, mesh = self.result.nodes, self.result.mesh
        largest = numpy.linalg.norm(nodes["displacements"], axis=1).max()
        seen = self.result.values("displacement").max()
        self.assertAlmostEqual(seen, largest, delta=0.02 * largest)
        self.assertEqual(set(mesh.faces), set(range(1, len(self.morph.Shape.Faces) + 1)))

    def test_edges_of_the_report_are_those_of_the_shape(self):
        shape = self.morph.Shape
        for edge in shown.report(self.morph).edges:
            joined = {
                index
                for index, face in enumerate(shape.Faces, 1)
                if any(other.isSame(shape.Edges[edge.index - 1]) for other in face.Edges)
            }
            self.assertEqual(set(edge.faces), joined, f"Edge{edge.index}")

    def test_another_source_is_refused_with_what_to_do(self):
        kept = self.morph.Source
        other = self.document.addObject("Part::Feature", "Other")
        other.Shape = Part.makeBox(1, 1, 1).cut(Part.makeSphere(0.5))
        try:
            self.morph.Source = other
            self.assertFalse(shown.is_current(self.morph))
            with self.assertRaisesRegex(InputError, "not the solid it was computed from"):
                shown.solids(self.morph)
        finally:
            self.morph.Source = kept
            self.document.recompute()


if __name__ == "__main__":
    unittest.main()
