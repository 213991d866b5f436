"""Files that are not what they seem: each ends in one sentence, in the room of an honest one."""

from __future__ import annotations

import bz2
import gzip
import io
import lzma
import os
import subprocess
import sys
import zipfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from crustline import FormatError, InputError, Points, read
from crustline.formats import read_curves, write

TABLE = b"x,y\n1.5,2.5\n3.5,4.5\n"


def refusal(content: Any, **options: Any) -> str:
    """Return the sentence by which content is refused."""
    with pytest.raises(FormatError) as caught:
        read(content, **options)
    message = str(caught.value)
    assert "\n" not in message
    assert len(message) < 400
    return message


# Packed


@pytest.mark.parametrize("pack", [gzip.compress, bz2.compress, lzma.compress])
@pytest.mark.parametrize("suffix", ["", ".csv.gz"])
def test_a_packed_file_is_unpacked(tmp_path: Path, pack: Any, suffix: str) -> None:
    path = tmp_path / f"points{suffix}"
    path.write_bytes(pack(TABLE))
    assert read(path).xy.tolist() == [[1.5, 2.5], [3.5, 4.5]]


def test_the_suffix_before_gz_counts(tmp_path: Path) -> None:
    path = tmp_path / "points.geojson.gz"
    path.write_bytes(gzip.compress(b'{"type":"Point","coordinates":[1,2]}'))
    assert read(path).xy.tolist() == [[1, 2]]


def zipped(**files: bytes) -> bytes:
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(name.replace("_", "."), content)
    return stream.getvalue()


def test_an_archive_of_one_file_of_points_is_unpacked() -> None:
    assert len(read(zipped(readme_pdf=b"?", points_csv=TABLE))) == 2


def test_an_archive_of_several_is_refused_with_their_names() -> None:
    assert "'a.csv', 'b.csv'" in refusal(zipped(a_csv=TABLE, b_csv=TABLE))
    assert "no file of points" in refusal(zipped(a_pdf=TABLE))


@pytest.mark.parametrize("pack", [gzip.compress, bz2.compress, lzma.compress])
def test_a_packed_bomb_is_refused(pack: Any) -> None:
    assert "unpacks to more than" in refusal(pack(bytes(80 << 20)))


def test_a_bomb_in_an_archive_is_refused() -> None:
    assert "unpacks to more than" in refusal(zipped(a_csv=bytes(80 << 20)))


def test_a_bomb_of_arrays_is_refused() -> None:
    stream = io.BytesIO()
    np.savez_compressed(stream, points=np.zeros((5_000_000, 2)))
    assert "unpacks to more than" in refusal(stream.getvalue())


@pytest.mark.parametrize("cut", [1, 10, 20])
def test_a_truncated_packed_file_is_refused(cut: int) -> None:
    assert "unpacker" in refusal(gzip.compress(TABLE * 100)[:-cut])
    assert refusal(zipped(a_csv=TABLE)[:-cut])


# NumPy


def npy(header: str, body: bytes = b"") -> bytes:
    text = header.encode() + b" " * (117 - len(header)) + b"\n"
    return b"\x93NUMPY\x01\x00" + len(text).to_bytes(2, "little") + text + body


@pytest.mark.parametrize(
    "header",
    [
        "{'descr': '<f8', 'fortran_order': False, 'shape': (1000000000000, 2), }",
        "{'descr': '<U0', 'fortran_order': False, 'shape': (1000000000000, 2), }",
        "{'descr': '<f8', 'fortran_order': False, 'shape': (-1, 2), }",
        "{'descr': '<f8', 'fortran_order': False, 'shape': (1, 2), }",
        "{'descr': '|V0', 'fortran_order': False, 'shape': (99999999999, 2), }",
        "{'descr': [('x', '<f8')], 'fortran_order': False, 'shape': (2, 2), }",
        "{'descr': '|O', 'fortran_order': False, 'shape': (2, 2), }",
        "{'descr': '<f8'",
        "__import__('os').abort()",
    ],
)
def test_a_header_that_lies_is_refused(header: str) -> None:
    assert refusal(npy(header, bytes(8)))


def test_arrays_of_both_orders_and_ends_are_read(tmp_path: Path) -> None:
    table = np.array([[1.5, 2.5], [3.5, 4.5], [5.5, 6.5]])
    for array in (np.asfortranarray(table), table.astype(">f4"), table.astype("<f2")):
        np.save(tmp_path / "p.npy", array)
        assert read(tmp_path / "p.npy").xy.tolist() == table.tolist()


