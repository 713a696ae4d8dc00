"""A progress bar for a terminal; silent elsewhere."""

import sys
import time
from typing import Optional, TextIO

_WIDTH = 30
_INTERVAL_S = 0.05


class Progress:
    """One line on standard error, redrawn in place and wiped at the end."""

    def __init__(self, quiet: bool, stream: Optional[TextIO] = None):
        self._stream = sys.stderr if stream is None else stream
        self._shown = not quiet and self._stream.isatty()
        self._started = time.monotonic()
        self._drawn = float("-inf")

    def __enter__(self) -> "Progress":
        return self

    def __exit__(self, *_exception) -> None:
        if self._shown:
            self._stream.write("\r\x1b[K")
            self._stream.flush()

    def __call__(self, stage: str, fraction: float) -> None:
        """Shows the stage and the fraction done."""
        now = time.monotonic()
        if self._shown and now - self._drawn >= _INTERVAL_S:
            self._drawn = now
            fraction = min(max(fraction, 0.0), 1.0)
            bar = "#" * round(fraction * _WIDTH)
            self._stream.write(
                f"\r[{bar:<{_WIDTH}}] {fraction:4.0%} {now - self._started:5.1f} s  {stage}\x1b[K"
            )
            self._stream.flush()
