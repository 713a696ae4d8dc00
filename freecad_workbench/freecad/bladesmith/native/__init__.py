"""The geometry core through ctypes; nothing here knows FreeCAD.

FreeCAD must be imported before numpy, so this room imports numpy only where arrays come back.
"""

from .api import Field, Morphed, Part, check, library_version
from .curves import SPACINGS, Curve, Fillet, averaged_knots, compatible, parameters
from .errors import (
    ArgumentError,
    BladesmithError,
    Cancelled,
    DesignRuleError,
    InputError,
    InternalError,
    NumericsError,
    SetupError,
)
from .sections import Branch, Projection, Section
from .surfaces import Surface

__all__ = [
    "ArgumentError",
    "BladesmithError",
    "Branch",
    "Cancelled",
    "Curve",
    "DesignRuleError",
    "Field",
    "Fillet",
    "InputError",
    "InternalError",
    "Morphed",
    "NumericsError",
    "Part",
    "Projection",
    "SPACINGS",
    "Section",
    "SetupError",
    "Surface",
    "averaged_knots",
    "check",
    "compatible",
    "library_version",
    "parameters",
]
