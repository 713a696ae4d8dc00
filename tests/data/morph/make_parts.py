"""Writes the small solids of the morph tests as Open CASCADE's text B-rep, packed.

Run with FreeCAD's Python from this folder: python3 make_parts.py
"""

import gzip
import math
import os
import tempfile

import FreeCAD  # noqa: F401  (must come before Part)
import Part
from FreeCAD import Vector

HERE = os.path.dirname(os.path.abspath(__file__))


def plate():
    """A box with a round hole, a hole with a slanted axis, and a slot that splits its top."""
    body = Part.makeBox(20, 12, 6)
    body = body.cut(Part.makeCylinder(2, 20, Vector(5, 6, -5)))
    body = body.cut(Part.makeCylinder(1.5, 30, Vector(14, 6, -5), Vector(0.1, 0.2, 1)))
    return body.cut(Part.makeBox(2, 12, 2, Vector(9, 0, 4)))


def filleted():
    box = Part.makeBox(12, 8, 5)
    return box.makeFillet(1.0, box.Edges)


def cylinder():
    return Part.makeCylinder(3, 8)


def drop():
    """A cone's tip on a half ball: two poles, two seams, a tangent joint."""
    ball = Part.makeSphere(
        3, Vector(0, 0, 0), Vector(0, 0, 1), -90, math.degrees(math.asin(0.6)), 360
    )
    r, z = 3 * 0.8, 3 * 0.6
    cone = Part.makeCone(r, 0, r * 0.8 / 0.6, Vector(0, 0, z))
    return ball.fuse(cone)


def torus():
    return Part.makeTorus(6, 2)


def vase():
    """A spline turned all round."""
    spline = Part.BSplineCurve()
    spline.interpolate(
        [Vector(3, 0, 0), Vector(4, 0, 2), Vector(2.5, 0, 5), Vector(2, 0, 7), Vector(3, 0, 9)]
    )
    top, axis = Vector(0, 0, 9), Vector(0, 0, 0)
    wire = Part.Wire(
        [
            Part.makeLine(axis, Vector(3, 0, 0)),
            spline.toShape(),
            Part.makeLine(Vector(3, 0, 9), top),
            Part.makeLine(top, axis),
        ]
    )
    return Part.makeSolid(Part.Face(wire).revolve(axis, Vector(0, 0, 1), 360))


def bar():
    """A loft through turned rectangles."""
    wires = []
    for k in range(4):
        x, y = 6 - 0.5 * k, 2 - 0.2 * k
        corners = [
            Vector(-x, -y, 0),
            Vector(x, -y, 0),
            Vector(x, y, 0),
            Vector(-x, y, 0),
            Vector(-x, -y, 0),
        ]
        wire = Part.makePolygon(corners)
        wire.rotate(Vector(), Vector(0, 0, 1), 12 * k)
        wire.translate(Vector(0.3 * k, 0, 8 * k))
        wires.append(wire)
    return Part.makeLoft(wires, True, False)


def leaf():
    """A periodic spline surface between two plane ends."""
    count, rows = 10, 5
    poles = []
    for i in range(count):
        a = 2 * math.pi * i / count
        x, y = 5 * math.cos(a), 1.5 * math.sin(a) + 0.5 * math.cos(2 * a)
        line = []
        for k in range(rows):
            turn = math.radians(8 * k)
            c, s = math.cos(turn), math.sin(turn)
            line.append(Vector(x * c - y * s + 0.1 * k * k, x * s + y * c, 5 * k))
        poles.append(line)
    surface = Part.BSplineSurface()
    knots = [float(i) for i in range(count + 1)]
    surface.buildFromPolesMultsKnots(
        poles, [1] * (count + 1), [4, 1, 4], knots, [0, 1, 2], True, False, 3, 3
    )
    side = surface.toShape()
    ends = [Part.Face(Part.Wire(e)) for e in side.Edges if e.isClosed()]
    shell = Part.makeShell([side] + ends)
    shell.sewShape()
    return Part.makeSolid(shell)


def slivers():
    """A box with a chamfer of 0.02 mm, a step of 0.05 mm and a hole of 0.1 mm."""
    box = Part.makeBox(10, 6, 4)
    edge = [
        e
        for e in box.Edges
        if e.BoundBox.XLength > 9 and e.BoundBox.ZMin > 3 and e.BoundBox.YMin > 5
    ]
    body = box.makeChamfer(0.02, edge)
    body = body.cut(Part.makeBox(5, 0.05, 1, Vector(0, 0, 3)))
    return body.cut(Part.makeCylinder(0.05, 10, Vector(7, 3, -1)))


def from_step(name):
    def read():
        with gzip.open(os.path.join(HERE, "..", "p5", name + ".step.gz")) as packed:
            text = packed.read()
        with tempfile.NamedTemporaryFile(suffix=".step") as step:
            step.write(text)
            step.flush()
            return Part.read(step.name)

    return read


def scaled(make, factor):
    return lambda: make().scale(factor)


PARTS = {f.__name__: f for f in (plate, filleted, cylinder, drop, torus, vase, bar, leaf, slivers)}
PARTS["filleted_small"] = scaled(filleted, 0.01)
PARTS["filleted_large"] = scaled(filleted, 100)
PARTS["far"] = lambda: drop().translate(Vector(1e4, -2e3, 500))
PARTS.update({name: from_step(name) for name in ("base", "sphere", "two_solids", "faces_only")})

for name, make in PARTS.items():
    shape = make()
    print(
        name,
        shape.ShapeType,
        shape.isValid(),
        len(shape.Faces),
        [f.Surface.TypeId.split("::")[1] for f in shape.Faces][:40],
    )
    with open(os.path.join(HERE, name + ".brep.gz"), "wb") as file:
        file.write(gzip.compress(shape.exportBrepToString().encode(), mtime=0))
