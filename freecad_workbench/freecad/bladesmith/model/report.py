"""The report of a morph: the core's figures, and what was learned after them.

``document`` is the JSON document itself, under the names that users and checks rely on; the
classes below name what the summary and the page show. Lengths in mm, angles in degrees.
"""

import json
from dataclasses import dataclass
from typing import Any, Optional


@dataclass(frozen=True)
class Spread:
    """Mean and largest value of a quantity."""

    mean: float
    max: float

    @classmethod
    def of(cls, value: Optional[dict]) -> Optional["Spread"]:
        return None if value is None else cls(value["mean"], value["max"])


@dataclass(frozen=True)
class Change:
    """A quantity of the input and of the output solid."""

    before: Any
    after: Any

    @classmethod
    def of(cls, value: dict) -> "Change":
        return cls(value["before"], value["after"])


@dataclass(frozen=True)
class Face:
    """One face: its spline, its nodes, and how well they are met."""

    index: int
    name: str
    degree: tuple[int, int]
    poles: tuple[int, int]
    rational: bool
    nodes: int
    foot_mm: Spread
    deviation_mm: Spread
    distance_mm: Spread
    holdout_mm: Optional[Spread]
    spans: int
    spans_filled: int
    knots_inserted: int
    held: bool

    @classmethod
    def of(cls, value: dict) -> "Face":
        spreads = ("foot_mm", "deviation_mm", "distance_mm", "holdout_mm")
        pairs = ("degree", "poles")
        plain = ("index", "name", "rational", "nodes", "spans", "spans_filled", "knots_inserted")
        return cls(
            **{name: Spread.of(value[name]) for name in spreads},
            **{name: tuple(value[name]) for name in pairs},
            **{name: value[name] for name in plain},
            held=value.get("held", False),
        )


@dataclass(frozen=True)
class Edge:
    """One edge: how far its curve and its two traces are apart, and how its faces meet."""

    index: int
    faces: tuple[int, int]
    gap_mm: Change
    angle_deg: Change
    tangent: bool
    held: bool

    @classmethod
    def of(cls, value: dict) -> "Edge":
        return cls(
            value["index"],
            tuple(value["faces"]),
            Change.of(value["gap_mm"]),
            Change.of(value["angle_deg"]),
            value["tangent"],
            value.get("held", False),
        )


class Report:
    """A morph's report; what is added here goes into the document."""

    def __init__(self, document: dict[str, Any]):
        self.document = document
        self.faces: list[Face] = [Face.of(face) for face in document["faces"]]
        self.edges: list[Edge] = [Edge.of(edge) for edge in document["edges"]]
        self.deviation_mm = Spread.of(document["deviation_mm"])
        self.holdout_mm = Spread.of(document["holdout_mm"])
        self.volume_mm3 = Change.of(document["solid"]["volume_mm3"])
        self.area_mm2 = Change.of(document["solid"]["area_mm2"])
        self.centroid_mm = Change.of(document["solid"]["centroid_mm"])
        self.tolerance_mm = Change.of(document["solid"]["tolerance_mm"])

    @classmethod
    def of_text(cls, text: str) -> "Report":
        """The report that :meth:`to_json` wrote."""
        return cls(json.loads(text))

    @property
    def input(self) -> dict[str, Any]:
        return self.document["input"]

    @property
    def solid(self) -> dict[str, Any]:
        return self.document["solid"]

    @property
    def warnings(self) -> list[str]:
        return self.document["warnings"]

    @property
    def unmatched(self) -> int:
        return self.document["unmatched_nodes"]

    @property
    def seconds(self) -> dict[str, float]:
        return self.document["seconds"]

    def judged(self, valid: bool, closed: bool) -> None:
        """Records Open CASCADE's verdict; a solid is closed if the core finds so too."""
        self.solid["valid"] = valid
        self.solid["closed"] = bool(self.solid["closed"] and closed)

    def name_faces(self, names: list[str]) -> None:
        """Gives faces their names; those without one keep theirs."""
        for face, name in zip(self.document["faces"], names):
            face["name"] = name or face["name"]
        self.faces = [Face.of(face) for face in self.document["faces"]]

    def warn(self, *texts: str, first: bool = False) -> None:
        """Adds warnings: behind the others, or ``first`` where they are graver."""
        place = 0 if first else len(self.warnings)
        self.warnings[place:place] = texts

    def worst_face(self) -> Optional[Face]:
        """The face with the largest deviation."""
        return max(self.faces, key=lambda face: face.deviation_mm.max, default=None)

    def worst_holdout_face(self) -> Optional[Face]:
        """The face with the largest hold-out error; None without one."""
        tested = [face for face in self.faces if face.holdout_mm]
        return max(tested, key=lambda face: face.holdout_mm.max, default=None)

    def widest_edge(self) -> Optional[Edge]:
        """The edge with the largest gap afterwards."""
        return max(self.edges, key=lambda edge: edge.gap_mm.after, default=None)

    def most_opened_edge(self, held: bool) -> Optional[Edge]:
        """The tangent edge, beside held faces or elsewhere, whose angle grew most; or None."""
        tangent = [edge for edge in self.edges if edge.tangent and edge.held == held]
        return max(tangent, key=lambda e: e.angle_deg.after - e.angle_deg.before, default=None)

    def misses(self, tolerance_mm: float) -> bool:
        """Whether the largest deviation is beyond the tolerance asked for."""
        return not self.deviation_mm.max <= tolerance_mm

    def to_json(self) -> str:
        """The document as text, with a line end."""
        return json.dumps(self.document, indent=1, ensure_ascii=False) + "\n"
