"""Reads and edits STEP files (ISO 10303-21, clear text) as text.

A scanner finds every entity of the data sections with its place in the text; parameters are parsed
when they are asked for. Open CASCADE does the geometry: this is for names, colours and headers,
which FreeCAD drops.
"""

import re
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import NamedTuple


class Reference(int):
    """``#12``, the number of an entity."""


class Enumeration(str):
    """``.T.``, without its dots."""


class Record(NamedTuple):
    """``KEYWORD(parameter, ...)``: an entity, a part of a complex one, or a typed parameter."""

    keyword: str
    parameters: list


class Part21Error(ValueError):
    """The text is not what ISO 10303-21 asks for; says where and what was expected."""


_DELIMITER = re.compile(r"'[^']*'|/\*.*?\*/|;", re.S)
_ENTITY = re.compile(r"(?:\s|/\*.*?\*/)*#(\d+)\s*=\s*([A-Za-z0-9_!]*)", re.S)
_TOKEN = re.compile(
    r"(?:\s|/\*.*?\*/)*(?:(?P<string>(?:'[^']*')+)|#(?P<reference>\d+)|\.(?P<enumeration>\w+)\.|"
    r'(?P<number>[+-]?\d+\.?\d*(?:[Ee][+-]?\d+)?)|(?P<keyword>!?[A-Za-z_]\w*)|"(?P<binary>\w*)"|'
    r"(?P<mark>[(),$*;])|(?P<end>\Z))",
    re.S,
)


@dataclass
class Part21:
    """The text of a file, the place of each entity's definition in it, and numbers by keyword."""

    text: str
    places: dict[int, tuple[int, int]] = field(default_factory=dict)
    numbers: dict[str, list[int]] = field(default_factory=lambda: defaultdict(list))
    header: dict[str, tuple[int, int]] = field(default_factory=dict)
    data_end: int = -1

    def entity(self, number: int) -> list[Record]:
        """The records of an entity: one, or several where it is complex.

        Raises :class:`Part21Error` where it is missing or malformed.
        """
        if number not in self.places:
            raise Part21Error(f"entity #{number} is used but not defined")
        start, end = self.places[number]
        tokens = _Tokens(self.text, start, end, f"entity #{number}")
        kind, value = tokens.next()
        if kind == "keyword":
            return [tokens.record(value)]
        if (kind, value) != ("mark", "("):
            raise tokens.error("a keyword or '('", value)
        records = []
        while True:
            kind, value = tokens.next()
            if (kind, value) == ("mark", ")"):
                return records
            if kind != "keyword":
                raise tokens.error("a keyword or ')'", value)
            records.append(tokens.record(value))

    def record(self, number: int, *keywords: str) -> Record:
        """The first record of an entity with one of ``keywords`` (any, if none are given)."""
        for record in self.entity(number):
            if not keywords or record.keyword in keywords:
                return record
        raise Part21Error(f"entity #{number} is no {' or '.join(keywords)}")

    def first_string(self, number: int) -> tuple[int, int]:
        """Place of the first string of an entity, quotes included."""
        start, end = self.places[number]
        for token in _TOKEN.finditer(self.text, start, end):
            if token.lastgroup == "string":
                return token.span("string")
        raise Part21Error(f"entity #{number} has no string")


class _Tokens:
    """The tokens of one statement, and the parameter lists made of them."""

    def __init__(self, text: str, start: int, end: int, place: str):
        self.text, self.position, self.end, self.place = text, start, end, place

    def next(self) -> tuple[str, str]:
        token = _TOKEN.match(self.text, self.position, self.end)
        if token is None:
            raise self.error("a parameter", self.text[self.position : self.position + 20])
        self.position = token.end()
        return token.lastgroup, token.group(token.lastgroup)

    def error(self, expected: str, found: str) -> Part21Error:
        line = self.text.count("\n", 0, self.position) + 1
        return Part21Error(f"line {line}, {self.place}: expected {expected}, found '{found}'")

    def record(self, keyword: str) -> Record:
        kind, value = self.next()
        if (kind, value) != ("mark", "("):
            raise self.error("'('", value)
        return Record(keyword.upper(), self.parameters())

    def parameters(self) -> list:
        """What stands up to the closing parenthesis of a list that has just been opened."""
        stack: list[list] = [[]]
        keywords: list[str] = []
        while True:
            kind, value = self.next()
            if kind == "keyword":
                keywords.append(value.upper())
                self._expect_open()
                stack.append([])
            elif (kind, value) == ("mark", "("):
                keywords.append("")
                stack.append([])
            elif (kind, value) == ("mark", ")"):
                closed = stack.pop()
                if not stack:
                    return closed
                keyword = keywords.pop()
                stack[-1].append(Record(keyword, closed) if keyword else closed)
            elif kind == "end" or value == ";":
                raise self.error("')'", "the end")
            elif (kind, value) != ("mark", ","):
                stack[-1].append(_value(kind, value))

    def _expect_open(self):
        kind, value = self.next()
        if (kind, value) != ("mark", "("):
            raise self.error("'('", value)


