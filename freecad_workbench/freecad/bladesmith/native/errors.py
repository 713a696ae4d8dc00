"""One exception class for each range of the core's status numbers.

The ranges: 1-9 the caller, 10 cancelled, 100-199 the input, 200-299 numerics, 300-399 design rules,
900 and up a defect of ours. ``exit_code`` is what the command line ends with;
of a ``defect`` the log keeps the calls that led to it.
"""


class BladesmithError(Exception):
    """Anything that is told to the user in one line."""

    exit_code = 1
    defect = False


class SetupError(BladesmithError):
    """A part of the installation is missing."""


class ArgumentError(BladesmithError):
    """An argument cannot be used."""

    exit_code = 2


class Cancelled(BladesmithError):
    """The user asked to stop."""


class InputError(BladesmithError):
    """A file or its content cannot be used."""

    exit_code = 2


class NumericsError(BladesmithError):
    """A numerical method failed."""


class DesignRuleError(BladesmithError):
    """The design asked for cannot be made."""


class InternalError(BladesmithError):
    """A defect of Bladesmith."""

    defect = True


_RANGES = (
    (1, 9, ArgumentError),
    (10, 10, Cancelled),
    (100, 199, InputError),
    (200, 299, NumericsError),
    (300, 399, DesignRuleError),
)


def from_status(status: int, message: str) -> BladesmithError:
    """The exception for a status number other than 0."""
    for first, last, kind in _RANGES:
        if first <= status <= last:
            return kind(message)
    return InternalError(message or f"the core returned status {status}")
