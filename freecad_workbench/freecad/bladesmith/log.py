"""The log: a text file that a user can send with a question.

It holds versions, names and sizes of the inputs, settings, stages with their times,
warnings and errors; no folders, which name people and projects, and no geometry. Two older files
of a megabyte are kept beside it.

Modules write through :mod:`logging`; nothing is kept until :func:`start` is called, by the command
line and by the workbench. A log that cannot be written never stops the work.
"""

import logging
import logging.handlers
import os
import platform
import re
import sys
import time
from contextlib import contextmanager
from pathlib import Path
from typing import Optional

from . import __version__

_PACKAGE = logging.getLogger(__package__)
_LARGEST_BYTES, _OLDER_FILES = 1_000_000, 2
_FOLDERS = re.compile(
    r"(?<![\w.~])(?:[A-Za-z]:)?[/\\](?:[^/\\\n\"']+[/\\])+|~[/\\](?:[^/\\\n\"']+[/\\])*"
)


def path() -> Path:
    """The file: ``BLADESMITH_LOG``, or where FreeCAD or the system keep such things of a user."""
    named = os.environ.get("BLADESMITH_LOG")
    if named:
        return Path(named)
    freecad = os.environ.get("FREECAD_USER_HOME")
    if freecad:
        folder = Path(freecad)
    elif sys.platform == "win32":
        folder = Path(os.environ.get("LOCALAPPDATA") or Path.home())
    elif sys.platform == "darwin":
        folder = Path.home() / "Library" / "Logs"
    else:
        folder = Path(os.environ.get("XDG_STATE_HOME") or Path.home() / ".local" / "state")
    return folder / "Bladesmith" / "bladesmith.log"


def start(what: str) -> None:
    """Opens the log, once a process, and writes what runs, ``what``, with its versions."""
    if any(isinstance(handler, _File) for handler in _PACKAGE.handlers):
        return
    file = path()
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        handler = _File(file, "a", _LARGEST_BYTES, _OLDER_FILES, "utf-8")
    except OSError:
        return
    handler.setFormatter(_Discreet("%(asctime)s %(process)d %(levelname)s %(message)s"))
    _PACKAGE.addHandler(handler)
    _PACKAGE.setLevel(logging.INFO)
    _PACKAGE.info("%s: %s", what, ", ".join(_versions()))


def failure(error: Exception) -> None:
    """Writes the error being handled; a defect with the calls that led to it."""
    defect = getattr(error, "defect", True)
    _PACKAGE.error("%s: %s", type(error).__name__, error, exc_info=defect)


@contextmanager
def kept(what: str):
    """Starts the log, and writes the error that ends what is inside; also as a decorator."""
    start(what)
    try:
        yield
    except Exception as error:
        failure(error)
        raise


def sizes(*files: Optional[str]) -> str:
    """Names and sizes of the files that are given, in words."""
    return ", ".join(f"{Path(file).name} ({_size(file)})" for file in files if file)


class Stages:
    """Writes how long each stage of a work took; told of the stages by :meth:`enter`."""

    def __init__(self, logger: logging.Logger):
        self._logger = logger
        self._stage = ""
        self._since = time.monotonic()

    def enter(self, stage: str) -> None:
        """A stage begins, or goes on."""
        if stage != self._stage:
            self.end()
            self._stage, self._since = stage, time.monotonic()

    def end(self) -> None:
        """The stage, if there is one, ends."""
        if self._stage:
            self._logger.info("%s: %.2f s", self._stage, time.monotonic() - self._since)
        self._stage = ""


class _File(logging.handlers.RotatingFileHandler):
    """The log's file, known by its class."""

    def handleError(self, record: logging.LogRecord) -> None:
        """Says nothing: a full disk must not disturb the work."""


class _Discreet(logging.Formatter):
    """Leaves the folders out of every path, in tracebacks too."""

    def format(self, record: logging.LogRecord) -> str:
        return _FOLDERS.sub("", super().format(record))


def _versions() -> list[str]:
    freecad = sys.modules.get("FreeCAD")
    window = [f"FreeCAD {'.'.join(freecad.Version()[:3])}"] if freecad else []
    python = f"Python {platform.python_version()}"
    machine = f"{platform.system()} {platform.release()} {platform.machine()}"
    return [f"Bladesmith {__version__}", *window, python, machine, f"{os.cpu_count()} processors"]


def _size(file: str) -> str:
    try:
        return f"{os.path.getsize(file)} bytes"
    except OSError:
        return "not there"
