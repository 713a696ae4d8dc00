"""``bladesmith morph``: STEP solid and field in, morphed STEP solid and report out."""

import argparse
import os
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Optional

from .. import __version__
from ..model import FIELD_UNITS_MM, MorphOptions, Report
from ..native import BladesmithError, Field, InputError, Morphed, Part, SetupError
from ..occ import judge, step
from . import interruption
from .faces import selected
from .names_file import names_path, names_text
from .outputs import Outputs, check_target
from .progress import Progress
from .summary import print_summary

EXIT_MISSES_TOLERANCE = 3
_TOOL = f"Bladesmith {__version__}"

_READ_DONE, _CORE_DONE = 0.2, 0.75
"""Fractions of the whole work, for the progress bar."""


@dataclass
class _Result:
    """A morphed solid, judged, with what is needed to write it."""

    shape: object
    hot: object
    attributes: step.SolidAttributes
    report: Report
    nodes: Optional[dict]


def run(options: argparse.Namespace) -> int:
    """Runs the command; returns its exit code."""
    started = time.monotonic()
    _check_targets(options)
    with Progress(options.quiet) as progress, Outputs() as outputs:
        progress("reading the part", 0.0)
        part = step.read(options.part)
        result = _morph(options, part, progress, started)
        written = time.monotonic()
        _write_solid(options, part, result, outputs, progress)
        result.report.seconds["write"] += time.monotonic() - written
        _write_report(options, result, outputs, progress, started)
        outputs.commit()
    missed = result.report.misses(options.tolerance)
    if not options.quiet:
        print_summary(options, result.report)
    if missed:
        print(
            f"bladesmith: the largest deviation, {result.report.deviation_mm.max:.2e} mm, is "
            f"beyond --tolerance {options.tolerance:g} mm; {options.output} was written",
            file=sys.stderr,
        )
    return EXIT_MISSES_TOLERANCE if missed else 0


def _check_targets(options: argparse.Namespace) -> None:
    if Path(options.output).suffix.lower() not in step.SUFFIXES:
        raise InputError(
            f"{options.output}: the result is a STEP file, give a name that ends in .step or .stp"
        )
    targets = {"the result": options.output, "the report": options.json}
    if any(c in "\r\n" for c in options.output):
        raise InputError("--output: a file name must not have line ends")
    inputs = [options.part, options.field] + ([options.mesh] if options.mesh else [])
    seen: list[str] = []
    for what, target in targets.items():
        if target is None:
            continue
        check_target(target, what)
        if os.path.realpath(target) in map(os.path.realpath, inputs + seen):
            raise InputError(f"{target}: {what} would overwrite another file of this command")
        seen.append(target)
    if options.report:
        check_target(options.report, "the pages", directory=True)
        _check_pictures()


def _check_pictures() -> None:
    from importlib.util import find_spec

    if find_spec("matplotlib") is None:
        raise SetupError(
            "--report needs matplotlib: install it ('apt-get install python3-matplotlib' on "
            "Debian), or leave --report out"
        )


def _morph(
    options: argparse.Namespace, part: step.StepPart, progress: Progress, started: float
) -> _Result:
    chosen = step.chosen_solid(part, options.solid)
    settings = _settings(options, part, chosen)
    shape = part.shape if chosen is None else part.shape.Solids[chosen]
    core_part = Part.read(shape.exportBrepToString(), options.part)
    progress("reading the field", _READ_DONE / 2)
    field = Field.read(options.field, options.mesh, options.step or 0)
    read = time.monotonic() - started

    def share(stage: str, fraction: float) -> bool:
        progress(stage, _READ_DONE + (_CORE_DONE - _READ_DONE) * fraction)
        return not interruption.asked()

    with interruption.deferred():
        morphed = Morphed.morph(core_part, field, settings.settings(), share)
    report = Report(morphed.report())
    report.seconds["read"] = read
    cold = step.from_brep(morphed.part().write())
    if chosen is None:
        chosen = step.nearest_solid(part.shape.Solids, cold)
    attributes = part.solids[chosen]
    report.name_faces(attributes.face_names)
    report.warn(*part.warnings)
    nodes = morphed.nodes() if options.report else None
    return _Result(cold, part.shape.Solids[chosen], attributes, report, nodes)


