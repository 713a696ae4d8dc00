"""STEP files in and out: solids for the core, names and colours beside them.

Other length units are read into millimetres; files are written as AP214 in millimetres.
"""

import gzip
import logging
import os
import tempfile
import zlib
from dataclasses import dataclass, field
from pathlib import Path
from typing import Optional

from .. import log
from ..model.words import counted
from ..native.errors import InputError
from . import attributes as step_attributes
from .attributes import SolidAttributes
from .decoration import decorated
from .part21 import Part21Error, scan
from .runtime import part_module

_LOG = logging.getLogger(__name__)

SUFFIXES = (".step", ".stp")


@dataclass
class StepPart:
    """A STEP file read: Open CASCADE's shape, and names and colours for each of its solids."""

    path: str
    product: str
    shape: object
    solids: list[SolidAttributes]
    warnings: list[str] = field(default_factory=list)


def is_step(data: bytes) -> bool:
    """Whether a file's first bytes are those of a STEP file."""
    return data.lstrip(b"\xef\xbb\xbf \t\r\n").startswith(b"ISO-10303-21")


def first_bytes(path: str) -> bytes:
    """Some bytes of a file's beginning, unpacked where they are gzipped.

    Raises :class:`InputError` where it cannot be read.
    """
    return _read_bytes(path, 4096)


def _read_bytes(path: str, size: int = -1) -> bytes:
    try:
        with open(path, "rb") as file:
            if file.peek(2)[:2] == b"\x1f\x8b":
                return gzip.open(file).read(size)
            return file.read(size)
    except EOFError:
        raise InputError(
            f"{path}: the gzipped file ends early: it is truncated; copy it again"
        ) from None
    except (gzip.BadGzipFile, zlib.error) as reason:
        raise InputError(f"{path}: the gzipped file is damaged ({reason}); copy it again") from None
    except OSError as reason:
        why = reason.strerror or reason
        raise InputError(f"{path}: {why}; give an existing, readable file") from None


def read(path: str) -> StepPart:
    """Reads the solids of a STEP file (gzipped or not).

    Raises :class:`InputError` where it is no STEP file, cannot be transferred or holds no solid.
    """
    _LOG.info("STEP file: %s", log.sizes(path))
    data = _read_bytes(path)
    if not is_step(data):
        raise InputError(
            f"{path}: no STEP file (expected 'ISO-10303-21;' in its first line); "
            "give a solid as STEP, AP203, AP214 or AP242"
        )
    shape = _transfer(path, data)
    if not shape.Solids:
        raise InputError(_no_solid(path, shape))
    text = data.decode("utf-8", "replace") if _is_utf8(data) else data.decode("latin-1")
    return _with_attributes(path, shape, text)


def _is_utf8(data: bytes) -> bool:
    try:
        data.decode("utf-8")
    except UnicodeDecodeError:
        return False
    return True


def _transfer(path: str, data: bytes):
    part = part_module()
    try:
        if Path(path).suffix in SUFFIXES:
            return part.read(path)
        with tempfile.TemporaryDirectory(prefix="bladesmith-") as folder:
            plain = os.path.join(folder, "part.step")
            Path(plain).write_bytes(data)
            return part.read(plain)
    except RuntimeError as reason:
        raise InputError(
            f"{path}: Open CASCADE cannot read this STEP file ({_reason(reason)}); it may be "
            "cut off or damaged: export it again from the CAD system"
        ) from None


def _reason(error: Exception) -> str:
    text = str(error)
    return text[text.find("(") + 1 : text.rfind(")")] if "(" in text else text


def _no_solid(path: str, shape) -> str:
    faces = 0 if shape.isNull() else len(shape.Faces)
    holds = f"{counted(faces, 'face')} only" if faces else "no shape"
    return (
        f"{path}: no solid in this file, it holds {holds}; "
        "export the part as a closed solid (sew its faces in the CAD system first)"
    )


def _with_attributes(path: str, shape, text: str) -> StepPart:
    solids, warnings, product = shape.Solids, [], ""
    kinds = [[_kind(face) for face in solid.Faces] for solid in solids]
    try:
        file = scan(text)
        product = step_attributes.product_name(file)
        found = step_attributes.matched(step_attributes.solids(file), kinds)
    except (Part21Error, IndexError, TypeError, ValueError) as reason:
        found = [None] * len(solids)
        warnings.append(f"names and colours of {path} could not be read ({reason})")
    for index, (attributes, solid_kinds) in enumerate(zip(found, kinds), 1):
        if attributes is None and not warnings:
            warnings.append(
                f"names and colours of solid {index} are lost: "
                f"its faces ({len(solid_kinds)}) do not match a solid of the STEP text"
            )
    attributes = [
        a or SolidAttributes.unknown(len(solid_kinds)) for a, solid_kinds in zip(found, kinds)
    ]
    return StepPart(path, product or _stem(path), shape, attributes, warnings)


def _kind(face) -> str:
    return face.Surface.TypeId.replace("Part::Geom", "")


def _stem(path: str) -> str:
    name = Path(path).name
    return name.split(".")[0] or name


def chosen_solid(part: StepPart, number: Optional[int]) -> Optional[int]:
    """Index, from 0, of solid ``number`` or of the only one; None leaves the choice to the field.

    Raises :class:`InputError` where there is no such solid.
    """
    if number is None:
        return 0 if len(part.solids) == 1 else None
    if number > len(part.solids):
        raise InputError(f"{part.path}: {no_solid(number, len(part.solids), '--solid')}")
    return number - 1


def no_solid(number: int, count: int, option: str) -> str:
    """That a part with ``count`` solids has not this one, and what ``option`` takes."""
    remedy = f"{option} takes 1 to {count}" if count > 1 else f"leave {option} out"
    return f"there is no solid {number}: the part has {count}; {remedy}"


def nearest_solid(solids, shape) -> int:
    """Index, from 0, of the solid that ``shape`` is a slightly moved copy of."""
    points = [vertex.Point for vertex in shape.Vertexes]

    def distance(index: int) -> float:
        solid = solids[index]
        others = [vertex.Point for vertex in solid.Vertexes]
        if len(solid.Faces) != len(shape.Faces) or len(others) != len(points):
            return float("inf")
        return max((a.distanceToPoint(b) for a, b in zip(points, others)), default=0.0)

    return min(range(len(solids)), key=distance)


def from_brep(text: str):
    """The shape of B-rep text."""
    shape = part_module().Shape()
    shape.importBrepFromString(text)
    return shape


def write(shape, path: str, product: str, attributes: SolidAttributes, tool: str) -> None:
    """Writes one solid with names, colours and a header that names ``tool``.

    ``path`` must have a STEP suffix; it is overwritten without care, so give a temporary name.
    """
    shape.exportStep(path)
    file = Path(path)
    text = decorated(file.read_text("latin-1"), product, attributes, tool)
    file.write_text(text, "ascii")


def read_back(path: str):
    """The shape in a STEP file that has just been written."""
    return part_module().read(path)
