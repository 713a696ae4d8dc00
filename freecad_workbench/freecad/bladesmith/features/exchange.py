"""Solids of STEP files as document objects and back, with names and colours."""

from pathlib import Path

from ..native import InputError
from ..occ import step
from ..occ.attributes import SolidAttributes
from ..operations.export import morphed_product, write_step
from ..operations.outputs import Outputs, check_target
from . import attributes
from .shown import has_result


def read(document, path: str) -> list:
    """One object in ``document`` for each solid of a STEP file; names and colours come along.

    Raises :class:`InputError`.
    """
    part = step.read(path)
    return [
        _object(document, part, solid, said) for solid, said in zip(part.shape.Solids, part.solids)
    ]


def _object(document, part: step.StepPart, solid, said: SolidAttributes):
    obj = document.addObject("Part::Feature", "Solid")
    obj.Label = said.name or part.product or Path(part.path).stem
    obj.Shape = solid
    attributes.store(obj, part.product, said)
    return obj


def write(obj, path: str, fallback_colours=None) -> None:
    """Writes the solid of ``obj`` as STEP, AP214 in mm, with names and colours.

    ``fallback_colours`` by face are used where the object itself says none.
    Raises :class:`BladesmithError`; the file appears whole or not at all.
    """
    if Path(path).suffix.lower() not in step.SUFFIXES:
        raise InputError(f"{path}: give a name that ends in .step or .stp")
    check_target(path, "the solid")
    shape = getattr(obj, "Shape", None)
    if shape is None or len(shape.Solids) != 1:
        count = len(shape.Solids) if shape is not None else 0
        raise InputError(
            f"{obj.Label}: expected one solid to export, found {count}; select another"
        )
    product, said = attributes.load(obj, len(shape.Faces))
    coloured = said.colour or any(said.face_colours)
    if fallback_colours and not coloured and len(fallback_colours) == len(shape.Faces):
        said.face_colours = fallback_colours
    if has_result(obj):
        product = morphed_product(path, product)
    with Outputs() as outputs:
        write_step(outputs, path, shape, product, said)
        outputs.commit()
