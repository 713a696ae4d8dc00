"""Values shown on a part as colours: carried over from nodes, scaled, and turned into colours.

Shared by the page's pictures and the 3-D view. Import only after FreeCAD, as numpy must be.
"""
