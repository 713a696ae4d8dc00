"""The workbench in FreeCAD's real window, under a virtual display."""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import common

GUI = Path(__file__).with_name("gui")
SCREEN = "-screen 0 1600x1000x24"


def run_in_window(module: str, language: str = "English") -> str:
    """Runs a module of tests inside FreeCAD with a fresh user home; returns what went wrong."""
    with tempfile.TemporaryDirectory(prefix="bladesmith-tests-") as home:
        common.user_home(Path(home), language)
        log = Path(home, "log.txt")
        done = subprocess.run(
            ["xvfb-run", "-a", "-s", SCREEN, "freecad", str(GUI / "run.py")],
            env={
                **os.environ,
                "FREECAD_USER_HOME": home,
                "BLADESMITH_GUI_TESTS": module,
                "BLADESMITH_GUI_LOG": str(log),
            },
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=900,
        )
        if done.returncode == 0:
            return ""
        return log.read_text() if log.exists() else done.stdout


class Window(unittest.TestCase):
    def assert_passes(self, module, language="English"):
        failure = run_in_window(module, language)
        self.assertFalse(failure, failure)

    def test_a_users_walk_with_the_blade(self):
        self.assert_passes("blade_walk")

    def test_awkward_inputs_in_the_panel(self):
        self.assert_passes("awkward_inputs")

    def test_step_through_the_menus_report_and_fem_result(self):
        self.assert_passes("exchange_and_report")

    def test_the_window_in_german(self):
        self.assert_passes("german", "German")


if __name__ == "__main__":
    unittest.main()
