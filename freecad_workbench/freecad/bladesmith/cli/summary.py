"""The lines that a morph prints: warnings, then the main figures."""

import argparse
import sys

from ..model import Report


def print_summary(options: argparse.Namespace, report: Report) -> None:
    """Prints warnings to standard error and the figures to standard output."""
    sys.stdout.flush()
    for warning in report.warnings:
        print(f"warning: {warning}", file=sys.stderr)
    given, solid = report.input, report.solid
    checked = {True: "valid", False: "not valid", None: "not judged"}[solid["valid"]]
    print(
        f"{options.output}: {solid['faces']} faces, {checked}, "
        f"{'closed' if solid['closed'] else 'open'}"
    )
    print(
        f"  field               {given['nodes']} nodes, step {given['step']}, "
        f"factor {given['factor']:g}"
    )
    worst = report.worst_face()
    place = f"   ({worst.name})" if worst else ""
    print(f"  deviation           {_spread(report.deviation_mm)}{place}")
    if report.holdout_mm:
        print(f"  hold-out            {_spread(report.holdout_mm)}")
    edge = report.widest_edge()
    if edge:
        gap = edge.gap_mm
        print(f"  largest gap         {gap.after:.1e} mm, before {gap.before:.1e}")
    for held, name in ((False, "tangent edges"), (True, "beside held faces")):
        edge = report.most_opened_edge(held)
        if edge:
            angle = edge.angle_deg
            print(f"  {name:<19} at most {angle.after - angle.before:+.4f}° of change")
    volume = report.volume_mm3
    print(f"  volume              {volume.before:.6g} -> {volume.after:.6g} mm³")
    print(f"  time                {report.seconds['total']:.2f} s")
    for what, target in (("report", options.json), ("page", options.report)):
        if target:
            print(f"  {what:<19} {target}{'/report.html' if what == 'page' else ''}")


def _spread(spread) -> str:
    return f"mean {spread.mean:.1e}, max {spread.max:.1e} mm"
