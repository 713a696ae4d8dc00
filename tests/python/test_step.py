"""STEP files: units, names, colours, and what is refused."""

import random
import tempfile
import unittest
from pathlib import Path

import common
from common import FreeCAD, Part
from freecad.bladesmith.native import InputError
from freecad.bladesmith.occ import judge, step
from freecad.bladesmith.occ.attributes import SolidAttributes
from freecad.bladesmith.occ.part21 import scan

COLOURED = Path(__file__).parent / "data" / "coloured_box.step"
RED, GREEN, YELLOW = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (1.0, 1.0, 0.0)


class InFolder(unittest.TestCase):
    """A test with a folder of its own."""

    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="bladesmith-tests-")
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)

    def written(self, shape, attributes, product="part") -> Path:
        path = self.folder / "written.step"
        step.write(shape, str(path), product, attributes, "Bladesmith test")
        return path


class NamesAndColours(InFolder):
    def test_colours_of_a_file_made_by_freecad_are_read(self):
        part = step.read(str(COLOURED))
        self.assertEqual(part.product, "Würfel")
        self.assertEqual(part.solids[0].face_colours, [RED, GREEN, None, None, YELLOW, None])
        for component, expected in zip(part.solids[0].colour, (0.2, 0.4, 0.6)):
            self.assertAlmostEqual(component, expected, places=6)

    def test_names_and_colours_come_back_as_they_were_written(self):
        shape = Part.makeBox(1, 2, 3).cut(Part.makeCylinder(0.3, 3, shape_base()))
        random.seed(2)
        count = len(shape.Faces)
        names = random.choices(["", "suction side", "it's; #7 = X('", "Fläche\\n", "日本"], k=count)
        colours = random.choices([None, RED, (0.123456789, 0.5, 1.0)], k=count)
        attributes = SolidAttributes("the solid", GREEN, names, colours, [])
        part = step.read(str(self.written(shape.Solids[0], attributes, "Schaufel Ä")))
        found = part.solids[0]
        self.assertEqual(part.product, "Schaufel Ä")
        self.assertEqual((found.name, found.colour), ("the solid", GREEN))
        self.assertEqual(found.face_names, names)
        self.assertEqual(found.face_colours, colours)

    def test_faces_of_a_cavity_have_names_and_colours_too(self):
        hollow = Part.makeBox(4, 4, 4).cut(Part.makeBox(1, 1, 1, vector(1, 1, 1))).Solids[0]
        names = [f"face {i}" for i in range(len(hollow.Faces))]
        colours = [RED if i % 2 else None for i in range(len(names))]
        attributes = SolidAttributes("hollow", YELLOW, names, colours, [])
        found = step.read(str(self.written(hollow, attributes))).solids[0]
        self.assertEqual((found.name, found.colour), ("hollow", YELLOW))
        self.assertEqual((found.face_names, found.face_colours), (names, colours))

    def test_faces_are_those_of_the_text_in_the_same_order(self):
        """Each face's name is the number of the entity whose first vertex lies on it."""
        for name in ("base.step", "sphere.step", "two_solids.step"):
            self.assert_order(common.packed(name))

    def test_faces_of_the_larger_cases_are_those_of_the_text(self):
        for case in ("P1", "P2", "P3", "P4"):
            self.assert_order(common.shared_data(case) / "hot.step")

    def assert_order(self, path: Path):
        import gzip

        raw = path.read_bytes()
        text = (gzip.decompress(raw) if path.suffix == ".gz" else raw).decode()
        file = scan(text)
        shape = step.read(str(path)).shape
        numbers = [
            face
            for shell in file.numbers["CLOSED_SHELL"]
            for face in file.record(shell).parameters[1]
        ]
        self.assertEqual(len(numbers), len(shape.Faces), path)
        for number, face in zip(numbers, shape.Faces):
            point = first_vertex(file, number)
            distance = min(vertex.Point.distanceToPoint(point) for vertex in face.Vertexes)
            self.assertLess(distance, 1e-9, f"{path}: face #{number}")

    def test_solids_that_do_not_match_the_text_lose_their_names_and_say_so(self):
        text = COLOURED.read_text("utf-8").replace("PLANE(", "SPHERICAL_SURFACE(", 1)
        part = step._with_attributes("x.step", step.read(str(COLOURED)).shape, text)
        self.assertEqual(part.solids[0].face_colours, [None] * 6)
        self.assertIn("do not match", part.warnings[0])


