"""Displacements from a result of FreeCAD's FEM workbench."""

from ..native import InputError
from ..operations.morph import FieldNodes


def is_result(obj) -> bool:
    """Whether ``obj`` is a result with displacements at the nodes of a mesh."""
    return hasattr(obj, "DisplacementVectors") and hasattr(obj, "NodeNumbers")


def field_nodes(obj) -> FieldNodes:
    """The displacements of a ``Fem::FemResultObject``, in mm, as FreeCAD keeps them.

    Raises :class:`InputError` where it holds none, or not for the nodes of its mesh.
    """
    name = obj.Label
    if not is_result(obj):
        raise InputError(f"{name}: no result of the FEM workbench; choose a mechanical result")
    numbers, moved = obj.NodeNumbers, obj.DisplacementVectors
    mesh = getattr(obj, "Mesh", None)
    if mesh is None:
        raise InputError(f"{name}: the result has no mesh; run the analysis again in FreeCAD")
    if not moved:
        raise InputError(f"{name}: the result holds no displacements; run a static analysis")
    if len(moved) != len(numbers):
        raise InputError(
            f"{name}: {len(moved)} displacements for {len(numbers)} nodes; run the analysis again"
        )
    nodes = mesh.FemMesh.Nodes
    missing = [number for number in numbers if number not in nodes]
    if missing:
        raise InputError(
            f"{name}: {len(missing)} of {len(numbers)} nodes are not in its mesh {mesh.Label}, "
            f"the first is node {missing[0]}; run the analysis again"
        )
    points = tuple(tuple(nodes[number]) for number in numbers)
    return FieldNodes(name, tuple(numbers), points, tuple(map(tuple, moved)))
