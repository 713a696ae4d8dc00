"""The add-on archive: unpacked into ``Mod`` of an empty user folder it is a full installation."""

import os
import re
import subprocess
import sys
import tempfile
import unittest
import zipfile
from pathlib import Path

import common

LIBRARY = common.ROOT / "target" / "release" / "libbladesmith.so"
MORPH = """
import os, sys, traceback
try:
    import FreeCAD
    from freecad.bladesmith.cli import main
    code = main({arguments!r})
    print("user", FreeCAD.getUserAppDataDir())
except BaseException:
    traceback.print_exc()
    code = 99
sys.stdout.flush()
os._exit(code)
"""


def pack(folder: Path) -> Path:
    """Packs the add-on into a folder; the archive."""
    script = common.ROOT / "cmake" / "addon.py"
    command = [sys.executable, str(script), str(LIBRARY), str(folder)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    return Path(done.stdout.strip())


class Addon(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory(prefix="bladesmith-tests-")
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = Path(temporary.name)
        cls.archive = pack(cls.folder)
        cls.user = cls.folder / "user"
        with zipfile.ZipFile(cls.archive) as archive:
            archive.extractall(cls.user / "Mod")

    def freecad(self, *arguments) -> subprocess.CompletedProcess:
        """Runs a command of Bladesmith inside FreeCAD, with the empty user folder."""
        script = self.folder / "morph.py"
        script.write_text(MORPH.format(arguments=list(map(str, arguments))))
        bare = {k: v for k, v in os.environ.items() if not k.startswith(("PYTHON", "BLADESMITH"))}
        return subprocess.run(
            ["freecadcmd", str(script)],
            env={**bare, "HOME": str(self.user), "FREECAD_USER_HOME": str(self.user)},
            cwd=self.folder,
            capture_output=True,
            text=True,
            stdin=subprocess.DEVNULL,
        )

    def test_it_names_release_and_platform_and_packs_the_same_bytes_again(self):
        self.assertRegex(self.archive.name, r"^bladesmith-\d+\.\d+\.\d+-freecad-\w+-\w+\.zip$")
        again = self.folder / "again"
        again.mkdir()
        self.assertEqual(pack(again).read_bytes(), self.archive.read_bytes())

    def test_everything_lies_in_one_folder_without_leavings(self):
        with zipfile.ZipFile(self.archive) as archive:
            names = archive.namelist()
        self.assertTrue(all(name.startswith("Bladesmith/") for name in names), names)
        self.assertIn("Bladesmith/package.xml", names)
        self.assertFalse([name for name in names if re.search(r"\.pyc$|/tests/|~$", name)])

    def test_freecad_finds_it_and_morphs_with_the_library_inside(self):
        output = self.folder / "cold.step"
        part, field = common.packed("base.step"), common.packed("base.frd")
        done = self.freecad("morph", part, field, "-o", output)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn(f"user {self.user}", done.stdout)
        self.assertTrue(common.Part.read(str(output)).isValid())
        beside = common.morph(part, field).output
        shapes = [common.Part.read(str(path)) for path in (output, beside)]
        texts = [shape.exportBrepToString() for shape in shapes]
        self.assertEqual(texts[0], texts[1], "the add-on and the checkout give different parts")

    def test_without_its_library_it_says_what_to_install(self):
        library = next(self.user.rglob("libbladesmith.so.*"))
        hidden = library.with_name("hidden")
        library.rename(hidden)
        self.addCleanup(hidden.rename, library)
        done = self.freecad("info", common.packed("base.frd"))
        self.assertEqual(done.returncode, 1, done.stderr)
        lines = [line for line in done.stderr.splitlines() if line.startswith("bladesmith: ")]
        self.assertEqual(len(lines), 1, done.stderr)
        self.assertIn("the library of Bladesmith was not found", lines[0])
        self.assertIn(f"install the add-on archive {self.archive.name}", lines[0])
        self.assertIn("Mod", lines[0])


if __name__ == "__main__":
    unittest.main()