class Files(InFolder):
    def test_the_same_solid_gives_the_same_bytes_in_every_write(self):
        shape = Part.makeCylinder(2, 5)
        texts = {self.written(shape, SolidAttributes.unknown(3)).read_bytes() for _ in range(3)}
        without_time = {text.split(b"FILE_SCHEMA")[1] for text in texts}
        self.assertEqual(len(without_time), 1)

    def test_other_units_are_read_into_millimetres(self):
        box = Part.makeBox(25.4, 50.8, 1000)
        for unit in ("INCH", "M", "MM"):
            path = self.folder / f"{unit}.step"
            Part.setStaticValue("write.step.unit", unit)
            try:
                box.exportStep(str(path))
            finally:
                Part.setStaticValue("write.step.unit", "MM")
            size = step.read(str(path)).shape.BoundBox
            for found, expected in zip(
                (size.XLength, size.YLength, size.ZLength), (25.4, 50.8, 1000)
            ):
                self.assertAlmostEqual(found, expected, places=6, msg=unit)

    def test_odd_file_names_and_packed_files_are_read(self):
        data = COLOURED.read_bytes()
        for name in ("ä ö.step", "BIG.STP", "none", "wrong.txt", "x.Step"):
            path = self.folder / name
            path.write_bytes(data)
            self.assertEqual(len(step.read(str(path)).shape.Faces), 6, name)
        self.assertEqual(len(step.read(str(common.packed("sphere.step"))).shape.Faces), 4)

    def test_unusable_files_are_named_with_what_was_expected(self):
        text = COLOURED.read_text("utf-8")
        cases = {
            "missing.step": (None, "No such file"),
            "mesh.step": ("solid ascii\n", "no STEP file.*ISO-10303-21"),
            "empty.step": ("", "no STEP file"),
            "cut.step": (text[: len(text) // 2], "cannot read this STEP file"),
            "nothing.step": (
                text[: text.index("#1 =")] + "ENDSEC;\nEND-ISO-10303-21;\n",
                "no solid",
            ),
        }
        for name, (content, reason) in cases.items():
            path = self.folder / name
            if content is not None:
                path.write_text(content, "utf-8")
            with self.assertRaisesRegex(InputError, f"{name}: .*{reason}"):
                step.read(str(path))

    def test_faces_without_a_solid_are_refused(self):
        with self.assertRaisesRegex(InputError, "no solid in this file, it holds 5 faces"):
            step.read(str(common.packed("faces_only.step")))

    def test_a_damaged_packed_file_is_refused(self):
        whole = common.packed("base.step").read_bytes()
        cases = {
            "cut.step.gz": (whole[:2000], "ends early: it is truncated; copy it again"),
            "spoiled.step.gz": (whole[:2000] + whole[2100:], "is damaged .*; copy it again"),
        }
        for name, (content, reason) in cases.items():
            path = self.folder / name
            path.write_bytes(content)
            with self.assertRaisesRegex(InputError, f"{name}: the gzipped file {reason}"):
                step.read(str(path))


class Judgement(unittest.TestCase):
    def test_a_good_solid_is_valid_and_closed(self):
        self.assertEqual(judge.judge(Part.makeTorus(5, 1)), judge.Verdict(True, True, []))

    def test_an_open_shell_is_found_open(self):
        shell = Part.makeShell(Part.makeBox(1, 1, 1).Faces[:5])
        verdict = judge.judge(Part.Solid(shell))
        self.assertFalse(verdict.closed)
        self.assertIn("its shell is open", verdict.complaints)

    def test_a_face_that_crosses_itself_is_found(self):
        corners = [(0, 0, 0), (1, 1, 0), (1, 0, 0), (0, 1, 0), (0, 0, 0)]
        bow_tie = Part.Face(Part.Wire(Part.makePolygon([vector(*p) for p in corners])))
        verdict = judge.judge(bow_tie.extrude(vector(0, 0, 1)))
        self.assertFalse(verdict.valid)

    def test_two_solids_or_none_are_no_solid(self):
        both = Part.makeCompound([Part.makeBox(1, 1, 1), Part.makeBox(1, 1, 1, vector(2, 0, 0))])
        self.assertEqual(judge.judge(both).complaints, ["expected one solid, found 2"])

    def test_equal_solids_do_not_differ_and_others_do(self):
        box = Part.makeBox(1, 2, 3)
        self.assertEqual(judge.differences(box, box.copy(), 1e-6), [])
        moved = box.copy()
        moved.translate(vector(0, 0, 1e-3))
        self.assertTrue(any("off by" in text for text in judge.differences(box, moved, 1e-6)))
        cut = box.cut(Part.makeCylinder(0.2, 3))
        self.assertTrue(any("faces became" in t for t in judge.differences(box, cut, 1e-6)))

    def test_swapped_faces_differ(self):
        box = Part.makeBox(1, 2, 3)
        faces = box.Faces
        swapped = Part.Solid(Part.makeShell([faces[1], faces[0], *faces[2:]]))
        self.assertTrue(judge.differences(box, swapped, 1e-6))


def vector(x, y, z):
    return FreeCAD.Vector(x, y, z)


def shape_base():
    return vector(0.5, 1, 0)


def first_vertex(file, face: int):
    """The point where the first edge of a face's first loop starts."""
    loop = file.record(file.record(face).parameters[1][0]).parameters[1]
    edge = file.record(file.record(loop).parameters[1][0]).parameters[3]
    vertex = file.record(edge).parameters[1]
    return vector(*file.record(file.record(vertex).parameters[1]).parameters[1])


if __name__ == "__main__":
    unittest.main()
