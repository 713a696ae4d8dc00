"""The triangles that FreeCAD's 3-D view will ask for, made in a process of their own.

Open CASCADE holds Python's lock while it meshes, a second for a large face, and a window that
needs the lock would stand still. ``python -m freecad.bladesmith.occ.drawing`` is that process.
"""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Callable

from .runtime import part_module
from .step import from_brep

_POLL_S = 0.05


def with_triangles(brep: str, deviation_percent: float, go_on: Callable[[], bool]):
    """The shape of B-rep text with the triangles of a view with this *Deviation*.

    Without them where the process could not be run, or ``go_on`` said no: the view then makes its
    own.
    """
    with tempfile.TemporaryDirectory(prefix="bladesmith-") as folder:
        text, binary = Path(folder, "in.brep"), Path(folder, "out.bin")
        text.write_text(brep, "utf-8")
        if _meshed([str(text), str(binary), repr(deviation_percent)], go_on) and binary.exists():
            shape = part_module().Shape()
            shape.importBinary(str(binary))
            return shape
    return from_brep(brep)


def _meshed(arguments: list[str], go_on: Callable[[], bool]) -> bool:
    root = str(Path(__file__).resolve().parents[3])
    command = [_interpreter(), "-m", __name__, *arguments]
    streams = dict.fromkeys(("stdin", "stdout", "stderr"), subprocess.DEVNULL)
    try:
        process = subprocess.Popen(command, env={**os.environ, "PYTHONPATH": root}, **streams)
    except OSError:
        return False
    while go_on():
        try:
            return process.wait(_POLL_S) == 0
        except subprocess.TimeoutExpired:
            continue
    process.kill()
    process.wait()
    return False


def _interpreter() -> str:
    """A Python that finds FreeCAD: inside FreeCAD ``sys.executable`` may be FreeCAD itself."""
    if Path(sys.executable).name.lower().startswith("python"):
        return sys.executable
    beside = (
        shutil.which("python3", path=str(Path(sys.executable).parent)) if sys.executable else None
    )
    return beside or shutil.which("python3") or "python3"


def main(text: str, binary: str, deviation_percent: str) -> None:
    """Reads B-rep text, meshes it as a view with this deviation does, writes a binary B-rep."""
    shape = from_brep(Path(text).read_text("utf-8"))
    box = shape.BoundBox
    shape.tessellate((box.XLength + box.YLength + box.ZLength) / 300 * float(deviation_percent))
    shape.exportBinary(binary)


if __name__ == "__main__":
    main(*sys.argv[1:])
