"""A morph's result made ready to be shown: meshes, movement, and values of several quantities."""

from collections.abc import Generator
from dataclasses import dataclass
from typing import Optional

import numpy

from ..occ.tessellation import Tessellation, edge_lines, joined, tessellate_face
from .movement import movement, normals
from .nodes import at_mesh_points
from .refinement import refined
from .scale import Scale, automatic

_LONGEST_SIDE = 1 / 50
"""Longest side of a triangle that carries colours, relative to the part's diagonal."""

_SHOWN_MOVEMENT = 0.08
"""Largest enlarged movement, relative to the part's diagonal."""


@dataclass(frozen=True)
class Quantity:
    """What can be shown: the palette, and whether its values have a sign or span decades."""

    palette: str
    component: Optional[int] = None
    deviation: bool = False

    @property
    def signed(self) -> bool:
        return self.component is not None

    @property
    def logarithmic(self) -> bool:
        return self.deviation

    def of(self, vectors: numpy.ndarray) -> numpy.ndarray:
        """The values (n,) of vectors (n, 3)."""
        if self.component is None:
            return numpy.linalg.norm(vectors, axis=1)
        return vectors[:, self.component]


QUANTITIES = {
    "displacement": Quantity("sequential"),
    "displacement_x": Quantity("diverging", 0),
    "displacement_y": Quantity("diverging", 1),
    "displacement_z": Quantity("diverging", 2),
    "deviation": Quantity("severity", deviation=True),
}


@dataclass(frozen=True)
class Spot:
    """The node at which a quantity is largest."""

    node: int
    face: int
    foot: numpy.ndarray
    displacement: numpy.ndarray
    value: float


@dataclass
class ShownResult:
    """Meshes and values; lengths in mm. Positions are the input's plus a factor times movement."""

    size: float
    mesh: Tessellation
    start: numpy.ndarray
    """(n, 3, 3) S, Su, Sv of the input at the mesh's points."""
    change: numpy.ndarray
    """(n, 3, 3) what the morph adds to them."""
    deviation: numpy.ndarray
    """(n, 3) at the mesh's points; NaN on faces without nodes."""
    edges: list
    """For each edge its points (k, 3) before and after."""
    nodes: dict

    def positions(self, factor: float) -> tuple[numpy.ndarray, numpy.ndarray]:
        """Points and normals of the mesh, moved."""
        moved = self.start + factor * self.change
        return moved[:, 0], normals(self.mesh, moved)

    def edge(self, index: int, factor: float) -> numpy.ndarray:
        """Points along an edge, numbered from 1, moved."""
        before, after = self.edges[index - 1]
        return before + factor * (after - before)

    def values(self, name: str) -> numpy.ndarray:
        """(n,) a quantity at the mesh's points."""
        quantity = QUANTITIES[name]
        return quantity.of(self.deviation if quantity.deviation else self.change[:, 0])

    def worst(self, name: str) -> Optional[Spot]:
        """Where a quantity is largest among the nodes, whatever its sign; None without nodes."""
        nodes, values = self.nodes, self._at_nodes(name)
        if not len(values):
            return None
        k = int(numpy.abs(values).argmax())
        return Spot(
            int(nodes["ids"][k]),
            int(nodes["faces"][k]),
            nodes["feet"][k],
            nodes["displacements"][k],
            float(values[k]),
        )

    def automatic_scale(self, name: str, steps: int = 0, logarithmic: bool = False) -> Scale:
        """A scale up to the largest value of a quantity, those at the nodes included."""
        everything = numpy.concatenate((self.values(name), self._at_nodes(name)))
        return automatic(everything, QUANTITIES[name].signed, logarithmic, steps)

    def _at_nodes(self, name: str) -> numpy.ndarray:
        quantity = QUANTITIES[name]
        return quantity.of(self.nodes["deviations" if quantity.deviation else "displacements"])

    def enlargement(self) -> float:
        """A round factor at which the movement is well seen, at least 1."""
        largest = float(numpy.linalg.norm(self.change[:, 0], axis=1).max(initial=0))
        return max(round_down(_SHOWN_MOVEMENT * self.size / largest), 1.0) if largest else 1.0


def prepare(before, after, nodes: dict) -> Generator[float, None, ShownResult]:
    """Builds a :class:`ShownResult` in short steps: yields the fraction done, returns the result.

    ``before`` and ``after`` are the solids, ``nodes`` the core's arrays by node and face.
    """
    size = before.BoundBox.DiagonalLength
    meshes, starts, changes, deviations = [], [], [], []
    pairs = list(zip(before.Faces, after.Faces))
    for index, (face, moved) in enumerate(pairs, 1):
        mesh = tessellate_face(face, index, size)
        yield (index - 0.8) / len(pairs)
        mesh = refined(mesh, size * _LONGEST_SIDE)
        start, change = movement(mesh, face, moved, size)
        yield (index - 0.5) / len(pairs)
        deviations.append(at_mesh_points(mesh, nodes, nodes["deviations"]))
        meshes.append(mesh)
        starts.append(start)
        changes.append(change)
        yield index / len(pairs)
    return ShownResult(
        size,
        joined(meshes),
        numpy.concatenate(starts),
        numpy.concatenate(changes),
        numpy.concatenate(deviations),
        edge_lines(before, after),
        nodes,
    )


def round_down(value: float) -> float:
    """The next smaller of 1, 2, 5 times a power of ten."""
    power = 10.0 ** numpy.floor(numpy.log10(value))
    return float(max(step * power for step in (1, 2, 5) if step * power <= value * (1 + 1e-9)))
