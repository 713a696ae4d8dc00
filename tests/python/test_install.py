"""``make install`` and ``make uninstall``: the command works from its new place, and goes again."""

import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import common


def make(verb: str, **variables) -> subprocess.CompletedProcess:
    """Runs a verb of the Makefile as from a terminal of its own."""
    plain = {k: v for k, v in os.environ.items() if not k.startswith(("MAKE", "MFLAGS"))}
    return subprocess.run(
        ["make", verb, *(f"{name}={value}" for name, value in variables.items())],
        cwd=common.ROOT,
        env=plain,
        capture_output=True,
        text=True,
        stdin=subprocess.DEVNULL,
    )


def terminal(lines: str, folder: Path, **environment) -> subprocess.CompletedProcess:
    """Runs lines as in a terminal in ``folder``."""
    return subprocess.run(
        ["sh", "-e", "-c", lines],
        cwd=folder,
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
    )


class Installation(unittest.TestCase):
    def test_the_installed_command_finds_its_own_library_and_goes_again(self):
        with tempfile.TemporaryDirectory(prefix="bladesmith-tests-") as folder:
            prefix = Path(folder, "usr")
            made = make("install", PREFIX=prefix)
            self.assertEqual(made.returncode, 0, made.stderr)
            output = Path(folder, "cold.step")
            arguments = [common.packed("base.step"), common.packed("base.frd"), "-o", output]
            done = subprocess.run(
                [prefix / "bin" / "bladesmith", "morph", *arguments],
                cwd=folder,
                env={"PATH": "/usr/bin:/bin", "HOME": folder},
                capture_output=True,
                text=True,
            )
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertTrue(common.Part.read(str(output)).isValid())
            removed = make("uninstall", PREFIX=prefix)
            self.assertEqual(removed.returncode, 0, removed.stderr)
            self.assertEqual(sorted(prefix.rglob("*")), [])

    def test_a_staged_installation_goes_below_destdir_and_knows_its_prefix(self):
        with tempfile.TemporaryDirectory(prefix="bladesmith-tests-") as folder:
            made = make("install", PREFIX="/opt/blades", DESTDIR=folder)
            self.assertEqual(made.returncode, 0, made.stderr)
            self.assertEqual(os.listdir(folder), ["opt"])
            shell = Path(folder, "opt", "blades", "bin", "bladesmith")
            said = subprocess.run([shell, "--version"], capture_output=True, text=True, check=True)
            self.assertRegex(said.stdout, r"bladesmith \d+\.\d+")
            for text in Path(folder).rglob("*.pc"):
                self.assertNotIn(folder, text.read_text())
            removed = make("uninstall", PREFIX="/opt/blades", DESTDIR=folder)
            self.assertEqual(removed.returncode, 0, removed.stderr)
            self.assertEqual(sorted(Path(folder, "opt", "blades").rglob("*")), [])

    def test_programs_are_built_by_the_lines_of_the_documentation(self):
        with tempfile.TemporaryDirectory(prefix="bladesmith-tests-") as name:
            folder, prefix = Path(name), Path(name, "usr")
            made = make("install", PREFIX=prefix)
            self.assertEqual(made.returncode, 0, made.stderr)
            shutil.copytree(common.ROOT / "examples" / "c", folder / "examples" / "c")
            shutil.copytree(common.ROOT / "examples" / "cpp", folder / "examples" / "cpp")
            shutil.copy(folder / "examples" / "c" / "morph.c", folder / "tool.c")
            data = common.ROOT / "tests" / "consumer" / "data"
            shutil.copy(data / "bar.brep", folder / "hot.brep")
            shutil.copy(data / "bar.frd.gz", folder / "blade.frd.gz")
            packages = str(prefix / "lib" / "pkgconfig")
            built = [
                lines for lines in common.code(common.page("c-api")) if "make" not in lines.split()
            ]
            self.assertEqual(len(built), 4)
            for lines in built:
                lines = lines.replace("/opt/bladesmith", str(prefix))
                done = terminal(lines, folder, PKG_CONFIG_PATH=packages)
                self.assertEqual(done.returncode, 0, f"{lines}\n{done.stderr}")
            for program in ("tool", "morph"):
                self.assertIn("usage: morph", terminal(f"./{program} || true", folder).stderr)
            self.assertIn("deviation_mm", (folder / "report.json").read_text())
            self.assertTrue(common.Part.read(str(folder / "cold.brep")).isValid())


if __name__ == "__main__":
    unittest.main()