def _value(kind: str, text: str):
    if kind == "string":
        return decode(text)
    if kind == "reference":
        return Reference(text)
    if kind == "enumeration":
        return Enumeration(text.upper())
    if kind == "number":
        return int(text) if text.lstrip("+-").isdigit() else float(text)
    return text if kind == "binary" else None


def scan(text: str) -> Part21:
    """Finds the entities of all data sections.

    Raises :class:`Part21Error` where the text is no STEP file.
    """
    if not text.lstrip("\ufeff \t\r\n").startswith("ISO-10303-21"):
        raise Part21Error("line 1: expected 'ISO-10303-21;', the first words of a STEP file")
    found = Part21(text)
    in_header = True
    for start, end in _statements(text):
        entity = _ENTITY.match(text, start, end)
        if entity:
            number = int(entity.group(1))
            found.places[number] = (entity.start(2), end)
            found.numbers[entity.group(2).upper()].append(number)
            continue
        words = text[start:end].split("(", 1)[0].split()
        if not words:
            continue
        keyword, place = words[-1].upper(), text.index(words[-1], start)
        if keyword == "DATA":
            in_header = False
        elif in_header:
            found.header[keyword] = (place, end)
        elif keyword == "ENDSEC":
            found.data_end = place
    if found.data_end < 0:
        raise Part21Error("the data section does not end: the file is cut off")
    return found


def _statements(text: str) -> Iterator[tuple[int, int]]:
    start = 0
    for delimiter in _DELIMITER.finditer(text):
        if delimiter.group() == ";":
            yield start, delimiter.start()
            start = delimiter.end()


def edited(text: str, edits: list[tuple[int, int, str]]) -> str:
    """The text with every (start, end, replacement) made; places must not overlap."""
    pieces, position = [], 0
    for start, end, replacement in sorted(edits):
        pieces += (text[position:start], replacement)
        position = end
    pieces.append(text[position:])
    return "".join(pieces)


_ESCAPE = re.compile(
    r"\\X2\\((?:[0-9A-Fa-f]{4})*)\\X0\\|\\X4\\((?:[0-9A-Fa-f]{8})*)\\X0\\|\\X\\([0-9A-Fa-f]{2})|"
    r"\\S\\(.)|\\P[A-I]\\|\\(\\)|\\[NTF]\\",
    re.S,
)


def decode(quoted: str) -> str:
    """The characters of a string as it stands in the file, quotes and escapes resolved.

    ``\\S\\`` is taken as ISO 8859-1, the default code page.
    """
    text = quoted[1:-1].replace("''", "'").replace("\n", "").replace("\r", "")
    if "\\" not in text:
        return text
    return _ESCAPE.sub(_unescape, text)


def _unescape(escape) -> str:
    two, four, one, shifted, backslash = escape.groups()
    if two is not None:
        return bytes.fromhex(two).decode("utf-16-be", "replace")
    if four is not None:
        return bytes.fromhex(four).decode("utf-32-be", "replace")
    if one is not None:
        return chr(int(one, 16))
    if shifted is not None:
        return chr(ord(shifted) | 0x80)
    return backslash or ""


def encode(text: str) -> str:
    """The text as a quoted string of a STEP file."""
    pieces = []
    for run in re.findall(r"[ -~]+|[^ -~]+", text):
        if run.isascii() and run.isprintable():
            pieces.append(run.replace("\\", "\\\\").replace("'", "''"))
        else:
            pieces.append(f"\\X2\\{run.encode('utf-16-be').hex().upper()}\\X0\\")
    return f"'{''.join(pieces)}'"
