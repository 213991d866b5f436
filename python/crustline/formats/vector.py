"""GIS vector files by GDAL, through pyogrio: GeoPackage, Shapefile, FlatGeobuf, KML and GPX.

The vertices of every geometry are read, with a row's columns at each of them. Points are written a
row each; curves as lines or polygons, one row each, with what is said of a curve in columns.
"""

from __future__ import annotations

import warnings
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from crustline.curves import Curves
from crustline.errors import CrustlineError, FormatError, FormatWarning, InputError
from crustline.formats.arrow import as_table, as_wkb, column_of, points_of_wkb
from crustline.formats.attributes import attributes_of_points
from crustline.formats.features import curve_columns
from crustline.formats.format import Format, Layer
from crustline.formats.geometries import from_wkb, geometries_of, vertices_of
from crustline.formats.gpx import as_extensions
from crustline.formats.names import apart, quote_all
from crustline.formats.options import LAYER, POLYGONS, WHERE
from crustline.formats.source import Source
from crustline.formats.target import Target
from crustline.points import Points, own_points
from crustline.projection import to_longitude_latitude

_NEEDS = ("pyogrio", "pyarrow", "shapely")
_GEOMETRY = "geometry"
# What stands before the names of columns that GPX does not have.
_EXTENSION = "ogr_"


@dataclass(frozen=True)
class _Part:
    """What becomes one layer: its name, the type of its geometries, and an Arrow table."""

    name: str
    kind: str
    table: Any


