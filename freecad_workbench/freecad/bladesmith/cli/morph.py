"""``bladesmith morph``: STEP solid and field in, morphed STEP solid and report out."""

import argparse
import os
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from typing import Optional

from ..model import DEFAULT_FACTOR, FIELD_UNITS_MM, MorphOptions, Report
from ..native import InputError, SetupError
from ..occ import judge, step
from ..operations.export import morphed_product, write_step
from ..operations.faces import selected
from ..operations.morph import FieldFile, Job, accept
from ..operations.morph import run as run_job
from ..operations.outputs import STDOUT, Outputs, check_target
from . import interruption
from .progress import Progress
from .summary import print_summary

EXIT_MISSES_TOLERANCE = 3

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
        interruption.too_late()
        outputs.commit()
    missed = result.report.misses(options.tolerance)
    if not options.quiet:
        print_summary(options, result.report)
    if options.json == STDOUT:
        sys.stdout.write(result.report.to_json())
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
        if target is None or (target == STDOUT and what == "the report"):
            continue
        check_target(target, what)
        if os.path.realpath(target) in map(os.path.realpath, inputs + seen):
            raise InputError(f"{target}: {what} would overwrite another file of this command")
        seen.append(target)
    if options.report:
        _check_page(options.report)


def _check_page(folder: str) -> None:
    from importlib.util import find_spec

    if Path(folder).suffix.lower() in (".html", ".htm"):
        raise InputError(
            f"{folder}: --report takes a folder, in which it writes report.html and its pictures; "
            f"give {Path(folder).with_suffix('')}"
        )
    check_target(folder, "--report", directory=True)
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
    field = FieldFile(options.field, options.mesh, options.step or 0)
    job = Job(shape, options.part, field, settings)
    read = time.monotonic() - started
    progress("reading the field", _READ_DONE / 2)

    def share(stage: str, fraction: float) -> bool:
        progress(stage, _READ_DONE + (_CORE_DONE - _READ_DONE) * fraction)
        return not interruption.asked()

    with interruption.deferred():
        done = run_job(job, share)
    report = done.report
    report.seconds["read"] += read
    if chosen is None:
        chosen = step.nearest_solid(part.shape.Solids, done.shape)
    attributes = part.solids[chosen]
    report.name_faces(attributes.face_names)
    report.warn(*part.warnings)
    nodes = done.nodes() if options.report else None
    return _Result(done.shape, part.shape.Solids[chosen], attributes, report, nodes)


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
        factor=DEFAULT_FACTOR if options.factor is None else options.factor,
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
    accept(result.report, verdict, result.hot, f"{options.output} was not written")
    progress("writing", _CORE_DONE + 0.05)
    product = morphed_product(options.output, part.product)
    written = write_step(outputs, options.output, result.shape, product, result.attributes)
    if verdict.valid:
        accept(result.report, written, result.hot, f"{options.output} was not written")
    result.report.judged(written.valid and verdict.valid, written.closed)


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
        began = time.monotonic()
        shapes = (result.hot, result.shape)
        write_page(folder, result.report, shapes, result.nodes, options.tolerance)
        result.report.seconds["draw"] = time.monotonic() - began
    result.report.seconds["total"] = time.monotonic() - started
    if options.json and options.json != STDOUT:
        Path(outputs.file(options.json)).write_text(result.report.to_json(), "utf-8")
