"""The tables of the page, as HTML."""

from collections.abc import Iterable, Sequence
from html import escape
from typing import Optional

from ..model import Report
from ..model.words import direction
from .words import length, opened


def table(
    heads: Sequence[str], rows: Iterable[tuple[Sequence[str], str]], text_columns: int = 1
) -> str:
    """A table of (cells, class) rows; the first ``text_columns`` columns hold words."""
    lines = ["<table><thead><tr>", *_cells("th", heads, text_columns), "</tr></thead><tbody>"]
    for cells, kind in rows:
        lines.append(f'<tr class="{kind}">' if kind else "<tr>")
        lines += [*_cells("td", cells, text_columns), "</tr>"]
    return "".join([*lines, "</tbody></table>"])


def _cells(tag: str, cells: Sequence[str], text_columns: int) -> list[str]:
    return [
        f"<{tag}{' class=text' if i < text_columns else ''}>{escape(cell)}</{tag}>"
        for i, cell in enumerate(cells)
    ]


def faces_table(report: Report, tolerance_mm: float) -> str:
    """All faces, the largest deviation first; those beyond the tolerance are marked."""
    heads = ["Face", "Name", "Degree", "Poles", "Nodes", "Spans", "filled"]
    heads += ["Foot max", "Deviation mean", "max", "Re-projected max"]
    if report.holdout_mm:
        heads += ["Hold-out mean", "max"]
    rows = []
    for face in sorted(report.faces, key=lambda face: -face.deviation_mm.max):
        name = face.name + (" (held)" if face.held else "")
        cells = [str(face.index), name, _pair(face.degree), _pair(face.poles)]
        cells += [str(face.nodes), str(face.spans), str(face.spans_filled)]
        cells += [length(face.foot_mm.max), *_spread(face.deviation_mm)]
        cells.append(length(face.distance_mm.max))
        if report.holdout_mm:
            cells += _spread(face.holdout_mm)
        beyond = face.deviation_mm.max > tolerance_mm
        rows.append((cells, "bad" if beyond else "odd" if not face.nodes else ""))
    return table(heads, rows, text_columns=2)


def edges_table(report: Report) -> str:
    """All edges, the largest gap first; tangent joints that opened are marked."""
    names = {face.index: face.name for face in report.faces}
    heads = ["Edge", "Between", "Gap before", "after", "Angle before", "after", "Joint"]
    marked = {edge.index for edge in opened(report)}
    rows = []
    for edge in sorted(report.edges, key=lambda edge: -edge.gap_mm.after):
        between = " and ".join(dict.fromkeys(names.get(i, f"Face{i}") for i in edge.faces))
        joint = ("tangent" if edge.tangent else "kink") + (", held" if edge.held else "")
        cells = [str(edge.index), between, length(edge.gap_mm.before), length(edge.gap_mm.after)]
        cells += [f"{edge.angle_deg.before:.3f}°", f"{edge.angle_deg.after:.3f}°", joint]
        rows.append((cells, "bad" if edge.index in marked else ""))
    return table(heads, rows, text_columns=2)


def solid_table(report: Report) -> str:
    """Volume, area, centroid and tolerance, before and after."""
    rows = []
    for what, change in (("Volume, mm³", report.volume_mm3), ("Area, mm²", report.area_mm2)):
        relative = (change.after / change.before - 1) if change.before else 0.0
        cells = [what, f"{change.before:.8g}", f"{change.after:.8g}", f"{relative:+.4%}"]
        rows.append((cells, ""))
    for axis in range(3):
        before, after = (c[axis] for c in (report.centroid_mm.before, report.centroid_mm.after))
        cells = [f"Centroid {'xyz'[axis]}, mm", f"{before:.5f}", f"{after:.5f}"]
        rows.append(([*cells, f"{after - before:+.5f}"], ""))
    change = report.tolerance_mm
    cells = ["Largest tolerance, mm", length(change.before), length(change.after), ""]
    return table(["", "before", "after", "change"], [*rows, (cells, "")])


def input_table(report: Report) -> str:
    """What went in, and by which release."""
    given, tool = report.input, report.document["tool"]
    rows = [
        ("Solid", given["solid"]),
        ("Field", given["field"]),
        ("Result step", str(given["step"])),
        ("Factor", f"{given['factor']:g}: {direction(given['factor'])}"),
        ("Nodes of the field", str(given["nodes"])),
        ("Made with", f"{tool['name']} {tool['version']}"),
    ]
    return table(["", ""], [(row, "") for row in rows], text_columns=2)


def _pair(values) -> str:
    return f"{values[0]} × {values[1]}"


def _spread(spread: Optional[object]) -> list[str]:
    return ["–", "–"] if spread is None else [length(spread.mean), length(spread.max)]
