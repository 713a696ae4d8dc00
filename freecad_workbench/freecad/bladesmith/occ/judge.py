"""Open CASCADE's judgement of a solid, and of whether two are the same.

Only calls that survive bad geometry are used: ``Face.validate`` and its like can end the process.
"""

from dataclasses import dataclass, field

_FRACTIONS = (0.11, 0.37, 0.63, 0.89)
_VOLUME_NOISE = 1e-3
"""Open CASCADE integrates trimmed spline faces to no more than this, relative to the volume."""


@dataclass
class Verdict:
    """What Open CASCADE says of a solid."""

    valid: bool
    closed: bool
    complaints: list[str] = field(default_factory=list)


def judge(shape) -> Verdict:
    """Asks whether a shape is one valid, closed solid."""
    solids = shape.Solids
    if len(solids) != 1:
        return Verdict(False, False, [f"expected one solid, found {len(solids)}"])
    valid, closed = shape.isValid(), all(shell.isClosed() for shell in shape.Shells)
    complaints = []
    if not valid:
        bad = [f"Face{i}" for i, face in enumerate(shape.Faces, 1) if not face.isValid()]
        complaints.append(f"not valid ({', '.join(bad) or 'as a whole'})")
    if not closed:
        complaints.append("its shell is open")
    return Verdict(valid, closed, complaints)


def comparison_tolerance(shape) -> float:
    """What the digits of a STEP file may move a point, in mm: 1e-6, or more beyond a metre."""
    return 1e-6 * max(1.0, shape.BoundBox.DiagonalLength / 1000.0)


def differences(first, second, tolerance_mm: float) -> list[str]:
    """What differs between two solids that should have the same faces in the same order.

    Compares the numbers of faces and edges, points of each face's surface, and the volume. A face
    whose parameters were changed is compared by the nearest points of the other's surface.
    """
    pairs = (("faces", first.Faces, second.Faces), ("edges", first.Edges, second.Edges))
    found = [f"{len(a)} {what} became {len(b)}" for what, a, b in pairs if len(a) != len(b)]
    if found:
        return found
    for index, (a, b) in enumerate(zip(first.Faces, second.Faces), 1):
        distance = _face_distance(a, b, tolerance_mm)
        if distance > tolerance_mm:
            found.append(f"Face{index} is off by {distance:.1e} mm")
    change = abs(first.Volume - second.Volume)
    if change > _VOLUME_NOISE * abs(first.Volume):
        found.append(f"the volume changed by {change:.1e} mm³")
    return found


def _face_distance(first, second, tolerance_mm: float) -> float:
    a, b = first.ParameterRange, second.ParameterRange
    surfaces = first.Surface, second.Surface
    largest = 0.0
    for s in _FRACTIONS:
        for t in _FRACTIONS:
            point = surfaces[0].value(_between(a[0], a[1], s), _between(a[2], a[3], t))
            other = surfaces[1].value(_between(b[0], b[1], s), _between(b[2], b[3], t))
            distance = point.distanceToPoint(other)
            if distance > tolerance_mm:
                nearest = surfaces[1].value(*surfaces[1].parameter(point))
                distance = point.distanceToPoint(nearest)
            largest = max(largest, distance)
    return largest


def _between(first: float, last: float, fraction: float) -> float:
    return first + fraction * (last - first)
