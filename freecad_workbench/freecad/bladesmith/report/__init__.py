"""The page about a morph: figures in words and tables, pictures of the part."""

from .page import write_page

__all__ = ["write_page"]
