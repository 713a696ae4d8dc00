"""A result in FreeCAD's real 3-D view, under a virtual display."""

import unittest

from test_window import run_in_window


class ResultInWindow(unittest.TestCase):
    def test_colours_scale_movement_edges_and_page(self):
        failure = run_in_window("result_view")
        self.assertFalse(failure, failure)


if __name__ == "__main__":
    unittest.main()
