"""One action on a document inside FreeCAD, the add-on in ``Mod``; prints what came out as JSON.

``freecadcmd inside_freecad.py`` with BLADESMITH_ACTION, a JSON list: the action, the document, and
what else the action needs. FreeCAD ends with 0 whatever happens, so this ends the process itself.
"""

import json
import os
import sys
import traceback

import FreeCAD


def make(path, part, field):
    """A new document with a morph, saved."""
    from freecad.bladesmith.features import exchange, morph

    document = FreeCAD.newDocument()
    obj = morph.create(document, exchange.read(document, part)[0])
    obj.FieldFile = field
    document.recompute()
    document.saveAs(path)
    return obj


def recompute(path):
    """The document opened again, and its morph computed anew."""
    obj = _opened(path)
    obj.touch()
    return obj


def age(path):
    """Takes properties away that an older version did not know."""
    obj = _opened(path)
    for name in ("Holdout", "SchemaVersion", "DisplacementScale"):
        obj.removeProperty(name)
    obj.Document.save()
    return obj


def field(path, name):
    """The morph with another field file."""
    obj = _opened(path)
    obj.FieldFile = name
    return obj


def _opened(path):
    document = FreeCAD.openDocument(path)
    return next(obj for obj in document.Objects if obj.Name.startswith("Morph"))


def _said(obj) -> dict:
    before = obj.Shape.Volume
    if "SchemaVersion" in obj.PropertiesList:
        obj.Document.recompute()
    return {
        "valid": obj.isValid(),
        "status": obj.getStatusString(),
        "volume_before": before,
        "volume": obj.Shape.Volume,
        "factor": obj.Factor,
        "properties": obj.PropertiesList,
        "schema": getattr(obj, "SchemaVersion", None),
    }


code = 1
try:
    action, *arguments = json.loads(os.environ["BLADESMITH_ACTION"])
    print("\n" + json.dumps(_said(globals()[action](*arguments))))
    code = 0
except BaseException:
    traceback.print_exc()
sys.stdout.flush()
sys.stderr.flush()
os._exit(code)
