"""What a user can choose for a morph."""

from dataclasses import asdict, dataclass

FIELD_UNITS_MM = {"mm": 1.0, "m": 1000.0, "in": 25.4}
"""Length in mm of the units a field file may have."""

DEFAULT_FACTOR = 1.0
"""Adds the displacements; the window's new morphs follow the preferences instead."""


@dataclass(frozen=True)
class MorphOptions:
    """Settings of a morph. Lengths in mm; faces and solids count from 1; 0 leaves a choice open."""

    factor: float = DEFAULT_FACTOR
    tolerance_mm: float = 1e-3
    match_tolerance_mm: float = 0.0
    field_unit_mm: float = 0.0
    displacement_scale: float = 1.0
    solid: int = 0
    moving_faces: tuple[int, ...] = ()
    fixed_faces: tuple[int, ...] = ()
    extrapolate: bool = False
    holdout: bool = False
    threads: int = 0
    face_names: tuple[str, ...] = ()
    solid_name: str = ""

    def settings(self) -> dict:
        """The settings under the names of the core."""
        return asdict(self)
