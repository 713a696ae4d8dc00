"""The side file ``COLD.names.json``: names of solid and faces by index, where faces have any.

Many STEP readers, FreeCAD's among them, drop the names of faces; this keeps them at hand.
"""

import json
from pathlib import Path

from ..occ.attributes import SolidAttributes


def names_path(output: str) -> str:
    """``dir/cold.names.json`` for ``dir/cold.step``."""
    return str(Path(output).with_suffix(".names.json"))


def names_text(product: str, attributes: SolidAttributes) -> str:
    """JSON: ``product``, ``solid``, and ``faces`` with a name for every number from 1."""
    names = [name or f"Face{i}" for i, name in enumerate(attributes.face_names, 1)]
    document = {
        "product": product,
        "solid": attributes.name,
        "faces": {str(index): name for index, name in enumerate(names, 1)},
    }
    return json.dumps(document, indent=1, ensure_ascii=False) + "\n"
