"""Names and colours that came with a STEP file, carried by document objects.

``FaceNames`` holds the names of the faces and can be edited; ``StepAttributes`` the rest as JSON:
``product``, ``solid``, ``colour`` and ``face_colours`` (three numbers from 0 to 1, or null).
"""

import json

from ..occ.attributes import SolidAttributes
from .properties import Property, add_missing

PROPERTIES = (
    Property("App::PropertyStringList", "FaceNames", "Names", "Names of the faces, by number"),
    Property("App::PropertyString", "StepAttributes", "Names", "As in the STEP file", "", True),
)


def store(obj, product: str, attributes: SolidAttributes) -> None:
    """Writes names and colours into ``obj``, with properties for them where it has none."""
    add_missing(obj, PROPERTIES)
    obj.FaceNames = attributes.face_names if attributes.has_face_names else []
    obj.StepAttributes = json.dumps(
        {
            "product": product,
            "solid": attributes.name,
            "colour": attributes.colour,
            "face_colours": attributes.face_colours,
        }
    )


def load(obj, faces: int) -> tuple[str, SolidAttributes]:
    """Product name, and what ``obj`` says of a solid with that many faces.

    Objects that say nothing, or something of another number of faces, give their label alone.
    """
    text = getattr(obj, "StepAttributes", "")
    names = list(getattr(obj, "FaceNames", ()))
    said = json.loads(text) if text else {}
    found = SolidAttributes.unknown(faces)
    if len(names) == faces:
        found.face_names = names
    colours = said.get("face_colours", ())
    if len(colours) == faces:
        found.face_colours = [_colour(value) for value in colours]
        found.name, found.colour = said["solid"], _colour(said["colour"])
    return said.get("product") or obj.Label, found


def _colour(value):
    return None if value is None else tuple(value)
