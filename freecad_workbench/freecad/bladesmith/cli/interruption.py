"""Ctrl-C and SIGTERM: an orderly end, whatever is going on.

Elsewhere a signal raises :class:`KeyboardInterrupt` at once. Inside the core it must not, as an
exception cannot cross foreign frames: there it is noted, and the next progress call cancels.
"""

import signal
from contextlib import contextmanager

_deferred = False
_asked = False


def install() -> None:
    """Handles both signals from here on."""
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, _handle)


def _handle(_number, _frame) -> None:
    global _asked
    _asked = True
    if not _deferred:
        raise KeyboardInterrupt


def too_late() -> None:
    """Lets both signals pass from here on: results are about to get their names."""
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.SIG_IGN)


def asked() -> bool:
    """Whether a signal has asked to stop."""
    return _asked


@contextmanager
def deferred():
    """Only notes signals inside; raises :class:`KeyboardInterrupt` at the end if there was one."""
    global _deferred
    _deferred = True
    try:
        yield
    finally:
        _deferred = False
        if _asked:
            raise KeyboardInterrupt
