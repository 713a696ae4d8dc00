"""The morph as a document object, without a window: inputs, errors, saving, old documents."""

import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import common
from common import FreeCAD, awkward, bladesmith, packed
from freecad.bladesmith.features import exchange, morph
from freecad.bladesmith.native import InputError
from freecad.bladesmith.occ import step
from freecad.bladesmith.occ.attributes import SolidAttributes

INSIDE = Path(__file__).with_name("inside_freecad.py")
PROGRAM = common.ROOT / "examples" / "c" / "morph.c"


class Document(unittest.TestCase):
    def setUp(self):
        self.document = FreeCAD.newDocument("Test")
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory(prefix="bladesmith-")))

    def tearDown(self):
        FreeCAD.closeDocument(self.document.Name)

    def morph(self, part="base.step", field="base.frd", **settings):
        """A computed morph of a part that ships with the tests."""
        source = exchange.read(self.document, str(packed(part)))[0]
        obj = morph.create(self.document, source)
        obj.FieldFile, obj.Factor = str(packed(field)), 1.0
        for name, value in settings.items():
            setattr(obj, name, value)
        self.document.recompute()
        return obj

    def assert_refused(self, obj, pattern):
        self.document.recompute()
        self.assertFalse(obj.isValid())
        self.assertRegex(obj.getStatusString(), pattern)


class Results(Document):
    def test_the_shape_moves_and_the_figures_are_there(self):
        obj = self.morph(Holdout=True)
        self.assertTrue(obj.isValid(), obj.getStatusString())
        self.assertTrue(obj.Shape.isValid() and obj.Shape.isClosed())
        report = json.loads(obj.ReportJson)
        self.assertIs(report["solid"]["valid"], True)
        self.assertIsNotNone(report["holdout_mm"])
        count = len(obj.NodeIds)
        self.assertGreater(count, 1000)
        for name in ("NodeFaces", "NodeFeet", "NodeDisplacements", "NodeDeviations"):
            self.assertEqual(len(getattr(obj, name)), count, name)
            self.assertEqual(obj.getEditorMode(name), ["Hidden"])
        largest = max(vector.Length for vector in obj.NodeDeviations)
        self.assertAlmostEqual(largest, report["deviation_mm"]["max"], places=12)
        foot = obj.NodeFeet[0]
        face = obj.Source.Shape.Faces[obj.NodeFaces[0] - 1]
        self.assertLess(face.distToShape(common.Part.Vertex(foot))[0], 1e-6)

    def test_a_change_of_the_source_is_followed(self):
        obj = self.morph()
        before = obj.Shape.CenterOfMass
        obj.Source.Placement.Base.x += 1.0
        self.assert_refused(obj, "does not lie on the geometry")
        self.assertEqual(obj.Shape.CenterOfMass, before)
        obj.Source.Placement.Base.x -= 1.0
        self.document.recompute()
        self.assertTrue(obj.isValid(), obj.getStatusString())

    def test_a_result_computed_elsewhere_is_taken_only_for_the_same_input(self):
        obj = self.morph()
        half = morph.computed(morph.job_of(self.morph(Factor=0.5)))
        obj.Proxy.offer(half)
        obj.touch()
        self.document.recompute()
        self.assertEqual(json.loads(obj.ReportJson)["input"]["factor"], 1.0)
        obj.Factor, obj.Source = 0.5, obj.Source
        job = morph.job_of(obj)
        ready = morph.computed(job)
        ready.result.report.warn("computed elsewhere")
        obj.Proxy.offer(ready)
        self.document.recompute()
        self.assertIn("computed elsewhere", obj.ReportJson)

    def test_names_of_the_source_choose_faces_and_go_into_the_result(self):
        names = ["root, below", "tip", "", "x", "y", "z"]
        colours = [(0.1, 0.2, 0.3), None, None, None, None, None]
        hot = self.folder / "hot.step"
        bar = step.read(str(packed("base.step")))
        said = SolidAttributes("bar", (0.5, 0.5, 0.5), names, colours, [])
        step.write(bar.shape, str(hot), "Riegel", said, "test")
        source = exchange.read(self.document, str(hot))[0]
        self.assertEqual(list(source.FaceNames), names)
        obj = morph.create(self.document, source)
        obj.FieldFile, obj.FixedFaces = str(packed("base.frd")), ["root, below"]
        self.document.recompute()
        self.assertTrue(obj.isValid(), obj.getStatusString())
        faces = json.loads(obj.ReportJson)["faces"]
        self.assertEqual(faces[0]["name"], "root, below")
        self.assertTrue(faces[0]["held"])
        cold = self.folder / "cold.step"
        exchange.write(obj, str(cold))
        again = step.read(str(cold))
        self.assertEqual(again.product, "cold")
        exchange.write(source, str(self.folder / "copy.step"))
        self.assertEqual(step.read(str(self.folder / "copy.step")).product, "Riegel")
        self.assertEqual(again.solids[0].name, "bar")
        self.assertEqual(again.solids[0].face_names, names)
        self.assertEqual(again.solids[0].face_colours, colours)


