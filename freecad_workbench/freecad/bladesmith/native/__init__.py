"""The geometry core through ctypes; nothing here knows FreeCAD.

FreeCAD must be imported before numpy, so this room imports numpy only where arrays come back.
"""

from .api import Field, Morphed, Part, check, library_version
from .curves import SPACINGS, Curve, compatible, parameters
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
from .surfaces import Surface

__all__ = [
    "ArgumentError",
    "BladesmithError",
    "Cancelled",
    "Curve",
    "DesignRuleError",
    "Field",
    "InputError",
    "InternalError",
    "Morphed",
    "NumericsError",
    "Part",
    "SPACINGS",
    "SetupError",
    "Surface",
    "check",
    "compatible",
    "library_version",
    "parameters",
]
