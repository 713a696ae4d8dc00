"""Broken and awkward inputs through the command line: each refused, warned of, or simply right."""

import re
import unittest

import common
from common import awkward, mean, morph, packed
from freecad.bladesmith.occ import step

BASE, FRD = packed("base.step"), packed("base.frd")
MESH = ("--mesh", str(packed("base.inp")))
REFUSED = 2


class Awkward(unittest.TestCase):
    def assert_refused(self, done, *patterns):
        """Exit code 2, one line that matches every pattern, nothing written."""
        self.assertEqual(done.code, REFUSED, done.stderr)
        self.assertEqual(len(done.stderr.strip().splitlines()), 1, done.stderr)
        for pattern in patterns:
            self.assertRegex(done.stderr, pattern)
        self.assertEqual(list(done.output.parent.iterdir()), [])

    def assert_morphed(self, done, faces=6):
        """Success, a valid closed solid with its faces, in the file too."""
        self.assertEqual(done.code, 0, done.stderr)
        self.assertEqual(done.report["solid"]["faces"], faces)
        self.assertIs(done.report["solid"]["valid"], True)
        self.assertIs(done.report["solid"]["closed"], True)
        self.assertEqual(done.report["solid"]["folded"], 0)
        self.assertEqual(len(done.solid.Faces), faces)
        self.assertTrue(done.solid.isValid() and done.solid.isClosed())

    def assert_same_surface(self, first, second, tolerance_mm):
        """Equal parameters give equal points on every face, within its borders."""
        for index, (a, b) in enumerate(zip(first.solid.Faces, second.solid.Faces), 1):
            inside = 0
            for u, v in parameters(a, 9):
                if a.isPartOfDomain(u, v):
                    inside += 1
                    distance = a.Surface.value(u, v).distanceToPoint(b.Surface.value(u, v))
                    self.assertLess(distance, tolerance_mm, f"Face{index} at ({u}, {v})")
            self.assertGreater(inside, 9, f"Face{index} has no samples")

    def assert_reproduced(self, errors):
        """Closely on the whole, and everywhere within the default tolerance."""
        self.assertLess(mean(errors), 2e-5)
        self.assertLess(max(errors), 1e-3)

    def probe_errors(self, done, part, truth, factor=1.0):
        hot = step.read(str(part)).shape
        rows = common.probes(packed(f"truth/{truth}.csv"))
        return common.probe_errors(hot, done.solid, rows, factor)


def parameters(face, count):
    """A grid of parameters over a face's range."""
    low_u, high_u, low_v, high_v = face.ParameterRange
    for i in range(count):
        for j in range(count):
            yield (
                low_u + (high_u - low_u) * (i + 0.5) / count,
                low_v + (high_v - low_v) * (j + 0.5) / count,
            )


class Good(Awkward):
    def test_the_good_case_reproduces_the_probes(self):
        done = morph(BASE, FRD, *MESH)
        self.assert_morphed(done)
        errors = self.probe_errors(done, BASE, "base")
        self.assert_reproduced(errors)

    def test_taking_the_field_away_reproduces_the_probes_and_warns_of_the_first_order(self):
        done = morph(BASE, FRD, *MESH, "--factor", "-1")
        self.assert_morphed(done)
        errors = self.probe_errors(done, BASE, "base", -1.0)
        self.assert_reproduced(errors)
        self.assertRegex(done.warnings, r"first-order estimate.*\d")

    def test_poles_and_seams_survive(self):
        part = packed("sphere.step")
        done = morph(part, packed("sphere.frd"), "--mesh", str(packed("sphere.inp")))
        self.assert_morphed(done, faces=4)
        errors = self.probe_errors(done, part, "sphere")
        self.assert_reproduced(errors)

    def test_fewer_nodes_than_poles_give_no_wiggles_and_a_warning(self):
        done = morph(BASE, packed("coarse.frd"), "--mesh", str(packed("coarse.inp")))
        self.assert_morphed(done)
        empty, spans = map(
            int, re.search(r"empty knot spans: (\d+) of (\d+)", done.warnings).groups()
        )
        self.assertTrue(0 < empty < spans)
        self.assertLess(max(self.probe_errors(done, BASE, "coarse")), 3e-3)

    def test_windows_line_ends_change_nothing(self):
        done, base = morph(BASE, awkward("crlf")), morph(BASE, FRD)
        self.assert_morphed(done)
        self.assertEqual(done.output.read_bytes(), base.output.read_bytes())

    def test_shuffled_numbers_with_gaps_change_nothing(self):
        done = morph(BASE, awkward("gaps_shuffled"))
        self.assert_morphed(done)
        self.assert_same_surface(done, morph(BASE, FRD), 2e-5)


class Steps(Awkward):
    def test_the_last_of_two_steps_is_taken_and_said(self):
        done = morph(BASE, awkward("two_steps"))
        self.assert_morphed(done)
        self.assertEqual(done.report["input"]["step"], 2)
        self.assertRegex(done.warnings + done.stdout, "step 2")
        self.assert_same_surface(done, morph(BASE, FRD), 1e-9)

    def test_the_first_step_is_half_of_the_second(self):
        done = morph(BASE, awkward("two_steps"), "--step", "1")
        self.assert_morphed(done)
        self.assertEqual(done.report["input"]["step"], 1)
        self.assert_same_surface(done, morph(BASE, FRD, "--factor", "0.5"), 2e-6)

    def test_a_step_that_is_not_there_is_refused(self):
        done = morph(BASE, awkward("two_steps"), "--step", "3")
        self.assert_refused(done, "two_steps.frd", r"\b3\b", r"\b2\b")


