"""Names of commands, and where their icons are."""

from pathlib import Path

_ICONS = Path(__file__).parents[1] / "resources" / "icons"

COMMANDS = (
    "Bladesmith_ImportStep",
    "Bladesmith_Morph",
    "Separator",
    "Bladesmith_ShowResult",
    "Bladesmith_OpenReport",
    "Separator",
    "Bladesmith_ExportStep",
)
"""The commands of toolbar and menu, in their order; one that is not registered is left out."""


def icon(name: str) -> str:
    """Path of an icon."""
    return str(_ICONS / f"{name}.svg")
