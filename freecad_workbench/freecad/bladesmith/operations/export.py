"""A solid written as STEP with its names and colours, and read back to be sure."""

from pathlib import Path

from .. import __version__
from ..native import BladesmithError
from ..occ import judge, step
from ..occ.attributes import SolidAttributes
from .names_file import names_path, names_text
from .outputs import Outputs

_TOOL = f"Bladesmith {__version__}"


def morphed_product(target: str, source: str) -> str:
    """Name of a morphed part's product: its file's, which is not to be that of its ``source``.

    Systems that manage parts tell them apart by this name.
    """
    name = Path(target).stem
    return f"{name} morphed" if name == source else name


def write_step(
    outputs: Outputs, target: str, shape, product: str, attributes: SolidAttributes
) -> judge.Verdict:
    """Writes ``target``, and its side file of names where faces have any; both are pending.

    Returns Open CASCADE's verdict on what it reads back. Raises :class:`BladesmithError` where
    that is not the same solid.
    """
    name = outputs.file(target)
    step.write(shape, name, product, attributes, _TOOL)
    again = step.read_back(name)
    different = judge.differences(shape, again, judge.comparison_tolerance(shape))
    if different:
        raise BladesmithError(
            f"{target} was not written: read back, it is not the same solid "
            f"({'; '.join(different[:3])})"
        )
    if attributes.has_face_names:
        names = outputs.file(names_path(target))
        Path(names).write_text(names_text(product, attributes), "utf-8")
    return judge.judge(again)
