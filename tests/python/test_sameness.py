"""The same input gives the same result: with one thread or two, and from run to run."""

import unittest

import common
from common import bladesmith, morph, packed, shared_data

BLADE = (common.EXAMPLE / "hot.step.gz", common.EXAMPLE / "blade.frd.gz")


class Sameness(unittest.TestCase):
    def assert_same(self, part, field, *options):
        runs = [morph(part, field, *options, "--threads", n) for n in ("1", "2")]
        runs.append(morph(part, field, *options))
        texts = [run.output.read_text() for run in runs]
        self.assertEqual(texts[0], texts[1], "one thread and two differ")
        self.assertEqual(texts[1], texts[2], "two runs differ")
        reports = [{**run.report, "seconds": None} for run in runs]
        self.assertEqual(reports[0], reports[1])
        self.assertEqual(reports[1], reports[2])

    def test_the_bar(self):
        self.assert_same(packed("base.step"), packed("base.frd"), "--holdout")

    def test_the_blade(self):
        self.assert_same(*BLADE, "--factor", "-1")

    def test_the_header_has_the_time_that_was_asked_for(self):
        text = morph(packed("base.step"), packed("base.frd")).output.read_text()
        self.assertIn("'2023-11-14T22:13:20'", text)
        self.assertIn("'Bladesmith ", text)

    def test_the_core_gives_the_same_text_in_one_process(self):
        from freecad.bladesmith import native
        from freecad.bladesmith.model import MorphOptions
        from freecad.bladesmith.occ import step

        shape = step.read(str(packed("base.step"))).shape
        part = native.Part.read(shape.exportBrepToString(), "base")
        field = native.Field.read(str(packed("base.frd")))
        texts = {
            native.Morphed.morph(part, field, MorphOptions(threads=n).settings()).part().write()
            for n in (1, 2, 0, 2)
        }
        self.assertEqual(len(texts), 1)


class Cancelling(unittest.TestCase):
    def test_a_progress_call_that_says_no_cancels_and_one_that_raises_is_heard(self):
        from freecad.bladesmith import native
        from freecad.bladesmith.occ import step

        shape = step.read(str(packed("base.step"))).shape
        part = native.Part.read(shape.exportBrepToString(), "base")
        field = native.Field.read(str(packed("base.frd")))
        calls = []

        def stop(stage, fraction):
            calls.append((stage, fraction))
            return len(calls) < 3

        with self.assertRaises(native.Cancelled):
            native.Morphed.morph(part, field, {}, stop)
        self.assertEqual(len(calls), 3)
        self.assertTrue(all(0 <= fraction <= 1 for _stage, fraction in calls))

        def interrupt(stage, fraction):
            raise KeyboardInterrupt

        with self.assertRaises(KeyboardInterrupt):
            native.Morphed.morph(part, field, {}, interrupt)

    def test_the_largest_part_asks_at_every_face_whether_to_go_on(self):
        folder = shared_data("P3")
        from freecad.bladesmith import native
        from freecad.bladesmith.occ import step

        shape = step.read(str(folder / "hot.step")).shape
        part = native.Part.read(shape.exportBrepToString(), "P3")
        field = native.Field.read(str(folder / "P3.frd.gz"), str(folder / "P3.inp.gz"))
        heard = []

        def listen(_stage, fraction):
            heard.append(fraction)
            return True

        native.Morphed.morph(part, field, {"factor": -1.0}, listen)
        self.assertGreater(len(heard), len(shape.Faces))
        self.assertEqual(heard, sorted(heard), "progress goes back")


class Names(unittest.TestCase):
    def test_names_and_colours_go_from_the_input_into_the_result(self):
        import json
        import tempfile
        from pathlib import Path

        from freecad.bladesmith.occ import step
        from freecad.bladesmith.occ.attributes import SolidAttributes

        names = ["root", "tip's end", "Fläche", "", "x", "y"]
        colours = [(1.0, 0.0, 0.0), None, None, (0.25, 0.5, 0.75), None, None]
        with tempfile.TemporaryDirectory() as folder:
            hot, cold, report = (Path(folder, n) for n in ("hot.step", "cold.stp", "r.json"))
            bar = step.read(str(packed("base.step")))
            attributes = SolidAttributes("bar", (0.5, 0.5, 0.5), names, colours, [])
            step.write(bar.shape, str(hot), "Riegel", attributes, "test")
            arguments = ("morph", hot, packed("base.frd"), "-o", cold, "--json", report)
            done = bladesmith(*arguments, "--fixed", "root")
            self.assertIn(done.returncode, (0, 3), done.stderr)
            found = step.read(str(cold))
            side_file = json.loads(Path(folder, "cold.names.json").read_text())
            faces = json.loads(report.read_text())["faces"]
        self.assertEqual((found.product, side_file["product"]), ("cold", "cold"))
        self.assertEqual(found.solids[0].name, "bar")
        self.assertEqual(found.solids[0].face_names, names)
        self.assertEqual(found.solids[0].face_colours, colours)
        expected = [name or f"Face{i}" for i, name in enumerate(names, 1)]
        self.assertEqual([face["name"] for face in faces], expected)
        self.assertEqual(side_file["faces"], {str(i): n for i, n in enumerate(expected, 1)})


if __name__ == "__main__":
    unittest.main()
