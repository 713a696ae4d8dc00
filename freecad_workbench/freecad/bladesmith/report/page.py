"""Writes the page about a morph: an HTML file with its pictures in it, and the pictures beside."""

import base64
from html import escape
from pathlib import Path

from ..model import Report
from . import words
from .tables import edges_table, faces_table, input_table, solid_table

_DEFINITIONS = (
    (
        "Deviation",
        "distance, at a node's foot point on the face, between where the new surface puts this "
        "point and where the field puts it: |S′(u,v) − (S(u,v) + factor · U)|. Sliding counts.",
    ),
    ("Re-projected", "distance of the node's target to the nearest point of the new face."),
    (
        "Hold-out",
        "deviation at the nodes whose number is divisible by 10, from a second fit that did not "
        "see them. The result itself uses all nodes.",
    ),
    ("Foot", "distance of a node from the face before the move."),
    ("Gap", "largest distance, at 201 places along an edge, among its curve and its two traces."),
    ("Folded", "the normal of the new face is turned against the old one at a sample."),
    ("Spans, filled", "knot spans of a face, and those without a node, which are filled smoothly."),
)


def write_page(
    folder: str, report: Report, shapes: tuple, nodes: dict, tolerance_mm: float
) -> None:
    """Writes ``report.html`` and its pictures into ``folder``.

    ``shapes`` are the solid before and after, ``nodes`` the core's results by node and face.
    """
    images = _pictures(folder, shapes, nodes, tolerance_mm)
    page = _page(report, images, tolerance_mm, len(set(nodes["ids"].tolist())))
    Path(folder, "report.html").write_text(page, "utf-8")


def _pictures(
    folder: str, shapes: tuple, nodes: dict, tolerance_mm: float
) -> list[tuple[str, str]]:
    """Draws and saves all pictures; returns (image data, caption) for each."""
    from ..occ.tessellation import tessellate
    from . import pictures

    scene = pictures.Scene.of(tessellate(shapes[0]), tessellate(shapes[1]), nodes)
    exaggerated, scale = pictures.exaggerated_picture(scene)
    maps = pictures.map_pictures(scene)
    drawn = [
        ("part", pictures.part_picture(scene), "The part before and after, in the same view."),
        (
            "movement",
            exaggerated,
            f"The movement enlarged {scale:g} times; the edges of the input in red.",
        ),
        ("displacement", maps["displacement"], "Displacement on the input, factor included."),
        ("deviation", maps["deviation"], "Deviation at the nodes, on the input."),
        (
            "histograms",
            pictures.histogram_picture(nodes, tolerance_mm),
            "Nodes by deviation (below 1e-9 counted there) and by displacement.",
        ),
    ]
    found = []
    for name, figure, caption in drawn:
        file = Path(folder, f"{name}.png")
        pictures.save(figure, str(file))
        found.append((base64.b64encode(file.read_bytes()).decode(), caption))
    return found


def _page(
    report: Report, images: list[tuple[str, str]], tolerance_mm: float, nodes_on_faces: int
) -> str:
    name = escape(Path(report.input["solid"]).name)
    said = words.sentences(report, tolerance_mm)
    figures = [
        f'<figure><img alt="{escape(caption)}" src="data:image/png;base64,{data}">'
        f"<figcaption>{escape(caption)}</figcaption></figure>"
        for data, caption in images
    ]
    sections = [
        f"<h1>Morph of {name}</h1>",
        f'<p class="origin">by {escape(Path(report.input["field"]).name)}, '
        f"{escape(words.way(report))}</p>",
        f'<div class="verdict {words.state(report, tolerance_mm)}">'
        f'<p class="main">{escape(said[0])}</p>',
        *(f"<p>{escape(sentence)}</p>" for sentence in said[1:]),
        "</div>",
        _figures(report, nodes_on_faces),
        _warnings(report),
        "<h2>The part</h2>",
        *figures[:2],
        "<h2>Displacement and deviation</h2>",
        *figures[2:],
        "<h2>The solid</h2>",
        solid_table(report),
        "<h2>Faces</h2>",
        '<p class="note">Largest deviation first. Lengths in mm. Nodes on an edge count for both '
        "its faces.</p>",
        f'<div class="scroll">{faces_table(report, tolerance_mm)}</div>',
        "<h2>Edges</h2>",
        '<p class="note">Largest gap first. Lengths in mm.</p>',
        f'<div class="scroll">{edges_table(report)}</div>',
        "<h2>Input</h2>",
        input_table(report),
        "<h2>What the figures mean</h2>",
        "<dl>" + "".join(f"<dt>{t}</dt><dd>{escape(d)}</dd>" for t, d in _DEFINITIONS) + "</dl>",
    ]
    style = Path(__file__).with_name("page.css").read_text("utf-8")
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
        f"<title>Morph of {name}</title>\n<style>\n{style}</style></head>\n<body>\n"
        + "\n".join(section for section in sections if section)
        + "\n</body></html>\n"
    )


def _figures(report: Report, nodes_on_faces: int) -> str:
    volume = report.volume_mm3
    change = volume.after / volume.before - 1 if volume.before else 0.0
    shown = [
        ("largest deviation, mm", words.length(report.deviation_mm.max)),
        ("mean deviation, mm", words.length(report.deviation_mm.mean)),
        ("nodes on the part", str(nodes_on_faces)),
        ("change of volume", f"{change:+.3%}"),
    ]
    if report.holdout_mm:
        shown.insert(2, ("largest hold-out error, mm", words.length(report.holdout_mm.max)))
    edge = report.widest_edge()
    if edge:
        shown.insert(-1, ("largest gap, mm", words.length(edge.gap_mm.after)))
    boxes = [
        f'<div class="figure"><b>{value}</b><span>{what}</span></div>' for what, value in shown
    ]
    return f'<div class="figures">{"".join(boxes)}</div>'


def _warnings(report: Report) -> str:
    if not report.warnings:
        return ""
    items = "".join(f"<li>{escape(text)}</li>" for text in report.warnings)
    return f'<h2>Warnings</h2><ul class="warnings">{items}</ul>'
