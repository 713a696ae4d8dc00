"""Properties from a table, added where they are missing: for new objects and for old documents."""

from typing import NamedTuple


class Property(NamedTuple):
    """One property: FreeCAD's type, name, group, tip, first value, and whether it is hidden."""

    kind: str
    name: str
    group: str
    tip: str
    value: object = None
    hidden: bool = False


def add_missing(obj, table) -> None:
    """Adds the properties of ``table`` that ``obj`` has not; the others keep their values."""
    for item in table:
        if item.name in obj.PropertiesList:
            continue
        obj.addProperty(item.kind, item.name, item.group, item.tip, 0, False, item.hidden)
        if item.value is not None:
            setattr(obj, item.name, item.value)
