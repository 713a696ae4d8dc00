"""``bladesmith info``: what is in a STEP or a field file, in engineering terms."""

import argparse
import json
import sys
from pathlib import Path

from ..model.words import counted
from ..native import Field, Part
from ..occ import judge, step
from ..operations.outputs import STDOUT, Outputs, check_target


def run(options: argparse.Namespace) -> int:
    """Runs the command; returns its exit code."""
    to_stdout = options.json == STDOUT
    if options.json and not to_stdout:
        check_target(options.json, "the figures")
    if step.is_step(step.first_bytes(options.file)):
        document = _part_document(options.file)
        lines = _part_lines(document)
    else:
        document = {"kind": "field", **Field.read(options.file).info()}
        lines = _field_lines(document)
    text = json.dumps(document, indent=1, ensure_ascii=False) + "\n"
    if to_stdout:
        sys.stdout.write(text)
    elif options.json:
        with Outputs() as outputs:
            Path(outputs.file(options.json)).write_text(text, "utf-8")
            outputs.commit()
    if not (options.quiet or to_stdout):
        print("\n".join(lines))
    return 0


def _part_document(path: str) -> dict:
    part = step.read(path)
    solids = []
    for index, (shape, attributes) in enumerate(zip(part.shape.Solids, part.solids), 1):
        info = Part.read(shape.exportBrepToString(), path).info()
        verdict = judge.judge(shape)
        for face, name, colour in zip(
            info["faces"], attributes.face_names, attributes.face_colours
        ):
            face["name"] = name or f"Face{face['index']}"
            face["colour"] = colour
        solids.append(
            {
                "index": index,
                "name": attributes.name,
                "colour": attributes.colour,
                "valid": verdict.valid,
                "closed": verdict.closed,
                **{key: value for key, value in info.items() if key != "solids"},
            }
        )
    document = {"kind": "part", "name": path, "product": part.product}
    return {**document, "solids": solids, "warnings": part.warnings}


def _part_lines(document: dict) -> list[str]:
    solids = counted(len(document["solids"]), "solid")
    lines = [f"{document['name']}: {solids}, {document['product']}"]
    for solid in document["solids"]:
        name = f" {solid['name']}" if solid["name"] else ""
        checked = "valid" if solid["valid"] else "not valid"
        closed = "closed" if solid["closed"] else "open"
        lines.append(
            f"solid {solid['index']}{name}: {counted(len(solid['faces']), 'face')}, "
            f"{counted(solid['edges'], 'edge')}, {checked}, {closed}"
        )
        lines += _box_lines(solid["bounding_box_mm"], "mm")
        width = max(len(face["name"]) for face in solid["faces"])
        lines += [f"  {face['name']:<{width}}  {_surface(face)}" for face in solid["faces"]]
    return lines + [f"warning: {text}" for text in document["warnings"]]


def _surface(face: dict) -> str:
    if not face["poles"]:
        return face["surface"]
    degree, poles = ("x".join(map(str, face[key])) for key in ("degree", "poles"))
    rational = ", rational" if face["rational"] else ""
    return f"{face['surface']}, degree {degree}, {poles} poles{rational}"


def _box_lines(box, unit: str) -> list[str]:
    if not box:
        return []
    sides = " x ".join(f"{high - low:.6g}" for low, high in zip(*box))
    corners = " to ".join(f"({', '.join(f'{c:.6g}' for c in corner)})" for corner in box)
    return [f"  size {sides} {unit}, from {corners}"]


def _field_lines(document: dict) -> list[str]:
    packed = ", gzipped" if document["compressed"] else ""
    lines = [f"{document['name']}: {document['format']}{packed}"]
    surface = document["surface_nodes"]
    on_surface = "" if surface is None else f", {surface} on the surface"
    lines.append(
        f"  nodes {document['nodes']}, {document['nodes_with_result']} with a displacement"
        f"{on_surface}"
    )
    if document["elements"]:
        kinds = ", ".join(f"{e['count']} {e['kind']}" for e in document["elements"])
        lines.append(f"  elements {kinds}")
    unit = document["unit_guess"]
    if unit:
        lines += _box_lines(document["bounds"], f"{unit} (by the size)")
    else:
        place = ", ".join(f"{c:.6g}" for c in document["bounds"][0])
        lines.append(f"  all nodes in one place, ({place})")
    for step_ in document["steps"]:
        used = ", used" if step_["number"] == document["step"] else ""
        time = "" if step_["time"] is None else f", {_kind_of_time(step_)} {step_['time']:g}"
        rows = counted(step_["rows"], "displacement")
        lines.append(f"  step {step_['number']}: {rows}{time}{used}")
    blocks = ", ".join(f"{block['name']} ({block['rows']})" for block in document["blocks"])
    if blocks:
        lines.append(f"  blocks {blocks}")
    largest = document["largest_displacement"]
    place = ", ".join(f"{c:.6g}" for c in largest["at"])
    lines.append(
        f"  largest displacement {largest['value']:.6g} at node {largest['node']} ({place})"
    )
    return lines + [f"warning: {text}" for text in document["warnings"]]


def _kind_of_time(step_: dict) -> str:
    return "frequency" if step_["frequency"] else "time or load"
