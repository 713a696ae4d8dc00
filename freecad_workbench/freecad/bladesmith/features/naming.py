"""The core's messages name options of the command line; an object has properties instead."""

import re


def in_property_names(text: str) -> str:
    """``text`` with ``--field-unit`` and its like as the properties' names: ``FieldUnit``."""
    text = text.replace("--solid N", "Solid")
    return re.sub(r"--([a-z]+(?:-[a-z]+)*)", lambda found: _camel(found.group(1)), text)


def _camel(option: str) -> str:
    return "".join(word.capitalize() for word in option.split("-"))
