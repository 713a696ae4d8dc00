"""Every text of the window has its German, and the compiled file says what the source says."""

import os
import re
import subprocess
import sys
import unittest

import common
from freecad.bladesmith.taskpanels import core_texts
from test_reference import flat

sys.path.insert(0, str(common.ROOT / "tools"))

import translations  # noqa: E402

FILES = sorted(translations.FOLDER.glob("*.ts"))
_LOOK_UP = """
import json, sys
from PySide2.QtCore import QCoreApplication, QTranslator
application, translator = QCoreApplication([]), QTranslator()
assert translator.load(sys.argv[1]), "it cannot be loaded"
print(json.dumps([translator.translate(*key) for key in json.load(sys.stdin)]))
"""


class CoreTexts(unittest.TestCase):
    """The core's messages, which the window knows by their fixed words."""

    def test_they_are_those_of_the_core(self):
        said = "\n".join(map(flat, (common.ROOT / "src").rglob("*.rs")))
        for message in core_texts.TRANSLATED:
            for part in re.split(r"{\d}", message):
                self.assertTrue(part.strip(" ;:()") in said, f"the core does not say: {message}")

    def test_what_the_core_says_is_known_and_anything_else_stays(self):
        done = common.morph(common.packed("base.step"), common.packed("base.frd"), "--factor", "-1")
        refused = common.morph(common.packed("base.step"), common.awkward("mirrored"))
        said = [refused.stderr.strip().removeprefix("bladesmith: "), *done.report["warnings"]]
        self.assertGreater(len(said), 3)
        for text in said:
            shouted = core_texts.localised(text, str.upper)
            self.assertNotEqual(shouted, text)
            self.assertEqual(shouted.lower(), text.lower())
        self.assertEqual(core_texts.localised("something else", str.upper), "something else")


class Translations(unittest.TestCase):
    def test_german_is_there(self):
        self.assertIn("Bladesmith_de.ts", [path.name for path in FILES])

    def test_every_text_of_the_sources_is_translated_and_no_other(self):
        for path in FILES:
            said = translations.translations(path)
            self.assertEqual(set(said), translations.texts(), "run tools/translations.py update")
            missing = [key for key, text in said.items() if not text]
            self.assertFalse(missing, path.name)

    def test_placeholders_stay(self):
        for path in FILES:
            for (_context, source), text in translations.translations(path).items():
                wanted, found = (sorted(re.findall(r"{\d}", t)) for t in (source, text))
                self.assertEqual(wanted, found, source)

    def test_compiled_files_are_those_of_the_sources(self):
        import json

        for path in FILES:
            said = translations.translations(path)
            done = subprocess.run(
                ["/usr/bin/python3", "-c", _LOOK_UP, str(path.with_suffix(".qm"))],
                input=json.dumps(list(said)),
                env={**os.environ, "QT_QPA_PLATFORM": "offscreen"},
                capture_output=True,
                text=True,
            )
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(json.loads(done.stdout), list(said.values()), path.name)


if __name__ == "__main__":
    unittest.main()