@dataclass(frozen=True)
class _Driver:
    """A driver of GDAL, and what its files can hold.

    Attributes
    ----------
    name : str
        GDAL's name for it.
    suffix : str
        The end of its files' names.
    several : {"layers", "files"}
        Where geometries of other types go: into layers or into files of their own.
    roles : mapping of str to str
        The names of layers that the format itself fixes, by the type of their geometries.
    standard : mapping of str to object
        Columns that GDAL adds; left out when they hold nothing but this, or nothing at all.
    settings, layer_settings : mapping of str to str
        Settings for creating a file, and a layer.
    fixed : bool
        Whether the format has columns of its own, which are not made anew: only GDAL's slower way
        of writing fills them.
    renamed : mapping of str to str
        Columns that it calls otherwise, by its names for them.
    height : str
        The column that holds the heights of points.
    longest : int
        Bytes of the longest text that there is room for; 0 if there is no such bound.
    lonlat : bool
        Whether it knows longitude and latitude on WGS 84 only.
    narrow : bool
        Whether its whole numbers have 32 bits; columns with larger ones are written as text.
    clockwise : bool
        Whether the outsides of its polygons run clockwise, however they are given.
    """

    name: str
    suffix: str
    several: str
    roles: Mapping[str, str]
    standard: Mapping[str, Any]
    settings: Mapping[str, str]
    fixed: bool = False
    renamed: Mapping[str, str] = field(default_factory=dict)
    layer_settings: Mapping[str, str] = field(default_factory=dict)
    height: str = ""
    longest: int = 0
    lonlat: bool = False
    narrow: bool = False
    clockwise: bool = False

    # Reading

    def read(self, source: Source, *, layer: str | None = None, where: str | None = None) -> Points:
        """Return the vertices of a layer."""
        with source.path(self.suffix) as path:
            table, crs = self._table(source, path, layer, where)
        wkb = table.column(_GEOMETRY)
        columns = self._columns(table)
        found = points_of_wkb(wkb)
        with source.named(), source.library("GDAL"):
            if found is None:
                return vertices_of(from_wkb(wkb)).points(columns, crs)
            heights = columns.pop(self.height, None) if self.height else None
            xy, z = found
            return own_points(xy, z=heights if z is None else z, columns=columns, crs=crs)

    def read_curves(
        self, source: Source, *, layer: str | None = None, where: str | None = None
    ) -> Curves:
        """Return the lines and rings of a layer."""
        with source.path(self.suffix) as path:
            table, crs = self._table(source, path, layer, where, lines=True)
        with source.named(), source.library("GDAL"):
            found = vertices_of(from_wkb(table.column(_GEOMETRY)))
            return found.curves(found.points(self._columns(table), crs))

    def layers(self, source: Source) -> list[Layer]:
        """Return the layers that hold geometries."""
        with source.path(self.suffix) as path, source.library("GDAL"), _quiet():
            return _layers(path)

    def _table(
        self, source: Source, path: Path, layer: str | None, where: str | None, lines: bool = False
    ) -> tuple[Any, str | None]:
        import pyogrio

        with source.library("GDAL"), _quiet():
            chosen = self._choose(source, path, layer, lines)
            try:
                about, table = pyogrio.read_arrow(path, layer=chosen, where=where, encoding=None)
            except Exception as error:
                if where is None:
                    raise
                reason = str(error).split("\n")[0][:120]
                raise InputError(f"where (--where) is {where!r:.60}: {reason}") from None
        name = about["geometry_name"] or "wkb_geometry"
        names = [_GEOMETRY if each == name else each for each in table.column_names]
        return table.rename_columns(names), about["crs"]

    def _choose(self, source: Source, path: Path, wanted: str | None, lines: bool) -> str:
        names = list(_kinds(path))
        if wanted is not None:
            if wanted in names:
                return wanted
            raise source.error(f"there is no layer {wanted!r:.60}: choose from {quote_all(names)}")
        full = names
        if len(names) > 1:  # counting takes time
            full = [each.name for each in _layers(path) if each.count != 0]
        # GPX says the same twice: the points of tracks and routes are points of their own, too.
        twice = {each: f"{each[:-1]}_points" for each in full if f"{each[:-1]}_points" in full}
        full = [each for each in full if each not in (twice.values() if lines else twice)]
        if not full:
            raise source.error("no layer holds geometries: give a file with points or lines")
        if len(full) > 1:
            raise source.error(f"it has the layers {quote_all(full)}: choose one (--layer NAME)")
        source.note("layer", full[0])
        return full[0]

    def _columns(self, table: Any) -> dict[str, npt.NDArray[Any]]:
        columns = {}
        for name in table.column_names:
            array = table.column(name)
            if name == _GEOMETRY:
                continue
            if self.standard and array.null_count == len(array) and len(array):
                continue  # a column of the format that nobody filled
            values = column_of(array.combine_chunks())
            if name in self.standard and (values == self.standard[name]).all():
                continue
            if name == "id" and self.name == "LIBKML":
                continue  # GDAL's number of the row, with the layer before it
            name = name.removeprefix(_EXTENSION)
            columns[self.renamed.get(name, name)] = values
        return columns

    # Writing

    def write_points(self, points: Points, target: Target) -> None:
        """Write a row a point."""
        points = self._ready(points)
        if self.height:
            own = {k: v for k, v in points.columns.items() if k != self.height}
            if len(own) < len(points.columns):
                own[f"input_{self.height}"] = points.columns[self.height]
            heights = {} if points.z is None else {self.height: points.z}
            points = points.replace(columns={**heights, **own})
        self._write([_points_part(points, target)], points.crs, target)

    def write_curves(self, curves: Curves, target: Target, *, polygons: bool = False) -> None:
        """Write a row a curve, and the isolated points."""
        if self.clockwise and polygons and curves.orient not in (None, "gis"):
            warnings.warn(
                f"{target.name}: polygons of this format run clockwise around the outside, not as "
                f"orient={curves.orient!r} says: write lines, or a GeoPackage",
                FormatWarning,
                stacklevel=2,
            )
        ready = replace(curves, points=self._ready(curves.points))
        self._write(list(_parts(ready, polygons, _stem(target))), ready.points.crs, target)

    def write_lines(self, curves: Curves, target: Target) -> None:
        """Write a line a curve, and the isolated points, in formats without polygons."""
        self.write_curves(curves, target)

    def write_layers(
        self, things: Mapping[str, Points | Curves], target: Target, *, polygons: bool = False
    ) -> None:
        """Write each thing as a layer of its name, or as some if it has several types."""
        parts: list[_Part] = []
        crs = None
        for name, thing in things.items():
            points = thing if isinstance(thing, Points) else thing.points
            crs = crs or points.crs
            if isinstance(thing, Points):
                parts.append(_Part(name, _with_z("Point", thing), _table_of_points(thing)))
            else:
                parts.extend(_parts(thing, polygons, name))
        self._write(parts, crs, target)

    def _ready(self, points: Points) -> Points:
        if not self.lonlat:
            return points
        if points.crs is not None:
            points = to_longitude_latitude(points)
        beyond = np.flatnonzero((np.abs(points.xy) > (180, 90)).any(axis=1))
        if len(beyond):
            raise InputError(
                f"points: row {beyond[0]}, {points.xy[beyond[0]].tolist()}, is no longitude and "
                "latitude in degrees: say what it is by a CRS, or project it"
            )
        return points

    def _write(self, parts: Sequence[_Part], crs: str | None, target: Target) -> None:
        import pyogrio

        crs = "EPSG:4326" if self.lonlat else crs
        parts = [part for part in parts if part.table.num_rows] or parts[:1]
        with target.path(self.suffix) as path, _named(target):
            for number, part in enumerate(parts):
                more = number > 0 and self.several == "layers"
                options: dict[str, Any] = {
                    "layer": self.roles.get(part.kind.removesuffix(" Z"), part.name),
                    "driver": self.name,
                    "geometry_type": part.kind,
                    "crs": crs,
                    "encoding": "UTF-8" if self.longest else None,
                    "append": more,
                    "dataset_options": None if more else dict(self.settings),
                    "layer_options": dict(self.layer_settings),
                }
                table = self._fitted(part.table, target)
                place = self._place(path, part, number)
                if self.fixed:
                    _write_rows(table, place, options)
                else:
                    pyogrio.write_arrow(table, place, geometry_name=_GEOMETRY, **options)

    def _fitted(self, table: Any, target: Target) -> Any:
        """Return a table with names, widths of whole numbers, and texts that the format takes."""
        import pyarrow as pa

        table = as_extensions(table, self.height) if self.fixed else table
        table = table.rename_columns(apart(table.column_names))
        for k, column in enumerate(table.columns):
            kind = column.type
            if pa.types.is_duration(kind) or pa.types.is_timestamp(kind) or kind == pa.uint64():
                made = _in_words(column_of(column.combine_chunks()))
                table = table.set_column(k, table.column_names[k], pa.array(made))
        if self.longest:
            table = self._without_long_texts(table, target)
        if self.narrow:
            for k, column in enumerate(table.columns):
                if pa.types.is_integer(column.type):
                    alike = pa.compute.equal(column, column.cast(pa.int32(), safe=False))
                    kind = pa.int32() if pa.compute.all(alike).as_py() else pa.string()
                    table = table.set_column(k, table.column_names[k], column.cast(kind))
        return table

    def _without_long_texts(self, table: Any, target: Target) -> Any:
        import pyarrow as pa

        texts = [each.name for each in table.schema if pa.types.is_string(each.type)]
        long = [
            name
            for name in texts
            if (pa.compute.max(pa.compute.binary_length(table[name])).as_py() or 0) > self.longest
        ]
        if long:
            warnings.warn(
                f"texts of more than {self.longest} bytes have no room, so {quote_all(long)} "
                "is left out: write a GeoPackage to keep it",
                FormatWarning,
                stacklevel=2,
            )
        return table.drop_columns(long)

    def _place(self, path: Path, part: _Part, number: int) -> Path:
        return (
            path.with_name(f"{part.name}{path.suffix}")
            if self.several == "files" and number
            else path
        )


