"""Shapes of every kind that Open CASCADE's modelling makes, for tests of the B-rep text."""

import math

from common import FreeCAD, Part

V = FreeCAD.Vector


def placed(shape, position, axis, angle_deg):
    """A copy that shares the geometry and only carries a location."""
    copy = shape.copy(False)
    motion = FreeCAD.Placement(V(*position), FreeCAD.Rotation(V(*axis), angle_deg))
    copy.Placement = motion.multiply(shape.Placement)
    return copy


def spline(points, periodic=False):
    curve = Part.BSplineCurve()
    curve.interpolate([V(*p) for p in points], PeriodicFlag=periodic)
    return curve


def blob(z, scale=1.0, phase=0.0):
    """A closed periodic spline at height z."""
    points = []
    for i in range(9):
        a = 2 * math.pi * i / 9
        r = scale * (4 + math.cos(3 * a + phase))
        points.append((r * math.cos(a), r * math.sin(a), z))
    return Part.Wire(spline(points, periodic=True).toShape())


def wave(z=0.0):
    return spline([(0, 0, z), (2, 1, z), (4, -1, z + 0.5), (6, 0.5, z), (8, 0, z)])


def profile():
    """A closed planar wire of two splines and a line."""
    upper = spline([(0, 0, 0), (3, 2, 0), (8, 0.5, 0)]).toShape()
    lower = spline([(0, 0, 0), (3, -1, 0), (8, -0.5, 0)]).toShape()
    return Part.Wire(Part.__sortEdges__([upper, lower, Part.makeLine(V(8, 0.5, 0), V(8, -0.5, 0))]))


def sheet(periodic_u=False, rational=False):
    """A B-spline patch, closed in u where periodic."""
    rows = []
    for i in range(6):
        a = 2 * math.pi * i / 6
        ring = (5 * math.cos(a), 5 * math.sin(a)) if periodic_u else (2.0 * i, math.sin(a))
        flare = [1 + 0.1 * j for j in range(5)]
        heights = [2.0 * j + 0.3 * (i % 2) for j in range(5)]
        rows.append([V(ring[0] * f, ring[1] * f, z) for f, z in zip(flare, heights)])
    weights = [[1 + 0.2 * ((i + j) % 3) * rational for j in range(5)] for i in range(6)]
    surface = Part.BSplineSurface()
    umults = [1] * 7 if periodic_u else [4, 1, 1, 4]
    uknots = [float(k) for k in range(len(umults))]
    vmults, vknots = [4, 1, 4], [0.0, 0.5, 1.0]
    surface.buildFromPolesMultsKnots(
        rows, umults, vmults, uknots, vknots, periodic_u, False, 3, 3, weights
    )
    return surface


def primitives():
    yield "box", Part.makeBox(1, 2, 3)
    yield "cylinder", Part.makeCylinder(2, 5)
    yield "cylinder_part", Part.makeCylinder(2, 5, V(1, 2, 3), V(1, 1, 0), 200)
    yield "cone_tip", Part.makeCone(3, 0, 5)
    yield "cone_part", Part.makeCone(3, 1, 5, V(0, 1, 0), V(0, 1, 1), 100)
    yield "sphere", Part.makeSphere(4)
    yield "sphere_part", Part.makeSphere(4, V(1, 0, 0), V(1, 2, 3), -30, 90, 250)
    yield "torus", Part.makeTorus(6, 1.5)
    yield "torus_part", Part.makeTorus(6, 1.5, V(), V(0, 1, 1), -60, 120, 200)
    yield "wedge", Part.makeWedge(0, 0, 0, 2, 2, 10, 10, 10, 8, 8)
    yield "helix", Part.makeHelix(2, 10, 5)
    yield "plane_with_holes", plane_with_holes()
    yield "vertex", Part.Vertex(1, 2, 3)
    yield "line", Part.makeLine(V(0, 0, 0), V(1, 2, 3))
    yield "polygon", Part.makePolygon([V(0, 0, 0), V(1, 0, 0), V(1, 1, 0), V(0, 0, 0)])
    yield "conics", conics()


def plane_with_holes():
    outer = Part.Wire(Part.Ellipse(V(), 8, 5).toShape())
    holes = [Part.Wire(Part.makeCircle(1, V(x, 0, 0))) for x in (-3, 3)]
    for hole in holes:
        hole.reverse()
    return Part.Face([outer, *holes])


def conics():
    parabola = Part.Parabola()
    parabola.Focal = 1.5
    hyperbola = Part.Hyperbola(V(1, 2, 3), 4, 2)
    return Part.makeCompound(
        [
            parabola.toShape(-2, 3),
            hyperbola.toShape(-1, 1.5),
            Part.Ellipse(V(1, 0, 0), 5, 2).toShape(0.5, 4),
            Part.makeCircle(3, V(), V(1, 1, 1), 30, 200),
        ]
    )


