"""Values shown as colours: palettes, scales, values carried over from nodes, ticks and labels."""

import unittest

import common  # noqa: F401  FreeCAD comes before numpy
import numpy
from freecad.bladesmith.colours import palette
from freecad.bladesmith.colours.nodes import weighted
from freecad.bladesmith.colours.scale import Scale, automatic, labels, number

GREY_OF_SRGB = numpy.array([0.2126, 0.7152, 0.0722])


class Palettes(unittest.TestCase):
    def test_lightness_runs_evenly_and_one_way(self):
        for name in ("sequential", "severity"):
            steps = numpy.diff(palette.oklab(name, 65)[:, 0])
            self.assertGreater(abs(steps).min(), 0.8 * abs(steps).max(), name)
            self.assertEqual(len(set(numpy.sign(steps))), 1, name)

    def test_the_diverging_one_is_lightest_in_the_middle_and_alike_on_both_sides(self):
        light = palette.oklab("diverging", 65)[:, 0]
        self.assertEqual(light.argmax(), 32)
        self.assertLess(abs(light - light[::-1]).max(), 0.01)

    def test_equal_steps_of_value_look_about_equal(self):
        for name in palette.NAMES:
            steps = numpy.linalg.norm(numpy.diff(palette.oklab(name, 33), axis=0), axis=1)
            self.assertLess(steps.max() / steps.min(), 2.0, name)

    def test_what_the_screen_shows_keeps_the_order_in_grey(self):
        for name in ("sequential", "severity"):
            srgb = palette.colours(name, 33)
            linear = numpy.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)
            grey = numpy.diff(linear @ GREY_OF_SRGB)
            self.assertEqual(len(set(numpy.sign(grey))), 1, name)


class Scales(unittest.TestCase):
    def test_ends_lie_at_0_and_1_beyond_is_cut_and_unknown_stays(self):
        for scale in (Scale(1, 3), Scale(1, 3, steps=4, logarithmic=True)):
            places = scale.places(numpy.array([0.5, 1, 3, 7, numpy.nan]))
            numpy.testing.assert_allclose(places, [0, 0, 1, 1, numpy.nan], atol=1e-15)

    def test_value_undoes_places(self):
        for scale in (Scale(-2, 6), Scale(1e-6, 1e-2, logarithmic=True)):
            values = numpy.array([scale.value(place) for place in (0.0, 0.3, 1.0)])
            numpy.testing.assert_allclose(scale.places(values), [0, 0.3, 1], atol=1e-12)

    def test_a_scale_without_length_is_refused(self):
        for low, high, logarithmic in ((1, 1, False), (2, 1, False), (0, 1, True)):
            with self.assertRaises(ValueError):
                Scale(low, high, 0, logarithmic)
        with self.assertRaises(ValueError):
            Scale(0, numpy.nan)

    def test_steps_have_one_colour_each_and_reach_both_ends_of_the_palette(self):
        colours = palette.colours("sequential", 240)
        bar = Scale(0, 1, steps=6).bar(colours)
        self.assertEqual(len(numpy.unique(bar, axis=0)), 6)
        numpy.testing.assert_array_equal(bar[[0, 39, -1]], colours[[0, 0, -1]])
        self.assertFalse((bar[39] == bar[40]).all())

    def test_automatic_scales_hold_all_values(self):
        values = numpy.array([-0.4, 0.1, numpy.nan, 0.3])
        self.assertEqual(automatic(values, signed=True, logarithmic=False), Scale(-0.4, 0.4))
        self.assertEqual(automatic(abs(values), signed=False, logarithmic=False), Scale(0, 0.4))
        nothing = numpy.full(3, numpy.nan)
        self.assertEqual(automatic(nothing, signed=True, logarithmic=False), Scale(-1, 1))

    def test_automatic_logarithmic_scales_span_one_to_three_decades(self):
        for low, high in ((1e-9, 3e-4), (1e-5, 1e-5), (0, 0), (2e-5, 3e-4)):
            scale = automatic(numpy.geomspace(low + 1e-12, high + 1e-12, 99), False, True)
            self.assertGreaterEqual(scale.high, high)
            self.assertTrue(9.99 <= scale.high / scale.low <= 1000.1, scale)


class Ticks(unittest.TestCase):
    def test_they_are_the_ends_and_round_values_between(self):
        scale = Scale(0, 0.5446)
        numpy.testing.assert_allclose(scale.ticks(), [0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.5446])
        self.assertEqual(labels(scale)[-2:], ["0.500", "0.545"])
        self.assertEqual(labels(scale, unit_mm=1e-3)[-2:], ["500", "545"])

    def test_steps_are_named_at_their_borders(self):
        self.assertEqual(labels(Scale(-1, 1, steps=4)), ["-1.00", "-0.50", "0.00", "0.50", "1.00"])

    def test_decades_are_named_on_a_logarithmic_scale(self):
        self.assertEqual(
            labels(Scale(1e-6, 2.9e-4, 0, True), 1e-3),
            ["0.001", "0.002", "0.005"] + ["0.01", "0.02", "0.05", "0.1", "0.2", "0.29"],
        )

    def test_numbers_far_from_1_get_a_power_of_ten(self):
        cases = {0: "0", 0.25: "0.25", 1e-4: "10⁻⁴", 2.91e-4: "2.91·10⁻⁴", -1e-7: "-10⁻⁷"}
        cases.update({1234: "1234", 5e6: "5·10⁶"})
        self.assertEqual({value: number(value) for value in cases}, cases)


class NearestNodes(unittest.TestCase):
    def test_points_get_what_a_search_among_all_nodes_gives(self):
        random = numpy.random.default_rng(7)
        points, feet = random.random((900, 3)) * (9, 1, 0.1), random.random((1500, 3)) * (9, 1, 0.1)
        values = random.random((1500, 2))
        squares = ((points[:, None] - feet[None]) ** 2).sum(axis=2)
        nearest = numpy.argsort(squares, axis=1)[:, :4]
        weights = 1 / numpy.take_along_axis(squares, nearest, 1)
        expected = (values[nearest] * weights[..., None]).sum(axis=1) / weights.sum(1)[:, None]
        numpy.testing.assert_allclose(weighted(points, feet, values), expected, atol=2e-3)

    def test_at_a_node_its_own_value_counts(self):
        random = numpy.random.default_rng(8)
        feet, values = random.random((400, 3)), random.random(400)
        numpy.testing.assert_allclose(weighted(feet, feet, values), values, atol=1e-4)

    def test_fewer_nodes_than_neighbours_are_enough(self):
        point, foot = numpy.zeros((1, 3)), numpy.ones((1, 3))
        numpy.testing.assert_allclose(weighted(point, foot, numpy.array([5.0])), [5.0])


if __name__ == "__main__":
    unittest.main()
