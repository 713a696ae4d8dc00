"""Files that appear whole and together, or not at all.

Each is written under a temporary name in its own folder and renamed at the end; what was there
before stays until then.
"""

import os
import shutil
import tempfile
from pathlib import Path

from ..native.errors import InputError

STDOUT = "-"
"""In place of a file's name: standard output."""


class Outputs:
    """A context manager: leaving it by an exception, or without ``commit``, removes everything."""

    def __init__(self):
        self._pending: list[tuple[Path, Path]] = []

    def __enter__(self) -> "Outputs":
        return self

    def __exit__(self, *_exception) -> None:
        for temporary, _target in self._pending:
            if temporary.is_dir():
                shutil.rmtree(temporary, ignore_errors=True)
            else:
                temporary.unlink(missing_ok=True)

    def file(self, target: str) -> str:
        """A temporary name, with the same suffix, for the file ``target``."""
        path = Path(target)
        handle, name = tempfile.mkstemp(f".tmp{path.suffix}", f".{path.stem}.", _folder(path))
        os.close(handle)
        _apply_umask(name, 0o666)
        self._pending.append((Path(name), path))
        return name

    def directory(self, target: str) -> str:
        """A temporary folder whose files will be put into the folder ``target``."""
        path = Path(target)
        name = tempfile.mkdtemp(".tmp", f".{path.name}.", _folder(path))
        _apply_umask(name, 0o777)
        self._pending.append((Path(name), path))
        return name

    def commit(self) -> None:
        """Gives every file its name."""
        for temporary, target in self._pending:
            if not temporary.is_dir():
                os.replace(temporary, target)
                continue
            target.mkdir(exist_ok=True)
            for file in sorted(temporary.iterdir()):
                os.replace(file, target / file.name)
            temporary.rmdir()
        self._pending.clear()


def check_target(target: str, what: str, directory: bool = False) -> None:
    """Refuses a target that could not be written, before any work is done.

    Raises :class:`InputError`.
    """
    path = Path(target)
    folder = path.parent
    if not folder.is_dir():
        raise InputError(f"{target}: the folder {folder} for {what} does not exist; make it first")
    if not os.access(folder, os.W_OK):
        raise InputError(f"{target}: the folder {folder} for {what} cannot be written to")
    if path.is_dir() != directory and path.exists():
        kinds = ("a folder", "a file")
        expected, found = kinds if directory else reversed(kinds)
        raise InputError(
            f"{target}: for {what} {expected} is expected, and this is {found}; give another name"
        )


def _folder(path: Path) -> str:
    return str(path.parent)


def _apply_umask(name: str, mode: int) -> None:
    """The rights a file made in the ordinary way has; temporary ones are private."""
    mask = os.umask(0)
    os.umask(mask)
    os.chmod(name, mode & ~mask)