# What a file is


FOREIGN = {
    "PDF": b"%PDF-1.7",
    "LAS": b"LASF" + bytes(200),
    "HDF5": b"\x89HDF\r\n\x1a\n",
    "SVG": b'<!DOCTYPE svg PUBLIC "-//W3C"><svg:svg>',
    "web page": b"<!doctype html><html>",
    "DWG": b"AC1027",
    "pickle": b"\x80\x04\x95",
}
READABLE = {
    "Shapefile": b"\x00\x00\x27\x0a" + bytes(96), "GeoPackage": b"SQLite format 3\x00",
    "GeoParquet": b"PAR1\x15", "GPX": b"<gpx>",
    "KML": b'<?xml version="1.0"?><!-- a --><kml xmlns="http://www.opengis.net/kml/2.2">',
    "DXF": b"  0\r\nSECTION\r\n  2\r\nHEADER\r\n",
    "a picture": b"\xff\xd8\xff\xe0",
    "Excel": zipped(xl_workbook=b"?").replace(b"xl.workbook", b"xl/workbook"),
}  # fmt: skip


@pytest.mark.parametrize("suffix", ["", ".csv", ".txt"])
@pytest.mark.parametrize("kind", FOREIGN)
def test_a_wrong_file_is_named(tmp_path: Path, kind: str, suffix: str) -> None:
    path = tmp_path / f"points{suffix}"
    path.write_bytes(FOREIGN[kind])
    assert kind in refusal(path)


@pytest.mark.parametrize("suffix", [".csv", ".txt"])
@pytest.mark.parametrize("kind", READABLE)
def test_a_wrong_name_is_named(tmp_path: Path, kind: str, suffix: str) -> None:
    path = tmp_path / f"points{suffix}"
    path.write_bytes(READABLE[kind])
    assert f"is {kind} inside: name it ." in refusal(path)


def test_bytes_that_are_no_text_are_named() -> None:
    assert "null characters" in refusal(b"1 2\n\x00\x01\n3 4\n")


# Where bytes come from


@pytest.mark.skipif(not os.path.exists("/dev/zero"), reason="needs /dev/zero")
def test_a_device_without_end_is_refused() -> None:
    assert "it is a device" in refusal("/dev/zero")
    with open("/dev/zero", "rb") as file:
        run = subprocess.run(
            [sys.executable, "-c", "import crustline; crustline.read('-')"],
            stdin=file, capture_output=True, text=True, timeout=600, check=False,
        )  # fmt: skip
    assert "standard input cannot be read: it is a device" in run.stderr


def test_no_device_is_empty() -> None:
    assert "cannot be read" in refusal(os.devnull)


def pieces() -> Iterator[bytes]:
    yield from (TABLE[:5], TABLE[5:9], TABLE[9:])


@pytest.mark.parametrize(
    "given",
    [
        TABLE,
        io.BytesIO(TABLE),
        io.StringIO(TABLE.decode()),
        gzip.GzipFile(fileobj=io.BytesIO(gzip.compress(TABLE))),
        pieces(),
    ],
    ids=lambda given: type(given).__name__,
)
def test_what_is_no_path_is_read(given: Any) -> None:
    assert read(given).xy.tolist() == [[1.5, 2.5], [3.5, 4.5]]


def test_an_open_file_is_read_and_written(tmp_path: Path) -> None:
    with open(tmp_path / "a.csv", "wb") as file:
        write(Points([(1, 2), (3, 4)]), file, format="csv")
    with open(tmp_path / "a.csv", "rb") as file:
        assert read(file).xy.tolist() == [[1, 2], [3, 4]]
    text = io.StringIO()
    write([(1, 2)], text, format="xyz")
    assert text.getvalue() == "1.0 2.0\n"


@pytest.mark.parametrize("given", [5, None, [5], object()])
def test_what_is_nothing_to_read_is_refused(given: Any) -> None:
    with pytest.raises(InputError, match="give a path"):
        read(given)


def test_a_long_name_is_cut() -> None:
    assert "File name too long" in refusal("a" * 3000 + ".csv")


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs /dev/full")
def test_a_full_disk_is_told_by_name() -> None:
    with open("/dev/full", "wb", buffering=0) as full:
        for where in ("/dev/full", full):
            with pytest.raises(FormatError, match="cannot be written: No space left on device"):
                write([(1, 2)], where, format="csv")


