"""STEP with names and colours in FreeCAD's own menus *File > Open*, *Import* and *Export*.

FreeCAD imports this module by its name and calls :func:`open`, :func:`insert` and :func:`export`.
"""

from pathlib import Path

import FreeCAD
import FreeCADGui

from .. import log
from ..features import attributes, exchange
from ..native import InputError
from ..viewproviders.morph import diffuse

IMPORT_FILTER = "STEP with names of faces (*.step *.stp *.step.gz *.stp.gz)"
EXPORT_FILTER = "STEP with names of faces (*.step *.stp)"
"""In lower case only: FreeCAD compares suffixes in any case, and lists a module once for each."""


def register() -> None:
    """Adds the file type to FreeCAD's menus."""
    FreeCAD.addImportType(IMPORT_FILTER, __name__)
    FreeCAD.addExportType(EXPORT_FILTER, __name__)


def open(path: str):  # noqa: A001 (FreeCAD asks for this name)
    """The solids of a file in a new document."""
    document = FreeCAD.newDocument(Path(path).name.split(".")[0] or "Part")
    insert(path, document.Name)
    return document


@log.kept("FreeCAD, STEP import")
def insert(path: str, document_name: str) -> list:
    """The solids of a file in an open document; returns their objects."""
    document = FreeCAD.getDocument(document_name)
    found = exchange.read(document, path)
    for obj in found:
        said = attributes.load(obj, len(obj.Shape.Faces))[1]
        if obj.ViewObject and (said.colour or any(said.face_colours)):
            obj.ViewObject.DiffuseColor = diffuse(said, obj.ViewObject.ShapeColor)
    document.recompute()
    if FreeCAD.GuiUp:
        FreeCADGui.SendMsgToActiveView("ViewFit")
    return found


@log.kept("FreeCAD, STEP export")
def export(objects: list, path: str) -> None:
    """Writes one solid; raises :class:`InputError` for any other number of objects."""
    if len(objects) != 1:
        raise InputError(f"select one solid to export with its names, not {len(objects)} objects")
    obj = objects[0]
    colours = [tuple(c[:3]) for c in obj.ViewObject.DiffuseColor] if obj.ViewObject else None
    exchange.write(obj, path, colours)
