"""Every written file opens in a reader that is not ours, which finds the same curves there.

GDAL (through pyogrio), shapely, ezdxf with its audit, NumPy, pandas, pyarrow, networkx, svgelements
and resvg read: how many rings, lines and isolated points there are, which are closed, in which
direction they run, where they start, and what lies beside them.
"""

from __future__ import annotations

import io
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import ezdxf
import numpy as np
import pandas
import pyarrow.feather
import pyarrow.parquet
import pyogrio
import pytest
import resvg_py
import shapely
import svgelements  # type: ignore[import-untyped]
from ezdxf import path as dxf_path
from PIL import Image

import crustline as cl
from crustline.errors import FormatWarning


def circle(n: int, radius: float) -> np.ndarray:
    t = np.linspace(0, 2 * np.pi, n, endpoint=False)
    return np.c_[np.cos(t), np.sin(t)] * radius


@pytest.fixture(scope="module")
def curves() -> cl.Curves:
    """A ring with a hole, a line and an isolated point, shuffled, with heights, columns, a CRS."""
    line = np.c_[np.linspace(5, 7, 9), np.zeros(9)]
    xy = np.concatenate([circle(24, 3), circle(16, 1), line, [[40, 40]]])
    kind = np.repeat(np.array(["ring", "hole", "line", "dot"], dtype=object), [24, 16, 9, 1])
    order = np.random.default_rng(5).permutation(len(xy))
    points = cl.Points(
        xy[order],
        z=np.arange(50.0)[order],
        columns={"kind": kind[order], "n": np.arange(50)[order]},
        crs="EPSG:4326",
    )
    return cl.reconstruct(points, method=cl.crust)


@dataclass
class Found:
    """What a reader finds in a file."""

    rings: list[np.ndarray] = field(default_factory=list)
    lines: list[np.ndarray] = field(default_factory=list)
    isolated: int = 0
    names: set[str] = field(default_factory=set)
    crs: int | None = None
    heights: bool = True

    def add(self, geometries: Iterable[Any]) -> None:
        """Add lines, rings of polygons, and points of shapely."""
        for each in geometries:
            if each.geom_type.startswith("Multi") or each.geom_type == "GeometryCollection":
                self.add(each.geoms)
            elif each.geom_type == "Point":
                self.isolated += 1
            elif each.geom_type == "Polygon":
                self.rings += [np.array(ring.coords) for ring in (each.exterior, *each.interiors)]
            elif each.is_closed:
                self.rings.append(np.array(each.coords))
            else:
                self.lines.append(np.array(each.coords))


def by_gdal(path: Path) -> Found:
    found = Found()
    files = sorted(path.parent.glob(f"*{path.suffix}"))
    for file in files:
        for layer, _ in pyogrio.list_layers(file):
            if path.suffix == ".gpx" and not pyogrio.read_info(file, layer=layer)["features"]:
                continue
            if layer in ("track_points", "route_points"):
                continue
            frame = pyogrio.read_dataframe(file, layer=layer)
            found.add(frame.geometry)
            found.names |= set(frame.columns)
            found.crs = frame.crs.to_epsg()
            found.heights &= bool(frame.geometry.has_z.all())
    return found


def by_shapely(path: Path) -> Found:
    found = Found()
    for line in path.read_text().splitlines():
        found.add([shapely.from_wkt(line.partition(";")[2])])
        found.crs = int(line.partition(";")[0].removeprefix("SRID="))
    return found


def by_pyarrow(path: Path) -> Found:
    table = pyarrow.parquet.read_table(path)
    found = Found(names=set(table.column_names), crs=4326)
    found.add(shapely.from_wkb(table["geometry"].to_numpy()))
    assert b'"code": 4326' in table.schema.metadata[b"geo"]
    return found


def by_ezdxf(path: Path) -> Found:
    drawing = ezdxf.readfile(path)
    assert not drawing.audit().errors
    assert not drawing.audit().fixes
    found = Found()
    for entity in drawing.modelspace():
        if entity.dxftype() == "POINT":
            found.isolated += 1
            continue
        vertices = np.array([tuple(each) for each in dxf_path.make_path(entity).control_vertices()])
        assert entity.dxf.layer == {True: "OPEN"}.get(not entity.is_closed, entity.dxf.layer)
        (found.rings if entity.is_closed else found.lines).append(vertices)
    return found


def by_numpy(path: Path) -> Found:
    found = Found()
    with np.load(path) as archive:
        rows = np.split(archive["indices"], archive["offsets"][1:-1])
        for run, closed in zip(rows, archive["closed"], strict=True):
            (found.rings if closed else found.lines).append(archive["points"][run])
        found.isolated = len(archive["isolated"])
        found.names = {name.partition("/")[2] for name in archive}
    return found


def by_pandas(path: Path) -> Found:
    frame = pandas.read_csv(path, sep=None, engine="python")
    found = Found(names=set(frame.columns))
    for number, run in frame.groupby("curve"):
        rows = run.sort_values("order")[["x", "y"]].to_numpy()
        if number == -1:
            found.isolated = len(rows)
        else:
            (found.rings if run["closed"].all() else found.lines).append(rows)
    return found


def by_svgelements(path: Path) -> Found:
    """Read the outlines as drawn; y runs down on the screen, so that it is turned here."""
    found = Found()
    width, height = Image.open(
        io.BytesIO(bytes(resvg_py.svg_to_bytes(path.read_text(), dpi=96)))
    ).size
    assert min(width, height) > 0
    for element in svgelements.SVG.parse(str(path)).elements():
        if not isinstance(element, svgelements.Path):
            continue
        for part in element.as_subpaths():
            outline = svgelements.Path(part)
            closed = isinstance(outline[-1], svgelements.Close)
            ends = [each.end for each in outline if not isinstance(each, svgelements.Close)]
            if len(set(ends)) == 1:
                found.isolated += 1
                continue
            vertices = np.array([(end.x, -end.y) for end in ends])
            (found.rings if closed else found.lines).append(vertices)
    return found


