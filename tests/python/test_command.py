"""The command line: exit codes, messages, and that nothing half-written is ever left."""

import argparse
import contextlib
import copy
import io
import json
import os
import pty
import re
import select
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

import common
from common import bladesmith, packed
from freecad.bladesmith.cli.summary import print_summary
from freecad.bladesmith.model import Report

BASE = (packed("base.step"), packed("base.frd"))


class InFolder(unittest.TestCase):
    """A test with an empty folder, which it must leave with the expected files only."""

    def setUp(self):
        holder = tempfile.TemporaryDirectory(prefix="bladesmith-tests-")
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)

    def files(self):
        return sorted(path.name for path in self.folder.iterdir())

    def assert_refused(self, done, *words):
        """One line on standard error with these words, exit code 2, no file."""
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(done.stdout, "")
        lines = done.stderr.strip().splitlines()
        self.assertEqual(len(lines), 1, done.stderr)
        for word in words:
            self.assertIn(word, lines[0])
        self.assertEqual(self.files(), [])


class Usage(InFolder):
    def test_help_tells_options_and_exit_codes(self):
        for arguments in (["--help"], ["morph", "--help"], ["info", "--help"]):
            done = bladesmith(*arguments)
            self.assertEqual(done.returncode, 0)
        text = bladesmith("morph", "--help").stdout
        for option in ("--factor", "--mesh", "--tolerance", "--extrapolate", "exit codes"):
            self.assertIn(option, text)

    def test_the_version_is_that_of_the_crate(self):
        manifest = (common.ROOT / "Cargo.toml").read_text()
        version = re.search(r'^version = "([^"]+)"', manifest, re.M).group(1)
        self.assertEqual(bladesmith("--version").stdout, f"bladesmith {version}\n")
        package = (common.ROOT / "package.xml").read_text()
        self.assertIn(f"<version>{version}</version>", package)

    def test_wrong_options_end_with_2_and_name_the_option(self):
        cases = {
            "--factor": "x",
            "--tolerance": "0",
            "--step": "0",
            "--solid": "-1",
            "--threads": "two",
            "--field-unit": "yard",
            "--displacement-scale": "nan",
        }
        for option, value in cases.items():
            done = bladesmith("morph", *BASE, "-o", self.folder / "c.step", f"{option}={value}")
            self.assertEqual(done.returncode, 2, option)
            self.assert_refused(
                done, f"argument {option}:", f"'{value}'", "'bladesmith morph --help'"
            )

    def test_what_is_missing_is_said_in_one_line(self):
        self.assert_refused(bladesmith(), "COMMAND", "'bladesmith --help'")
        self.assert_refused(bladesmith("morph", *BASE), "-o/--output", "'bladesmith morph --help'")

    def test_it_runs_as_a_module_and_through_links_from_any_folder(self):
        link = self.folder / "bladesmith"
        link.symlink_to(common.LAUNCHER)
        (self.folder / "numpy.py").write_text("raise SystemExit('the wrong numpy')")
        linked = [str(link), "--version"]
        module = ["/usr/bin/python3", "-m", "freecad.bladesmith", "--version"]
        environment = {**os.environ, "PYTHONPATH": str(common.WORKBENCH)}
        for command in (linked, module):
            done = subprocess.run(
                command, cwd=self.folder, env=environment, capture_output=True, text=True
            )
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertTrue(done.stdout.startswith("bladesmith "))


