"""A morph from shape and field to a judged solid, the same wherever it is asked for.

Equal jobs give equal results, bit for bit. Any thread may run one.
"""

import time
from dataclasses import dataclass
from pathlib import Path
from typing import Callable, Optional

from .. import log, native
from ..model import MorphOptions, Report
from ..native import BladesmithError, Field, Morphed, Part
from ..occ import judge, step

Progress = Callable[[str, float], bool]
"""Gets the stage and the fraction done; returns False to cancel."""


@dataclass(frozen=True)
class FieldFile:
    """Displacements in a file, with the deck of its mesh; step 0 is the last."""

    path: str
    mesh: Optional[str] = None
    step: int = 0

    def read(self) -> Field:
        """Reads the file. Raises :class:`InputError`."""
        return Field.read(self.path, self.mesh, self.step)

    def state(self) -> tuple:
        """Changes when a file does."""
        paths = [Path(path) for path in (self.path, self.mesh) if path]
        stats = [path.stat() if path.exists() else None for path in paths]
        return self, [(stat.st_mtime_ns, stat.st_size) if stat else None for stat in stats]


@dataclass(frozen=True)
class FieldNodes:
    """Displacements by node: ids (n), points and displacements (n triples each), one unit."""

    name: str
    ids: tuple
    points: tuple
    displacements: tuple

    def read(self) -> Field:
        """The field. Raises :class:`InputError`."""
        return Field.from_arrays(self.name, self.ids, self.points, self.displacements)

    def state(self) -> tuple:
        """Changes when a value does."""
        return (self,)


@dataclass(frozen=True)
class Job:
    """One morph: Open CASCADE's shape with the name that messages use, a field, the settings."""

    shape: object
    name: str
    field: object
    options: MorphOptions

    def state(self) -> tuple:
        """Equal for jobs with equal results, as long as this job is kept and no file changes."""
        return self.shape.hashCode(), self.name, self.options, self.field.state()

    def part(self) -> Part:
        """The shape for the core. Raises :class:`InputError`."""
        return Part.read(self.shape.exportBrepToString(), self.name)


@dataclass
class Result:
    """The morphed solid with the core's report and its figures by node and face."""

    brep: str
    shape: object
    report: Report
    morphed: Morphed

    def nodes(self) -> dict:
        """Arrays by node and face, see :meth:`Morphed.nodes`."""
        return self.morphed.nodes()


def run(job: Job, progress: Optional[Progress] = None) -> Result:
    """Morphs; the shape is not judged yet.

    Raises :class:`BladesmithError`, :class:`Cancelled` among them.
    """
    started = time.monotonic()
    part, field = job.part(), job.field.read()
    read = time.monotonic() - started
    morphed = Morphed.morph(part, field, job.options.settings(), progress)
    report = Report(morphed.report())
    report.seconds["read"] = read
    brep = morphed.part().write()
    return Result(brep, step.from_brep(brep), report, morphed)


def check(job: Job, progress: Optional[Progress] = None) -> tuple[dict, dict]:
    """What the field holds, and how it lies on the part: :meth:`Field.info`, :func:`native.check`.

    Raises what a run would refuse the input for.
    """
    part, field = job.part(), job.field.read()
    return field.info(), native.check(part, field, job.options.settings(), progress)


@log.kept("FreeCAD, morph")
def complete(job: Job, progress: Optional[Progress] = None) -> Result:
    """Morphs and has Open CASCADE judge the solid; its verdict is in the report.

    A bad result of a good solid is a defect and refused, of a bad one it is told in the report.
    Raises :class:`BladesmithError`, :class:`Cancelled` among them.
    """
    result = run(job, progress)
    verdict = judge.judge(result.shape)
    if not (verdict.valid and verdict.closed):
        solids = job.shape.Solids
        hot = solids[step.nearest_solid(solids, result.shape)]
        accept(result.report, verdict, hot, f"{job.name} was not morphed")
    result.report.judged(verdict.valid, verdict.closed)
    return result


def accept(report: Report, verdict: judge.Verdict, hot, target: str) -> None:
    """Refuses a bad result of a good solid; of a bad one, tells it in the report.

    ``target`` says what is not made. Raises :class:`BladesmithError`.
    """
    if verdict.valid and verdict.closed:
        return
    what = "; ".join(verdict.complaints)
    before = judge.judge(hot)
    if before.valid and before.closed:
        raise BladesmithError(f"{target}: Open CASCADE finds the morphed solid {what}")
    report.warn(
        f"the input solid is {'; '.join(before.complaints)}, and so is the result: {what}; "
        "repair the input in the CAD system",
        first=True,
    )
