"""The page of a morph: words, tables, and pictures with something in them."""

import copy
import html.parser
import re
import tempfile
import unittest
from pathlib import Path

from common import bladesmith, morph, packed
from freecad.bladesmith.model import Report
from freecad.bladesmith.report import page, tables, words

PICTURES = ["deviation", "displacement", "histograms", "movement", "part"]


def report(**changes) -> Report:
    document = copy.deepcopy(morph(packed("base.step"), packed("base.frd")).report)
    document.update(changes)
    return Report(document)


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.holder = tempfile.TemporaryDirectory(prefix="bladesmith-tests-")
        cls.folder = Path(cls.holder.name, "pages")
        part, field = packed("sphere.step"), packed("sphere.frd")
        output = Path(cls.holder.name, "cold.step")
        cls.done = bladesmith("morph", part, field, "-o", output, "--report", cls.folder)

    @classmethod
    def tearDownClass(cls):
        cls.holder.cleanup()

    def test_it_stands_alone_with_its_pictures_inside(self):
        self.assertEqual(self.done.returncode, 0, self.done.stderr)
        files = sorted(path.name for path in self.folder.iterdir())
        self.assertEqual(files, sorted([f"{name}.png" for name in PICTURES] + ["report.html"]))
        text = (self.folder / "report.html").read_text()
        self.assertEqual(text.count("data:image/png;base64,"), len(PICTURES))
        self.assertNotRegex(re.sub(r"base64,[^\"]*", "", text), r"(src|href)=\"?https?:")

    def test_its_tags_are_closed(self):
        checker = Tags()
        checker.feed((self.folder / "report.html").read_text())
        self.assertEqual(checker.open, [])

    def test_pictures_show_the_part_in_colours_of_the_map(self):
        import numpy
        from matplotlib import image

        for name in ("part", "movement", "displacement", "deviation"):
            pixels = image.imread(str(self.folder / f"{name}.png"))[..., :3]
            height, width = pixels.shape[:2]
            self.assertGreater(min(height, width), 300, name)
            drawn = (pixels < 0.97).any(axis=2)
            self.assertTrue(0.15 < drawn.mean() < 0.9, f"{name}: {drawn.mean():.2f} is drawn")
            colours = numpy.unique((pixels[drawn] * 15).astype(int), axis=0)
            self.assertGreater(len(colours), 20, name)


class Tags(html.parser.HTMLParser):
    """Keeps the tags that are still open."""

    def __init__(self):
        super().__init__()
        self.open = []

    def handle_starttag(self, tag, attrs):
        if tag not in ("meta", "img", "br", "link"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            raise AssertionError(f"</{tag}> closes nothing")


class Words(unittest.TestCase):
    def test_a_good_result_is_called_good(self):
        self.assertEqual(words.state(report(warnings=[]), 1e-3), "good")
        self.assertIn("within the tolerance", words.sentences(report(), 1e-3)[0])

    def test_a_missed_tolerance_an_open_or_an_invalid_solid_are_called_bad(self):
        self.assertEqual(words.state(report(), 1e-12), "bad")
        self.assertIn("beyond the tolerance", words.sentences(report(), 1e-12)[0])
        for change in ({"closed": False}, {"valid": False}, {"folded": 1}):
            solid = {**report().solid, **change}
            self.assertEqual(words.state(report(solid=solid), 1e-3), "bad")
        said = words.sentences(report(solid={**report().solid, "folded": 1}), 1e-3)
        self.assertIn("folded, not to be used: 1 sampled normal turned", said[0])

    def test_warnings_and_opened_joints_are_called_odd_and_named(self):
        self.assertEqual(words.state(report(warnings=["look"]), 1e-3), "odd")
        edges = copy.deepcopy(report().document["edges"])
        edges[2].update(tangent=True, angle_deg={"before": 0.0, "after": 0.5}, held=True)
        changed = report(edges=edges, warnings=[])
        self.assertEqual(words.state(changed, 1e-3), "odd")
        said = " ".join(words.sentences(changed, 1e-3))
        self.assertIn("Beside held faces, Edge3 opened by up to 0.5°", said)
        edges[2]["held"] = False
        said = " ".join(words.sentences(report(edges=edges), 1e-3))
        self.assertIn("1 of 1 tangent joints opened: Edge3.", said)


class Tables(unittest.TestCase):
    def test_faces_come_worst_first_and_beyond_the_tolerance_marked(self):
        faces = copy.deepcopy(report().document["faces"])
        faces[3]["deviation_mm"] = {"mean": 1.0, "max": 2.0}
        text = tables.faces_table(report(faces=faces), 1e-3)
        first = text.index("<tbody>") + len("<tbody>")
        self.assertTrue(text[first:].startswith('<tr class="bad"><td class=text>4</td>'))
        self.assertEqual(text.count('class="bad"'), 1)

    def test_columns_of_the_hold_out_test_are_there_where_it_was_made(self):
        self.assertNotIn("Hold-out", tables.faces_table(report(), 1e-3))
        tested = Report(morph(packed("base.step"), packed("base.frd"), "--holdout").report)
        self.assertIn("Hold-out mean", tables.faces_table(tested, 1e-3))

    def test_names_cannot_break_the_page(self):
        faces = copy.deepcopy(report().document["faces"])
        faces[0]["name"] = "<script>alert('x')</script>"
        text = page._page(report(faces=faces, warnings=["<b>"]), [], 1e-3, 8)
        self.assertNotIn("<script>", text)
        self.assertNotIn("<b>\n", text.replace("<li><b>", ""))
        self.assertIn("&lt;b&gt;", text)


if __name__ == "__main__":
    unittest.main()
