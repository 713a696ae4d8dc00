"""Which rooms know FreeCAD and its window; sizes of files (for the order see layering.rs)."""

import ast
import unittest

import common

PACKAGE = common.WORKBENCH / "freecad" / "bladesmith"
_KERNEL = {"occ"}
_WINDOW = {"viewproviders", "taskpanels", "commands", "init_gui.py"}
ROOMS = {
    "ctypes": {"native"},
    **dict.fromkeys(("Part", "MeshPart", "Import"), _KERNEL),
    "FreeCAD": {"occ", "features", *_WINDOW},
    **dict.fromkeys(("FreeCADGui", "PySide", "pivy"), _WINDOW),
}
"""Modules from outside, and the rooms that may import them."""
LONGEST_FILE, LONGEST_FUNCTION = 500, 60


def modules():
    return [(path, ast.parse(path.read_text())) for path in sorted(PACKAGE.rglob("*.py"))]


def imported(tree):
    """Top-level modules that a module imports."""
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.level == 0:
            yield node.module.split(".")[0]
        elif isinstance(node, ast.Import):
            yield from (alias.name.split(".")[0] for alias in node.names)


class Layering(unittest.TestCase):
    def test_modules_from_outside_are_known_in_their_rooms_only(self):
        for path, tree in modules():
            room = path.relative_to(PACKAGE).parts[0]
            for module in set(imported(tree)) & set(ROOMS):
                self.assertIn(room, ROOMS[module], f"{path} imports {module}")

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
