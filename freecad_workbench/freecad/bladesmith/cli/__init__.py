"""The ``bladesmith`` commands. Heavy modules are imported by the commands that need them."""

from .command import main

__all__ = ["main"]
