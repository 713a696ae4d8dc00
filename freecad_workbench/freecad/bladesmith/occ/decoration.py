"""Puts names, colours and a header into the STEP text that Open CASCADE wrote for one solid."""

import os
from datetime import datetime, timezone

from .attributes import Colour, SolidAttributes, shell_faces
from .part21 import Part21, Part21Error, edited, encode, scan

_SOLIDS = ("MANIFOLD_SOLID_BREP", "BREP_WITH_VOIDS")


def header_time() -> str:
    """Now, or the moment that ``SOURCE_DATE_EPOCH`` fixes (UTC)."""
    epoch = os.environ.get("SOURCE_DATE_EPOCH", "")
    if epoch.isdigit():
        return datetime.fromtimestamp(int(epoch), timezone.utc).strftime("%Y-%m-%dT%H:%M:%S")
    return datetime.now().strftime("%Y-%m-%dT%H:%M:%S")


def decorated(text: str, product: str, attributes: SolidAttributes, tool: str) -> str:
    """The text with names, colours, and a header that names ``tool`` and ``product``.

    Raises :class:`Part21Error` where the text does not hold one solid with as many faces.
    """
    file = scan(text)
    faces = _faces(file)
    if len(faces) != len(attributes.face_names):
        raise Part21Error(
            f"expected {len(attributes.face_names)} faces in the shell, found {len(faces)}"
        )
    edits = _header_edits(file, product, tool)
    names = list(zip(faces, attributes.face_names))
    names += [(n, product) for n in file.numbers["PRODUCT"]]
    names.append((_solid(file), attributes.name))
    edits += [(*file.first_string(n), encode(name)) for n, name in names if name]
    edits += _product_identifier_edits(file, product)
    styles = _styles(file, attributes, faces)
    edits.append((file.data_end, file.data_end, "".join(line + "\n" for line in styles)))
    return edited(text, edits)


def _solid(file: Part21) -> int:
    found = [number for keyword in _SOLIDS for number in file.numbers[keyword]]
    if len(found) != 1:
        raise Part21Error(f"expected one solid, found {len(found)}")
    return found[0]


def _faces(file: Part21) -> list[int]:
    parameters = file.record(_solid(file)).parameters
    voids = parameters[2] if len(parameters) > 2 else []
    return [face for shell in [parameters[1], *voids] for face in shell_faces(file, shell)]


def _header_edits(file: Part21, product: str, tool: str) -> list[tuple[int, int, str]]:
    name = ",".join(
        (encode(product), encode(header_time()), "('')", "('')", encode("Open CASCADE"))
    )
    replacements = {
        "FILE_DESCRIPTION": "FILE_DESCRIPTION(('Solid morphed by Bladesmith'),'2;1')",
        "FILE_NAME": f"FILE_NAME({name},{encode(tool)},'')",
    }
    return [(*file.header[keyword], text) for keyword, text in replacements.items()]


def _product_identifier_edits(file: Part21, product: str) -> list[tuple[int, int, str]]:
    """The second string of PRODUCT: Open CASCADE numbers it by the writes of the process."""
    edits = []
    for number in file.numbers["PRODUCT"]:
        _, first_end = file.first_string(number)
        start = file.text.index("'", first_end)
        end = file.text.index("'", start + 1) + 1
        edits.append((start, end, encode(product)))
    return edits


class _Appender:
    """New entities numbered behind the last of the file."""

    def __init__(self, file: Part21):
        self.next = max(file.places) + 1
        self.lines: list[str] = []

    def add(self, definition: str) -> int:
        number = self.next
        self.next += 1
        self.lines.append(f"#{number} = {definition};")
        return number


def _styles(file: Part21, attributes: SolidAttributes, faces: list[int]) -> list[str]:
    """Styled items for the solid's colour and for faces that differ from it."""
    coloured = [(_solid(file), attributes.colour)] if attributes.colour else []
    coloured += [
        (face, colour)
        for face, colour in zip(faces, attributes.face_colours)
        if colour is not None and colour != attributes.colour
    ]
    if not coloured:
        return []
    appender = _Appender(file)
    styles = {}
    items = []
    for item, colour in coloured:
        if colour not in styles:
            styles[colour] = _style(appender, colour)
        items.append(appender.add(f"STYLED_ITEM('color',(#{styles[colour]}),#{item})"))
    listed = ",".join(f"#{item}" for item in items)
    appender.add(
        f"MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',({listed}),#{_context(file)})"
    )
    return appender.lines


def _style(appender: _Appender, colour: Colour) -> int:
    red, green, blue = (f"{component:.12f}" for component in colour)
    rgb = appender.add(f"COLOUR_RGB('',{red},{green},{blue})")
    fill = appender.add(f"FILL_AREA_STYLE_COLOUR('',#{rgb})")
    area = appender.add(f"FILL_AREA_STYLE('',(#{fill}))")
    surface = appender.add(f"SURFACE_STYLE_FILL_AREA(#{area})")
    side = appender.add(f"SURFACE_SIDE_STYLE('',(#{surface}))")
    usage = appender.add(f"SURFACE_STYLE_USAGE(.BOTH.,#{side})")
    return appender.add(f"PRESENTATION_STYLE_ASSIGNMENT((#{usage}))")


def _context(file: Part21) -> int:
    """The context of the representation that holds the solid."""
    for keyword in ("ADVANCED_BREP_SHAPE_REPRESENTATION", "SHAPE_REPRESENTATION"):
        for number in file.numbers[keyword]:
            return file.record(number).parameters[2]
    raise Part21Error("expected an ADVANCED_BREP_SHAPE_REPRESENTATION, found none")
