"""Independent judges of the core: Open CASCADE's points, trimesh's volumes."""

import unittest

import common
from common import Part as FreeCADPart
from common import morph, packed
from freecad.bladesmith import native

RELATIVE = 1e-12
EPSILON = 2.0**-52
ORDERS = ((0, 0), (1, 0), (0, 1), (2, 0), (1, 1), (0, 2))
GRID = 7


class Evaluation(unittest.TestCase):
    """The core's points and derivatives against Open CASCADE's, each by its own magnitude."""

    def assert_equal_surfaces(self, shape, name):
        import numpy

        part = native.Part.read(shape.exportBrepToString(), name)
        for index, face in enumerate(shape.Faces, 1):
            low_u, high_u, low_v, high_v = face.ParameterRange
            parameters = [
                (
                    low_u + (high_u - low_u) * (i + 0.37) / GRID,
                    low_v + (high_v - low_v) * (j + 0.61) / GRID,
                )
                for i in range(GRID)
                for j in range(GRID)
            ]
            ours = part.evaluate(index, parameters, 2)
            theirs = numpy.array([derivatives(face.Surface, u, v) for u, v in parameters])
            allowed = RELATIVE * numpy.abs(theirs).max(axis=(0, 2))
            allowed += 16 * EPSILON * numpy.abs(theirs[:, 0]).max() * amplification(face.Surface)
            excess = (numpy.abs(ours - theirs).max(axis=(0, 2)) / allowed).max()
            self.assertLessEqual(excess, 1, f"{name}: Face{index}, {face.Surface.TypeId}")

    def test_morphed_faces_of_the_small_cases(self):
        for name in ("base", "sphere"):
            done = morph(packed(f"{name}.step"), packed(f"{name}.frd"))
            self.assert_equal_surfaces(done.solid, name)

    def test_morphed_faces_of_the_blade(self):
        self.assert_equal_surfaces(blade().solid, "blade")

    def test_faces_of_every_elementary_kind(self):
        solids = {
            "cone": FreeCADPart.makeCone(3, 1, 5),
            "torus": FreeCADPart.makeTorus(5, 1),
            "sphere": FreeCADPart.makeSphere(2),
            "cylinder": FreeCADPart.makeCylinder(2, 5),
            "box": FreeCADPart.makeBox(1, 2, 3),
        }
        for name, shape in solids.items():
            self.assert_equal_surfaces(shape, name)


def derivatives(surface, u, v):
    """S, Su, Sv, Suu, Suv, Svv of Open CASCADE."""
    return [
        list(surface.value(u, v) if order == (0, 0) else surface.getDN(u, v, *order))
        for order in ORDERS
    ]


def amplification(surface):
    """How much differences of poles, rounded to doubles, are enlarged in each derivative."""
    import numpy

    if not hasattr(surface, "getUKnots"):
        return numpy.ones(len(ORDERS))
    per_u, per_v = (
        degree / min(numpy.diff(knots))
        for degree, knots in (
            (surface.UDegree, surface.getUKnots()),
            (surface.VDegree, surface.getVKnots()),
        )
    )
    return numpy.array([per_u**a * per_v**b for a, b in ORDERS])


def blade():
    folder = common.EXAMPLE
    mesh = ("--mesh", str(folder / "blade.inp.gz"), "--factor", "-1", "--holdout")
    return morph(folder / "hot.step.gz", folder / "blade.frd.gz", *mesh)


class Tessellation(unittest.TestCase):
    """trimesh finds a fine tessellation watertight, its volume converging to the core's."""

    def assert_watertight(self, done, fractions, limit):
        """Chords are fractions of the size; ``limit`` is on the volume's error at the finest.

        A chord off the surface by no more than c changes the volume by no more than c times area.
        """
        import numpy
        import trimesh

        size = done.solid.BoundBox.DiagonalLength
        volume = done.report["solid"]["volume_mm3"]["after"]
        errors = []
        for fraction in fractions:
            points, triangles = done.solid.copy().tessellate(size * fraction)
            mesh = trimesh.Trimesh(
                numpy.array([list(p) for p in points]), numpy.array(triangles), process=False
            )
            mesh.merge_vertices()
            self.assertTrue(mesh.is_watertight, f"chord {fraction} of the size")
            self.assertTrue(mesh.is_winding_consistent)
            errors.append(abs(mesh.volume / volume - 1))
            self.assertLess(errors[-1], size * fraction * mesh.area / volume)
        self.assertLess(errors[-1], limit, errors)
        self.assertLess(errors[-1], errors[0], errors)

    def test_the_bar(self):
        done = morph(packed("base.step"), packed("base.frd"))
        self.assert_watertight(done, (1e-2, 1e-3, 2e-4), 2e-4)

    def test_the_bar_with_a_ball(self):
        done = morph(packed("sphere.step"), packed("sphere.frd"))
        self.assert_watertight(done, (1e-2, 3e-3, 6e-4), 2e-4)

    def test_the_blade(self):
        self.assert_watertight(blade(), (1e-2, 5e-4), 6e-4)


if __name__ == "__main__":
    unittest.main()
