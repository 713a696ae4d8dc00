"""Makes bar.brep and bar.frd.gz, the small part that the C programs morph.

A bar 20 x 8 x 40 mm with a round hole across, and on nodes of its surface a displacement field
given in closed form: an expansion, a turn, and a bend that is quadratic in z. Run it with
FreeCAD's modules on the path:

    PYTHONPATH=/usr/lib/freecad-python3/lib /usr/bin/python3 make_bar.py
"""

import gzip
from pathlib import Path

import FreeCAD
import Part

HERE = Path(__file__).parent
SPACING_MM = 2.0


def bar():
    """The solid; seven faces, one of them with a seam."""
    block = Part.makeBox(20, 8, 40, FreeCAD.Vector(-10, -4, 0))
    return block.cut(Part.makeCylinder(3, 12, FreeCAD.Vector(2, -6, 22), FreeCAD.Vector(0, 1, 0)))


def displacement(p):
    """Displacement in mm at a point in mm."""
    bend = 2e-5 * p.z**2
    return 2e-3 * p.x - 1e-3 * p.y + bend, 1e-3 * p.x + 2e-3 * p.y, 2e-3 * p.z - 4e-5 * p.z * p.x


def surface_points(shape):
    """Points on the faces about SPACING_MM apart, those on edges included, each once."""
    found = {}

    def keep(point):
        found.setdefault(tuple(round(value, 6) + 0.0 for value in point))

    for edge in shape.Edges:
        count = max(3, round(edge.Length / SPACING_MM) + 1)
        for point in edge.discretize(Number=count):
            keep(point)
    for face in shape.Faces:
        u0, u1, v0, v1 = face.ParameterRange
        scale = face.Surface.Radius if hasattr(face.Surface, "Radius") else 1.0
        nu, nv = round((u1 - u0) * scale / SPACING_MM), round((v1 - v0) / SPACING_MM)
        for i in range(1, nu):
            for j in range(1, nv):
                u, v = u0 + (u1 - u0) * i / nu, v0 + (v1 - v0) * j / nv
                if face.isPartOfDomain(u, v):
                    keep(face.valueAt(u, v))
    return [FreeCAD.Vector(*point) for point in sorted(found)]


def record(key, values):
    """One line of a block of an .frd file: node number and three values of twelve columns."""
    return f" -1{key:10d}" + "".join(f"{value:12.5E}" for value in values)


def frd(points):
    """The text of a CalculiX result file with nodes and displacements, without elements."""
    count = len(points)
    lines = ["    1C", f"    2C{'':18}{count:12d}{'':37}1"]
    lines += [record(i + 1, p) for i, p in enumerate(points)]
    lines += [
        " -3",
        f"  100CL  101 1.000000000{count:12d}{'':21}0    1           1",
        " -4  DISP        4    1",
    ]
    lines += [f" -5  D{i}          1    2    {i}    0" for i in (1, 2, 3)]
    lines += [" -5  ALL         1    2    0    0    1ALL"]
    lines += [record(i + 1, displacement(p)) for i, p in enumerate(points)]
    return "\n".join(lines + [" -3", " 9999", ""])


def main():
    shape = bar()
    (HERE / "bar.brep").write_text(shape.exportBrepToString())
    with (
        open(HERE / "bar.frd.gz", "wb") as file,
        gzip.GzipFile("", "wb", fileobj=file, mtime=0) as packed,
    ):
        packed.write(frd(surface_points(shape)).encode())


if __name__ == "__main__":
    main()