def _kinds(path: Path) -> dict[str, str]:
    """Return the layers that hold geometries, and of which type these are."""
    import pyogrio

    return {name: kind for name, kind in pyogrio.list_layers(path).tolist() if kind}


def _layers(path: Path) -> list[Layer]:
    import pyogrio

    return [
        Layer(name, kind, pyogrio.read_info(path, layer=name, force_feature_count=True)["features"])
        for name, kind in _kinds(path).items()
    ]


def _in_words(values: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """Return whole numbers of 63 bits and times of four-digit years, and all else as text.

    GDAL knows no durations, rounds larger numbers, and takes other years for 1970.
    """
    if values.dtype.kind == "u" and int(values.max(initial=0)) < 2**63:
        return values.astype(np.int64)
    if values.dtype.kind == "M":
        known = values[~np.isnat(values)]
        if ((known >= np.datetime64("0001")) & (known < np.datetime64("10000"))).all():
            return values
    return np.array([str(value) for value in values])


def _write_rows(table: Any, path: Path, options: dict[str, Any]) -> None:
    import pyogrio.raw

    columns = {name: table.column(name) for name in table.column_names}
    geometry = columns.pop(_GEOMETRY).to_numpy()
    values = [column_of(each.combine_chunks()) for each in columns.values()]
    pyogrio.raw.write(path, geometry, values, np.array(list(columns), dtype=object), **options)


def _stem(target: Target) -> str:
    return Path(target.name).stem if target.suffix else "crustline"


def _points_part(points: Points, target: Target) -> _Part:
    return _Part(_stem(target), _with_z("Point", points), _table_of_points(points))


def _with_z(kind: str, points: Points) -> str:
    return kind if points.z is None else f"{kind} Z"


def _table_of_points(points: Points) -> Any:
    columns = attributes_of_points(points, reserved=(_GEOMETRY, "fid")).columns
    return as_table({**columns, _GEOMETRY: as_wkb(points.xy, points.z)})


def _parts(curves: Curves, polygons: bool, name: str) -> Iterator[_Part]:
    """Yield the polygons, the lines and the isolated points, as far as there are any."""
    import pyarrow as pa
    import shapely

    features = list(curves.features(polygons=polygons))
    made = geometries_of(curves, features)
    table = as_table(
        {
            **curve_columns(curves, features),
            _GEOMETRY: pa.array(list(shapely.to_wkb(made)), pa.binary()),
        }
    )
    are = shapely.get_type_id(made)
    for code, suffix in ((3, ""), (1, "_lines" if (are == 3).any() else "")):
        chosen = np.flatnonzero(are == code)
        if len(chosen):
            kind = _with_z("Polygon" if code == 3 else "LineString", curves.points)
            yield _Part(f"{name}{suffix}", kind, table.take(chosen))
    if len(curves.isolated) or not len(made):
        alone = curves.points.select(curves.isolated)
        yield _Part(f"{name}_isolated", _with_z("Point", alone), _table_of_points(alone))


@contextmanager
def _quiet() -> Iterator[None]:
    """Keep GDAL's remarks about what it could read from becoming warnings."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", RuntimeWarning)
        yield


@contextmanager
def _named(target: Target) -> Iterator[None]:
    """Name the target in what GDAL raises, and say what it warns of in a sentence."""
    with warnings.catch_warnings(record=True) as remarks:
        warnings.simplefilter("always")
        warnings.filterwarnings("ignore", "'crs' was not provided")
        try:
            yield
        except (CrustlineError, MemoryError, OSError):
            raise
        except Exception as error:
            reason = str(error).split("\n")[0][:160]
            raise FormatError(f"{target.name} cannot be written by GDAL: {reason}") from None
    for remark in {str(each.message).split("\n")[0][:160] for each in remarks}:
        warnings.warn(f"{target.name}: {remark}", FormatWarning, stacklevel=2)


def _format(
    name: str, title: str, magic: bytes, driver: _Driver, *,
    layered: bool = False, polygons: bool = True,
) -> Format:  # fmt: skip
    return Format(
        name=name,
        title=title,
        suffixes=(driver.suffix,),
        sniff=(lambda head: magic in head) if magic else None,
        read=driver.read,
        read_curves=driver.read_curves,
        layers=driver.layers,
        write_points=driver.write_points,
        write_curves=driver.write_curves if polygons else driver.write_lines,
        write_layers=driver.write_layers if layered else None,
        options=(LAYER, WHERE, POLYGONS) if polygons else (LAYER, WHERE),
        extra="gis",
        needs=_NEEDS,
    )


_KML = dict.fromkeys(("Name", "description", "icon", "altitudeMode"), "") | {
    "tessellate": -1, "extrude": 0, "visibility": -1,
}  # fmt: skip
_TRACKS = {"track_fid": 0, "track_seg_id": 0, "route_fid": 0, "track_seg_point_id": 0}
GPKG = _format(
    "gpkg", "GeoPackage", b"SQLite format 3\0",
    _Driver("GPKG", ".gpkg", "layers", {}, {}, {}), layered=True,
)  # fmt: skip
SHP = _format(
    "shp", "Shapefile", b"\x00\x00\x27\x0a",
    _Driver("ESRI Shapefile", ".shp", "files", {}, {}, {}, longest=254, clockwise=True),
)  # fmt: skip
FGB = _format(
    "fgb", "FlatGeobuf", b"fgb\x03fgb",
    _Driver("FlatGeobuf", ".fgb", "files", {}, {}, {}, layer_settings={"SPATIAL_INDEX": "NO"}),
)  # fmt: skip
KML = _format(
    "kml", "KML", b"<kml",
    _Driver("LIBKML", ".kml", "layers", {}, _KML, {}, renamed={"Name": "name"}, lonlat=True,
            narrow=True),
    layered=True,
)  # fmt: skip
GPX = _format(
    "gpx", "GPX", b"<gpx",
    _Driver("GPX", ".gpx", "files", {"Point": "waypoints", "LineString": "routes"}, _TRACKS,
            {"GPX_USE_EXTENSIONS": "YES"}, fixed=True, height="ele", lonlat=True, narrow=True),
    polygons=False,
)  # fmt: skip
