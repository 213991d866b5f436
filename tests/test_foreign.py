"""Files that other programs wrote: each gives the points, heights and closedness that it holds.

They lie in `tests/foreign`, a folder for each format: written by other libraries (`make.py` there
says how), or typed as a program writes them, after its public specification. A name says who wrote
the file and what is in it: three points, in a line or a ring, in space or not; a cube; a circle.
"""

from __future__ import annotations

import warnings
from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import crustline as cl
import test_formats_clouds
import test_formats_dialects
import test_formats_foreign
import test_formats_image
import test_slices_foreign
from crustline.formats import FORMATS, read_curves
from fuzz import clouds
from test_slices import polygons_of

FOLDER = Path(__file__).parent / "foreign"
XYZ = [[1.5, 2.5, 7], [3.5, 4.5, 8], [5.5, 2.5, 9]]
#: Where columns beside x and y have to be chosen, as their sentence says.
CHOSEN: dict[str, dict[str, Any]] = {"csv/leica-points-3d.csv": {"encoding": "latin-1"}}
#: The other parts of a Shapefile, and what makes the files.
BESIDE = {".dbf", ".shx", ".prj", ".cpg", ".py", ".pyc"}
FILES = sorted(path for path in FOLDER.glob("*/*") if path.suffix not in BESIDE)
NAMES = [f"{path.parent.name}/{path.name}" for path in FILES]


def having(word: str, *but: str) -> Any:
    """The files whose names have a word."""
    chosen = [
        name for name in NAMES if word in name.split("/")[1] and name.split("/")[0] not in but
    ]
    return pytest.mark.parametrize("name", chosen)


def read(name: str, reader: Any = cl.read) -> Any:
    return read_with(reader, FOLDER / name, **CHOSEN.get(name, {}))


def read_with(reader: Any, *given: Any, **options: Any) -> Any:
    """Read, whatever is doubtful about a file."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return reader(*given, **options)


@pytest.mark.parametrize("name", [each for each in NAMES if any(
    word in each for word in ("-points", "-line", "-ring", "-loose"))])  # fmt: skip
def test_points_are_read(name: str) -> None:
    points = read(name)
    found = sorted({tuple(row) for row in points.xy.round(9).tolist()})
    np.testing.assert_allclose(found, [row[:2] for row in XYZ], atol=1e-6)
    if "-3d" in name:
        heights = dict(zip(points.xy[:, 0].round(6).tolist(), points.z, strict=True))
        np.testing.assert_allclose([heights[x] for x, _, _ in XYZ], [7, 8, 9], atol=1e-6)
    if "-loose" not in name:
        assert len(points) == 3


@having("-line")
def test_lines_are_open(name: str) -> None:
    if "-lines" in name:
        pytest.skip("of text, not of a curve")
    curves = read(name, read_curves)
    assert curves.closed.tolist() == [False]
    assert curves.points.xy[curves.indices][:, 0].tolist() in ([1.5, 3.5, 5.5], [5.5, 3.5, 1.5])


@having("-ring")
def test_rings_are_closed(name: str) -> None:
    curves = read(name, read_curves)
    assert curves.closed.tolist() == [True]
    assert len(curves.indices) == 3


@having("-loose")
def test_loose_lines_are_one_ring(name: str) -> None:
    assert cl.reconstruct(read(name)).closed.tolist() == [True]


@having("-cube")
def test_slices_of_a_cube_are_squares(name: str) -> None:
    (found,) = read(name, lambda path: cl.slices(path, "z=0.25"))
    assert found.curves.closed.tolist() == [True]
    assert polygons_of(found.curves).area == pytest.approx(1, abs=1e-6)


@having("-circle", "svg")
def test_pictures_of_a_circle(name: str) -> None:
    radii = np.hypot(*(read(name).xy - (32, -32)).T)
    assert len(radii) > 100
    assert np.abs(radii - 20).max() < 0.7


@pytest.mark.parametrize("name", [each for each in NAMES if each.startswith("svg/")])
def test_drawings_of_a_circle(name: str) -> None:
    (loop,) = read(name, cl.shapes.bezier_path).loops
    xy = np.asarray(cl.shapes.bezier_path(FOLDER / name).point(np.linspace(0, 1, 64, False)))
    radii = np.hypot(*(xy - (5, 5)).T)
    assert np.abs(radii - 3).max() < 0.01
    assert loop is not None


#: Octrees put together by hand: no package that could be had writes COPC.
COPC: dict[str, dict[str, Any]] = {
    "format 6": {}, "format 7": {"kind": 7}, "format 8": {"kind": 8},
    "steps of a centimeter": {"step": 0.01}, "an origin far away": {"shift": -5e5},
    "a root without points": {"root": 0}, "pages of pages": {"pages": 2},
    "pages of pages of colors": {"kind": 7, "pages": 2},
    "chunks backwards": {"order": -1}, "a root alone": {"root": 200},
    "a CRS": {"record": b'LOCAL_CS["here"]\0'}, "bytes beside": {"extra": 3},
}  # fmt: skip


@pytest.mark.parametrize("name", COPC)
def test_octrees_are_read(name: str) -> None:
    content = clouds.copc(**COPC[name])
    points = read_with(cl.read, content, format="laz")
    expected, step = clouds.places(), COPC[name].get("step", 0.001)
    found = np.column_stack([points.xy, points.z])
    for column in range(3):
        ours, theirs = (np.sort(each[:, column]) for each in (found, expected))
        np.testing.assert_allclose(ours, theirs, atol=step / 2 + 1e-9)
    (part,) = read_with(cl.slices, content, "z=6", thickness=1, fit=False, format="laz")
    assert part.count == (np.abs(expected[:, 2].round(6) - 6) <= 0.5).sum()


def counted() -> Counter[str]:
    """How many foreign files of each format are read by tests to the content expected."""
    made = Counter(path.parent.name for path in FILES)
    made["copc"] = len(COPC)
    other = test_formats_foreign
    tables: dict[str, dict[str, Any]] = {
        "gpx": other.GPX, "kml": other.KMLS, "parquet": other.PARQUET,
        "dxf": dict(other.DXF), "excel": dict(other.EXCEL),
    }  # fmt: skip
    for key, cases in tables.items():
        made[key] += sum(each[1] == other.XY for each in cases.values())
    for key in ("shp", "gpkg", "fgb"):
        made[key] += len(other.KINDS)
    for key, _, _ in test_slices_foreign.FILES:
        made[key] += 1
    for key, _ in test_formats_clouds.FOREIGN.values():
        made[key] += 1
    made["las"] += 6 * 4  # test_headers_of_other_tools
    made["csv"] += len(test_formats_dialects.UNDERSTOOD)
    made["image"] += len(test_formats_image.FOREIGN)
    return made


def test_ten_files_of_each_format() -> None:
    made = counted()
    keys = [*(key for key, each in FORMATS.items() if each.can("read") or each.can("mesh"))]
    assert {key: made[key] for key in [*keys, "svg", "copc"] if made[key] < 10} == {}


if __name__ == "__main__":
    for each, number in sorted(counted().items()):
        print(f"{each:8} {number}")