READERS: dict[str, Callable[[Path], Found]] = {
    "gpkg": by_gdal, "shp": by_gdal, "fgb": by_gdal, "kml": by_gdal, "gpx": by_gdal,
    "geojson": by_gdal, "wkt": by_shapely, "parquet": by_pyarrow, "dxf": by_ezdxf,
    "npz": by_numpy, "csv": by_pandas, "tsv": by_pandas, "svg": by_svgelements,
}  # fmt: skip
POLYGONS = ["gpkg", "fgb", "kml", "geojson", "wkt", "parquet", "svg"]
#: Which files keep what lies beside the points of curves.
HEIGHTS = {"gpkg", "shp", "fgb", "kml", "gpx", "geojson", "wkt", "parquet"}
NAMES = {"gpkg", "shp", "fgb", "kml", "gpx", "geojson", "parquet", "npz", "csv", "tsv"}


def area(ring: np.ndarray) -> float:
    x, y = ring[:, 0], ring[:, 1]
    return float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y)) / 2


def signs(rings: list[np.ndarray]) -> tuple[float, float]:
    """The directions of the outer ring and of the hole."""
    hole, shell = sorted((area(ring) for ring in rings), key=abs)
    return np.sign(shell), np.sign(hole)


RULES = {None: (1, 1), "ccw": (1, 1), "cw": (-1, -1), "rfc7946": (1, -1), "gis": (-1, 1)}


@pytest.mark.parametrize("suffix", READERS)
@pytest.mark.parametrize("rule", RULES)
def test_curves_are_found_as_they_were(
    tmp_path: Path, suffix: str, rule: str | None, curves: cl.Curves
) -> None:
    path = tmp_path / f"curves.{suffix}"
    cl.write(curves.oriented(rule, start="south"), path)
    found = READERS[suffix](path)
    assert (len(found.rings), len(found.lines), found.isolated) == (2, 1, 1)
    expected = RULES["rfc7946"] if suffix == "dxf" and rule is None else RULES[rule]
    assert signs(found.rings) == expected
    for ring, count, radius in zip(sorted(found.rings, key=area), (16, 24), (1, 3), strict=False):
        if rule is None and suffix != "svg":
            np.testing.assert_allclose(ring[0, :2], (0, -radius), atol=1e-12)
            again = np.unique(np.round(ring[:, :2], 9), axis=0)
            assert len(again) == count
    if suffix in HEIGHTS - {"gpx"}:
        assert found.heights
    if suffix == "gpx":  # where GDAL takes heights for a column
        assert "ele" in found.names
    if suffix in NAMES:
        assert any("kind" in name for name in found.names)
    assert found.crs in (4326, None)


@pytest.mark.parametrize("suffix", POLYGONS)
@pytest.mark.parametrize("rule", RULES)
def test_polygons_are_found_as_they_were(
    tmp_path: Path, suffix: str, rule: str | None, curves: cl.Curves
) -> None:
    path = tmp_path / f"curves.{suffix}"
    cl.write(curves.oriented(rule), path, polygons=True)
    found = READERS[suffix](path)
    assert (len(found.rings), len(found.lines), found.isolated) == (2, 1, 1)
    assert signs(found.rings) == RULES[rule or "rfc7946"]


def test_shapefiles_of_polygons_have_a_direction_of_their_own(
    tmp_path: Path, curves: cl.Curves
) -> None:
    path = tmp_path / "curves.shp"
    with pytest.warns(FormatWarning, match="clockwise around the outside"):
        cl.write(curves.oriented("ccw"), path, polygons=True)
    assert signs(by_gdal(path).rings) == RULES["gis"]


@pytest.mark.parametrize(
    ("unit", "width", "pixels"),
    [("mm", 25.4, 96), ("cm", 2.54, 96), ("in", 3, 288), ("m", 0.0254, 96)],
)
def test_drawings_have_their_size(tmp_path: Path, unit: str, width: float, pixels: int) -> None:
    """At 96 pixels an inch, which is what a renderer takes an inch for."""
    path = tmp_path / "square.svg"
    side = width / 1.06  # the margin is 3 % on each side
    cl.write(cl.reconstruct([(0, 0), (side, 0), (side, side), (0, side)]), path, unit=unit)
    image = Image.open(io.BytesIO(bytes(resvg_py.svg_to_bytes(path.read_text(), dpi=96))))
    assert image.size == (pixels, pixels)


def test_graphs_hold_the_same_edges(curves: cl.Curves) -> None:
    import networkx

    graph = curves.to_networkx()
    parts = sorted(map(len, networkx.connected_components(graph)))
    assert parts == [1, 9, 16, 24]
    assert len(networkx.cycle_basis(graph)) == 2


def test_polygons_may_have_holes_of_different_sizes() -> None:
    """New Zealand has four lakes; polygons with two unlike holes were a traceback."""
    lakes = [circle(n, 1) + center for n, center in ((16, (-5, 0)), (18, (0, 0)), (20, (5, 0)))]
    curves = cl.reconstruct(np.concatenate([circle(80, 12), *lakes]), method=cl.crust)
    (polygon,) = curves.to_shapely(polygons=True)
    assert polygon.is_valid
    assert sorted(len(each.coords) - 1 for each in polygon.interiors) == [16, 18, 20]