class Refusals(InFolder):
    def test_the_result_must_be_a_step_file(self):
        done = bladesmith("morph", *BASE, "-o", self.folder / "cold.stl")
        self.assert_refused(done, "cold.stl", ".step or .stp")

    def test_missing_inputs_are_named(self):
        cases = [
            (("none.step", BASE[1]), "none.step"),
            ((BASE[0], "none.frd"), "none.frd"),
            ((*BASE, "--mesh", "none.inp"), "none.inp"),
        ]
        for arguments, name in cases:
            done = bladesmith("morph", *arguments, "-o", self.folder / "c.step")
            self.assert_refused(done, f"{name}: No such file or directory; give an existing")
            self.assertNotIn("os error", done.stderr)

    def test_a_folder_is_no_input(self):
        done = bladesmith("morph", common.P5, BASE[1], "-o", self.folder / "c.step")
        self.assert_refused(done, "p5")

    def test_a_field_in_place_of_the_part_is_refused(self):
        done = bladesmith("morph", BASE[1], BASE[0], "-o", self.folder / "c.step")
        self.assert_refused(done, "base.frd", "no STEP file")

    def test_inputs_are_never_overwritten(self):
        part = self.folder / "hot.step"
        part.write_bytes(b"ISO-10303-21;")
        for option in ("-o", "--json"):
            arguments = [part, BASE[1], option, part]
            if option == "--json":
                arguments += ["-o", self.folder / "c.step"]
            done = bladesmith("morph", *arguments)
            self.assertEqual(done.returncode, 2)
            self.assertIn("would overwrite", done.stderr)
        self.assertEqual(part.read_bytes(), b"ISO-10303-21;")

    def test_folders_that_do_not_exist_are_refused_before_any_work(self):
        for option in ("-o", "--json", "--report"):
            arguments = ["morph", *BASE, option, self.folder / "none" / "x.step"]
            if option != "-o":
                arguments += ["-o", self.folder / "c.step"]
            done = bladesmith(*arguments)
            self.assert_refused(done, "none", "does not exist; make it first")

    def test_faces_and_solids_that_are_not_there_are_refused(self):
        cases = {
            ("--faces", "Face9"): "give Face1 to Face6",
            ("--fixed", "tip"): "no face 'tip'",
            ("--solid", "3"): "there is no solid 3: the part has 1; leave --solid out",
        }
        for options, words in cases.items():
            done = bladesmith("morph", *BASE, "-o", self.folder / "c.step", *options)
            self.assert_refused(done, words)

    def test_a_page_needs_a_folder(self):
        target, file = self.folder / "c.step", self.folder / "taken"
        done = bladesmith("morph", *BASE, "-o", target, "--report", self.folder / "pages.html")
        self.assert_refused(done, "--report takes a folder", f"give {self.folder / 'pages'}")
        file.write_text("")
        done = bladesmith("morph", *BASE, "-o", target, "--report", file)
        self.assertIn("for --report a folder is expected, and this is a file", done.stderr)

    def test_a_deck_in_place_of_the_results_is_called_one(self):
        self.assert_refused(
            bladesmith("info", packed("base.inp")), "base.inp.gz: a deck (.inp) has"
        )

    def test_faces_of_several_solids_need_the_solid_they_count_in(self):
        arguments = ["morph", packed("two_solids.step"), BASE[1], "-o", self.folder / "c.step"]
        self.assert_refused(bladesmith(*arguments, "--fixed", "1"), "holds 2", "--solid")
        done = bladesmith(*arguments, "--fixed", "1", "--solid", "1", "--quiet")
        self.assertIn(done.returncode, (0, 3), done.stderr)

    def test_tracebacks_are_for_those_who_ask(self):
        arguments = ("morph", "none.step", BASE[1], "-o", self.folder / "c.step")
        self.assertNotIn("Traceback", bladesmith(*arguments).stderr)
        asked = subprocess.run(
            [str(common.LAUNCHER), *map(str, arguments)],
            env={**os.environ, "BLADESMITH_DEBUG": "1"},
            capture_output=True,
            text=True,
        )
        self.assertIn("Traceback", asked.stderr)

    def test_without_freecad_the_remedy_is_told(self):
        done = bladesmith("info", BASE[0], BLADESMITH_FREECAD_LIB="/nowhere")
        self.assertEqual(done.returncode, 1)
        self.assertIn("apt-get install freecad-python3", done.stderr)


