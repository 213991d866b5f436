"""`Points.write`: `read` gives back what was written, as far as the format can hold it."""

from __future__ import annotations

import numpy as np
import pytest

from crustline.errors import FormatError, InputError
from crustline.formats import FORMATS, read
from crustline.points import Points

READABLE = ["csv", "tsv", "xyz", "geojson", "wkt", "npy", "npz"]
WITH_COLUMNS = {"csv", "tsv", "npz", "geojson"}
WITH_CRS = {"npz", "geojson", "wkt"}


def survey(heights=True):
    """Eight rows, the last of them repeated, whose columns need care in every format."""
    rng = np.random.default_rng(5)
    xy = np.concatenate([rng.normal(size=(7, 2)) * 10.0 ** np.arange(-9, 5, 2)[:, None], [[0, 0]]])
    return Points(
        np.concatenate([xy, xy[-1:]]),
        z=np.arange(9) / 7 if heights else None,
        columns={
            "name": np.array(["a", 'say "b"', "c,d", "é", "", "f", "#g", "h", "i"], dtype=object),
            "count": np.arange(9),
        },
        crs="EPSG:25832",
        names=("easting", "northing"),
    )


@pytest.mark.parametrize("heights", [True, False])
@pytest.mark.parametrize("key", READABLE)
def test_reading_gives_back_what_was_written(tmp_path, key, heights):
    points = survey(heights)
    path = tmp_path / f"points{FORMATS[key].suffixes[0]}"
    points.write(path)
    again = read(path)
    assert again.xy.tobytes() == points.xy.tobytes()
    if heights:
        assert again.z.tobytes() == points.z.tobytes()
    if key in WITH_COLUMNS:
        assert list(again.columns) == list(points.columns)
        for name, column in points.columns.items():
            assert again.columns[name].tolist() == column.tolist()
    assert again.crs == ("EPSG:25832" if key in WITH_CRS else None)


def test_names_of_coordinates_are_kept(tmp_path):
    survey().write(tmp_path / "points.csv")
    assert (tmp_path / "points.csv").read_text().startswith("easting,northing,z,name,count\n")


def test_a_column_that_is_called_as_the_height_is_renamed(tmp_path):
    points = Points([(1, 2)], z=[3], columns={"z": [4]})
    points.write(tmp_path / "points.csv")
    assert (tmp_path / "points.csv").read_text() == "x,y,z,input_z\n1.0,2.0,3.0,4\n"


def test_a_picture_has_a_dot_for_each_row(tmp_path):
    survey().write(tmp_path / "points.svg")
    assert (tmp_path / "points.svg").read_text().count("h0") == 9


@pytest.mark.parametrize("key", [key for key in READABLE if key not in ("npy", "npz")])
def test_no_points_are_written_as_text(tmp_path, key):
    Points(np.zeros((0, 2))).write(tmp_path / "none", format=key)
    assert (tmp_path / "none").exists()


def test_selected_rows_carry_what_is_theirs():
    points = survey()
    for rows in ([7, 2], np.array([], int), [], np.arange(9) % 2 == 0):
        chosen = points.select(rows)
        index = np.arange(9)[np.asarray(rows, dtype=None if len(rows) else int)]
        assert isinstance(chosen, Points)
        assert chosen.xy.tobytes() == np.asarray(points)[index].tobytes()
        assert chosen.z.tolist() == points.z[index].tolist()
        assert chosen.columns["name"].tolist() == points.columns["name"][index].tolist()
        assert (chosen.crs, chosen.names) == (points.crs, points.names)


def test_what_cannot_be_written_is_refused(tmp_path):
    with pytest.raises(InputError, match=r"no format is known.*\.xyz"):
        survey().write(tmp_path / "points.qqq")
    with pytest.raises(InputError, match="'qqq'"):
        survey().write(tmp_path / "points.csv", format="qqq")
    with pytest.raises(FormatError, match="folder"):
        survey().write(tmp_path / "none" / "points.csv")
