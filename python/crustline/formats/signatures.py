"""Files that are no points, or that no reader knows: what they are, and what to do."""

from __future__ import annotations

import re

__all__ = ["foreign", "known_archive"]

_CONVERT = "save its points as CSV or GeoJSON"
_SIGNATURES = (
    (b"%PDF", "a PDF file: save its drawing as SVG or DXF"),
    (b"%!PS", "a PostScript file: save its drawing as SVG or DXF"),
    (b"\x89HDF", f"an HDF5 file: {_CONVERT}"),
    (b"CDF", f"a NetCDF file: {_CONVERT}"),
    (b"AC10", "a DWG file: save it as DXF"),
    (b"MATLAB 5.0", f"a MATLAB file: {_CONVERT}"),
    (b"\x28\xb5\x2f\xfd", "packed by zstd: unpack it first"),
    (b"7z\xbc\xaf\x27\x1c", "a 7z archive: unpack it first"),
    (b"Rar!", "a RAR archive: unpack it first"),
    (b"\x80\x04\x95", f"a Python pickle, which is not read: {_CONVERT}"),
    (b"solid ", "an STL file of a surface: name it .stl, and cut it by planes (--slice z=0)"),
)
_ARCHIVES = (
    (b"xl/", "an Excel file: name it .xlsx"),
    (b"[Content_Types].xml", "an Office file: save the sheet as CSV"),
    (b"mimetype", "an OpenDocument file: name a sheet of it .ods"),
    (b"doc.kml", "a KMZ file: save it as GeoJSON"),
)
_ROOTS = {
    "gml": f"a GML file: {_CONVERT}",
    "svg": "an SVG drawing: sample its paths first (crustline sample FILE.svg -r 0.2 …)",
    "html": "a web page, not the file it leads to: download that one",
    "vtkfile": f"a VTK file: {_CONVERT}",
}
_XML = re.compile(
    rb"(?:<\?xml.*?\?>|<!--.*?-->|<!(?i:DOCTYPE)[^>\[]*(?:\[.*?\])?\s*>|\s)*<(?:\w+:)?(\w+)",
    re.DOTALL,
)


def known_archive(head: bytes) -> str | None:
    """Return what a zip archive is that is a file of some program, and what to do."""
    return next((what for name, what in _ARCHIVES if name in head), None)


def foreign(head: bytes) -> str | None:
    """Return what a file of these first bytes is, and what to do; None if that is not known."""
    for magic, what in _SIGNATURES:
        if head.startswith(magic):
            return what
    if head.startswith(b"PK\x03\x04"):
        return known_archive(head) or "a zip archive: unpack it first"
    root = _XML.match(head.removeprefix(b"\xef\xbb\xbf"))
    if root:
        word = root[1].decode("ascii", "replace")
        return _ROOTS.get(word.lower(), f"an XML file of {word[:40]}: {_CONVERT}")
    return None
