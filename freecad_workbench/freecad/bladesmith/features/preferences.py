"""What the user chose on the preferences page; FreeCAD keeps it."""

import FreeCAD

_GROUP = "User parameter:BaseApp/Preferences/Mod/Bladesmith"


def factor() -> float:
    """Factor of a new morph."""
    return FreeCAD.ParamGet(_GROUP).GetFloat("Factor", -1.0)


def tolerance_mm() -> float:
    """Tolerance of a new morph, mm."""
    return FreeCAD.ParamGet(_GROUP).GetFloat("Tolerance", 1e-3)


def threads() -> int:
    """Threads of the core; 0 for all processors."""
    return FreeCAD.ParamGet(_GROUP).GetInt("Threads", 0)


def layout() -> int:
    """How a new result stands to its source: 0 over it, 1 beside it, 2 alone."""
    return FreeCAD.ParamGet(_GROUP).GetInt("Layout", 0)
