"""Faces a user names: by number, as ``Face7``, or by their name in the STEP file."""

import csv
import difflib
import re
from collections.abc import Sequence
from typing import Optional

from ..native.errors import InputError

_NUMBER = re.compile(r"(?:Face)?(\d+)", re.IGNORECASE)


def selected(option: str, values: Optional[Sequence[str]], names: Sequence[str]) -> tuple[int, ...]:
    """Numbers, from 1, of the faces that ``values`` of ``option`` list.

    ``names`` are those of the STEP file by index. A name wins over a number, and selects every
    face that has it; a name with a comma stands in double quotes.

    Raises :class:`InputError` for a face that is not there.
    """
    found = set()
    for value in values or ():
        wanted = [word.strip() for word in next(csv.reader([value], skipinitialspace=True))]
        for word in filter(None, wanted):
            found.update(_numbers(option, word, names))
        if not any(wanted):
            raise InputError(f"{option}: expected names or numbers of faces, found nothing")
    return tuple(sorted(found))


def _numbers(option: str, word: str, names: Sequence[str]) -> list[int]:
    named = [index for index, name in enumerate(names, 1) if name == word]
    if named:
        return named
    number = _NUMBER.fullmatch(word)
    if number and 1 <= int(number.group(1)) <= len(names):
        return [int(number.group(1))]
    known = sorted({name for name in names if name})
    close = difflib.get_close_matches(word, known, 3) or known[:8]
    also = f", or a name such as {', '.join(close)}" if close else ""
    raise InputError(
        f"{option}: the part has no face '{word}'; give Face1 to Face{len(names)}{also}"
    )
