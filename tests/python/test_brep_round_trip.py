"""B-rep text through the core is the same shape for Open CASCADE.

BLADESMITH_DATA names a directory whose STEP files are tested too.
"""

import json
import math
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

import brep_zoo
from common import ROOT, Part

CATALOGUE = ROOT / "tests/data/brep/catalogue.brep"
PASSES = {
    "plain": [],
    "version2": ["--version=2"],
    "version3": ["--version=3"],
    "normalised": ["--normalise", "--sample"],
}
# Coordinates in the text carry 15 digits at least.
RELATIVE = 1e-12
# Parameters beyond this stand for infinity; sampling then goes up to FAR.
ENDLESS = 1e50
FAR = 5.0


def imported(text):
    shape = Part.Shape()
    shape.importBrepFromString(text)
    return shape


def step_files():
    data = os.environ.get("BLADESMITH_DATA")
    return sorted(pathlib.Path(data).rglob("*.step")) if data else []


def read_step(path):
    shape = Part.Shape()
    shape.read(str(path))
    return shape


def spread(first, last, n):
    """n parameters from first to last, infinite ends replaced."""
    if first < -ENDLESS:
        first = -FAR
    if last > ENDLESS:
        last = FAR
    return [first + (last - first) * i / (n - 1) for i in range(n)]


def flat(point):
    """Coordinates of a point of the plane, which FreeCAD does not let iterate."""
    return [point.x, point.y]


def direction(tangent):
    length = math.hypot(*tangent)
    return [x / length for x in tangent]


class Portrait:
    """All that makes a shape: words that must agree exactly, and numbers."""

    def __init__(self, shape):
        self.words, self.numbers = [str(shape.isValid())], []
        self.structure(shape)
        for number, face in enumerate(shape.Faces, 1):
            self.face(number, face)
        for number, edge in enumerate(shape.Edges, 1):
            self.edge(number, edge)
        for number, vertex in enumerate(shape.Vertexes, 1):
            self.tolerance(f"vertex {number}", vertex)
            self.add(f"vertex {number}", vertex.Point)

    def add(self, what, values):
        values = list(values)
        self.words.append(f"{what}: {len(values)} numbers")
        self.numbers.extend((what, value) for value in values)

    def tolerance(self, what, shape):
        self.words.append(f"{what} tolerance {shape.Tolerance:.12g}")

    def structure(self, shape):
        self.words.append(f"{shape.ShapeType} {shape.Orientation}")
        for child in shape.SubShapes:
            self.structure(child)
        self.words.append("end")

    def face(self, number, face):
        what = f"face {number}"
        self.words.append(f"{what} {face.Orientation} {face.Surface.TypeId}")
        self.tolerance(what, face)
        u0, u1, v0, v1 = face.ParameterRange
        self.add(f"{what} range", [u0, u1, v0, v1])
        for i, u in enumerate(spread(u0, u1, 6)):
            for j, v in enumerate(spread(v0, v1, 6)):
                self.add(f"{what} at sample ({i}, {j})", face.valueAt(u, v))
        for wire in face.Wires:
            self.words.append(f"{what} wire {wire.Orientation}")
            for edge in wire.Edges:
                self.trace(what, face, edge)

    def trace(self, what, face, edge):
        self.words.append(f"{what} edge {edge.Orientation}")
        trace = face.curveOnSurface(edge)
        if trace:
            curve, first, last = trace
            self.add(f"{what} trace range", [first, last])
            for i, t in enumerate(spread(first, last, 5)):
                self.add(f"{what} trace at sample {i}", flat(curve.value(t)))

    def edge(self, number, edge):
        what = f"edge {number}"
        self.words.append(f"{what} {edge.Orientation} {edge.Degenerated} {edge.Closed}")
        self.tolerance(what, edge)
        if not edge.Degenerated:
            self.add(f"{what} range", edge.ParameterRange)
            for i, t in enumerate(spread(*edge.ParameterRange, 9)):
                self.add(f"{what} at sample {i}", edge.valueAt(t))


def power_scale(degrees_and_knots, orders):
    """How much larger than the poles a spline's derivative may become: p!/(p-k)!/h^k."""
    scale = 1.0
    for (degree, knots), order in zip(degrees_and_knots, orders):
        shortest = min(b - a for a, b in zip(knots, knots[1:]))
        for k in range(order):
            scale *= (degree - k) / shortest
    return scale


def largest(poles):
    return max(abs(x) for pole in poles for x in pole)


def third_derivative_is_approximate(surface):
    """Open CASCADE gives no exact third derivative of offset curves, which an offset needs."""
    basis = getattr(surface, "BasisSurface", None)
    return isinstance(getattr(basis, "BasisCurve", None), Part.OffsetCurve)


