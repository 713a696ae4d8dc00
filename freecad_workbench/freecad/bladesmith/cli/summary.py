"""The lines that a morph prints: warnings, then the main figures."""

import argparse
import sys

from ..model import DEFAULT_FACTOR, Report
from ..model.words import counted, direction
from ..operations.outputs import STDOUT


def print_summary(options: argparse.Namespace, report: Report) -> None:
    """Prints warnings to standard error and the figures to standard output.

    Where the report itself goes to standard output, there are no figures beside it.
    """
    sys.stdout.flush()
    for warning in report.warnings:
        print(f"warning: {warning}", file=sys.stderr)
    if options.factor is None:
        print(
            f"notice: without --factor it is {DEFAULT_FACTOR:g}: {direction(DEFAULT_FACTOR)}; "
            "hot to cold is --factor -1",
            file=sys.stderr,
        )
    if options.json != STDOUT:
        print("\n".join(_figures(options, report)))


def _figures(options: argparse.Namespace, report: Report) -> list[str]:
    given = report.input
    lines = [
        f"{options.output}: {_state(report)}",
        f"  field               {counted(given['nodes'], 'node')}, step {given['step']}",
        f"  factor              {given['factor']:g}: {direction(given['factor'])}",
        f"  deviation           {_spread(report.deviation_mm)}{_place(report.worst_face())}",
    ]
    if report.holdout_mm:
        place = _place(report.worst_holdout_face())
        lines.append(f"  hold-out            {_spread(report.holdout_mm)}{place}")
    edge = report.widest_edge()
    if edge:
        gap = edge.gap_mm
        lines.append(f"  largest gap         {gap.after:.1e} mm, before {gap.before:.1e}")
    for held, name in ((False, "tangent edges"), (True, "beside held faces")):
        edge = report.most_opened_edge(held)
        if edge:
            angle = edge.angle_deg
            lines.append(f"  {name:<19} at most {angle.after - angle.before:+.4f}° of change")
    volume = report.volume_mm3
    lines.append(f"  volume              {volume.before:.6g} -> {volume.after:.6g} mm³")
    lines.append(f"  time                {report.seconds['total']:.2f} s")
    for what, target in (("report", options.json), ("page", options.report)):
        if target:
            page = "/report.html" if what == "page" else ""
            lines.append(f"  {what:<19} {target}{page}")
    return lines


def _state(report: Report) -> str:
    """What the result is, the worst first."""
    solid = report.solid
    said = ["FOLDED"] if solid["folded"] else []
    said.append(counted(solid["faces"], "face"))
    said.append({True: "valid", False: "not valid", None: "not judged"}[solid["valid"]])
    said.append("closed" if solid["closed"] else "open")
    return ", ".join(said)


def _spread(spread) -> str:
    return f"mean {spread.mean:.1e}, max {spread.max:.1e} mm"


def _place(face) -> str:
    return f"   ({face.name})" if face else ""
