"""The log: what it holds, what it must not, where it is, and that it never stops the work."""

import logging
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import common
from common import bladesmith, packed
from freecad.bladesmith import log


class Commands(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="bladesmith-tests-")
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name, "jane", "secret project")
        self.folder.mkdir(parents=True)
        self.file = Path(temporary.name, "logs", "mine.log")

    def run_logged(self, *arguments):
        """Runs a command; what it did and the text of its log."""
        done = bladesmith(*arguments, BLADESMITH_LOG=str(self.file))
        return done, self.file.read_text()

    def copied(self, name: str) -> Path:
        """An input in the folder whose name is private."""
        path = self.folder / f"{name}.gz"
        path.write_bytes(packed(name).read_bytes())
        return path

    def test_a_morph_leaves_versions_inputs_settings_stages_and_warnings(self):
        part, field = self.copied("base.step"), self.copied("base.frd")
        output = self.folder / "cold.step"
        done, text = self.run_logged("morph", part, field, "-o", output, "--factor", "-1")
        self.assertEqual(done.returncode, 0, done.stderr)
        size = part.stat().st_size
        for expected in (
            r"command line, morph: Bladesmith \d+\.\d+\.\d+, Python 3[.\d]+, \w+ .* processors",
            r"FreeCAD \d+\.\d+\.\d+, Open CASCADE \d+\.",
            rf"STEP file: base\.step\.gz \({size} bytes\)",
            r"field: base\.frd\.gz \(\d+ bytes\), step the last",
            r"settings: .*'factor': -1\.0",
            r"fitting each face: \d+\.\d\d s",
            r"largest deviation \d\.\d+e-\d+ mm",
            r"WARNING .*first-order estimate",
        ):
            self.assertRegex(text, expected)
        self.assertNotRegex(text, "jane|secret|Traceback")

    def test_an_input_that_cannot_be_used_is_one_line_without_its_folder(self):
        done, text = self.run_logged("info", self.folder / "missing.frd")
        self.assertEqual(done.returncode, 2)
        self.assertRegex(text, r"ERROR InputError: missing\.frd: ")
        self.assertNotRegex(text, "jane|secret|Traceback")

    def test_a_defect_leaves_its_traceback_without_folders_and_the_user_hears_where(self):
        code = (
            "import sys\n"
            "from freecad.bladesmith.cli import command, info\n"
            "def fail(options): raise RuntimeError('broken at /home/jane/secret project/x.step')\n"
            "info.run = fail\n"
            "sys.exit(command.main(['info', 'x.frd']))\n"
        )
        script = self.folder / "script.py"
        script.write_text(code)
        environment = {"PYTHONPATH": str(common.WORKBENCH), "BLADESMITH_LOG": str(self.file)}
        command = ["/usr/bin/python3", str(script)]
        done = subprocess.run(command, env=environment, capture_output=True, text=True)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn(f"please report it with the log, {self.file}", done.stderr)
        text = self.file.read_text()
        self.assertIn("RuntimeError: broken at x.step", text)
        self.assertRegex(text, r'File "command\.py", line \d+, in main')
        self.assertNotRegex(text, "jane|secret")

    def test_its_place_can_be_asked_for(self):
        done, text = self.run_logged("log")
        self.assertEqual(done.stdout, f"{self.file}\n")
        self.assertIn("command line, log", text)

    def test_a_log_that_cannot_be_written_does_not_stop_the_work(self):
        blocked = self.folder / "file"
        blocked.write_text("")
        done = bladesmith("info", packed("base.frd"), BLADESMITH_LOG=str(blocked / "x.log"))
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        done = bladesmith("info", packed("base.frd"), BLADESMITH_LOG="/dev/full")
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_it_is_cut_into_files_of_a_megabyte_and_the_oldest_go(self):
        self.file.parent.mkdir()
        for name in ("mine.log", "mine.log.1", "mine.log.2"):
            self.file.with_name(name).write_text(f"{name}\n" + 999_990 * "x" + "\n")
        self.run_logged("log")
        names = sorted(path.name for path in self.file.parent.iterdir())
        self.assertEqual(names, ["mine.log", "mine.log.1", "mine.log.2"])
        self.assertLess(self.file.stat().st_size, 10_000)
        self.assertTrue(self.file.with_name("mine.log.2").read_text().startswith("mine.log.1\n"))


class InFreeCAD(unittest.TestCase):
    def test_a_morph_of_a_document_is_kept_and_so_is_what_ends_it(self):
        from freecad.bladesmith.model import MorphOptions
        from freecad.bladesmith.native import InputError
        from freecad.bladesmith.occ import step
        from freecad.bladesmith.operations.morph import FieldFile, Job, complete

        self.addCleanup(forget_the_log)
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder, "mine.log")
            shape = step.read(str(packed("base.step"))).shape
            with mock.patch.dict(os.environ, BLADESMITH_LOG=str(file)):
                forget_the_log()
                field = FieldFile(str(packed("base.frd")))
                complete(Job(shape, "Part", field, MorphOptions()))
                with self.assertRaises(InputError):
                    complete(Job(shape, "Part", FieldFile("/home/jane/no.frd"), MorphOptions()))
            text = file.read_text()
        self.assertRegex(text, r"FreeCAD, morph: Bladesmith .*, FreeCAD \d+\.\d+")
        self.assertRegex(text, r"fitting all faces together: \d")
        self.assertRegex(text, r"ERROR InputError: no\.frd: ")
        self.assertNotIn("jane", text)


def forget_the_log():
    """As in a process that has not started it."""
    package = logging.getLogger("freecad.bladesmith")
    for handler in [h for h in package.handlers if hasattr(h, "baseFilename")]:
        package.removeHandler(handler)
        handler.close()


class Places(unittest.TestCase):
    def place(self, platform: str, **environment) -> Path:
        alone = mock.patch.dict(os.environ, environment, clear=True)
        with alone, mock.patch.object(sys, "platform", platform):
            return log.path()

    def test_it_lies_where_the_user_the_system_or_freecad_keep_such_things(self):
        home = {"HOME": "/home/x"}
        own = Path("Bladesmith", "bladesmith.log")
        self.assertEqual(self.place("linux", BLADESMITH_LOG="/a/b.log"), Path("/a/b.log"))
        self.assertEqual(self.place("linux", **home), Path("/home/x/.local/state") / own)
        self.assertEqual(self.place("linux", XDG_STATE_HOME="/s"), Path("/s") / own)
        self.assertEqual(self.place("linux", FREECAD_USER_HOME="/f"), Path("/f") / own)
        self.assertEqual(self.place("darwin", **home), Path("/home/x/Library/Logs") / own)
        self.assertEqual(self.place("win32", LOCALAPPDATA="/l"), Path("/l") / own)


class Folders(unittest.TestCase):
    def test_they_are_left_out_of_paths_and_nothing_else_is(self):
        formatter = log._Discreet("%(message)s")
        cases = {
            "/home/jane/a b/hot.step: no solid": "hot.step: no solid",
            r"C:\Users\Jane\hot.step, line 3": "hot.step, line 3",
            "'/tmp/x/y.frd' and '/var/z.inp'": "'y.frd' and 'z.inp'",
            "~/parts/hot.step": "hot.step",
            "10 mm/s, 3/4 of 5 nodes, a/b": "10 mm/s, 3/4 of 5 nodes, a/b",
        }
        for message, expected in cases.items():
            record = logging.LogRecord("x", logging.INFO, "", 0, message, (), None)
            self.assertEqual(formatter.format(record), expected)


if __name__ == "__main__":
    unittest.main()
