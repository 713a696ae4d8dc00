"""The binding to the core: symbols, layout of the options, errors, finding the library."""

import ctypes
import re
import subprocess
import tempfile
import unittest
from pathlib import Path

import common
from common import Part as FreeCADPart
from freecad import bladesmith
from freecad.bladesmith import native
from freecad.bladesmith.model import MorphOptions as ModelOptions
from freecad.bladesmith.native import api, errors

HEADER = common.ROOT / "include" / "bladesmith" / "bladesmith.h"
MISSING = common.ROOT / "no such file.frd"


class Header(unittest.TestCase):
    def test_the_binding_calls_exactly_what_the_header_declares(self):
        text = re.sub(r"/\*.*?\*/|//[^\n]*", "", HEADER.read_text(), flags=re.S)
        declared = set(re.findall(r"\b(bladesmith_\w+)\s*\(", text))
        self.assertEqual(declared, {*api.STATUS_CALLS, *api.OTHER_CALLS})

    def test_the_options_are_laid_out_as_a_c_compiler_lays_them_out(self):
        fields = [name for name, _kind in api.MorphOptions._fields_]
        lines = "".join(
            f'printf("%zu\\n", offsetof(bladesmith_morph_options, {name}));\n' for name in fields
        )
        program = (
            "#include <stddef.h>\n#include <stdio.h>\n#include <bladesmith/bladesmith.h>\n"
            f"int main(void) {{\n{lines}"
            'printf("%zu\\n", sizeof(bladesmith_morph_options));\nreturn 0; }\n'
        )
        with tempfile.TemporaryDirectory() as folder:
            source, binary = Path(folder, "layout.c"), Path(folder, "layout")
            source.write_text(program)
            include = f"-I{HEADER.parents[1]}"
            subprocess.run(["gcc", include, "-o", str(binary), str(source)], check=True)
            printed = subprocess.run([str(binary)], capture_output=True, text=True, check=True)
        expected = [getattr(api.MorphOptions, name).offset for name in fields]
        expected.append(ctypes.sizeof(api.MorphOptions))
        self.assertEqual([int(line) for line in printed.stdout.split()], expected)

    def test_library_and_package_are_of_one_release(self):
        self.assertEqual(native.library_version(), bladesmith.__version__)

    def test_every_setting_of_the_model_is_one_of_the_core(self):
        options, _kept = api._options(api._core(), ModelOptions(factor=-1, threads=2).settings())
        self.assertEqual((options.factor, options.threads), (-1.0, 2))
        with self.assertRaisesRegex(TypeError, "no setting 'speed'"):
            api._options(api._core(), {"speed": 3})


class Errors(unittest.TestCase):
    def test_each_range_of_numbers_has_its_class_and_exit_code(self):
        cases = {
            1: (errors.ArgumentError, 2),
            10: (errors.Cancelled, 1),
            100: (errors.InputError, 2),
            199: (errors.InputError, 2),
            200: (errors.NumericsError, 1),
            300: (errors.DesignRuleError, 1),
            900: (errors.InternalError, 1),
            777: (errors.InternalError, 1),
        }
        for status, (kind, code) in cases.items():
            error = errors.from_status(status, "why")
            self.assertIs(type(error), kind, status)
            self.assertEqual(error.exit_code, code, status)

    def test_a_missing_field_file_is_an_input_error_that_names_it(self):
        with self.assertRaisesRegex(native.InputError, "no such file.frd"):
            native.Field.read(str(MISSING))

    def test_malformed_brep_text_is_an_input_error_with_its_line(self):
        with self.assertRaisesRegex(native.InputError, "part.step, line 1"):
            native.Part.read("not a B-rep", "part.step")


class Parts(unittest.TestCase):
    def setUp(self):
        shape = FreeCADPart.makeCylinder(2, 5)
        self.part = native.Part.read(shape.exportBrepToString(), "cylinder")
        self.shape = shape

    def test_written_text_is_the_same_shape_for_open_cascade(self):
        again = FreeCADPart.Shape()
        again.importBrepFromString(self.part.write())
        self.assertTrue(again.isValid())
        self.assertAlmostEqual(again.Volume, self.shape.Volume, places=9)

    def test_evaluate_gives_points_and_derivatives(self):
        import numpy

        values = self.part.evaluate(1, [(0.5, 1.0), (2.0, 3.0)], 2)
        self.assertEqual(values.shape, (2, 6, 3))
        surface = self.shape.Faces[0].Surface
        numpy.testing.assert_allclose(values[0, 0], surface.value(0.5, 1.0), atol=1e-12)

    def test_bad_arguments_are_refused_before_and_by_the_core(self):
        with self.assertRaisesRegex(ValueError, r"shape \(n, 2\)"):
            self.part.evaluate(1, [1.0, 2.0])
        with self.assertRaises(native.ArgumentError):
            self.part.evaluate(99, [(0.0, 0.0)])

    def test_fields_come_from_arrays_and_copy_them(self):
        field = native.Field.from_arrays("mine", [7, 3], [(0, 0, 0), (1, 0, 0)], [(0, 0, 1)] * 2)
        self.assertEqual(field.info()["nodes"], 2)
        with self.assertRaisesRegex(ValueError, "2 .*ids|ids need"):
            native.Field.from_arrays("mine", [7, 3], [(0, 0, 0)], [(0, 0, 1)] * 2)


class Finding(unittest.TestCase):
    def load(self, **environment):
        code = "from freecad.bladesmith import native; print(native.library_version())"
        return subprocess.run(
            ["/usr/bin/python3", "-c", code],
            env={"PYTHONPATH": str(common.WORKBENCH), **environment},
            capture_output=True,
            text=True,
        )

    def test_a_named_library_that_is_not_there_says_what_to_do(self):
        done = self.load(BLADESMITH_LIBRARY="/nowhere/lib.so")
        self.assertIn("/nowhere/lib.so", done.stderr)
        self.assertIn("make build", done.stderr)

    def test_a_library_of_something_else_is_refused(self):
        done = self.load(BLADESMITH_LIBRARY="libm.so.6")
        self.assertIn("libm.so.6 is not the library of Bladesmith", done.stderr)

    def test_a_library_with_another_interface_is_refused_with_both_versions(self):
        with tempfile.TemporaryDirectory() as folder:
            source, library = Path(folder, "other.c"), Path(folder, "libother.so")
            source.write_text("unsigned bladesmith_abi_version(void) { return 77; }\n")
            command = ["gcc", "-shared", "-fPIC", "-o", str(library), str(source)]
            subprocess.run(command, check=True)
            done = self.load(BLADESMITH_LIBRARY=str(library))
        self.assertRegex(done.stderr, "has C interface 77, this package needs 1")


if __name__ == "__main__":
    unittest.main()