def test_text_that_no_encoding_holds_is_refused() -> None:
    points = Points([(1, 2)], columns={"name": ["\ud800"]})
    with pytest.raises(FormatError, match="surrogate"):
        write(points, io.BytesIO(), format="csv")
    stream = io.BytesIO()
    write(points, stream, format="geojson")
    assert read(stream.getvalue()).columns["name"].tolist() == ["\ud800"]


def test_curves_of_an_archive_are_checked() -> None:
    stream = io.BytesIO()
    arrays = {"points": np.zeros((2, 2)), "isolated": np.empty(0, int)}
    np.savez(stream, indices=[0, 7], offsets=[0, 2], closed=[False], **arrays)
    with pytest.raises(FormatError, match="0 to 1"):
        read_curves(stream.getvalue())
    np.savez(stream := io.BytesIO(), indices=[0, 1], offsets=[0], closed=[False], **arrays)
    with pytest.raises(FormatError, match="do not fit together"):
        read_curves(stream.getvalue())


def spreadsheet(path: Path, rows: str) -> Path:
    """Write an OpenDocument sheet of these rows."""
    spaces = "".join(
        f' xmlns:{name}="urn:oasis:names:tc:opendocument:xmlns:{name}:1.0"'
        for name in ("office", "table", "text")
    )
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("mimetype", "application/vnd.oasis.opendocument.spreadsheet")
        archive.writestr("META-INF/manifest.xml", "<manifest:manifest/>")
        archive.writestr(
            "content.xml",
            f"<office:document-content{spaces}><office:body><office:spreadsheet>"
            f'<table:table table:name="one">{rows}</table:table>'
            "</office:spreadsheet></office:body></office:document-content>",
        )
    return path


VALUE = '<table:table-cell office:value-type="float" office:value="{0}"/>'


def sheet_row(*values: float, times: int = 1, after: str = "") -> str:
    cells = "".join(VALUE.format(value) for value in values) + after
    return f'<table:table-row table:number-rows-repeated="{times}">{cells}</table:table-row>'


def empty_cells(times: int) -> str:
    return f'<table:table-cell table:number-columns-repeated="{times}"/>'


def test_opendocument_sheets_with_a_far_cell_are_refused_and_empty_ends_are_not(
    tmp_path: Path,
) -> None:
    pytest.importorskip("python_calamine")
    near = sheet_row(0, 1, after=empty_cells(16_382)) + sheet_row(2, 3)
    path = spreadsheet(tmp_path / "p.ods", near + sheet_row(after=empty_cells(9), times=10**6))
    assert read(path).xy.tolist() == [[0, 1], [2, 3]]
    below = near + sheet_row(times=10**6) + sheet_row(4, 5, after=empty_cells(90) + VALUE.format(6))
    aside = near + sheet_row(4, after=empty_cells(10**8) + VALUE.format(5))
    for rows in (below, aside, sheet_row(*[0] * 90, times=10**6)):
        with pytest.raises(FormatError, match=r"a sheet spans [\d,]+ rows and [\d,]+ columns"):
            read(spreadsheet(tmp_path / "far.ods", rows))


def test_binary_workbooks_with_a_far_cell_are_refused(tmp_path: Path) -> None:
    pytest.importorskip("python_calamine")

    def record(kind: int, *numbers: int) -> bytes:
        body = b"".join(number.to_bytes(4, "little") for number in numbers)
        return bytes([kind, len(body)]) + body

    def workbook(*records: bytes) -> Path:
        path = tmp_path / "far.xlsb"
        with zipfile.ZipFile(path, "w") as archive:
            # A record of the kind 148, in two bytes, and one of 200 bytes.
            other = b"\x94\x01\x10" + bytes(16) + b"\x81\x01\xc8\x01" + bytes(200)
            archive.writestr("xl/worksheets/sheet1.bin", other + b"".join(records))
        return path

    first, far = record(0, 0) + record(5, 0, 0, 0, 0), record(0, 10**6) + record(5, 99, 0, 0, 0)
    with pytest.raises(FormatError, match="spans 1,000,001 rows and 100 columns"):
        read(workbook(first, far))
    # Without it there is nothing to refuse before the library looks.
    with pytest.raises(FormatError, match="python-calamine cannot read it"):
        read(workbook(first))