class Coverage(Awkward):
    def test_a_part_of_the_nodes_is_refused_unless_extrapolation_is_asked_for(self):
        for name in ("partial_face", "partial_disp"):
            done = morph(BASE, awkward(name))
            self.assert_refused(done, "--extrapolate", r"Face\d|face \d")
            asked = morph(BASE, awkward(name), "--extrapolate")
            self.assertIn(asked.code, (0, 3), asked.stderr)
            self.assertRegex(asked.warnings, r"Face\d|face \d")
            self.assertTrue(asked.solid.isValid())

    def test_nodes_without_a_result_are_counted(self):
        done = morph(BASE, awkward("partial_disp"), "--extrapolate")
        self.assertRegex(done.warnings, r"\d+ of 2425 nodes")


class Results(Awkward):
    def test_a_file_without_displacements_lists_its_blocks(self):
        done = morph(BASE, awkward("no_disp"))
        self.assert_refused(done, "no_disp.frd", "displacement", "nodes", "elements")

    def test_a_cut_off_file_says_how_much_was_read(self):
        done = morph(BASE, awkward("truncated"))
        self.assert_refused(done, "truncated.frd", r"\d+ of 2425")

    def test_files_of_another_kind_are_refused(self):
        self.assert_refused(morph(BASE, awkward("empty")), "empty.frd", "empty")
        self.assert_refused(morph(BASE, awkward("not_frd")), "not_frd.frd", "results")

    def test_nodes_that_are_not_numbers_are_named_and_never_get_out(self):
        done = morph(BASE, awkward("nan"))
        if done.code == REFUSED:
            self.assert_refused(done, "nan.frd", r"\b7\b.*\b418\b")
        else:
            self.assert_morphed(done)
            self.assertRegex(done.warnings, r"\b7\b.*\b418\b")
        self.assertNotIn("nan", str(done.report).lower())

    def test_two_results_for_a_node_are_named(self):
        done = morph(BASE, awkward("duplicate_nodes"))
        said = done.stderr if done.code == REFUSED else done.warnings
        self.assertRegex(said, r"\b3\b.*\b50\b.*\b300\b")
        if done.code != REFUSED:
            self.assertIn(done.code, (0, 3), done.stderr)


class Units(Awkward):
    def test_metres_are_found_and_the_option_is_named(self):
        self.assert_refused(morph(BASE, awkward("metres")), "--field-unit m", "1000|metre")

    def test_metres_that_are_told_give_the_same_result(self):
        done = morph(BASE, awkward("metres"), "--field-unit", "m")
        self.assert_morphed(done)
        self.assert_same_surface(done, morph(BASE, FRD), 5e-5)

    def test_displacements_in_another_unit_are_suspected_and_can_be_scaled(self):
        done = morph(BASE, awkward("disp_metres_only"))
        self.assert_morphed(done)
        self.assertIn("--displacement-scale 1000", done.warnings)
        scaled = morph(BASE, awkward("disp_metres_only"), "--displacement-scale", "1000")
        self.assert_morphed(scaled)
        self.assert_same_surface(scaled, morph(BASE, FRD), 2e-6)

    def test_displacements_larger_than_the_part_are_refused(self):
        done = morph(BASE, awkward("huge_disp"))
        self.assert_refused(done, "larger than the (part|model)|folded")

    def test_zero_displacements_change_nothing_and_are_told(self):
        done = morph(BASE, awkward("zero_disp"))
        self.assert_morphed(done)
        self.assertRegex(done.warnings, "all displacements are zero")
        hot = step.read(str(BASE)).shape
        for a, b in zip(hot.Faces, done.solid.Faces):
            u, v = a.ParameterRange[0::2]
            self.assertLess(a.Surface.value(u, v).distanceToPoint(b.Surface.value(u, v)), 1e-7)


class Place(Awkward):
    def test_a_mirrored_model_is_refused_with_its_distance(self):
        done = morph(BASE, awkward("mirrored"))
        self.assert_refused(done, "does not lie on the geometry", r"\d+(\.\d+)? ?mm")

    def test_a_model_in_another_frame_is_refused_with_its_distance(self):
        done = morph(BASE, awkward("other_frame"))
        self.assert_refused(done, "does not lie on the geometry", r"\d+(\.\d+)? ?mm")


class Solids(Awkward):
    def test_the_covered_one_of_two_solids_is_morphed_and_said(self):
        part = packed("two_solids.step")
        done = morph(part, FRD)
        self.assert_morphed(done)
        self.assertRegex(done.warnings, "only solid 1 is morphed")
        self.assertEqual(len(done.solid.Solids), 1)
        self.assert_same_surface(done, morph(BASE, FRD), 1e-6)
        chosen = morph(part, FRD, "--solid", "1")
        self.assert_morphed(chosen)
        self.assert_same_surface(done, chosen, 1e-9)

    def test_a_solid_without_nodes_is_refused(self):
        done = morph(packed("two_solids.step"), FRD, "--solid", "2")
        self.assert_refused(done, "does not lie on the geometry|no node")

    def test_faces_without_a_solid_are_refused(self):
        self.assert_refused(morph(packed("faces_only.step"), FRD), "no solid")


if __name__ == "__main__":
    unittest.main()
