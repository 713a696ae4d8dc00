"""The figures that real parts must reach, through the command line.

The compressor blade ships with the project; the larger cases come from ``BLADESMITH_DATA``.
"""

import unittest
from pathlib import Path

import common
from common import FreeCAD, mean, morph
from freecad.bladesmith.occ import step

FACTOR = ("--factor", "-1")
TANGENT_DEG = 0.1
DEFAULT_TOLERANCE_MM = 1e-3


class Case(unittest.TestCase):
    """A part, morphed from hot to cold."""

    gap_mm = 5e-5
    """How much wider an edge's gap may become."""

    def assert_kept(self, done, hot_path: Path):
        """The same solid in the report, for Open CASCADE, and in the file."""
        missed = done.report["deviation_mm"]["max"] > DEFAULT_TOLERANCE_MM
        self.assertEqual(done.code, 3 if missed else 0, done.stderr)
        solid = done.report["solid"]
        self.assertEqual((solid["valid"], solid["closed"], solid["folded"]), (True, True, 0))
        hot, cold = step.read(str(hot_path)).shape, done.solid
        self.assertEqual(len(cold.Faces), len(hot.Faces))
        self.assertEqual(len(cold.Edges), len(hot.Edges))
        self.assertTrue(cold.isValid() and cold.isClosed())
        largest = 2 * max(abs(x) for x in self.size_of_movement(done))
        for index, (a, b) in enumerate(zip(hot.Faces, cold.Faces), 1):
            distance = a.CenterOfMass.distanceToPoint(b.CenterOfMass)
            self.assertLess(distance, largest, f"Face{index} is another one")

    def size_of_movement(self, done):
        before, after = (done.report["solid"]["centroid_mm"][k] for k in ("before", "after"))
        return [3.0, *(b - a for a, b in zip(before, after))]

    def assert_joints(self, done):
        for edge in done.report["edges"]:
            gap, angle = edge["gap_mm"], edge["angle_deg"]
            name = f"Edge{edge['index']} of faces {edge['faces']}"
            self.assertLessEqual(gap["after"], gap["before"] + self.gap_mm, name)
            if edge["tangent"] and not edge["held"]:
                self.assertLessEqual(angle["after"], angle["before"] + TANGENT_DEG, name)
            if edge["tangent"] and angle["after"] > angle["before"] + TANGENT_DEG:
                beside = "|".join(f"Face{face}" for face in edge["faces"])
                self.assertRegex(done.warnings, rf"holds.*\b({beside})\b", f"{name} is not named")

    def assert_few_poles(self, done, faces):
        """The faces of the aerofoil, coarse before, have at most one pole for three nodes."""
        for index in faces:
            face = done.report["faces"][index - 1]
            poles = face["poles"][0] * face["poles"][1]
            self.assertLessEqual(3 * poles, face["nodes"], f"Face{index}: {poles} poles")

    def assert_probes(self, done, hot_path: Path, probes_path: Path, limit_mm: float):
        hot = step.read(str(hot_path)).shape
        errors = common.probe_errors(hot, done.solid, common.probes(probes_path), -1.0)
        self.assertLessEqual(mean(errors), limit_mm)


