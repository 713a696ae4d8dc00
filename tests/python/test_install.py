"""``make install``: the command works from its new place, without the checkout."""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import common


class Installation(unittest.TestCase):
    def test_the_installed_command_finds_its_own_library(self):
        with tempfile.TemporaryDirectory(prefix="bladesmith-tests-") as folder:
            prefix = Path(folder, "usr")
            plain = {k: v for k, v in os.environ.items() if not k.startswith(("MAKE", "MFLAGS"))}
            made = subprocess.run(
                ["make", "install", f"PREFIX={prefix}"],
                cwd=common.ROOT,
                env=plain,
                capture_output=True,
                text=True,
                stdin=subprocess.DEVNULL,
            )
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


if __name__ == "__main__":
    unittest.main()
