"""Finds and loads the core's shared library.

Searched in this order: the file named by ``BLADESMITH_LIBRARY``; beside this package; the build
folder of a checkout; the ``lib`` folder of an installation; the system's library path.
"""

import ctypes
import os
import sys
from collections.abc import Iterable
from pathlib import Path
from sysconfig import get_platform

from .. import __version__
from .errors import SetupError

ABI_VERSION = 1
"""Version of the C interface that :mod:`.api` was written against."""

_PACKAGE_ROOT = Path(__file__).resolve().parents[3]


def _file_names() -> list[str]:
    if sys.platform == "win32":
        return ["bladesmith.dll"]
    if sys.platform == "darwin":
        return [f"libbladesmith.{ABI_VERSION}.dylib", "libbladesmith.dylib"]
    return [f"libbladesmith.so.{ABI_VERSION}", "libbladesmith.so"]


def _candidates() -> list[str]:
    folders = [
        Path(__file__).resolve().parent,
        _PACKAGE_ROOT.parent / "target" / "release",
        _PACKAGE_ROOT.parent.parent / "lib",
    ]
    files = [folder / name for folder in folders for name in _file_names()]
    return [str(file) for file in files if file.is_file()] + _file_names()


def load(calls: Iterable[str] = ()) -> ctypes.CDLL:
    """The loaded library, its ABI version checked, with all of ``calls``.

    Raises :class:`SetupError` where there is none, or one of another version.
    """
    chosen = os.environ.get("BLADESMITH_LIBRARY")
    reasons = []
    for name in [chosen] if chosen else _candidates():
        try:
            library = ctypes.CDLL(name)
        except OSError as reason:
            reasons.append(str(reason))
            continue
        return _checked(library, name, calls)
    raise SetupError(
        f"the library of Bladesmith was not found ({'; '.join(reasons)}): {_remedy()}, or name the "
        "file in the environment variable BLADESMITH_LIBRARY"
    )


def _checked(library: ctypes.CDLL, name: str, calls: Iterable[str]) -> ctypes.CDLL:
    try:
        library.bladesmith_abi_version.restype = ctypes.c_uint32
        found = library.bladesmith_abi_version()
    except AttributeError:
        raise SetupError(f"{name} is not the library of Bladesmith: {_remedy()}") from None
    if found != ABI_VERSION:
        raise SetupError(
            f"{name} has C interface {found}, this package needs {ABI_VERSION}: {_remedy()}, "
            "so that both are of one release"
        )
    missing = [call for call in calls if not hasattr(library, call)]
    if missing:
        raise SetupError(
            f"{name} is older than this package, it has no {missing[0]}: {_remedy()}, "
            "so that both are of one release"
        )
    return library


def _remedy() -> str:
    """What brings the library, by where this package lies."""
    if (_PACKAGE_ROOT.parent / "Cargo.toml").is_file():
        return f"run 'make build' in {_PACKAGE_ROOT.parent}"
    if (_PACKAGE_ROOT / "manifest.txt").is_file():
        return "run 'make install' again in Bladesmith's sources"
    return (
        f"install the add-on archive bladesmith-{__version__}-freecad-{get_platform()}.zip, which "
        "holds it, by unpacking it into FreeCAD's folder Mod"
    )
