"""Reading and writing: one file for each format, a table of them, and the doors to it.

`crustline.formats.format` says how to add a format.
"""

from crustline.formats.catalog import FORMATS
from crustline.formats.format import Format, Layer, Option
from crustline.formats.reading import layers, read, read_curves, stream
from crustline.formats.source import Source
from crustline.formats.target import Target
from crustline.formats.writing import write

__all__ = [
    "FORMATS", "Format", "Layer", "Option", "Source", "Target",
    "layers", "read", "read_curves", "stream", "write",
]  # fmt: skip
