"""Keeps the translations of the workbench in step with its sources, and compiles them.

``translations.py update`` adds new texts to every ``.ts`` file and drops those no longer used;
``translations.py compile`` makes the ``.qm`` files with Qt's ``lrelease`` (Debian: package
qttools5-dev-tools). Both kinds of files are committed: users need no tools.
"""

import ast
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

PACKAGE = Path(__file__).resolve().parents[1] / "freecad_workbench" / "freecad" / "bladesmith"
FOLDER = PACKAGE / "resources" / "translations"

_CONTEXT = "Bladesmith"
_LRELEASE = ("lrelease", "/usr/lib/qt5/bin/lrelease", "lrelease-qt5")


def texts() -> set[tuple[str, str]]:
    """(context, text) of everything a user can read in the window."""
    found = set()
    for path in sorted(PACKAGE.rglob("*.py")):
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            found |= _of_call(node) | _of_command(node) | _of_list(node)
    for path in sorted(PACKAGE.rglob("*.ui")):
        root = ElementTree.parse(path).getroot()
        context = root.findtext("class")
        found |= {(context, s.text) for s in root.iter("string") if s.text and not s.get("notr")}
    return found


def _of_call(node) -> set:
    """``translate("text")``."""
    named = isinstance(node, ast.Call) and isinstance(node.func, ast.Name)
    if not named or node.func.id != "translate":
        return set()
    return {(_CONTEXT, a.value) for a in node.args if isinstance(a, ast.Constant)}


def _of_command(node) -> set:
    """The dictionary of a command: FreeCAD looks its texts up under the command's name."""
    if not isinstance(node, ast.Dict):
        return set()
    items = {k.value: v for k, v in zip(node.keys, node.values) if isinstance(k, ast.Constant)}
    if not {"Pixmap", "MenuText", "ToolTip"} <= items.keys():
        return set()
    name = items["Pixmap"].args[0].value
    return {(name, items[key].value) for key in ("MenuText", "ToolTip")}


def _of_list(node) -> set:
    """``TRANSLATED = (...)``: texts that are looked up by a variable."""
    named = isinstance(node, ast.Assign) and isinstance(node.targets[0], ast.Name)
    if not named or node.targets[0].id != "TRANSLATED":
        return set()
    return {(_CONTEXT, element.value) for element in node.value.elts}


def translations(path: Path) -> dict[tuple[str, str], str]:
    """What a ``.ts`` file says, by (context, text); empty where it is not finished."""
    found = {}
    for context in ElementTree.parse(path).getroot().iter("context"):
        for message in context.iter("message"):
            key = context.findtext("name"), message.findtext("source")
            found[key] = message.findtext("translation") or ""
    return found


def update(path: Path) -> None:
    """Writes a ``.ts`` file anew: the texts of the sources with the translations it had."""
    known = translations(path) if path.exists() else {}
    root = ElementTree.Element("TS", version="2.1", language=path.stem.split("_")[1])
    contexts = {}
    for name, text in sorted(texts()):
        if name not in contexts:
            contexts[name] = ElementTree.SubElement(root, "context")
            ElementTree.SubElement(contexts[name], "name").text = name
        message = ElementTree.SubElement(contexts[name], "message")
        ElementTree.SubElement(message, "source").text = text
        said = known.get((name, text), "")
        kind = {} if said else {"type": "unfinished"}
        ElementTree.SubElement(message, "translation", kind).text = said
    ElementTree.indent(root, " ")
    body = ElementTree.tostring(root, "unicode")
    head = '<?xml version="1.0" encoding="utf-8"?>\n<!DOCTYPE TS>\n'
    path.write_text(f"{head}{body}\n", "utf-8")


def compile_all() -> None:
    """Makes a ``.qm`` beside every ``.ts``."""
    tool = next(filter(None, map(shutil.which, _LRELEASE)), None)
    if tool is None:
        sys.exit("lrelease is missing: install it ('apt-get install qttools5-dev-tools' on Debian)")
    for path in sorted(FOLDER.glob("*.ts")):
        subprocess.run([tool, "-silent", path, "-qm", path.with_suffix(".qm")], check=True)


if __name__ == "__main__":
    if sys.argv[1:] == ["update"]:
        for file in sorted(FOLDER.glob("*.ts")):
            update(file)
    elif sys.argv[1:] == ["compile"]:
        compile_all()
    else:
        sys.exit("usage: translations.py update|compile")
