"""Imports FreeCAD where it is installed, once and only when it is needed.

Searched: the Python path; the folder named by ``BLADESMITH_FREECAD_LIB``; the usual folders.
FreeCAD must come before numpy: the other order crashes on Debian 12.
"""

import importlib
import logging
import os
import sys

from ..native.errors import SetupError

_LOG = logging.getLogger(__name__)

_FOLDERS = (
    "/usr/lib/freecad-python3/lib",
    "/usr/lib/freecad/lib",
    "/usr/lib64/freecad/lib",
    "/usr/local/lib/freecad/lib",
    "/opt/freecad/lib",
    "/Applications/FreeCAD.app/Contents/Resources/lib",
)

_STEP_SETTINGS = {
    "xstep.cascade.unit": "MM",
    "write.step.unit": "MM",
    "write.step.schema": "AP214IS",
}


def part_module():
    """FreeCAD's ``Part`` module, set to millimetres and AP214 whatever the user's preferences.

    Raises :class:`SetupError` where FreeCAD is not installed.
    """
    loaded = sys.modules.get("Part")
    if loaded is not None and "FreeCAD" in sys.modules:
        return loaded
    _import_freecad()
    part = importlib.import_module("Part")
    for name, value in _STEP_SETTINGS.items():
        part.setStaticValue(name, value)
    release = ".".join(sys.modules["FreeCAD"].Version()[:3])
    _LOG.info("FreeCAD %s, Open CASCADE %s", release, part.OCC_VERSION)
    return part


def _import_freecad():
    named = os.environ.get("BLADESMITH_FREECAD_LIB")
    for folder in (named,) if named else (None, *_FOLDERS):
        if folder is not None:
            if not os.path.isdir(folder):
                continue
            sys.path.append(folder)
        try:
            importlib.import_module("FreeCAD")
            return
        except ImportError:
            if folder is not None:
                sys.path.remove(folder)
    raise SetupError(
        "FreeCAD was not found"
        + (f" in {named} (BLADESMITH_FREECAD_LIB)" if named else "")
        + ": install it ('apt-get install freecad-python3' on Debian), or name the folder that "
        "holds FreeCAD.so in the environment variable BLADESMITH_FREECAD_LIB"
    )
