"""The reference pages say what is so: functions, statuses, messages, names in the report, code."""

import re
import subprocess
import tempfile
import unittest
from pathlib import Path

import common
from common import page
from freecad.bladesmith.native import errors

HEADER = (common.ROOT / "include" / "bladesmith" / "bladesmith.h").read_text()


def flat(path: Path) -> str:
    """A source with the texts that it writes on several lines in one."""
    text = re.sub(r"\\\n\s*", "", path.read_text())
    return re.sub(r'"\s*\n\s*f?"', "", text)


class Interface(unittest.TestCase):
    def test_every_function_is_named_and_none_that_is_not_there(self):
        bare = re.sub(r"/\*.*?\*/|//[^\n]*", "", HEADER, flags=re.S)
        declared = set(re.findall(r"\b(bladesmith_\w+)\s*\(", bare))
        splines = {
            name
            for name in declared
            if re.match(
                "bladesmith_(curves?|surfaces?|section|table|parameters|averaged_knots)", name
            )
        }
        table = page("c-api").split("## Functions")[1].split("##")[0]
        self.assertEqual(set(re.findall(r"`(bladesmith_\w+)`", table)), declared - splines)

        kernel = page("kernel")
        short = {name.lstrip("_") for name in re.findall(r"`(\w+)`", kernel)}
        left_out = {n for n in splines if not {n, re.sub("bladesmith_[a-z]+_", "", n)} & short}
        self.assertEqual(left_out, set())
        noun = None
        for row in kernel.split("## Functions")[1].split("##")[0].splitlines():
            column = row.split("|")[2] if row.startswith("|") else ""
            noun = "".join(re.findall(r"C: `(bladesmith_\w+_)…`", column)) or noun
            named = {
                name if name.startswith("bladesmith_") else f"{noun}{name}"
                for name in re.findall(r"`(\w+)`", column)
            }
            self.assertEqual(named - splines, set())
        self.assertEqual(noun, "bladesmith_surface_")

    def test_every_status_has_its_number_exception_and_exit_code(self):
        declared = dict(re.findall(r"BLADESMITH_STATUS_(\w+) = (\d+),", HEADER))
        rows = re.findall(
            r"^\| (\d+) \| `(\w+)` \|[^|]*\| (?:`(\w+)`)? *\|([^|]*)\|$", page("errors"), re.M
        )
        self.assertEqual({name: number for number, name, *_ in rows}, declared)
        for number, name, exception, code in rows:
            kind = type(errors.from_status(int(number), name))
            if exception:
                self.assertEqual(exception, kind.__name__, name)
                self.assertEqual(int(code), kind.exit_code, name)

    def test_the_code_compiles(self):
        text = "\n".join(map(page, ("c-api", "kernel", "c-errors", "threads")))
        kinds = {"c": ("c", ["gcc", "-std=c99"]), "cpp": ("cpp", ["g++", "-std=c++17"])}
        for language, (suffix, compiler) in kinds.items():
            found = common.code(text, language)
            self.assertGreater(len(found), 2, language)
            for source in found:
                with tempfile.NamedTemporaryFile("w", suffix=f".{suffix}") as file:
                    file.write(source)
                    file.flush()
                    flags = ["-Wall", "-Wextra", "-pedantic", "-Werror", "-fsyntax-only"]
                    command = [*compiler, *flags, f"-I{common.ROOT / 'include'}", file.name]
                    done = subprocess.run(command, capture_output=True, text=True)
                self.assertEqual(done.returncode, 0, f"{source}\n{done.stderr}")


class Links(unittest.TestCase):
    def test_links_of_the_files_outside_the_pages_lead_somewhere(self):
        papers = [*common.ROOT.glob("*.md"), *common.ROOT.glob("examples/*/*.md")]
        self.assertGreater(len(papers), 3)
        for paper in papers:
            for link in re.findall(r"\]\(([^)#]+)", paper.read_text()):
                there = link.startswith("https://") or (paper.parent / link).exists()
                self.assertTrue(there, f"{paper.name}: {link}")


class CommandLine(unittest.TestCase):
    def options(self, *command):
        """Long options of a command, as its help tells them."""
        text = common.bladesmith(*command, "--help").stdout
        return set(re.findall(r"^  (?:-\w.*, )?(--[a-z-]+)", text, re.M)) - {"--help"}

    def test_every_option_of_morph_has_its_row_and_no_other_has(self):
        rows = re.findall(r"^\| (`-.*?) \|", page("command-line"), re.M)
        listed = {option for row in rows for option in re.findall(r"--[a-z-]+", row)}
        self.assertEqual(listed, self.options("morph"))

    def test_options_named_elsewhere_are_there(self):
        known = self.options("morph") | self.options("info") | {"--help", "--version"}
        for name in ("tutorial", "errors", "file-formats", "conventions", "../README"):
            named = set(re.findall(r"`(--[a-z-]+)", page(name)))
            self.assertEqual(named - known, set(), name)


class Messages(unittest.TestCase):
    def test_messages_that_are_explained_are_those_of_the_program(self):
        package = common.WORKBENCH / "freecad" / "bladesmith"
        files = [*(common.ROOT / "src").rglob("*.rs"), *package.rglob("*.py")]
        said = "\n".join(map(flat, files))
        quoted = re.findall(r"^\| \*(.*?)\* \|", page("errors"), re.M)
        self.assertGreater(len(quoted), 20)
        unknown = []
        for message in quoted:
            plain = message.replace("\\|", "|")
            for part in re.split(r"…|\.\.\.|Face\d|\d[\d.]*", plain):
                words = part.strip(" ;:()'")
                if len(words) > 3 and words not in said:
                    unknown.append(words)
        self.assertEqual(unknown, [], "the program says nothing of this")


class ReportNames(unittest.TestCase):
    def test_every_name_of_the_report_is_explained(self):
        text = page("file-formats").split("## Report")[1]
        named = set(re.findall(r"`(\w+)`", text))
        report = common.morph(common.packed("base.step"), common.packed("base.frd")).report
        tables = [report, report["tool"], report["input"], report["solid"], report["seconds"]]
        tables += [report["faces"][0], report["edges"][0]]
        for table in tables:
            self.assertEqual(set(table) - named, set(), "not explained in file-formats.md")

    def test_every_variable_of_the_environment_is_listed(self):
        package = common.WORKBENCH / "freecad" / "bladesmith"
        used = set()
        for path in package.rglob("*.py"):
            used |= set(re.findall(r'environ(?:\.get\(|\[)"(BLADESMITH_\w+)"', path.read_text()))
        listed = set(re.findall(r"`(BLADESMITH_[A-Z]+(?:_[A-Z]+)*)(?:=1)?`", page("conventions")))
        self.assertEqual(listed, used)


if __name__ == "__main__":
    unittest.main()
