"""The core's frequent messages in the user's language: known by their fixed words.

The core speaks English, as the log and the report do; what it fills in stands at ``{0}`` and on.
"""

import re
from typing import Callable

TRANSLATED = (
    "{0}: the FE model does not lie on the geometry of {1}: {2} of {3} nodes are within {4} mm, "
    "the median distance is {5} mm; check that both are in the same place, orientation (not "
    "mirrored) and unit, or give --match-tolerance",
    "{0}: the mesh measures {1} and the part {2} mm, a ratio of {3}: the field seems to be in {4}; "
    "give {5}",
    "areas without nodes on {0}, {1} mm² in all: {2}; give --extrapolate to extend the field over "
    "them",
    "the largest displacement, {0} mm, is {1} times the part's size ({2} mm): the solid would be "
    "folded; check the unit of the displacements (--displacement-scale scales them alone) and the "
    "factor",
    "{0}: only {1} with a displacement: {2}",
    "{0}: the {1} nodes with a displacement lie in one line: {2}",
    "a morph needs at least {0} that do not lie in one line",
    "{0}: a deck (.inp) has a mesh but no displacements: give the results of its run (.frd) here, "
    "and the deck as their mesh",
    "the displacement was computed on the given shape and taken away from it: the result is a "
    "first-order estimate of the unloaded shape; the second-order term |∇u|·|u| reaches about "
    "{0} mm",
    "the field holds {0} still; its gradient jumps at the edges there",
    "tangent joints open by up to {0}° {1}: edges {2}",
    "beside held faces",
    "elsewhere",
    "edges gape by up to {0} mm: {1}",
    "empty knot spans: {0} of {1} on {2}: their poles follow the regularisation alone",
    "the field has no elements: {0} of {1} nodes lie on the faces, the others are taken as inside",
    "{0} of {1} surface nodes lie on no face within {2} mm and are not used (ids {3})",
    "all displacements are zero: the result equals the input",
)
"""Messages as the core's sources have them; a test compares."""


def localised(text: str, translate: Callable[[str], str]) -> str:
    """``text`` by ``translate`` where it is one of these messages; else as it is."""
    for message in TRANSLATED:
        found = _pattern(message).fullmatch(text)
        if found:
            filled = [localised(part, translate) for part in found.groups()]
            return translate(message).format(*filled)
    return text


def _pattern(message: str) -> re.Pattern:
    return re.compile(re.sub(r"\\\{\d\\\}", "(.+?)", re.escape(message)), re.DOTALL)
