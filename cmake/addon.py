"""Packs the FreeCAD add-on with the shared library inside: ``addon.py LIBRARY FOLDER``.

Writes ``FOLDER/bladesmith-<release>-freecad-<platform>.zip`` and prints its name. Unpacked into
FreeCAD's ``Mod`` folder it is a full installation. Equal inputs give equal bytes.
"""

import os
import re
import subprocess
import sys
import sysconfig
import tempfile
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
TOP = "Bladesmith"
NATIVE = "freecad_workbench/freecad/bladesmith/native"
PAPERS = ("package.xml", "LICENSE-MIT", "LICENSE-APACHE")
LEFT_OUT = {"__pycache__", "tests"}


def sources() -> list[Path]:
    """The files of the add-on, relative to the checkout, in order."""
    found = [ROOT / name for name in PAPERS]
    for path in sorted((ROOT / "freecad_workbench").rglob("*")):
        if path.is_file() and not LEFT_OUT.intersection(path.parts):
            found.append(path)
    return [path.relative_to(ROOT) for path in found]


def library_name() -> str:
    """The name by which the package looks for the library beside itself."""
    header = (ROOT / "include" / "bladesmith" / "bladesmith.h").read_text()
    abi = re.search(r"#define BLADESMITH_ABI_VERSION (\d+)", header)[1]
    return f"libbladesmith.so.{abi}"


def stripped(library: Path) -> bytes:
    """The library without what only debuggers need."""
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder, "library")
        subprocess.run(["strip", "--strip-unneeded", "-o", target, library], check=True)
        return target.read_bytes()


def add(archive: zipfile.ZipFile, name: str, content: bytes, mode: int) -> None:
    """Adds a file without the time of day, so that packing again gives the same bytes."""
    entry = zipfile.ZipInfo(f"{TOP}/{name}")
    entry.external_attr = (0o100000 | mode) << 16
    entry.compress_type = zipfile.ZIP_DEFLATED
    archive.writestr(entry, content)


def main(library: Path, folder: Path) -> None:
    """Writes the archive, whole or not at all."""
    release = re.search(r'^version = "(.*)"$', (ROOT / "Cargo.toml").read_text(), re.M)[1]
    target = folder / f"bladesmith-{release}-freecad-{sysconfig.get_platform()}.zip"
    partial = target.with_suffix(".tmp")
    with zipfile.ZipFile(partial, "w") as archive:
        for path in sources():
            mode = 0o755 if os.access(ROOT / path, os.X_OK) else 0o644
            add(archive, path.as_posix(), (ROOT / path).read_bytes(), mode)
        add(archive, f"{NATIVE}/{library_name()}", stripped(library), 0o755)
    partial.replace(target)
    print(target)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit("usage: addon.py LIBRARY FOLDER")
    main(Path(sys.argv[1]), Path(sys.argv[2]))
