"""Bladesmith: hot-to-cold morphing of CAD solids by a finite-element displacement field.

Rooms, each using only those before it: ``native`` (the core, by ctypes), ``model`` (plain data),
``occ`` (FreeCAD and Open CASCADE), ``colours`` (values on triangles), ``report`` (the page with
pictures), ``cli`` (the commands).
Lengths are millimetres, angles degrees, faces and edges count from 1.
"""

__version__ = "0.1.0"
