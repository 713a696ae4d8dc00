"""STEP text: scanning, strings, edits."""

import random
import unittest

import common  # noqa: F401  (puts the package on the path)
from freecad.bladesmith.occ.part21 import (
    Enumeration,
    Part21Error,
    Record,
    Reference,
    decode,
    edited,
    encode,
    scan,
)

FILE = """ISO-10303-21;
HEADER;
FILE_DESCRIPTION(('a ; b'),'2;1');
FILE_NAME('it''s','2020-01-01T00:00:00',(''),(''),'','','');
FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));
ENDSEC;
DATA;
/* a comment with #99 = NOTHING('x'); inside */
#1 = ADVANCED_FACE('suction
 side',(#2, #3),#4,.F.);
#2=CARTESIAN_POINT ( 'p' , ( 1., -2.5E-03 , +3 ) ) ;
#3 = ( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.) );
#10 = UNCERTAINTY(LENGTH_MEASURE(1.E-07),$,"0AF",((1,2),(3,4)));
ENDSEC;
END-ISO-10303-21;
"""


class Scanning(unittest.TestCase):
    def setUp(self):
        self.file = scan(FILE)

    def test_entities_are_found_by_number_and_keyword_and_comments_are_not(self):
        self.assertEqual(sorted(self.file.places), [1, 2, 3, 10])
        self.assertEqual(self.file.numbers["ADVANCED_FACE"], [1])

    def test_parameters_keep_their_kinds(self):
        face = self.file.record(1)
        self.assertEqual(face.keyword, "ADVANCED_FACE")
        self.assertEqual(face.parameters, ["suction side", [2, 3], 4, "F"])
        self.assertIsInstance(face.parameters[1][0], Reference)
        self.assertIsInstance(face.parameters[3], Enumeration)
        self.assertEqual(self.file.record(2).parameters, ["p", [1.0, -2.5e-3, 3]])

    def test_complex_entities_have_several_records(self):
        records = self.file.entity(3)
        self.assertEqual([r.keyword for r in records], ["LENGTH_UNIT", "NAMED_UNIT", "SI_UNIT"])
        self.assertEqual(self.file.record(3, "SI_UNIT").parameters, ["MILLI", "METRE"])

    def test_typed_parameters_nested_lists_and_unset_values(self):
        typed, unset, binary, lists = self.file.record(10).parameters
        self.assertEqual(typed, Record("LENGTH_MEASURE", [1e-7]))
        self.assertIsNone(unset)
        self.assertEqual(binary, "0AF")
        self.assertEqual(lists, [[1, 2], [3, 4]])

    def test_header_entries_end_before_their_semicolon_even_with_one_in_a_string(self):
        start, end = self.file.header["FILE_DESCRIPTION"]
        self.assertEqual(FILE[start:end], "FILE_DESCRIPTION(('a ; b'),'2;1')")

    def test_an_edit_changes_only_its_place(self):
        start, end = self.file.first_string(1)
        changed = edited(FILE, [(start, end, encode("TE"))])
        self.assertEqual(scan(changed).record(1).parameters[0], "TE")
        self.assertEqual(changed.replace("'TE'", "'suction\n side'"), FILE)


class Damage(unittest.TestCase):
    def test_other_files_are_refused_by_their_first_words(self):
        with self.assertRaisesRegex(Part21Error, "line 1: expected 'ISO-10303-21;'"):
            scan("solid ascii\n")

    def test_a_file_that_is_cut_off_is_told_so(self):
        with self.assertRaisesRegex(Part21Error, "cut off"):
            scan(FILE[: FILE.index("#10")])

    def test_a_malformed_entity_names_its_line_and_what_was_expected(self):
        broken = scan(FILE.replace("(#2, #3),#4", "(#2, #3,#4"))
        with self.assertRaisesRegex(Part21Error, r"line 9|line 10.*expected"):
            broken.record(1)

    def test_a_missing_entity_is_named(self):
        with self.assertRaisesRegex(Part21Error, "#7 is used but not defined"):
            scan(FILE).record(7)

    def test_every_cut_and_every_lost_byte_ends_in_an_answer(self):
        for position in range(0, len(FILE), 3):
            for text in (FILE[:position], FILE[:position] + FILE[position + 1 :]):
                try:
                    file = scan(text)
                    for number in file.places:
                        file.entity(number)
                except Part21Error:
                    continue


class Strings(unittest.TestCase):
    def test_escapes_of_the_standard_are_read(self):
        cases = {
            "'it''s'": "it's",
            r"'\X2\00FC\X0\ber'": "über",
            r"'\X4\0001F600\X0\'": "\U0001f600",
            r"'\X\FC'": "ü",
            r"'\S\|'": "ü",
            r"'a\\b'": "a\\b",
            "'two\r\nlines'": "twolines",
        }
        for text, expected in cases.items():
            self.assertEqual(decode(text), expected, text)

    def test_every_text_survives_being_written_and_read(self):
        letters = "aB '\\\"üß日\U0001f600\t;#/*"
        random.seed(4)
        for _ in range(500):
            text = "".join(random.choices(letters, k=random.randrange(12)))
            written = encode(text)
            self.assertTrue(written.isascii() and written.isprintable(), written)
            self.assertEqual(decode(written), text)


if __name__ == "__main__":
    unittest.main()