class Results(InFolder):
    def test_a_morph_leaves_exactly_the_files_asked_for(self):
        options = ["--json", self.folder / "r.json", "--report", self.folder / "pages"]
        done = bladesmith(
            "morph", *BASE, "--mesh", packed("base.inp"), "-o", self.folder / "c.step", *options
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.files(), ["c.step", "pages", "r.json"])
        self.assertIn("report.html", os.listdir(self.folder / "pages"))
        for word in ("6 faces, valid, closed", "deviation", "largest gap", "volume"):
            self.assertIn(word, done.stdout)
        seconds = json.loads((self.folder / "r.json").read_text())["seconds"]
        parts = sum(value for stage, value in seconds.items() if stage != "total")
        self.assertTrue(0.9 * seconds["total"] < parts <= seconds["total"], seconds)

    def test_the_way_a_factor_moves_the_part_is_said_and_a_default_is_noticed(self):
        cases = {(): "1: displacements added (cold to hot)"}
        cases["--factor", "1"] = cases[()]
        cases["--factor", "-1"] = "-1: displacements taken away (hot to cold)"
        for options, words in cases.items():
            done = common.morph(*BASE, *options)
            self.assertRegex(done.stdout, rf"(?m)^  factor +{re.escape(words)}$")
            self.assertEqual("notice: without --factor" in done.stderr, not options, done.stderr)

    def test_the_report_can_go_to_standard_output_alone(self):
        done = bladesmith("morph", *BASE, "-o", self.folder / "c.step", "--json", "-")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(json.loads(done.stdout)["solid"]["faces"], 6)
        self.assertEqual(self.files(), ["c.step"])
        self.assertIn("notice: without --factor", done.stderr)

    def test_a_folded_result_is_said_first(self):
        report = Report(copy.deepcopy(common.morph(*BASE).report))
        report.solid["folded"] = 3
        options = argparse.Namespace(output="c.step", json=None, report=None, factor=1.0)
        quiet = contextlib.redirect_stderr(io.StringIO())
        with quiet, contextlib.redirect_stdout(io.StringIO()) as said:
            print_summary(options, report)
        self.assertTrue(said.getvalue().startswith("c.step: FOLDED, 6 faces, valid"))

    def test_the_face_of_the_largest_hold_out_error_is_named(self):
        done = common.morph(*BASE, "--holdout")
        faces = done.report["faces"]
        worst = max(faces, key=lambda face: face["holdout_mm"]["max"])["name"]
        self.assertRegex(done.stdout, rf"hold-out .*\({worst}\)")

    def test_quiet_prints_nothing(self):
        done = bladesmith("morph", *BASE, "-o", self.folder / "c.step", "--quiet")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))

    def test_a_missed_tolerance_ends_with_3_and_the_result_is_written(self):
        output = self.folder / "c.step"
        done = bladesmith("morph", *BASE, "-o", output, "--tolerance", "1e-9")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("beyond --tolerance 1e-09 mm", done.stderr)
        self.assertTrue(common.Part.read(str(output)).isValid())

    def test_the_report_has_the_names_that_users_rely_on(self):
        report = common.morph(*BASE).report
        names = "tool input faces edges deviation_mm holdout_mm unmatched_nodes solid warnings"
        self.assertLessEqual({*names.split(), "seconds"}, set(report))
        self.assertEqual(report["tool"]["name"], "bladesmith")
        self.assertEqual(report["solid"]["faces"], 6)
        self.assertIs(report["solid"]["valid"], True)
        self.assertIs(report["solid"]["closed"], True)
        stages = {"read", "associate", "fit", "rebuild", "write", "total"}
        self.assertEqual(set(report["seconds"]), stages)
        parts = sum(report["seconds"][stage] for stage in stages - {"total"})
        self.assertLessEqual(parts, report["seconds"]["total"] * 1.05)

    def test_fixed_faces_stay_and_only_moving_ones_move(self):
        for options in (("--fixed", "Face1"), ("--faces", "2,3,4,5,6")):
            done = common.morph(*BASE, *options)
            self.assertIn(done.code, (0, 3), done.stderr)
            hot = common.Part.read(str(common.morph(*BASE, "--factor", "0").output))
            before, after = hot.Faces[0].Surface, done.solid.Faces[0].Surface
            for u, v in ((0.2, 0.3), (0.5, 0.9), (0.7, 0.1)):
                self.assertLess(before.value(u, v).distanceToPoint(after.value(u, v)), 1e-6)