class CompressorBlade(Case):
    PART = common.EXAMPLE / "hot.step.gz"
    AEROFOIL = (1, 2, 5, 6)

    def morphed(self):
        field, mesh = common.EXAMPLE / "blade.frd.gz", common.EXAMPLE / "blade.inp.gz"
        return morph(self.PART, field, "--mesh", str(mesh), *FACTOR, "--holdout")

    def test_the_solid_is_kept(self):
        self.assert_kept(self.morphed(), self.PART)

    def test_no_edge_opens(self):
        self.assert_joints(self.morphed())

    def test_the_nodes_are_met(self):
        """Apart from faces that are held: there the field jumps, and the joint is kept instead."""
        report = self.morphed().report
        self.assertLessEqual(report["deviation_mm"]["mean"], 1e-5)
        for face in report["faces"]:
            if not face["held"]:
                self.assertLessEqual(face["deviation_mm"]["max"], 3e-4, face["name"])

    def test_nodes_that_were_not_used_are_met(self):
        report = self.morphed().report
        self.assertLessEqual(report["holdout_mm"]["mean"], 2e-5)
        self.assertLessEqual(report["holdout_mm"]["max"], 1e-3)

    def assert_holdout(self, index):
        face = self.morphed().report["faces"][index - 1]
        self.assertLessEqual(face["holdout_mm"]["max"], 5e-5, face["name"])

    def test_nodes_of_the_aerofoil_that_were_not_used_are_met(self):
        for index in set(self.AEROFOIL) - {5}:
            self.assert_holdout(index)

    # Known miss: 5.3e-5 mm at one node on the fillet's edge, which lies 3.5e-5 mm off a polynomial
    # through its neighbours on that edge. Fails as soon as the limit is met.
    @unittest.expectedFailure
    def test_nodes_of_face_5_that_were_not_used_are_met(self):
        self.assert_holdout(5)

    def test_the_probes_are_reproduced(self):
        self.assert_probes(self.morphed(), self.PART, common.EXAMPLE / "probes.csv.gz", 2e-5)

    def test_the_aerofoil_has_at_most_four_times_its_poles(self):
        hot = step.read(str(self.PART)).shape
        for index in self.AEROFOIL:
            face = self.morphed().report["faces"][index - 1]
            surface = hot.Faces[index - 1].Surface
            before = surface.NbUPoles * surface.NbVPoles
            after = face["poles"][0] * face["poles"][1]
            self.assertLessEqual(after, 4 * before, face["name"])


class SharedCase(Case):
    """A case of the shared data, or a skip that says why."""

    case = field = ""

    def setUp(self):
        folder = common.shared_data(self.case)
        self.part, self.probes = folder / "hot.step", folder / "probes.csv"
        mesh = str(folder / f"{self.field}.inp.gz")
        self.done = morph(self.part, folder / f"{self.field}.frd.gz", "--mesh", mesh, *FACTOR)


class TurbineBlade(SharedCase):
    case = field = "P2"
    gap_mm = 3e-4

    def test_it_is_the_same_solid_with_closed_joints_and_few_poles(self):
        self.assert_kept(self.done, self.part)
        self.assert_joints(self.done)
        self.assert_few_poles(self.done, (1, 2, 5, 6))


class CooledVane(SharedCase):
    case = field = "P3"
    gap_mm = 3e-4

    def test_it_is_the_same_solid_with_closed_joints_and_few_poles(self):
        self.assert_kept(self.done, self.part)
        self.assert_joints(self.done)
        self.assert_few_poles(self.done, (12, 13, 14, 15))


class HeatedDisc(SharedCase):
    """Free uniform heating: the exact answer is a scaling about a point."""

    case = field = "P4"
    STRAIN = 0.008468
    CENTRE = (-18.0, 0.0, 58.0)

    def test_it_is_the_same_solid_with_closed_joints(self):
        self.assert_kept(self.done, self.part)
        self.assert_joints(self.done)

    def test_every_point_is_scaled_exactly_with_nodes_or_without(self):
        centre = FreeCAD.Vector(*self.CENTRE)
        hot = step.read(str(self.part)).shape
        for index, (a, b) in enumerate(zip(hot.Faces, self.done.solid.Faces), 1):
            low_u, high_u, low_v, high_v = a.ParameterRange
            for i in range(11):
                for j in range(11):
                    u = low_u + (high_u - low_u) * i / 10
                    v = low_v + (high_v - low_v) * j / 10
                    point = a.Surface.value(u, v)
                    exact = point - (point - centre) * self.STRAIN
                    distance = exact.distanceToPoint(b.Surface.value(u, v))
                    self.assertLessEqual(distance, 2e-6, f"Face{index} at ({u}, {v})")

    def test_the_volume_is_scaled(self):
        volume = self.done.report["solid"]["volume_mm3"]
        ratio = volume["after"] / volume["before"]
        self.assertLessEqual(abs(ratio / (1 - self.STRAIN) ** 3 - 1), 1e-7)


class SpinningDisc(SharedCase):
    case, field = "P4", "P4b"

    def test_it_is_the_same_solid_with_closed_joints(self):
        self.assert_kept(self.done, self.part)
        self.assert_joints(self.done)


if __name__ == "__main__":
    unittest.main()