def rounded():
    box = Part.makeBox(10, 8, 6)
    yield "fillet_box", box.makeFillet(1, box.Edges)
    yield "fillet_variable", box.makeFillet(0.5, 1.5, box.Edges[:3])
    yield "chamfer_box", box.makeChamfer(1, box.Edges)
    cylinder = Part.makeCylinder(4, 8)
    yield "fillet_cylinder", cylinder.makeFillet(1, cylinder.Edges[:1])
    yield "chamfer_cylinder", cylinder.makeChamfer(0.7, cylinder.Edges[2:])
    cut = box.cut(Part.makeCylinder(2, 20, V(5, 4, -5)))
    rims = [e for e in cut.Edges if e.Curve.TypeId == "Part::GeomCircle"]
    yield "fillet_hole", cut.makeFillet(0.4, rims)
    blade = Part.Face(profile()).extrude(V(0, 1, 10))
    yield "fillet_spline", blade.makeFillet(0.05, blade.Edges[-2:])


def swept():
    blobs = [blob(0), blob(4, 1.3, 0.5), blob(9, 0.8, 1.0)]
    yield "loft_closed_smooth", Part.makeLoft(blobs, True, False)
    yield "loft_closed_ruled", Part.makeLoft(blobs, True, True)
    circle = Part.Wire(Part.makeCircle(3))
    yield "loft_round_square", Part.makeLoft([circle, square(6, 5)], True)
    yield "loft_to_point", Part.makeLoft([circle, Part.Vertex(0, 0, 5)], True)
    path = Part.Wire(spline([(0, 0, 0), (0, 2, 5), (3, 3, 9)]).toShape())
    yield "pipe_shell", path.makePipeShell([Part.Wire(Part.makeCircle(1))], True, True)
    yield "pipe", path.makePipe(Part.Face(Part.Wire(Part.makeCircle(0.5))))
    helix = Part.Wire(Part.makeHelix(3, 6, 5))
    section = Part.Wire(Part.makeCircle(0.4, V(5, 0, 0), V(0, 1, 0)))
    yield "helix_sweep", helix.makePipeShell([section], True, True)
    yield "ruled", Part.makeRuledSurface(wave().toShape(), wave(5).toShape())
    yield "filled", Part.makeFilledFace(Part.__sortEdges__(Part.makeBox(2, 3, 1).Faces[0].Edges))
    yield "revolution_spline", meridian().revolve(V(), V(0, 0, 1), 360)
    yield "revolution_part", meridian().revolve(V(), V(0, 0, 1), 120)
    yield "revolution_profile", Part.Face(profile()).revolve(V(0, -5, 0), V(1, 0, 0), 270)
    yield "revolution_periodic", blob(0).revolve(V(9, 0, 0), V(0, 1, 0), 360)
    yield "extrusion_spline", wave().toShape().extrude(V(1, 2, 3))
    yield "extrusion_profile", Part.Face(profile()).extrude(V(0.5, 0.2, 9))
    yield "extrusion_periodic", Part.Face(blob(0)).extrude(V(0, 0, 7))
    ellipse = Part.Ellipse(V(), 5, 2)
    yield "extrusion_ellipse", Part.Face(Part.Wire(ellipse.toShape())).extrude(V(0, 1, 4))
    yield "extrusion_arc", ellipse.toShape(0.4, 3).extrude(V(0, 1, 4))
    yield "extrusion_conics", conics().extrude(V(0.3, 0.1, 4))


def square(size, z):
    h = size / 2
    return Part.makePolygon([V(-h, -h, z), V(h, -h, z), V(h, h, z), V(-h, h, z), V(-h, -h, z)])


def meridian():
    """A spline from axis to axis: its revolution has a degenerated edge at each end."""
    return spline([(0, 0, 0), (2, 0, 1), (1, 0, 3), (0, 0, 5)]).toShape()


def freeform():
    yield "bspline", sheet().toShape()
    yield "bspline_rational", sheet(rational=True).toShape()
    yield "bspline_periodic", sheet(periodic_u=True).toShape()
    yield "bspline_periodic_rational", sheet(periodic_u=True, rational=True).toShape()
    bezier = Part.BezierSurface()
    bezier.increase(3, 2)
    for i in range(1, 5):
        for j in range(1, 4):
            bezier.setPole(i, j, V(i, j, 0.3 * i * j - 0.2 * j * j))
    yield "bezier", bezier.toShape()
    bezier.setWeight(2, 2, 1.7)
    yield "bezier_rational", bezier.toShape()
    curve = Part.BezierCurve()
    curve.setPoles([V(0, 0, 0), V(1, 2, 0), V(3, 2, 1), V(4, 0, 2)])
    yield "bezier_curve", curve.toShape()
    curve.setWeight(2, 3.0)
    yield "bezier_extruded", curve.toShape().extrude(V(0, 1, 5))
    yield "offset_curve", Part.OffsetCurve(wave(), 0.4, V(0, 0.1, 1)).toShape()
    offset = Part.OffsetCurve(wave(), 0.4, V(0, 0, 1)).toShape()
    yield "offset_curve_extruded", offset.extrude(V(0, 0.5, 5))
    yield "offset_surface", Part.OffsetSurface(sheet(), 0.3).toShape()
    yield "offset_rational", Part.OffsetSurface(sheet(rational=True), -0.3).toShape()
    yield "offset_periodic", Part.OffsetSurface(sheet(periodic_u=True), 0.2).toShape()
    extrusion = Part.SurfaceOfExtrusion(wave(), V(0, 0.6, 0.8))
    yield "offset_extrusion", Part.OffsetSurface(extrusion, 0.3).toShape(0.1, 0.9, 0, 4)
    yield "periodic_edge", blob(0)
    nurbs = Part.makeCylinder(2, 5).fuse(Part.makeSphere(3)).toNurbs()
    yield "nurbs_of_boolean", nurbs
    yield "nurbs_of_torus", Part.makeTorus(6, 1.5).toNurbs()