class Interruption(InFolder):
    def start(self, *options):
        return subprocess.Popen(
            [str(common.LAUNCHER), "morph", *map(str, BASE), "-o", str(self.folder / "c.step")]
            + list(options),
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )

    def test_stopping_at_any_moment_leaves_the_folder_as_it_was(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            for delay in (0.15, 0.3, 0.45, 0.6, 0.75):
                process = self.start("--json", str(self.folder / "r.json"))
                time.sleep(delay)
                process.send_signal(number)
                _out, error = process.communicate(timeout=60)
                self.assertNotIn("Traceback", error)
                if process.returncode == 0:
                    self.assertEqual(self.files(), ["c.step", "r.json"])
                    for path in self.folder.iterdir():
                        path.unlink()
                else:
                    self.assertEqual(self.files(), [], f"{number.name} after {delay} s: {error}")

    def test_a_terminal_sees_progress(self):
        ours, theirs = pty.openpty()
        process = subprocess.Popen(
            [str(common.LAUNCHER), "morph", *map(str, BASE), "-o", str(self.folder / "c.step")],
            stdout=subprocess.DEVNULL,
            stderr=theirs,
        )
        os.close(theirs)
        seen = b""
        while process.poll() is None or select.select([ours], [], [], 0)[0]:
            if select.select([ours], [], [], 0.2)[0]:
                try:
                    seen += os.read(ours, 4096)
                except OSError:
                    break
        os.close(ours)
        self.assertEqual(process.wait(), 0)
        self.assertRegex(seen.decode(), r"\[#+ +\] +\d+%")


class Info(InFolder):
    def test_a_part_is_told_in_engineering_terms(self):
        done = bladesmith("info", packed("two_solids.step"), "--json", self.folder / "i.json")
        self.assertEqual(done.returncode, 0, done.stderr)
        for word in ("2 solids", "solid 1: 6 faces", "valid, closed", "degree 3x3, 35x41 poles"):
            self.assertIn(word, done.stdout)
        document = json.loads((self.folder / "i.json").read_text())
        self.assertEqual([len(solid["faces"]) for solid in document["solids"]], [6, 6])

    def test_a_field_is_told_in_engineering_terms(self):
        done = bladesmith("info", common.awkward("two_steps"))
        self.assertEqual(done.returncode, 0, done.stderr)
        for word in ("nodes 2425", "1250 C3D10", "step 1", "step 2", "largest displacement 0.2"):
            self.assertIn(word, done.stdout)

    def test_it_can_go_to_standard_output_alone_as_json(self):
        done = bladesmith("info", packed("base.frd"), "--json", "-")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(json.loads(done.stdout)["nodes"], 2425)
        self.assertFalse(Path("-").exists())

    def test_a_field_of_one_node_is_told_to_be_too_small_and_guesses_no_unit(self):
        field = self.folder / "one.csv"
        field.write_text("id,x,y,z,dx,dy,dz\n7,1,2,3,0.1,0,0\n")
        done = bladesmith("info", field)
        self.assertIn("all nodes in one place, (1, 2, 3)", done.stdout)
        self.assertIn("only 1 node with a displacement: a morph needs at least 4", done.stdout)
        self.assertNotIn("by the size", done.stdout)
        done = bladesmith("morph", BASE[0], field, "-o", self.folder / "c.step")
        self.assertEqual(done.returncode, 2)
        self.assertIn("one.csv: only 1 node with a displacement: a morph needs", done.stderr)

    def test_a_reader_that_goes_away_is_no_error_to_read(self):
        process = subprocess.Popen(
            [str(common.LAUNCHER), "info", str(packed("base.step"))],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        process.stdout.close()
        self.assertEqual(process.stderr.read(), "")
        process.stderr.close()
        self.assertEqual(process.wait(), 1)

    def test_other_files_are_refused(self):
        self.assert_refused(bladesmith("info", common.awkward("not_frd")), "not_frd.frd")
        self.assert_refused(bladesmith("info", "none.frd"), "none.frd")


if __name__ == "__main__":
    unittest.main()
