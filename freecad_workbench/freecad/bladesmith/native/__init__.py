"""The geometry core through ctypes; nothing here knows FreeCAD.

FreeCAD must be imported before numpy, so this room imports numpy only where arrays come back.
"""

from .api import Field, Morphed, Part, check, library_version
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

__all__ = [
    "ArgumentError",
    "BladesmithError",
    "Cancelled",
    "DesignRuleError",
    "Field",
    "InputError",
    "InternalError",
    "Morphed",
    "NumericsError",
    "Part",
    "SetupError",
    "check",
    "library_version",
]
