"""Colours for values: lists of sRGB colours that look evenly spaced.

Made in Oklab (B. Ottosson, 2020), where equal distances look equal: lightness runs linearly along
each list, towards the middle and back in the diverging one, so that a value shows in grey too.
"""

import numpy

GREY = numpy.array([0.66, 0.66, 0.66])
"""Where nothing is known."""

_KEYS = {
    # Places from 0 to 1: lightness, chroma, hue in degrees.
    "sequential": (
        (0.00, 0.44, 0.150, 285),
        (0.25, 0.56, 0.135, 252),
        (0.50, 0.68, 0.110, 195),
        (0.75, 0.80, 0.160, 140),
        (1.00, 0.92, 0.175, 102),
    ),
    "severity": (
        (0.00, 0.96, 0.050, 100),
        (0.35, 0.799, 0.135, 78),
        (0.65, 0.661, 0.185, 45),
        (1.00, 0.50, 0.190, 25),
    ),
    "diverging": (
        (0.00, 0.45, 0.150, 262),
        (0.25, 0.705, 0.105, 245),
        (0.50, 0.96, 0.000, 140),
        (0.75, 0.705, 0.130, 38),
        (1.00, 0.45, 0.165, 25),
    ),
}

NAMES = tuple(_KEYS)
"""``sequential`` for sizes, ``severity`` for what should be small, ``diverging`` for signs."""

_TO_CONE = numpy.array(
    [
        [1.0, 0.3963377774, 0.2158037573],
        [1.0, -0.1055613458, -0.0638541728],
        [1.0, -0.0894841775, -1.2914855480],
    ]
)
_TO_LINEAR = numpy.array(
    [
        [4.0767416621, -3.3077115913, 0.2309699292],
        [-1.2684380046, 2.6097574011, -0.3413193965],
        [-0.0041960863, -0.7034186147, 1.7076147010],
    ]
)


def oklab(name: str, count: int) -> numpy.ndarray:
    """(count, 3) lightness and the two colour axes of a list, before sRGB cuts what it cannot show.

    Hue and chroma are followed as a path through the colour plane.
    """
    keys = numpy.array(_KEYS[name])
    places = numpy.linspace(0, 1, count)
    hues = numpy.radians(keys[:, 3])
    plane = (keys[:, 2] * numpy.cos(hues), keys[:, 2] * numpy.sin(hues))
    return numpy.stack([numpy.interp(places, keys[:, 0], a) for a in (keys[:, 1], *plane)], axis=1)


def colours(name: str, count: int = 256) -> numpy.ndarray:
    """(count, 3) sRGB colours from 0 to 1, from the lowest value's to the highest one's."""
    linear = (oklab(name, count) @ _TO_CONE.T) ** 3 @ _TO_LINEAR.T
    linear = numpy.clip(linear, 0, 1)
    return numpy.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
