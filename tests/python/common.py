"""What the tests share: places, the command line, morphs that are run once, and truth."""

import csv
import functools
import gzip
import io
import json
import os
import re
import subprocess
import sys
import tempfile
import unittest
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
WORKBENCH = ROOT / "freecad_workbench"
LAUNCHER = WORKBENCH / "bladesmith"
P5 = ROOT / "tests" / "data" / "p5"
EXAMPLE = ROOT / "examples" / "compressor_blade"
AWKWARD = ROOT / "target" / "tmp" / "p5"
EPOCH = "1700000000"

sys.path.insert(0, str(WORKBENCH))

from freecad.bladesmith.occ.runtime import part_module  # noqa: E402

Part = part_module()
"""FreeCAD's module, imported before numpy as it must be."""

FreeCAD = sys.modules["FreeCAD"]

_RESULTS = tempfile.TemporaryDirectory(prefix="bladesmith-tests-")

# The tests must not fill the user's log.
os.environ["BLADESMITH_LOG"] = str(Path(_RESULTS.name, "bladesmith.log"))


def bladesmith(*arguments, **environment) -> subprocess.CompletedProcess:
    """Runs the command line with a fixed header time; output as text."""
    settings = {**os.environ, "SOURCE_DATE_EPOCH": EPOCH, **environment}
    settings.pop("BLADESMITH_DEBUG", None)
    return subprocess.run(
        [str(LAUNCHER), *map(str, arguments)],
        env=settings,
        capture_output=True,
        text=True,
        stdin=subprocess.DEVNULL,
        timeout=600,
    )


@dataclass(frozen=True)
class Morph:
    """A finished ``bladesmith morph``."""

    code: int
    stdout: str
    stderr: str
    output: Path
    report: dict

    @property
    def warnings(self) -> str:
        return "\n".join(self.report["warnings"])

    @functools.cached_property
    def solid(self):
        """The result, read from its STEP file."""
        return Part.read(str(self.output))


@functools.cache
def morph(part: Path, field: Path, *options: str) -> Morph:
    """Runs ``bladesmith morph`` once for the same arguments, in a folder of its own."""
    folder = Path(tempfile.mkdtemp(dir=_RESULTS.name))
    output, report = folder / "cold.step", folder / "report.json"
    done = bladesmith("morph", part, field, "-o", output, "--json", report, *options)
    document = json.loads(report.read_text()) if report.exists() else {}
    return Morph(done.returncode, done.stdout, done.stderr, output, document)


_USER_CONFIGURATION = """\
<?xml version="1.0" encoding="UTF-8" standalone="no" ?>
<FCParameters><FCParamGroup Name="Root"><FCParamGroup Name="BaseApp">
<FCParamGroup Name="Preferences"><FCParamGroup Name="General">
<FCText Name="AutoloadModule">PartWorkbench</FCText>
<FCText Name="Language">{language}</FCText>
</FCParamGroup></FCParamGroup></FCParamGroup></FCParamGroup></FCParameters>
"""


def user_home(folder: Path, language: str = "English") -> None:
    """Makes ``folder`` a user home of FreeCAD in which the add-on is installed, by a link."""
    (folder / "Mod").mkdir()
    (folder / "Mod" / "Bladesmith").symlink_to(ROOT)
    (folder / "user.cfg").write_text(_USER_CONFIGURATION.format(language=language))


def page(name: str) -> str:
    """The source of a page of the documentation."""
    return (ROOT / "docs" / f"{name}.md").read_text()


def code(text: str, language: str = "") -> list[str]:
    """The code of a page in one language; that of terminals has none."""
    found = re.findall(r"^```(\w*)\n(.*?)^```$", text, re.M | re.S)
    return [lines for name, lines in found if name == language]


def packed(name: str) -> Path:
    """A small case that ships with the tests: ``base.step``, ``base.frd``, ``base.inp`` ..."""
    return P5 / f"{name}.gz"


def awkward(name: str) -> Path:
    """A broken or awkward results file made from ``base.frd``."""
    path = AWKWARD / f"{name}.frd"
    if not path.exists():
        raise FileNotFoundError(f"{path}: run 'make awkward-files' first ('make test' does)")
    return path


def shared_data(case: str) -> Path:
    """The folder of a larger case, or a skip that says why."""
    folder = os.environ.get("BLADESMITH_DATA")
    if not folder:
        raise unittest.SkipTest(f"{case}: BLADESMITH_DATA names no folder with the larger cases")
    path = Path(folder) / case
    if not path.is_dir():
        raise unittest.SkipTest(f"{case}: not in {folder} (BLADESMITH_DATA)")
    return path


@dataclass(frozen=True)
class Probe:
    """A point of the finite-element surface between the nodes, with its displacement."""

    point: object
    displacement: object
    face: int


def probes(path: Path) -> list:
    """The rows of a probes file, gzipped or not, as FreeCAD vectors."""
    data = path.read_bytes()
    text = (gzip.decompress(data) if path.suffix == ".gz" else data).decode()
    rows = list(csv.reader(io.StringIO(text)))
    found = []
    for row in rows[1:]:
        x, y, z, ux, uy, uz = map(float, row[:6])
        found.append(Probe(FreeCAD.Vector(x, y, z), FreeCAD.Vector(ux, uy, uz), int(row[6])))
    return found


def frd_rows(path: Path) -> list:
    """(number, point, displacement) of the nodes of a small ASCII ``.frd`` file, gzipped."""
    lines = gzip.decompress(path.read_bytes()).decode().splitlines()
    starts = [i for i, line in enumerate(lines) if line.split()[:1] == ["2C"]]
    moved = [i for i, line in enumerate(lines) if line.startswith(" -4") and "DISP" in line]
    points, displacements = (_frd_block(lines, start) for start in (starts[0], moved[-1]))
    return [(n, points[n], displacements[n]) for n in sorted(points)]


def _frd_block(lines: list, start: int) -> dict:
    found = {}
    for line in lines[start + 1 :]:
        if line.startswith(" -3"):
            return found
        if line.startswith(" -1"):
            values = [float(line[13 + 12 * k : 25 + 12 * k]) for k in range(3)]
            found[int(line[3:13])] = tuple(values)
    return found


def probe_errors(hot, cold, rows, factor: float) -> list:
    """By how much, in mm, the cold solid misses each probe: a vector, so sliding counts.

    The foot of a probe on the hot face keeps its parameters on the cold one.
    """
    before = [face.Surface for face in hot.Faces]
    after = [face.Surface for face in cold.Faces]
    errors = []
    for row in rows:
        u, v = before[row.face - 1].parameter(row.point)
        moved = before[row.face - 1].value(u, v) + row.displacement * factor
        errors.append(moved.distanceToPoint(after[row.face - 1].value(u, v)))
    return errors


def mean(values) -> float:
    """Arithmetic mean."""
    return sum(values) / len(values)
