"""Small sound files of every format that is read, for the fuzzer to break.

What only an extra can write or read is there if its packages are.
"""

from __future__ import annotations

import gzip
import io
import tempfile
import warnings
import zipfile
from functools import cache
from pathlib import Path

import numpy as np

import crustline as cl
from crustline import CrustlineError
from fuzz import clouds


def npy(array: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> bytes:
    stream = io.BytesIO()
    np.save(stream, array)
    return stream.getvalue()


def npz() -> bytes:
    stream = io.BytesIO()
    arrays = {"indices": np.arange(3), "offsets": np.array([0, 3]), "closed": np.array([True])}
    np.savez(stream, points=np.eye(3, 2), isolated=np.arange(0), crs=np.array("a"), **arrays)
    return stream.getvalue()


def zipped(name: str, content: bytes) -> bytes:
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(name, content)
    return stream.getvalue()


SVG = b"""<?xml version="1.0"?>
<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"
 viewBox="0 0 9 9">
<g transform="rotate(30 1 1) scale(2)"><circle id="c" cx="1" cy="2" r="3"/></g>
<path d="M 0 0 C 0 1.5 2 1.5 2 0 C 2 -1.5 0 -1.5 0 0 Z" style="fill:#ff0000"/>
<ellipse cx="50%" cy="2mm" rx="3" ry="1"/><use xlink:href="#c" x="5"/></svg>"""
TABLE = b'x,y,z,name\n1.5,2.5,3,"a ""b"""\n3.5,4.5,4,c\n5.5,2.5,5,\n'
PLAIN: dict[str, list[bytes]] = {
    "csv": [
        TABLE,
        b"x;y\n1,5;2,5\n3,5;4,5\n",
        b"curve,order,row,x,y,closed\n0,0,0,1,2,1\n0,1,1,3,4,1\n0,2,2,5,0,1\n-1,0,3,9,9,0\n",
        "lon;lat\n8°30'36\"E;47°15'N\n".encode(),
        b"id,wkt\n1,POINT (1 2)\n2,\"LINESTRING (3 4, 5 6)\"\n",
        b"sep=;\nx;y\n1.234.567,5;2\n",
    ],
    "xyz": [
        b"E387\n 1. 2.\n\n1.5 2.5\n3.5 4.5\n5.5 2.5\n",
        b"* c\nL001\n3 2\n1 2\n3 4\n5 6\n",
        b'TITLE="t"\nVARIABLES = "X", "Y"\nZONE I=2\n1 2\n3 4\n',
        b"# x y\n1 2 #ff0000\n> -Z1\nNaN NaN\n0.6D+03 4\n",
    ],
    "geojson": [
        b'{"type":"FeatureCollection","features":[{"type":"Feature","properties":{"a":[1,2]},'
        b'"geometry":{"type":"LineString","coordinates":[[0,0],[1,2.5]]}},{"type":"Feature",'
        b'"properties":null,"geometry":{"type":"MultiPolygon","coordinates":[[[[0,0],[4,0],[4,4],'
        b"[0,0]]]]}}]}",
    ],
    "json": [
        b"[[0,0],[1,0.5]]",
        b'[{"x":1,"y":2},{"x":3,"y":4}]',
        b'{"x":1,"y":2}\n{"x":3,"y":4}\n',
    ],
    "wkt": [
        b"SRID=25832;POLYGON Z ((0 0 1, 4 0 1, 4 4 1, 0 0 1), (1 1 1, 2 1 1, 1 2 1, 1 1 1))\n"
        b"GEOMETRYCOLLECTION (POINT Z (1 2 3), MULTIPOINT Z ((1 2 3), (3 4 5)))\n",
    ],
    "npy": [npy(np.eye(4, 2)), npy(np.eye(4, 3))],
    "npz": [npz()],
    "svg": [SVG],
    "packed": [gzip.compress(TABLE), zipped("a.csv", TABLE), zipped("a.wkt", b"POINT (1 2)")],
}  # fmt: skip


#: Formats that one file is written in, and the parts of a Shapefile.
WRITTEN = ("gpkg", "fgb", "kml", "gpx", "parquet", "feather", "dxf")
SHAPEFILE = ("shp", "shx", "dbf", "prj")
#: All that `seeds` may have.
KEYS = (*PLAIN, *WRITTEN, *SHAPEFILE, "excel", "image", "world", "axes", *clouds.KEYS)


def _things() -> list[cl.Points | cl.Curves]:
    t = np.arange(8) * np.pi / 4
    xy = np.vstack([np.c_[np.cos(t), np.sin(t)] + 5, [[9, 9], [10, 9.5], [11, 9], [70, 70]]])
    columns = {"name": list("abcdefghijkl"), "n": np.arange(12), "w": xy[:, 0] / 7}
    points = cl.Points(xy, z=np.arange(12.0), columns=columns, crs="EPSG:4326")
    return [points, cl.Points(xy), cl.reconstruct(points), cl.reconstruct(xy, method=cl.gabriel)]


def _written(suffix: str, folder: str) -> list[Path]:
    paths = []
    for number, thing in enumerate(_things()):
        path = Path(folder, f"{number}.{suffix}")
        try:
            cl.write(thing, path)
        except CrustlineError:  # a format of points alone, or one whose extra is missing
            continue
        paths.append(path)
    return paths


@cache
def shapefile() -> dict[str, bytes]:
    """Return the parts of a Shapefile by their suffixes; none without the extra."""
    with tempfile.TemporaryDirectory() as folder:
        paths = _written("shp", folder)[:1]
        return {each: paths[0].with_suffix(f".{each}").read_bytes() for each in SHAPEFILE if paths}


def _workbook() -> bytes:
    import openpyxl

    book = openpyxl.Workbook()
    for row in [["x", "y", "z", "name"], [1.5, 2.5, 3, "a"], [3.5, 4.5, 4, "b"], [5, 6, 7, True]]:
        book.active.append(row)
    book.create_sheet("other").append([1, 2])
    stream = io.BytesIO()
    book.save(stream)
    return stream.getvalue()


def _arrow() -> dict[str, list[bytes]]:
    """Return tables that nothing is packed in, which bits can be turned over in."""
    import pyarrow as pa
    import pyarrow.feather as feather
    import pyarrow.parquet as parquet

    table = pa.table({"x": [1.5, 2, 3], "y": [4.0, 5, 6], "name": ["a", "b", None]})
    made: dict[str, list[bytes]] = {}
    for key, write in (
        ("parquet", lambda to: parquet.write_table(table, to, compression="none")),
        ("feather", lambda to: feather.write_feather(table, to, compression="uncompressed")),
    ):
        stream = io.BytesIO()
        write(stream)
        made[key] = [stream.getvalue()]
    return made


def _drawing() -> bytes:
    """Return a drawing of the few lines that a reader needs."""
    tags = [
        "0", "SECTION", "2", "BLOCKS", "0", "BLOCK", "2", "b", "10", "0", "20", "0",
        "0", "POINT", "10", "7.5", "20", "8", "0", "ENDBLK", "0", "ENDSEC",
        "0", "SECTION", "2", "ENTITIES",
        "0", "LINE", "8", "a", "10", "0", "20", "0", "30", "1", "11", "2.5", "21", "0", "31", "1",
        "0", "POLYLINE", "66", "1", "70", "1",
        "0", "VERTEX", "10", "1", "20", "1", "0", "VERTEX", "10", "2", "20", "1", "42", "0.5",
        "0", "VERTEX", "10", "2", "20", "2", "0", "SEQEND",
        "0", "ARC", "10", "4", "20", "4", "40", "1.5", "50", "10", "51", "200",
        "0", "CIRCLE", "10", "9", "20", "9", "40", "2",
        "0", "INSERT", "2", "b", "10", "3", "20", "3", "41", "2", "50", "30",
        "0", "ENDSEC", "0", "EOF", "",
    ]  # fmt: skip
    return "\n".join(tags).encode()


def _pictures() -> dict[str, list[bytes]]:
    """Return pictures of every kind, a world file, and places on axes."""
    import rasterio
    from PIL import Image

    down, right = np.mgrid[0:20, 0:24]
    gray = np.where(np.hypot(down - 9.3, right - 11.2) < 6.5, 230, 20).astype(np.uint8)
    image = Image.fromarray(gray)
    color = Image.merge("RGB", [image, image, Image.fromarray(gray // 2)])
    found = []
    for kind, picture, options in (
        ("PNG", image, {}), ("PNG", color.convert("P"), {}), ("PNG", color.convert("RGBA"), {}),
        ("JPEG", color, {}), ("GIF", image, {}), ("BMP", color, {}), ("PPM", image, {}),
        ("WEBP", color, {"lossless": True}), ("WEBP", color, {}), ("PPM", image.convert("1"), {}),
        ("TIFF", image, {}), ("TIFF", color, {"compression": "tiff_lzw"}),
    ):  # fmt: skip
        stream = io.BytesIO()
        picture.save(stream, kind, **options)
        found.append(stream.getvalue())
    place = rasterio.Affine(0.5, 0, 400_000, 0, -0.5, 5_000_000)
    profile = {"driver": "GTiff", "width": 24, "height": 20, "count": 2, "dtype": "uint8"}
    profile |= {"alpha": "yes"}
    for more in ({"tiled": True, "blockxsize": 16, "blockysize": 16}, {"nodata": 20}):
        with rasterio.MemoryFile() as file:
            with file.open(**profile, **more, transform=place, crs="EPSG:25832") as data:
                data.write(np.stack([gray, 255 - gray]))
                data.colorinterp = [
                    rasterio.enums.ColorInterp.gray,
                    rasterio.enums.ColorInterp.alpha,
                ]
            found.append(file.read())
    found.append(b"P2 6 5 9\n" + b"0 0 0 0 0 0 " + b"0 9 9 9 9 0 " * 3 + b"0 0 0 0 0 0\n")
    return {
        "image": found,
        "world": [b"0.5\n0.0\n0.0\n-0.5\n400000.25\n4999999.75\n"],
        "axes": [b"2,17=0,1 21,3=10,1e4 log=y", b"2,17=0,;21,17=10, 2,17=,1 2,3=,5"],
    }


@cache
def seeds() -> dict[str, list[bytes]]:
    """Return sound files by what they are: a format, "packed", or a part of a Shapefile."""
    found = dict(PLAIN)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for suffix in WRITTEN:
            with tempfile.TemporaryDirectory() as folder:
                found[suffix] = [path.read_bytes() for path in _written(suffix, folder)]
        found["dxf"] = found["dxf"] and [*[_drawing()] * 8, found["dxf"][0]]
        found |= {part: [content] for part, content in shapefile().items()}
    try:
        for key, files in _arrow().items():
            found[key] = found[key] + files
        found["excel"] = [_workbook()]
        found |= _pictures()
    except ImportError:
        pass
    found |= clouds.seeds()
    return {key: files for key, files in found.items() if files}
