"""From values to places on a colour bar: ranges, steps, ticks."""

import math
from dataclasses import dataclass

import numpy

SMALLEST = 1e-9
"""Values below count as this on a logarithmic scale."""

_DECADES = 3
_NEAR_END = 0.055
"""A tick closer than this to an end of the bar would touch its label."""


@dataclass(frozen=True)
class Scale:
    """What the two ends of a colour bar mean, and in how many steps it goes (0: smoothly)."""

    low: float
    high: float
    steps: int = 0
    logarithmic: bool = False

    def __post_init__(self):
        if not (math.isfinite(self.low) and math.isfinite(self.high) and self.low < self.high):
            raise ValueError(f"a scale from {self.low:g} to {self.high:g} has no length")
        if self.logarithmic and self.low <= 0:
            raise ValueError(f"a logarithmic scale cannot start at {self.low:g}")

    def places(self, values: numpy.ndarray) -> numpy.ndarray:
        """Values as fractions of the bar, cut to 0 and 1; NaN stays."""
        if self.logarithmic:
            values = numpy.log(numpy.maximum(values, SMALLEST) / self.low)
            return numpy.clip(values / math.log(self.high / self.low), 0, 1)
        return numpy.clip((values - self.low) / (self.high - self.low), 0, 1)

    def value(self, place: float) -> float:
        """What a fraction of the bar means."""
        if self.logarithmic:
            return self.low * (self.high / self.low) ** place
        return self.low + (self.high - self.low) * place

    def bar(self, colours: numpy.ndarray) -> numpy.ndarray:
        """The colours along the bar: those given, or the middle one of each step."""
        if not self.steps:
            return colours
        place = numpy.linspace(0, 1, len(colours), endpoint=False)
        step = numpy.floor(place * self.steps)
        # The first and the last step take the ends of the list.
        chosen = step / max(self.steps - 1, 1) * (len(colours) - 1)
        return colours[numpy.rint(chosen).astype(int)]

    def ticks(self) -> list[float]:
        """Values to be written beside the bar: its ends, and steps or round values between."""
        if self.steps:
            return [self.value(k / self.steps) for k in range(self.steps + 1)]
        inner = _decades(self.low, self.high) if self.logarithmic else _round(self.low, self.high)
        places = self.places(numpy.array(inner))
        kept = [v for v, p in zip(inner, places) if _NEAR_END < p < 1 - _NEAR_END]
        return [self.low, *kept, self.high]


def automatic(values: numpy.ndarray, signed: bool, logarithmic: bool, steps: int = 0) -> Scale:
    """A scale that shows all values: from zero, even about zero if ``signed``, or logarithmic.

    A logarithmic one spans one to three decades and leaves out smaller values.
    """
    known = values[numpy.isfinite(values)]
    if logarithmic:
        top = max(float(known.max(initial=0)), 10 * SMALLEST)
        few = float(numpy.quantile(known, 0.02)) if len(known) else 0.0
        lowest = math.ceil(math.log10(max(top / 10**_DECADES, SMALLEST)))
        bottom = 10.0 ** max(lowest, math.floor(math.log10(max(few, SMALLEST))))
        return Scale(min(bottom, top / 10), top, steps, True)
    top = float(numpy.abs(known).max(initial=0)) or 1.0
    return Scale(-top if signed else 0.0, top, steps)


def _round(low: float, high: float) -> list[float]:
    """Multiples of 1, 2 or 5 times a power of ten, about six of them."""
    rough = (high - low) / 6
    power = 10.0 ** math.floor(math.log10(rough))
    step = min((k * power for k in (1, 2, 5, 10)), key=lambda s: abs(math.log(s / rough)))
    return [k * step for k in range(math.ceil(low / step), math.floor(high / step) + 1)]


def _decades(low: float, high: float) -> list[float]:
    """Powers of ten, with 2 and 5 times them where there are few."""
    factors = (1, 2, 5) if high / low < 10**2.5 else (1,)
    powers = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    return [f * 10.0**p for p in powers for f in factors if low <= f * 10.0**p <= high]


def labels(scale: Scale, unit_mm: float = 1.0) -> list[str]:
    """The ticks as text in a unit: three digits of the largest, or each on its own."""
    shown = [value / unit_mm for value in scale.ticks()]
    digits = 2 - math.floor(math.log10(max(map(abs, shown))))
    if scale.logarithmic or not 0 <= digits <= 5:
        return [number(value) for value in shown]
    return [f"{value:.{digits}f}" for value in shown]


_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def number(value: float) -> str:
    """Three digits, with a power of ten where it is below 0.001 or above 99999."""
    if value == 0 or 1e-3 <= abs(value) < 1e5:
        return f"{value:.3g}" if abs(value) < 1000 else f"{value:.0f}"
    mantissa, exponent = f"{value:.2e}".split("e")
    mantissa = mantissa.rstrip("0").rstrip(".")
    power = "10" + str(int(exponent)).translate(_RAISED)
    return {"1": power, "-1": f"-{power}"}.get(mantissa, f"{mantissa}·{power}")