def booleans():
    box, ball = Part.makeBox(6, 6, 6), Part.makeSphere(4, V(6, 6, 6))
    rod = Part.makeCylinder(1.5, 20, V(3, 3, -5), V(0.1, 0.2, 1))
    yield "cut", box.cut(rod)
    yield "fuse", box.fuse(ball)
    yield "common", box.common(ball)
    yield "cut_many", box.multiFuse([ball]).cut(rod).cut(Part.makeTorus(4, 1))
    yield "cone_sections", Part.makeCone(5, 0, 10).cut(Part.makeBox(20, 20, 20, V(1, -10, -5)))
    plane = Part.makePlane(20, 20, V(1, -10, -5), V(1, 0, 0.2))
    yield "section", Part.makeCone(5, 0, 10).section(plane)
    pieces, _ = box.generalFuse([ball, rod])
    yield "general_fuse", pieces
    yield "two_shells", Part.makeBox(10, 10, 10).cut(Part.makeSphere(3, V(5, 5, 5)))
    yield "thickness", box.makeThickness([box.Faces[0]], 0.5, 1e-4)
    yield "offset_solid", Part.makeCone(4, 2, 6).makeOffsetShape(0.5, 1e-4)
    yield "split_cylinder", Part.makeCylinder(3, 5).cut(Part.makeBox(10, 10, 2, V(0, -5, 1)))


def arranged():
    box, cone = Part.makeBox(1, 2, 3), Part.makeCone(3, 0, 5)
    moved = placed(cone, (10, 0, 0), (1, 1, 0), 40)
    yield "placed", moved
    yield "placed_again", placed(moved, (0, 5, 1), (0, 1, 0), 70)
    offset = Part.OffsetSurface(sheet(), 0.3).toShape()
    yield "placed_offset", placed(offset, (1, 2, 3), (1, 2, 3), 100)
    copies = [placed(box, (3 * i, i, 0), (0, 0, 1), 20 * i) for i in range(4)]
    shared = Part.makeCompound([box, *copies])
    yield "shared", shared
    nested = Part.makeCompound([shared, placed(shared, (0, 9, 0), (1, 0, 0), 90), moved])
    yield "nested", nested
    yield "nested_placed", placed(nested, (1, 1, 1), (1, 1, 1), 33)
    yield "same_place_twice", Part.makeCompound([moved, moved, cone])
    revolved = Part.Face(profile()).revolve(V(0, -5, 0), V(1, 0, 0), 270)
    yield "placed_revolution", placed(revolved, (4, 4, 4), (0, 1, 1), 15)
    mirrored = revolved.mirror(V(1, 0, 0), V(1, 0.2, 0))
    yield "mirrored", mirrored
    yield "mirrored_placed", placed(mirrored, (1, 2, 3), (0, 1, 0), 45)
    torus = Part.makeTorus(6, 1.5, V(), V(0, 1, 1), -60, 120, 200)
    yield "mirrored_torus", torus.mirror(V(), V(0, 0, 1))
    yield "mirrored_offset", offset.mirror(V(), V(0, 1, 1))
    turned = Part.makeSphere(2)
    turned.reverse()
    yield "reversed", turned
    face = Part.makeCylinder(1, 2).Faces[0].copy()
    face.reverse()
    yield "reversed_face", placed(face, (1, 0, 0), (0, 1, 0), 90)
    yield "shell", Part.makeBox(1, 2, 3).Shells[0]
    yield "open_shell", Part.makeShell(Part.makeBox(1, 2, 3).Faces[:4])
    pieces, _ = box.generalFuse([Part.makeBox(1, 2, 3, V(1, 0, 0))])
    yield "comp_solid", Part.CompSolid(pieces.Solids)
    loose = [Part.Vertex(9, 9, 9), wave().toShape(), Part.makeCircle(2)]
    yield "mixed", Part.makeCompound([box, *loose])
    scaled = cone.transformGeometry(FreeCAD.Matrix(2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0.5, 0))
    yield "stretched", scaled


def shapes():
    """All members, as pairs of name and shape."""
    for family in (primitives, rounded, swept, freeform, booleans, arranged):
        yield from family()
