"""Files that appear whole and together, or not at all; faces that users name; progress."""

import io
import os
import stat
import tempfile
import unittest
from pathlib import Path

import common  # noqa: F401  (puts the package on the path)
from freecad.bladesmith.cli.progress import Progress
from freecad.bladesmith.native import InputError
from freecad.bladesmith.operations.faces import selected
from freecad.bladesmith.operations.outputs import Outputs, check_target


class Files(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="bladesmith-tests-")
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)

    def names(self):
        return sorted(path.name for path in self.folder.iterdir())

    def test_nothing_is_there_before_and_everything_after_the_commit(self):
        with Outputs() as outputs:
            for name in ("a.step", "b.json"):
                temporary = Path(outputs.file(str(self.folder / name)))
                self.assertEqual(temporary.suffix, Path(name).suffix)
                temporary.write_text(name)
            page = Path(outputs.directory(str(self.folder / "pages")))
            (page / "report.html").write_text("page")
            self.assertFalse({"a.step", "b.json", "pages"} & set(self.names()))
            outputs.commit()
        self.assertEqual(self.names(), ["a.step", "b.json", "pages"])
        self.assertEqual((self.folder / "a.step").read_text(), "a.step")
        self.assertEqual([p.name for p in (self.folder / "pages").iterdir()], ["report.html"])

    def test_an_error_leaves_what_was_there_and_nothing_else(self):
        (self.folder / "a.step").write_text("before")
        with self.assertRaises(KeyboardInterrupt), Outputs() as outputs:
            Path(outputs.file(str(self.folder / "a.step"))).write_text("after")
            outputs.directory(str(self.folder / "pages"))
            raise KeyboardInterrupt
        self.assertEqual(self.names(), ["a.step"])
        self.assertEqual((self.folder / "a.step").read_text(), "before")

    def test_an_existing_folder_of_pages_keeps_its_other_files(self):
        pages = self.folder / "pages"
        pages.mkdir()
        (pages / "mine.txt").write_text("mine")
        (pages / "report.html").write_text("old")
        with Outputs() as outputs:
            Path(outputs.directory(str(pages)), "report.html").write_text("new")
            outputs.commit()
        self.assertEqual(sorted(p.name for p in pages.iterdir()), ["mine.txt", "report.html"])
        self.assertEqual((pages / "report.html").read_text(), "new")

    def test_files_have_the_rights_of_ordinary_ones(self):
        mask = os.umask(0o027)
        try:
            with Outputs() as outputs:
                outputs.file(str(self.folder / "a.step"))
                outputs.commit()
        finally:
            os.umask(mask)
        self.assertEqual(stat.S_IMODE((self.folder / "a.step").stat().st_mode), 0o640)

    def test_targets_that_cannot_be_are_refused_with_a_remedy(self):
        (self.folder / "file").write_text("")
        cases = [
            (self.folder / "none" / "a.step", False, "does not exist; make it first"),
            (self.folder, False, "a file is expected, and this is a folder"),
            (self.folder / "file", True, "a folder is expected, and this is a file"),
        ]
        for target, directory, reason in cases:
            with self.assertRaisesRegex(InputError, reason):
                check_target(str(target), "the result", directory)


class Faces(unittest.TestCase):
    NAMES = ["", "suction side", "suction side", "7", "tip, outer", "", ""]

    def selected(self, *values):
        return selected("--faces", values, self.NAMES)

    def test_numbers_face_numbers_and_names(self):
        self.assertEqual(self.selected("1,Face2", "face6"), (1, 2, 6))
        self.assertEqual(self.selected("suction side"), (2, 3))
        self.assertEqual(self.selected('1, "tip, outer"'), (1, 5))
        self.assertEqual(selected("--faces", None, self.NAMES), ())

    def test_a_name_wins_over_a_number(self):
        self.assertEqual(self.selected("7"), (4,))
        self.assertEqual(self.selected("Face7"), (7,))

    def test_unknown_faces_are_refused_with_what_there_is(self):
        for word in ("0", "8", "Face99", "-1", "pressure side", "Face"):
            with self.assertRaisesRegex(InputError, f"no face '{word}'; give Face1 to Face7"):
                self.selected(word)
        with self.assertRaisesRegex(InputError, "suction side"):
            self.selected("suction")
        for empty in ("", " , "):
            with self.assertRaisesRegex(InputError, "found nothing"):
                self.selected(empty)


class Terminal(io.StringIO):
    def isatty(self):
        return True


class ProgressBar(unittest.TestCase):
    def test_a_terminal_sees_stage_and_share_and_is_left_clean(self):
        terminal = Terminal()
        with Progress(quiet=False, stream=terminal) as progress:
            progress("fit", 0.5)
        text = terminal.getvalue()
        self.assertIn("50%", text)
        self.assertIn("fit", text)
        self.assertTrue(text.endswith("\r\x1b[K"))

    def test_files_and_quiet_users_see_nothing(self):
        for stream, quiet in ((io.StringIO(), False), (Terminal(), True)):
            with Progress(quiet=quiet, stream=stream) as progress:
                progress("fit", 0.5)
            self.assertEqual(stream.getvalue(), "")


if __name__ == "__main__":
    unittest.main()
