"""Bladesmith: hot-to-cold morphing of CAD solids by a finite-element displacement field.

Rooms, each using only those before it: ``native`` (the core, by ctypes), ``model`` (plain data),
``occ`` (FreeCAD and Open CASCADE), ``operations`` (what is done, for command line and window),
``colours`` (values on triangles), ``features``, ``viewproviders``, ``taskpanels``, ``commands``
(the workbench of FreeCAD), ``report`` (the page with pictures), ``cli`` (the command line).
Lengths are millimetres, angles degrees, faces and edges count from 1.
"""

import logging

__version__ = "0.1.0"

# Without a log file, warnings are not for the terminal: the commands say them in their own way.
logging.getLogger(__name__).addHandler(logging.NullHandler())