class Sameness(Document):
    def test_window_command_line_and_c_give_the_same_solid(self):
        obj = self.morph(Factor=-1.0)
        obj.Source.Shape.tessellate(0.1)
        ours = morph.computed(morph.job_of(obj)).result.brep
        cold, from_command = (self.folder / name / "cold.step" for name in ("window", "command"))
        cold.parent.mkdir()
        from_command.parent.mkdir()
        os.environ["SOURCE_DATE_EPOCH"] = common.EPOCH
        self.addCleanup(os.environ.pop, "SOURCE_DATE_EPOCH")
        exchange.write(obj, str(cold))
        part, field = packed("base.step"), packed("base.frd")
        done = bladesmith("morph", part, field, "-o", from_command, "--factor", "-1")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(cold.read_text(), from_command.read_text(), "the command line differs")
        self.assertEqual(self.from_c(), ours, "C differs")

    def from_c(self):
        """The B-rep text that the C program writes."""
        program, hot, cold = (self.folder / name for name in ("program", "hot.brep", "cold.brep"))
        library = common.ROOT / "target" / "release" / "libbladesmith.so"
        (self.folder / "libbladesmith.so.1").symlink_to(library)
        flags = [f"-I{common.ROOT / 'include'}", f"-Wl,-rpath,{self.folder}"]
        subprocess.run(["gcc", *flags, "-o", program, PROGRAM, library, "-lm"], check=True)
        shape = step.read(str(packed("base.step"))).shape
        hot.write_text(shape.Solids[0].exportBrepToString())
        command = [program, hot, packed("base.frd"), "-1", cold]
        done = subprocess.run(command, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return cold.read_text()


class Refusals(Document):
    def test_wrong_input_says_why_and_keeps_the_last_shape(self):
        obj = self.morph()
        volume, report = obj.Shape.Volume, obj.ReportJson
        wrong = {
            "Step": (7, "step 7 is not in it"),
            "Tolerance": (0.0, "Tolerance: expected a value above zero"),
            "MatchTolerance": (-1.0, "MatchTolerance: expected zero or more"),
            "DisplacementScale": (-2.0, "DisplacementScale: expected a value above zero"),
            "Factor": (float("nan"), "Factor: expected a finite number"),
            "FieldFile": ("/nowhere/field.frd", "/nowhere/field.frd"),
            "FixedFaces": (["Face99"], "FixedFaces: the part has no face 'Face99'"),
            "Solid": (2, "there is no solid 2"),
            "Source": (None, "Source: choose the object"),
        }
        for name, (value, pattern) in wrong.items():
            with self.subTest(name):
                good = getattr(obj, name)
                setattr(obj, name, value)
                self.assert_refused(obj, pattern)
                self.assertEqual(obj.Shape.Volume, volume)
                self.assertEqual(obj.ReportJson, report)
                setattr(obj, name, good)
        self.document.recompute()
        self.assertTrue(obj.isValid(), obj.getStatusString())

    def test_what_to_do_is_said_in_names_of_properties(self):
        obj = self.morph()
        obj.FieldFile = str(awkward("metres"))
        self.assert_refused(obj, "give FieldUnit m")
        obj.FieldUnit = "m"
        self.document.recompute()
        self.assertTrue(obj.isValid(), obj.getStatusString())
        obj.FieldFile, obj.FieldUnit = str(awkward("partial_face")), morph.NOT_STATED
        self.assert_refused(obj, "give Extrapolate")

    def test_a_source_without_a_solid_is_refused(self):
        obj = self.morph()
        obj.Source = self.document.addObject("Part::Feature", "Faces")
        obj.Source.Shape = common.Part.makePlane(1, 1)
        self.assert_refused(obj, "Faces: no solid, it holds 1 face only")
        obj.Source = self.document.addObject("App::FeaturePython", "Nothing")
        self.assert_refused(obj, "Nothing: this object has no shape")

    def test_a_source_without_names_shows_none(self):
        obj = self.morph()
        self.assertEqual((obj.FaceNames, obj.Source.FaceNames), ([], []))

    def test_only_one_solid_is_exported_and_only_as_step(self):
        obj = self.morph()
        with self.assertRaisesRegex(InputError, "ends in .step or .stp"):
            exchange.write(obj, str(self.folder / "cold.igs"))
        empty = self.document.addObject("Part::Feature", "Empty")
        with self.assertRaisesRegex(InputError, "Empty: expected one solid to export, found 0"):
            exchange.write(empty, str(self.folder / "cold.step"))
        self.assertEqual(list(self.folder.iterdir()), [])


class Fem(Document):
    def result(self, field="base.frd"):
        """A result object as the FEM workbench makes one of the same file."""
        import Fem

        rows = common.frd_rows(packed(field))
        mesh = self.document.addObject("Fem::FemMeshObject", "ResultMesh")
        fem_mesh = Fem.FemMesh()
        for number, point, _displacement in rows:
            fem_mesh.addNode(*point, number)
        mesh.FemMesh = fem_mesh
        result = self.document.addObject("Fem::FemResultObjectPython", "CCX_Results")
        result.addProperty("App::PropertyVectorList", "DisplacementVectors")
        result.Mesh = mesh
        result.NodeNumbers = [number for number, _point, _displacement in rows]
        result.DisplacementVectors = [FreeCAD.Vector(*row[2]) for row in rows]
        return result

    def test_a_result_object_gives_the_shape_of_its_file(self):
        from_file = self.morph()
        obj = self.morph()
        obj.FieldFile, obj.FieldObject = "", self.result()
        self.document.recompute()
        self.assertTrue(obj.isValid(), obj.getStatusString())
        for a, b in zip(from_file.Shape.Vertexes, obj.Shape.Vertexes):
            self.assertLess(a.Point.distanceToPoint(b.Point), 2e-5)
        self.assertEqual(json.loads(obj.ReportJson)["input"]["field"], "CCX_Results")

    def test_incomplete_results_are_refused(self):
        obj = self.morph()
        obj.FieldObject = self.result()
        vectors = obj.FieldObject.DisplacementVectors
        obj.FieldObject.DisplacementVectors = vectors[:-1]
        self.assert_refused(obj, f"{len(vectors) - 1} displacements for {len(vectors)} nodes")
        obj.FieldObject.DisplacementVectors = []
        self.assert_refused(obj, "holds no displacements")
        obj.FieldObject.Mesh = None
        self.assert_refused(obj, "has no mesh")
        obj.FieldObject = obj.Source
        self.assert_refused(obj, "no result of the FEM workbench")


class Reopened(Document):
    """Documents opened in a new FreeCAD with the add-on in its ``Mod`` folder."""

    def saved(self):
        """A saved document with a morph, made inside such a FreeCAD; its path."""
        path = self.folder / "blade.FCStd"
        self.inside("make", path, packed("base.step"), packed("base.frd"))
        return path

    def inside(self, *arguments, **environment):
        """Runs one action of ``inside_freecad.py`` in a new process; what it prints as JSON."""
        home = self.folder / "home"
        if not home.exists():
            home.mkdir()
            common.user_home(home)
        words = json.dumps([str(argument) for argument in arguments])
        done = subprocess.run(
            ["freecadcmd", str(INSIDE)],
            env={
                **os.environ,
                "FREECAD_USER_HOME": str(home),
                "BLADESMITH_ACTION": words,
                **environment,
            },
            stdin=subprocess.DEVNULL,
            capture_output=True,
            text=True,
            timeout=120,
        )
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return json.loads(done.stdout.strip().splitlines()[-1])

    def test_it_recomputes_in_a_new_process(self):
        found = self.inside("recompute", self.saved())
        self.assertTrue(found["valid"], found["status"])
        self.assertAlmostEqual(found["volume"] / found["volume_before"], 1.0, places=9)
        self.assertEqual(found["schema"], morph.SCHEMA_VERSION)

    def test_without_the_library_the_last_shape_stays_and_the_reason_says_what_to_install(self):
        path = self.saved()
        found = self.inside("recompute", path, BLADESMITH_LIBRARY="/nowhere/libbladesmith.so")
        self.assertFalse(found["valid"])
        self.assertGreater(found["volume_before"], 1.0)
        self.assertEqual(found["volume"], found["volume_before"])
        self.assertRegex(found["status"], "library of Bladesmith was not found.*run 'make build'")

    def test_an_older_document_gets_what_it_lacks_once(self):
        path = self.saved()
        found = self.inside("age", path)
        self.assertNotIn("Holdout", found["properties"])
        found = self.inside("recompute", path)
        self.assertTrue(found["valid"], found["status"])
        self.assertIn("Holdout", found["properties"])
        self.assertEqual(found["schema"], morph.SCHEMA_VERSION)
        self.assertEqual(found["factor"], -1.0)

    def test_awkward_files_are_refused_with_their_names(self):
        found = self.inside("field", self.saved(), awkward("truncated"))
        self.assertFalse(found["valid"])
        self.assertRegex(found["status"], r"truncated.frd.*of 2425")


if __name__ == "__main__":
    unittest.main()
