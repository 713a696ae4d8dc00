"""Commands of toolbar and menu, each named ``Bladesmith_<Name>``."""

COMMANDS = [
    "Bladesmith_ImportStep",
    "Bladesmith_Morph",
    "Separator",
    "Bladesmith_ShowResult",
    "Bladesmith_OpenReport",
    "Separator",
    "Bladesmith_ExportStep",
]
"""The commands of toolbar and menu, in their order; one that is not registered is left out."""
