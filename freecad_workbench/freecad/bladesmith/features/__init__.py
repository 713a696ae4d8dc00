"""Parametric document objects: properties in, shape and figures out. No window, no ctypes."""
