"""Words that several rooms say: counts, and which way a factor moves the part."""


def way(factor: float) -> str:
    """Which way a factor moves a part whose displacements belong to the shape given."""
    if factor == 0:
        return "nothing moves"
    return "cold to hot" if factor > 0 else "hot to cold"


def counted(count: int, noun: str) -> str:
    """``1 face``, ``2 faces``."""
    return f"{count} {noun}{'' if count == 1 else 's'}"


def direction(factor: float) -> str:
    """What a factor does with the displacements, in words."""
    done = "not used" if factor == 0 else "added" if factor > 0 else "taken away"
    return f"displacements {done} ({way(factor)})"
