"""Plain data: what a morph is asked to do, and what is said about it afterwards."""

from .options import DEFAULT_FACTOR, FIELD_UNITS_MM, MorphOptions
from .report import Report

__all__ = ["DEFAULT_FACTOR", "FIELD_UNITS_MM", "MorphOptions", "Report"]
