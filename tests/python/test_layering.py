"""Rooms use only rooms to their left; files and functions stay small."""

import ast
import unittest

import common

PACKAGE = common.WORKBENCH / "freecad" / "bladesmith"
ROOMS = ["native", "model", "occ", "report", "cli"]
FREECAD_ROOM = "occ"
KERNEL = {"FreeCAD", "Part", "FreeCADGui", "MeshPart", "Import"}
LONGEST_FILE, LONGEST_FUNCTION = 500, 60


def modules():
    return [(path, ast.parse(path.read_text())) for path in sorted(PACKAGE.rglob("*.py"))]


def imported(path, tree):
    """Rooms and top-level modules that a module imports."""
    room = path.relative_to(PACKAGE).parts[0]
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.level == 2:
            yield (node.module or "").split(".")[0] or None
        elif isinstance(node, ast.ImportFrom) and node.level == 1:
            yield room
        elif isinstance(node, ast.ImportFrom) and node.module:
            parts = node.module.split(".")
            yield parts[2] if parts[:2] == ["freecad", "bladesmith"] and parts[2:] else parts[0]
        elif isinstance(node, ast.Import):
            yield from (alias.name.split(".")[0] for alias in node.names)


class Layering(unittest.TestCase):
    def test_every_folder_is_a_known_room(self):
        folders = {path.parent.name for path in PACKAGE.rglob("*.py")} - {"bladesmith"}
        self.assertEqual(folders, set(ROOMS))

    def test_rooms_use_only_rooms_to_their_left(self):
        for path, tree in modules():
            room = path.relative_to(PACKAGE).parts[0]
            if room not in ROOMS:
                continue
            for name in imported(path, tree):
                if name in ROOMS:
                    self.assertLessEqual(ROOMS.index(name), ROOMS.index(room), f"{path}: {name}")

    def test_one_room_knows_freecad_and_one_the_library(self):
        for path, tree in modules():
            room = path.relative_to(PACKAGE).parts[0]
            names = set(imported(path, tree))
            if room != FREECAD_ROOM:
                self.assertFalse(names & KERNEL, path)
            if room != "native":
                self.assertNotIn("ctypes", names, path)

    def test_the_namespace_package_stays_one(self):
        self.assertFalse((PACKAGE.parent / "__init__.py").exists())


class Size(unittest.TestCase):
    def test_files_and_functions_fit_a_screen_or_two(self):
        tests = sorted((common.ROOT / "tests" / "python").glob("*.py"))
        for path in sorted(PACKAGE.rglob("*.py")) + tests:
            text = path.read_text()
            self.assertLessEqual(text.count("\n"), LONGEST_FILE, path)
            for node in ast.walk(ast.parse(text)):
                if isinstance(node, ast.FunctionDef):
                    length = node.end_lineno - node.lineno + 1
                    self.assertLessEqual(length, LONGEST_FUNCTION, f"{path}: {node.name}")

    def test_every_module_and_public_function_says_what_it_does(self):
        for path, tree in modules():
            self.assertTrue(ast.get_docstring(tree), path)
            for node in tree.body:
                public = isinstance(node, (ast.FunctionDef, ast.ClassDef))
                if public and not node.name.startswith("_"):
                    self.assertTrue(ast.get_docstring(node), f"{path}: {node.name}")


if __name__ == "__main__":
    unittest.main()