def _settings(
    options: argparse.Namespace, part: step.StepPart, chosen: Optional[int]
) -> MorphOptions:
    if chosen is None and (options.faces or options.fixed):
        raise InputError(
            f"{options.part}: --faces and --fixed count within one solid, and this file holds "
            f"{len(part.solids)}; choose one with --solid"
        )
    names = [] if chosen is None else part.solids[chosen].face_names
    return MorphOptions(
        factor=options.factor,
        tolerance_mm=options.tolerance,
        match_tolerance_mm=options.match_tolerance or 0.0,
        field_unit_mm=FIELD_UNITS_MM[options.field_unit] if options.field_unit else 0.0,
        displacement_scale=options.displacement_scale,
        moving_faces=selected("--faces", options.faces, names),
        fixed_faces=selected("--fixed", options.fixed, names),
        extrapolate=options.extrapolate,
        holdout=options.holdout,
        threads=options.threads or 0,
        face_names=tuple(names),
        solid_name=options.part,
    )


def _write_solid(
    options: argparse.Namespace,
    part: step.StepPart,
    result: _Result,
    outputs: Outputs,
    progress: Progress,
) -> None:
    """Writes the STEP file under its temporary name, reads it back, and judges both."""
    progress("judging the solid", _CORE_DONE)
    verdict = judge.judge(result.shape)
    if not (verdict.valid and verdict.closed):
        _refuse_unless_input_was_bad(options, result, verdict.complaints)
    progress("writing", _CORE_DONE + 0.05)
    name = outputs.file(options.output)
    step.write(result.shape, name, part.product, result.attributes, _TOOL)
    progress("reading back", _CORE_DONE + 0.15)
    again = step.read_back(name)
    tolerance = judge.comparison_tolerance(result.shape)
    different = judge.differences(result.shape, again, tolerance)
    if different:
        raise BladesmithError(
            f"{options.output} was not written: read back, it is not the morphed solid "
            f"({'; '.join(different[:3])})"
        )
    verdict_again = judge.judge(again)
    if verdict.valid and not (verdict_again.valid and verdict_again.closed):
        _refuse_unless_input_was_bad(options, result, verdict_again.complaints)
    result.report.judged(verdict_again.valid and verdict.valid, verdict_again.closed)
    if result.attributes.has_face_names:
        names = outputs.file(names_path(options.output))
        Path(names).write_text(names_text(part.product, result.attributes), "utf-8")


def _refuse_unless_input_was_bad(
    options: argparse.Namespace, result: _Result, complaints: list[str]
) -> None:
    """A bad result of a good solid is ours and not written; of a bad one it is told."""
    what = "; ".join(complaints)
    before = judge.judge(result.hot)
    if before.valid and before.closed:
        raise BladesmithError(
            f"{options.output} was not written: Open CASCADE finds the morphed solid {what}"
        )
    result.report.warn(
        f"the input solid is {'; '.join(before.complaints)}, and so is the result: {what}; "
        "repair the input in the CAD system"
    )


def _write_report(
    options: argparse.Namespace,
    result: _Result,
    outputs: Outputs,
    progress: Progress,
    started: float,
) -> None:
    if options.report:
        from ..report import write_page

        folder = outputs.directory(options.report)
        progress("drawing", _CORE_DONE + 0.2)
        result.report.seconds["total"] = time.monotonic() - started
        shapes = (result.hot, result.shape)
        write_page(folder, result.report, shapes, result.nodes, options.tolerance)
    result.report.seconds["total"] = time.monotonic() - started
    if options.json:
        Path(outputs.file(options.json)).write_text(result.report.to_json(), "utf-8")