class RoundTrip(unittest.TestCase):
    """Texts of all shapes, written again by the core in every way."""

    maxDiff = 2000

    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.directory = pathlib.Path(cls.temporary.name)
        (cls.directory / "texts").mkdir()
        cls.shapes = dict(brep_zoo.shapes())
        cls.steps = {f"step_{p.parent.name}_{p.stem}": read_step(p) for p in step_files()}
        cls.shapes.update(cls.steps)
        for name, shape in cls.shapes.items():
            cls.text_file("texts", name).write_text(shape.exportBrepToString())
        catalogue = CATALOGUE.read_text()
        cls.shapes["catalogue"] = imported(catalogue)
        cls.text_file("texts", "catalogue").write_text(catalogue)
        for name, options in PASSES.items():
            cls.run_core(name, options)
        cls.portraits = {name: Portrait(shape) for name, shape in cls.shapes.items()}

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    @classmethod
    def text_file(cls, directory, name):
        return cls.directory / directory / f"{name}.brep"

    @classmethod
    def run_core(cls, name, options):
        (cls.directory / name).mkdir()
        paths = [str(cls.directory / "texts"), str(cls.directory / name)]
        command = ["cargo", "run", "--release", "--locked", "--quiet", "--example"]
        command += ["brep_round_trip", "--"]
        done = subprocess.run(command + options + paths, cwd=ROOT, text=True, capture_output=True)
        if done.returncode:
            raise AssertionError(f"{name}: the core failed: {done.stderr}")

    def compare(self, pass_name):
        for name, expected in self.portraits.items():
            with self.subTest(shape=name):
                shape = imported(self.text_file(pass_name, name).read_text())
                self.assert_same(expected, Portrait(shape))

    def assert_same(self, expected, found):
        self.assertEqual(expected.words, found.words)
        for (what, a), (_, b) in zip(expected.numbers, found.numbers):
            if abs(a - b) > RELATIVE * max(1.0, abs(a)):
                self.fail(f"{what}: {b!r} instead of {a!r}")

    def for_each_sample(self, check):
        for name in self.shapes:
            with self.subTest(shape=name):
                shape = imported(self.text_file("normalised", name).read_text())
                file = self.text_file("normalised", name).with_suffix(".json")
                check(shape, json.loads(file.read_text()))

    def assert_close(self, what, found, expected, scale=1.0):
        found, expected = list(found), list(expected)
        bound = RELATIVE * max(1.0, scale, *(abs(x) for x in expected))
        gap = max(abs(a - b) for a, b in zip(found, expected))
        if not gap <= bound:
            self.fail(f"{what}: core {found}, Open CASCADE {expected}, gap {gap} > {bound}")

    def test_written_text_is_the_same_shape(self):
        self.compare("plain")

    def test_format_version_2_is_the_same_shape(self):
        self.compare("version2")

    def test_format_version_3_is_the_same_shape(self):
        self.compare("version3")

    def test_open_cascade_writes_the_same_text_again(self):
        """Nothing is lost: flags, regularities, points on curves, locations, sharing, order."""
        for pass_name in ("plain", "version2", "version3"):
            for name in self.shapes:
                with self.subTest(shape=name, text=pass_name):
                    expected, found = (self.written_again(d, name) for d in ("texts", pass_name))
                    self.assert_same_text(expected, found)

    def written_again(self, directory, name):
        """Tokens that Open CASCADE writes after reading a text.

        Without the flag 'checked' of shapes: it sets that itself on reading format version 1.
        """
        text = imported(self.text_file(directory, name).read_text()).exportBrepToString()
        return re.sub(r"^([01]{2})[01]([01]{4})$", r"\1_\2", text, flags=re.MULTILINE).split()

    def assert_same_text(self, expected, found):
        self.assertEqual(len(expected), len(found))
        for number, (a, b) in enumerate(zip(expected, found)):
            if a != b:
                near = " ".join(expected[max(number - 8, 0) : number + 1])
                delta = 1e-15 * max(1.0, abs(float(a)))
                self.assertAlmostEqual(float(a), float(b), delta=delta, msg=near)

    def test_triangulations_are_kept(self):
        for pass_name in ("texts", "plain", "version2", "version3"):
            faces = imported(self.text_file(pass_name, "catalogue").read_text()).Faces
            self.assertEqual(faces[2].getUVNodes(), [(0, 0), (1, 0), (1, 1)], pass_name)

    def test_normalised_text_is_the_same_shape(self):
        self.compare("normalised")

    def test_normalised_text_has_no_locations(self):
        for name in self.shapes:
            text = self.text_file("normalised", name).read_text()
            self.assertIn("\nLocations 0 \n", text, name)
            self.assertIn("\nTriangulations 0 \n", text, name)

    def test_the_data_were_there(self):
        if not self.steps:
            self.skipTest("BLADESMITH_DATA is not set: STEP files of real parts were not tested")
        self.assertGreater(len(self.steps), 4)

    def test_surfaces_evaluate_as_in_open_cascade(self):
        self.for_each_sample(self.check_surfaces)

    def check_surfaces(self, shape, samples):
        self.assertEqual(len(shape.Faces), len(samples["faces"]))
        for number, (face, sample) in enumerate(zip(shape.Faces, samples["faces"]), 1):
            for uv, derivatives in sample["points"]:
                what = f"face {number}, {sample['kind']}, at {uv}"
                self.check_surface_point(what, face, uv, derivatives)
            for uv, (point,) in sample["ends"]:
                what = f"face {number}, {sample['kind']}, at {uv}"
                self.assert_close(what, point, face.valueAt(*uv))

    def check_surface_point(self, what, face, uv, derivatives):
        surface, first, second = face.Surface, face.derivative1At(*uv), face.derivative2At(*uv)
        # FreeCAD offers the mixed derivative only of surfaces.
        expected = [face.valueAt(*uv), *first, second[0], surface.getDN(*uv, 1, 1), second[1]]
        orders = [(0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2)]
        if third_derivative_is_approximate(surface):
            expected = expected[:3]
        for order, a, b in zip(orders, derivatives, expected):
            scale = self.surface_scale(surface, order)
            self.assert_close(f"{what}, derivative {order}", a, b, scale)

    def surface_scale(self, surface, orders):
        """Size of the terms that sum up to a derivative: rounding is relative to it."""
        if isinstance(surface, Part.OffsetSurface):
            # The normal's k-th derivative has the basis' next one.
            basis = surface.BasisSurface
            extra = max(self.surface_scale(basis, order) for order in ((1, 0), (0, 1)))
            return self.surface_scale(basis, orders) * extra
        if isinstance(surface, Part.BSplineSurface):
            knots = [(surface.UDegree, surface.getUKnots()), (surface.VDegree, surface.getVKnots())]
            poles = [pole for row in surface.getPoles() for pole in row]
            return largest(poles) * power_scale(knots, orders)
        basis = getattr(surface, "BasisCurve", None)
        if isinstance(basis, Part.BSplineCurve):
            along = orders[1] if isinstance(surface, Part.SurfaceOfRevolution) else orders[0]
            return self.curve_scale(basis, along)
        return 1.0

    def curve_scale(self, curve, order):
        if isinstance(curve, Part.BSplineCurve):
            knots = [(curve.Degree, curve.getKnots())]
            return largest(curve.getPoles()) * power_scale(knots, [order])
        return 1.0

    def test_curves_evaluate_as_in_open_cascade(self):
        self.for_each_sample(self.check_curves)

    def check_curves(self, shape, samples):
        self.assertEqual(len(shape.Edges), len(samples["edges"]))
        for number, (edge, sample) in enumerate(zip(shape.Edges, samples["edges"]), 1):
            for (t,), (point,) in sample["ends"]:
                self.assert_close(f"edge {number}, at its end {t}", point, edge.valueAt(t))
            for (t,), (point, first, second) in sample["points"]:
                what = f"edge {number}, at {t}"
                expected = [edge.valueAt(t), edge.derivative1At(t), edge.derivative2At(t)]
                for order, (a, b) in enumerate(zip((point, first, second), expected)):
                    scale = self.curve_scale(edge.Curve, order)
                    self.assert_close(f"{what}, derivative {order}", a, b, scale)

    def test_topology_is_open_cascades(self):
        self.for_each_sample(self.check_topology)

    def check_topology(self, shape, samples):
        edges = {edge.hashCode(): i for i, edge in enumerate(shape.Edges)}
        users = [set() for _ in shape.Edges]
        for i, (face, sample) in enumerate(zip(shape.Faces, samples["faces"])):
            self.assertEqual(face.Orientation == "Reversed", sample["reversed"], f"face {i + 1}")
            self.check_traces(face, sample["traces"], edges)
            for edge in face.Edges:
                users[edges[edge.hashCode()]].add(i)
        for i, (edge, sample) in enumerate(zip(shape.Edges, samples["edges"])):
            self.assertEqual(users[i], set(sample["faces"]), f"edge {i + 1}")
            if edge.Orientation == "Forward" and not any(v is None for v in sample["vertices"]):
                ends = (edge.firstVertex(), edge.lastVertex())
                for vertex, point in zip(ends, sample["vertices"]):
                    self.assert_close(f"edge {i + 1}, vertex", point, vertex.Point)
        faces = {face.hashCode(): i for i, face in enumerate(shape.Faces)}
        solids = [[faces[face.hashCode()] for face in solid.Faces] for solid in shape.Solids]
        self.assertEqual(solids, samples["solids"])

    def check_traces(self, face, traces, edges):
        wires = [wire for wire in face.Wires if wire.ShapeType == "Wire"]
        self.assertEqual([len(wire) for wire in traces], [len(wire.SubShapes) for wire in wires])
        for wire, wire_traces in zip(wires, traces):
            for edge, trace in zip(wire.SubShapes, wire_traces):
                self.assertEqual(edges[edge.hashCode()], trace["edge"])
                for sample in trace["points"]:
                    self.check_trace(f"edge {trace['edge'] + 1}", face, edge, sample)

    def check_trace(self, what, face, edge, sample):
        (t,), uv, tangent, point = sample
        what = f"{what}, trace at {t}"
        trace = face.curveOnSurface(edge)
        if trace is None:
            # FreeCAD has no class for such a curve, but this edge has no other.
            self.assert_close(what, point, edge.valueAt(t))
            return
        curve = trace[0]
        self.assert_close(what, uv, flat(curve.value(t)))
        self.assert_close(f"{what}, direction", direction(tangent), flat(curve.tangent(t)))


if __name__ == "__main__":
    unittest.main()
