"""FreeCAD and Open CASCADE: STEP files in and out, names and colours, judgement of solids.

The only room that knows them. STEP text is read by :mod:`.part21` without either.
"""
