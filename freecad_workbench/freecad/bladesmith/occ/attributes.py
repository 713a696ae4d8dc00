"""Names and colours of a STEP file's solids and faces, which FreeCAD's reader drops.

Faces are taken in the order of their shells, which is the order Open CASCADE keeps. A solid of the
file and one of Open CASCADE's belong together if they have as many faces and the elementary
surfaces agree face by face.
"""

from dataclasses import dataclass, field
from typing import Optional

from .part21 import Part21, Record, Reference

Colour = tuple[float, float, float]

_SOLIDS = ("MANIFOLD_SOLID_BREP", "BREP_WITH_VOIDS", "FACETED_BREP")
_FACES = ("ADVANCED_FACE", "FACE_SURFACE")
_STYLED = ("STYLED_ITEM", "OVER_RIDING_STYLED_ITEM")
_KINDS = {
    "PLANE": "Plane",
    "CYLINDRICAL_SURFACE": "Cylinder",
    "CONICAL_SURFACE": "Cone",
    "SPHERICAL_SURFACE": "Sphere",
    "TOROIDAL_SURFACE": "Toroid",
}
_PREDEFINED = {
    "black": (0.0, 0.0, 0.0),
    "red": (1.0, 0.0, 0.0),
    "green": (0.0, 1.0, 0.0),
    "blue": (0.0, 0.0, 1.0),
    "yellow": (1.0, 1.0, 0.0),
    "magenta": (1.0, 0.0, 1.0),
    "cyan": (0.0, 1.0, 1.0),
    "white": (1.0, 1.0, 1.0),
}
_MEANINGLESS = ("", "NONE")


@dataclass
class SolidAttributes:
    """What a STEP file says of one solid; lists by face. An empty name or None: nothing said."""

    name: str = ""
    colour: Optional[Colour] = None
    face_names: list[str] = field(default_factory=list)
    face_colours: list[Optional[Colour]] = field(default_factory=list)
    face_kinds: list[Optional[str]] = field(default_factory=list, repr=False)

    @property
    def has_face_names(self) -> bool:
        return any(self.face_names)

    @classmethod
    def unknown(cls, faces: int) -> "SolidAttributes":
        """Nothing said of a solid with that many faces."""
        return cls("", None, [""] * faces, [None] * faces, [None] * faces)


def product_name(file: Part21) -> str:
    """Name of the first product; empty where there is none or a translator made it up."""
    for number in file.numbers["PRODUCT"]:
        parameters = file.record(number).parameters
        names = [p for p in parameters[:2] if isinstance(p, str)]
        for name in reversed(names):
            if name.strip() and not name.startswith("Open CASCADE STEP translator"):
                return name.strip()
    return ""


def solids(file: Part21) -> list[SolidAttributes]:
    """The solids of a file, in its order.

    Raises :class:`Part21Error` where entities are malformed or missing.
    """
    colours = _colours(file)
    found = []
    for number in sorted(n for keyword in _SOLIDS for n in file.numbers[keyword]):
        parameters = file.record(number).parameters
        outer, voids = parameters[1], parameters[2] if len(parameters) > 2 else []
        shells = [outer, *voids]
        faces = [face for shell in shells for face in shell_faces(file, shell)]
        inherited = next((colours[s] for s in shells if s in colours), None)
        found.append(
            SolidAttributes(
                name=_name(parameters[0]),
                colour=colours.get(number, inherited),
                face_names=[_face_name(file, face) for face in faces],
                face_colours=[colours.get(face) for face in faces],
                face_kinds=[_face_kind(file, face) for face in faces],
            )
        )
    return found


def shell_faces(file: Part21, shell: int) -> list[int]:
    """Numbers of a shell's faces, in order."""
    record = file.record(shell)
    if record.keyword == "ORIENTED_CLOSED_SHELL":
        return shell_faces(file, record.parameters[2])
    return list(record.parameters[1])


def matched(file_solids: list[SolidAttributes], shape_kinds: list[list[str]]):
    """For each solid of Open CASCADE (its surface kinds by face) what the file says, or None.

    None where no solid of the file agrees, or several do that say different things.
    """
    if len(file_solids) == len(shape_kinds):
        pairs = list(zip(file_solids, shape_kinds))
        if all(_agree(solid, kinds) for solid, kinds in pairs):
            return file_solids
    matches = []
    for kinds in shape_kinds:
        agreeing = [solid for solid in file_solids if _agree(solid, kinds)]
        alike = agreeing and all(solid == agreeing[0] for solid in agreeing)
        matches.append(agreeing[0] if alike else None)
    return matches


def _agree(solid: SolidAttributes, kinds: list[str]) -> bool:
    return len(solid.face_kinds) == len(kinds) and all(
        said is None or said == kind for said, kind in zip(solid.face_kinds, kinds)
    )


def _name(value) -> str:
    name = value.strip() if isinstance(value, str) else ""
    return "" if name.upper() in _MEANINGLESS else name


def _face_name(file: Part21, face: int) -> str:
    return _name(file.record(face, *_FACES, "ORIENTED_FACE").parameters[0])


def _face_kind(file: Part21, face: int) -> Optional[str]:
    record = file.record(face, *_FACES, "ORIENTED_FACE")
    if record.keyword == "ORIENTED_FACE":
        return _face_kind(file, record.parameters[2])
    return _KINDS.get(file.entity(record.parameters[2])[0].keyword)


def _colours(file: Part21) -> dict[int, Colour]:
    """Surface colour by the number of the entity that carries it; overriding styles win."""
    found = {}
    for keyword in _STYLED:
        for number in file.numbers[keyword]:
            _name_, styles, item = file.record(number).parameters[:3]
            colour = next(filter(None, (_style_colour(file, style) for style in styles)), None)
            if colour is not None:
                found[item] = colour
    return found


def _style_colour(file: Part21, assignment: int) -> Optional[Colour]:
    for usage in _references(file.entity(assignment)):
        records = file.entity(usage)
        if records[0].keyword == "SURFACE_STYLE_USAGE":
            return _first_colour(file, usage, depth=6)
    return None


def _first_colour(file: Part21, number: int, depth: int) -> Optional[Colour]:
    records = file.entity(number)
    for record in records:
        if record.keyword == "COLOUR_RGB":
            red, green, blue = record.parameters[-3:]
            return float(red), float(green), float(blue)
        if record.keyword.endswith("PRE_DEFINED_COLOUR") and record.parameters:
            return _PREDEFINED.get(str(record.parameters[0]).lower())
    if depth == 0:
        return None
    deeper = (_first_colour(file, child, depth - 1) for child in _references(records))
    return next((colour for colour in deeper if colour is not None), None)


def _references(values) -> list[int]:
    """Every reference in a parameter list, in order."""
    found = []
    for value in values:
        if isinstance(value, Reference):
            found.append(value)
        elif isinstance(value, Record):
            found += _references(value.parameters)
        elif isinstance(value, list):
            found += _references(value)
    return found
