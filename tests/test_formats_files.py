"""What all formats share: finding the format, standard input and output, whole files or none."""

from __future__ import annotations

import io
import os
import stat
import sys

import numpy as np
import pytest

from crustline.curves import trace
from crustline.errors import FormatError, FormatWarning, InputError
from crustline.formats import FORMATS, read, write
from crustline.formats.crs import normalize_crs
from crustline.points import Points

WRITTEN = [key for key, each in FORMATS.items() if each.write_curves]


def curves():
    points = Points([(0, 0), (1, 0), (0, 1), (5, 5)], z=[1, 2, 3, 4], crs="EPSG:25832")
    return trace(points, [(0, 1), (1, 2), (0, 2)])


class Standard:
    """A standard stream that knows bytes only."""

    def __init__(self, content=b""):
        self.buffer = io.BytesIO(content)

    def flush(self):
        pass


# Of curves and isolated points these make several layers or files: see test_formats_gis.py.
SEVERAL = ("gpkg", "shp", "fgb", "kml", "gpx")


@pytest.mark.parametrize(
    "format", [key for key in WRITTEN if FORMATS[key].read and key not in SEVERAL]
)
def test_standard_output_to_standard_input(monkeypatch, format):
    stdout = Standard()
    monkeypatch.setattr(sys, "stdout", stdout)
    write(curves(), "-", format=format)
    monkeypatch.setattr(sys, "stdin", Standard(stdout.buffer.getvalue()))
    points = read("-")  # the content says what it is
    assert sorted(points.xy.tolist()) == sorted(curves().points.xy.tolist())
    assert sorted(points.z.tolist()) == [1, 2, 3, 4]


def test_standard_output_has_no_room_for_several_files(monkeypatch):
    monkeypatch.setattr(sys, "stdout", Standard())
    with pytest.raises(FormatError, match="several files"):
        write(curves(), "-", format="shp")


def test_the_format_can_be_told(tmp_path):
    write(curves(), tmp_path / "curves.csv", format="geojson")
    assert read(tmp_path / "curves.csv", format="geojson").xy.shape == (4, 2)
    assert (tmp_path / "curves.csv").read_text().startswith("{")


@pytest.mark.parametrize("format", WRITTEN)
def test_no_points_can_be_written(tmp_path, format):
    write(trace([], []), tmp_path / f"none.{format}")
    if format in ("csv", "tsv"):
        with pytest.warns(FormatWarning, match="no rows"):
            assert len(read(tmp_path / f"none.{format}")) == 0
    elif format in ("npz", "geojson"):
        assert len(read(tmp_path / f"none.{format}")) == 0


def test_unknown_formats_are_named(tmp_path):
    (tmp_path / "p.csv").write_text("1,2\n")
    with pytest.raises(InputError, match=r"'nef'.*csv, tsv"):
        read(tmp_path / "p.csv", format="nef")
    for name in ("out.nef", "out", "-"):
        with pytest.raises(InputError, match=r"\.geojson"):
            write(curves(), name)
    with pytest.raises(InputError, match="'nef'"):
        write(curves(), tmp_path / "out.csv", format="nef")
    assert os.listdir(tmp_path) == ["p.csv"]


@pytest.mark.parametrize("columns", ["xy", ["x"], ["x", "y", "z", "w"]])
def test_the_number_of_columns_is_checked(tmp_path, columns):
    (tmp_path / "p.csv").write_text("1,2,3\n")
    with pytest.raises(InputError, match="columns"):
        read(tmp_path / "p.csv", columns=columns)


def test_unreadable_inputs_are_named(tmp_path):
    with pytest.raises(FormatError, match=r"none\.csv cannot be read: there is no such file"):
        read(tmp_path / "none.csv")
    with pytest.raises(FormatError, match="it is a folder"):
        read(tmp_path)
    with pytest.raises(FormatError, match="null character"):
        read("a\0b.csv")


def test_unwritable_outputs_are_named_and_leave_nothing(tmp_path):
    (tmp_path / "file").write_text("")
    (tmp_path / "folder.csv").mkdir()
    for name in ("none/out.csv", "folder.csv", "file/out.csv"):
        with pytest.raises(FormatError, match="cannot be written"):
            write(curves(), tmp_path / name)
    assert sorted(os.listdir(tmp_path)) == ["file", "folder.csv"]


@pytest.mark.parametrize("error", [OSError(28, "No space left on device"), KeyboardInterrupt()])
def test_a_write_that_fails_leaves_the_old_file(tmp_path, monkeypatch, error):
    path = tmp_path / "out.csv"
    path.write_text("old")

    def fail(*_):
        raise error

    monkeypatch.setattr(os, "replace", fail)
    with pytest.raises((FormatError, KeyboardInterrupt)):
        write(curves(), path)
    assert path.read_text() == "old"
    assert os.listdir(tmp_path) == ["out.csv"]


@pytest.mark.skipif(os.name == "nt", reason="needs the modes of POSIX")
def test_modes_and_links_are_kept(tmp_path):
    target = tmp_path / "target.csv"
    target.write_text("old")
    target.chmod(0o640)
    (tmp_path / "link.csv").symlink_to(target)
    write(curves(), tmp_path / "link.csv")
    assert (tmp_path / "link.csv").is_symlink()
    assert target.read_text().startswith("curve,")
    assert stat.S_IMODE(target.stat().st_mode) == 0o640


@pytest.mark.skipif(not os.path.exists("/dev/null"), reason="needs /dev/null")
def test_a_device_is_written_to_and_not_replaced():
    write(curves(), "/dev/null", format="csv")
    assert not os.path.isfile("/dev/null")


@pytest.mark.parametrize(
    ("name", "normal"),
    [
        ("EPSG:4326", "EPSG:4326"),
        ("epsg:25832", "EPSG:25832"),
        ("urn:ogc:def:crs:EPSG:6.9:25832", "EPSG:25832"),
        ("urn:ogc:def:crs:OGC:1.3:CRS84", "OGC:CRS84"),
        (" local grid ", "local grid"),
    ],
)
def test_names_of_reference_systems(name, normal):
    assert normalize_crs(name) == normal


def test_the_input_may_be_the_output(tmp_path):
    path = tmp_path / "p.csv"
    path.write_text("x,y\n1,2\n")
    write(trace(read(path), []), path)
    assert np.array_equal(read(path), [[1, 2]])
