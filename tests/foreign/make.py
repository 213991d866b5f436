"""Write the files here that other libraries write; those typed by hand stay as they are.

    pip install simplekml gpxpy pyshp fiona xlsxwriter xlwt odfpy fastparquet meshio plyfile
    python tests/foreign/make.py

Run by hand, seldom: the files are what is tested, and none of these packages is needed for that.
"""

from __future__ import annotations

import io
import json
import warnings
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pandas
import polars
import pyarrow as pa
import shapely

FOLDER = Path(__file__).parent
XY = [(1.5, 2.5), (3.5, 4.5), (5.5, 2.5)]
XYZ = [(1.5, 2.5, 7.0), (3.5, 4.5, 8.0), (5.5, 2.5, 9.0)]
TABLE: dict[str, list[float]] = {"x": [1.5, 3.5, 5.5], "y": [2.5, 4.5, 2.5]}
DEEP: dict[str, list[float]] = {**TABLE, "z": [7.0, 8.0, 9.0]}
GEOMETRIES = {
    "points": shapely.points(XY),
    "line": np.array([shapely.linestrings(XY)]),
    "ring": np.array([shapely.polygons([*XY, XY[0]])]),
    "points-3d": shapely.points(XYZ),
}


def place(key: str, name: str) -> Path:
    """The place of a file of a format."""
    path = FOLDER / key / name
    path.parent.mkdir(exist_ok=True)
    return path


# Frames and text


def text() -> None:
    frame, deep = pandas.DataFrame(TABLE), pandas.DataFrame(DEEP)
    frame.to_csv(place("csv", "pandas-points.csv"))
    frame.to_csv(place("csv", "pandas-points-semicolon.csv"), sep=";", decimal=",", index=False)
    polars.DataFrame(TABLE).write_csv(place("csv", "polars-points.csv"))
    polars.DataFrame(TABLE).write_csv(
        place("csv", "polars-points-quoted.csv"), quote_style="always"
    )
    pa.csv.write_csv(pa.table(TABLE), place("csv", "pyarrow-points.csv"))  # type: ignore[attr-defined]
    np.savetxt(place("csv", "numpy-points.csv"), XY, delimiter=",", header="x,y")
    np.savetxt(place("xyz", "numpy-points-3d.xyz"), XYZ)
    np.savetxt(place("xyz", "numpy-points-3d-fixed.xyz"), XYZ, "%12.3f")
    deep.to_csv(place("xyz", "pandas-points-3d.xyz"), sep=" ", index=False, header=False)
    frame.to_csv(place("tsv", "pandas-points.tsv"), sep="\t", index=False)
    polars.DataFrame(DEEP).write_csv(place("tsv", "polars-points-3d.tsv"), separator="\t")
    np.savetxt(place("tsv", "numpy-points.tsv"), XY, delimiter="\t", header="x\ty", comments="")


def jsons() -> None:
    frame = pandas.DataFrame(TABLE)
    for orient in ("records", "columns", "split", "values", "table"):
        frame.to_json(place("json", f"pandas-points-{orient}.json"), orient=orient)
    frame.to_json(place("json", "pandas-points-lines.json"), orient="records", lines=True)
    frame.to_json(place("json", "pandas-points-indented.json"), orient="records", indent=2)
    polars.DataFrame(TABLE).write_json(place("json", "polars-points.json"))
    polars.DataFrame(DEEP).write_ndjson(place("json", "polars-points-3d-lines.json"))
    for name, thing in {"lists": TABLE, "rows": XY, "rows-3d": XYZ}.items():
        path = place("json", f"json-{'points-3d' if '3d' in name else 'points'}-{name}.json")
        path.write_text(json.dumps(thing, indent=1))


def wkts() -> None:
    for name, made in GEOMETRIES.items():
        lines = "\n".join(shapely.to_wkt(made).tolist())
        place("wkt", f"shapely-{name}.wkt").write_text(lines + "\n")
        legacy = [shapely.to_wkt(each, trim=False, rounding_precision=-1) for each in made]
        place("wkt", f"geos-{name}-untrimmed.wkt").write_text("\n".join(legacy) + "\n")
    old = shapely.to_wkt(GEOMETRIES["points-3d"], old_3d=True).tolist()
    place("wkt", "shapely-points-3d-old.wkt").write_text("\n".join(old))


def arrays() -> None:
    array = np.array(XY)
    np.save(place("npy", "numpy-points.npy"), array)
    np.save(place("npy", "numpy-points-columns-first.npy"), np.asfortranarray(array))
    np.save(place("npy", "numpy-points-big-endian.npy"), array.astype(">f8"))
    np.save(place("npy", "numpy-points-float32.npy"), array.astype("<f4"))
    np.save(place("npy", "numpy-points-float16.npy"), array.astype("<f2"))
    np.save(place("npy", "numpy-points-3d.npy"), np.array(XYZ))
    rows = np.array(XY, object)
    np.save(
        place("npy", "numpy-points-structured.npy"),
        np.array([tuple(row) for row in rows], [("x", "<f8"), ("y", "<f8")]),
    )
    np.save(
        place("npy", "numpy-points-3d-structured.npy"),
        np.array(XYZ, [("name", "<U3"), ("x", "f4"), ("y", "f4"), ("z", "f4")][1:]),
    )
    for version in ((1, 0), (2, 0), (3, 0)):
        with place("npy", f"numpy-points-version-{version[0]}.npy").open("wb") as file:
            np.lib.format.write_array(file, array, version)
    np.savez(place("npz", "numpy-points.npz"), points=array)
    np.savez_compressed(place("npz", "numpy-points-compressed.npz"), points=array)
    np.savez(place("npz", "numpy-points-unnamed.npz"), array)
    np.savez(place("npz", "numpy-points-columns.npz"), **TABLE)
    np.savez(place("npz", "numpy-points-3d-columns.npz"), **DEEP)
    np.savez(place("npz", "numpy-points-3d-one.npz"), xyz=np.array(XYZ))
    np.savez(place("npz", "numpy-points-beside.npz"), **TABLE, label=np.array(list("abc")))
    np.savez(place("npz", "numpy-points-coordinates.npz"), X=TABLE["x"], Y=TABLE["y"])
    np.savez_compressed(place("npz", "numpy-points-lonlat.npz"), lon=TABLE["x"], lat=TABLE["y"])
    for name, how in (("zip64", {"allowZip64": True}), ("lzma", {"compression": zipfile.ZIP_LZMA})):
        with zipfile.ZipFile(place("npz", f"zipfile-points-{name}.npz"), "w", **how) as archive:  # type: ignore[arg-type]
            for key, values in TABLE.items():
                stream = io.BytesIO()
                np.save(stream, np.array(values))
                with archive.open(f"{key}.npy", "w", force_zip64=name == "zip64") as part:
                    part.write(stream.getvalue())


# Geometries


def gdal() -> None:
    import pyogrio

    kinds = {"points": "Point", "line": "LineString", "ring": "Polygon", "points-3d": "Point Z"}
    drivers: dict[str, tuple[str, dict[str, dict[str, str]]]] = {
        "geojson": (
            "GeoJSON",
            {
                "": {},
                "rfc7946": {"RFC7946": "YES"},
                "bbox": {"WRITE_BBOX": "YES"},
                "digits": {"COORDINATE_PRECISION": "3"},
                "ids": {"ID_GENERATE": "YES"},
            },
        ),
        "gpkg": (
            "GPKG",
            {
                "1.0": {"VERSION": "1.0"},
                "1.2": {"VERSION": "1.2"},
                "1.4": {"VERSION": "1.4"},
                "no-index": {"SPATIAL_INDEX": "NO"},
                "the_geom": {"GEOMETRY_NAME": "the_geom"},
            },
        ),
        "fgb": (
            "FlatGeobuf",
            {"index": {"SPATIAL_INDEX": "YES"}, "plain": {"SPATIAL_INDEX": "NO"}},
        ),
        "kml": ("KML", {"": {}}),
        "shp": ("ESRI Shapefile", {"": {}}),
        "csv": (
            "CSV",
            {
                "wkt": {"GEOMETRY": "AS_WKT"},
                "crlf": {"GEOMETRY": "AS_WKT", "LINEFORMAT": "CRLF"},
                "semicolon": {"GEOMETRY": "AS_WKT", "SEPARATOR": "SEMICOLON"},
            },
        ),
    }
    for key, (driver, settings) in drivers.items():
        for variant, options in settings.items():
            shapes = (
                GEOMETRIES if variant in ("", "1.4", "index") else {"points": GEOMETRIES["points"]}
            )
            for shape, made in shapes.items():
                name = "-".join(filter(None, ("gdal", shape, variant)))
                path = place(key, f"{name}.{key}")
                path.unlink(missing_ok=True)
                pyogrio.raw.write(
                    path,
                    shapely.to_wkb(made),
                    [np.arange(len(made))],
                    np.array(["n"], object),
                    driver=driver,
                    geometry_type=kinds[shape],
                    crs="EPSG:4326",
                    **options,
                )
    for shape, made in GEOMETRIES.items():
        path = place("geojson", f"gdal-{shape}-sequence.geojsonl")
        path.unlink(missing_ok=True)
        pyogrio.raw.write(
            path,
            shapely.to_wkb(made),
            [],
            np.array([], object),
            driver="GeoJSONSeq",
            geometry_type=kinds[shape],
            crs="EPSG:4326",
        )
    place("geojson", "shapely-line.geojson").write_text(shapely.to_geojson(GEOMETRIES["line"])[0])
    place("geojson", "shapely-ring-indented.geojson").write_text(
        shapely.to_geojson(GEOMETRIES["ring"], indent=2)[0]
    )


def frames() -> None:
    import geopandas

    frame = geopandas.GeoDataFrame({"n": [0, 1, 2]}, geometry=GEOMETRIES["points"], crs="EPSG:4326")
    place("geojson", "geopandas-points.geojson").write_text(frame.to_json())
    frame.to_parquet(place("parquet", "geopandas-points-1.0.parquet"), schema_version="1.0.0")
    frame.to_parquet(place("parquet", "geopandas-points-bbox.parquet"), write_covering_bbox=True)
    frame.to_parquet(
        place("parquet", "geopandas-points-geoarrow.parquet"),
        geometry_encoding="geoarrow",
        schema_version="1.1.0",
    )
    plain = pandas.DataFrame(DEEP)
    polars.DataFrame(DEEP).write_parquet(place("parquet", "polars-points-3d.parquet"))
    for packing in ("uncompressed", "snappy", "gzip", "lz4", "zstd", "brotli"):
        polars.DataFrame(TABLE).write_parquet(
            place("parquet", f"polars-points-{packing}.parquet"), compression=packing
        )
    plain.to_parquet(place("parquet", "fastparquet-points-3d.parquet"), engine="fastparquet")
    plain.to_parquet(place("parquet", "pandas-points-3d.parquet"), engine="pyarrow")
    plain.to_feather(place("feather", "pandas-points-3d.feather"))
    for version, packing in ((1, None), (2, "lz4"), (2, "zstd"), (2, "uncompressed")):
        pa.feather.write_feather(
            pa.table(TABLE),
            str(place("feather", f"pyarrow-points-{version}-{packing}.feather")),
            compression=packing,
            version=version,
        )
    for packing in ("uncompressed", "lz4", "zstd"):
        polars.DataFrame(TABLE).write_ipc(
            place("feather", f"polars-points-{packing}.arrow"), compression=packing
        )
    tables = {
        "float32": pa.table({k: pa.array(v, pa.float32()) for k, v in TABLE.items()}),
        "dictionary": pa.table({**TABLE, "kind": pa.array(["a", "b", "a"]).dictionary_encode()}),
        "large-text": pa.table({**TABLE, "name": pa.array(["a", "é", None], pa.large_string())}),
        "view": pa.table({**TABLE, "name": pa.array(["a", "b", "c" * 20], pa.string_view())}),
    }
    for name, table in tables.items():
        with pa.ipc.new_file(
            place("feather", f"pyarrow-points-{name}.arrow"), table.schema
        ) as file:
            file.write_table(table, max_chunksize=2)


def shapefiles() -> None:
    import shapefile

    kinds: dict[str, tuple[int, Callable[[Any], None]]] = {
        "points": (shapefile.POINT, lambda file: [file.point(x, y) for x, y in XY]),
        "points-3d": (shapefile.POINTZ, lambda file: [file.pointz(*each) for each in XYZ]),
        "points-measured": (shapefile.POINTM, lambda file: [file.pointm(*each) for each in XYZ]),
        "points-multi": (shapefile.MULTIPOINT, lambda file: file.multipoint(XY)),
        "line": (shapefile.POLYLINE, lambda file: file.line([XY])),
        "line-3d": (shapefile.POLYLINEZ, lambda file: file.linez([[list(each) for each in XYZ]])),
        "ring": (shapefile.POLYGON, lambda file: file.poly([[*XY, XY[0]]])),
    }
    for name, (kind, write) in kinds.items():
        with shapefile.Writer(place("shp", f"pyshp-{name}.shp"), shapeType=kind) as file:
            file.field("name", "C", 20)
            write(file)
            for number in range(file.shpNum):
                file.record(f"é{number}")


def by_fiona() -> None:
    import fiona

    drivers = {
        "gpkg": "GPKG",
        "shp": "ESRI Shapefile",
        "fgb": "FlatGeobuf",
        "geojson": "GeoJSON",
    }
    schema = {"geometry": "LineString", "properties": {"name": "str"}}
    row = {"geometry": shapely.geometry.mapping(GEOMETRIES["line"][0]), "properties": {"name": "é"}}
    for key, driver in drivers.items():
        path = place(key, f"fiona-line.{key}")
        with fiona.open(path, "w", driver=driver, schema=schema, crs="EPSG:4326") as file:
            file.write(row)


def kmls() -> None:
    import simplekml

    writers: dict[str, Callable[[Any], Any]] = {
        "points": lambda kml: [kml.newpoint(name="é", coords=[each]) for each in XY],
        "points-3d": lambda kml: [kml.newpoint(name="é", coords=[each]) for each in XYZ],
        "line": lambda kml: kml.newlinestring(name="a", coords=XY),
        "line-3d": lambda kml: kml.newlinestring(coords=XYZ, altitudemode="absolute"),
        "ring": lambda kml: kml.newpolygon(name="a", outerboundaryis=[*XY, XY[0]]),
    }
    for name, write in writers.items():
        kml = simplekml.Kml()
        write(kml)
        kml.save(str(place("kml", f"simplekml-{name}.kml")))
    kml = simplekml.Kml()
    multi = kml.newmultigeometry(name="a")
    for each in XY:
        multi.newpoint(coords=[each])
    kml.save(str(place("kml", "simplekml-multi-points.kml")))


def gpxs() -> None:
    from gpxpy import gpx

    points = [gpx.GPXTrackPoint(y, x) for x, y in XY]
    deep = [gpx.GPXTrackPoint(y, x, elevation=z) for x, y, z in XYZ]
    for name in ("points", "line", "line-route", "line-3d"):
        made = gpx.GPX()
        if name == "points":
            made.waypoints += [gpx.GPXWaypoint(y, x) for x, y in XY]
        elif name == "line-route":
            made.routes.append(gpx.GPXRoute())
            made.routes[0].points += [gpx.GPXRoutePoint(y, x) for x, y in XY]
        else:
            made.tracks.append(gpx.GPXTrack())
            made.tracks[0].segments.append(gpx.GPXTrackSegment(deep if "3d" in name else points))
        for version in ("1.0", "1.1"):
            place("gpx", f"gpxpy-{name}-{version}.gpx").write_text(made.to_xml(version))


# Workbooks


def books() -> None:
    import odf.opendocument
    import odf.table
    import odf.text
    import xlsxwriter
    import xlwt

    rows = [["x", "y"], *XY]
    for name, how in (
        ("", {}),
        ("-constant-memory", {"constant_memory": True}),
        ("-strings", {"strings_to_numbers": True}),
        ("-1904", {"date_1904": True}),
    ):
        with xlsxwriter.Workbook(place("excel", f"xlsxwriter-points{name}.xlsx"), how) as made:
            sheet = made.add_worksheet("Survey é")
            bold = made.add_format({"bold": True, "num_format": "0.00"})
            for number, row in enumerate(rows):
                texts = how.get("strings_to_numbers")
                sheet.write_row(number, 0, [str(each) for each in row] if texts else row, bold)
    with xlsxwriter.Workbook(place("excel", "xlsxwriter-points-formulas.xlsx")) as made:
        sheet = made.add_worksheet()
        sheet.write_row(0, 0, rows[0])
        for number, (x, y) in enumerate(XY, 1):
            sheet.write_formula(number, 0, f"={x}*1", None, x)
            sheet.write_formula(number, 1, f"={y}*1", None, y)
    with xlsxwriter.Workbook(place("excel", "xlsxwriter-points-3d-table.xlsx")) as made:
        sheet = made.add_worksheet()
        sheet.add_table(0, 0, 3, 2, {"data": XYZ, "columns": [{"header": each} for each in DEEP]})
        sheet.freeze_panes(1, 0)
    for name, encoding in (("", "ascii"), ("-unicode", "utf-8")):
        old = xlwt.Workbook(encoding=encoding)
        sheet = old.add_sheet("Points" if not name else "Pünkte")
        for number, row in enumerate(rows):
            for column, value in enumerate(row):
                sheet.write(number, column, value)
        old.save(str(place("excel", f"xlwt-points{name}.xls")))
    document = odf.opendocument.OpenDocumentSpreadsheet()
    table = odf.table.Table(name="Points")
    for row in rows:
        line = odf.table.TableRow()
        for value in row:
            how = (
                {"valuetype": "string"}
                if isinstance(value, str)
                else {"valuetype": "float", "value": value}
            )
            cell = odf.table.TableCell(**how)
            cell.addElement(odf.text.P(text=str(value)))
            line.addElement(cell)
        table.addElement(line)
    document.spreadsheet.addElement(table)
    document.save(str(place("excel", "odfpy-points.ods")))
    pandas.DataFrame(DEEP).to_excel(
        place("excel", "pandas-points-3d.ods"), engine="odf", index=False
    )
    pandas.DataFrame(DEEP).to_excel(place("excel", "pandas-points-3d.xlsx"), engine="openpyxl")
    polars.DataFrame(TABLE).write_excel(place("excel", "polars-points.xlsx"))


# Clouds and meshes


def clouds() -> None:
    import laspy

    for version, kind in (
        ("1.1", 0),
        ("1.2", 0),
        ("1.2", 1),
        ("1.2", 3),
        ("1.3", 4),
        ("1.4", 6),
        ("1.4", 7),
        ("1.4", 8),
        ("1.4", 10),
    ):
        for packed in (False, True):
            if packed and kind == 4:
                continue
            header = laspy.LasHeader(version=version, point_format=kind)
            header.scales, header.offsets = [0.01, 0.01, 0.001], [0.0, -100.0, 5.0]
            made = laspy.LasData(header)
            made.x, made.y, made.z = np.array(XYZ).T
            key = "laz" if packed else "las"
            made.write(place(key, f"laspy-points-3d-{version}-{kind}.{key}"))
    for backend in (laspy.LazBackend.LazrsParallel, laspy.LazBackend.Laszip):
        if not backend.is_available():
            continue
        for kind in (1, 3, 7):
            made = laspy.LasData(laspy.LasHeader(version="1.4", point_format=kind))
            made.x, made.y, made.z = np.array(XYZ).T
            with place("laz", f"{backend.name.lower()}-points-3d-1.4-{kind}.laz").open(
                "wb"
            ) as file:
                made.write(file, laz_backend=backend)


def scans() -> None:
    import pye57
    from pye57 import libe57

    x, y, z = np.array(XYZ).T
    data = {"cartesianX": x, "cartesianY": y, "cartesianZ": z}
    more: dict[str, dict[str, Any]] = {
        "plain": {},
        "intensity": {"intensity": np.array([0.1, 0.2, 0.3])},
        "colors": {
            f"color{each}": np.array([1, 2, 3], np.uint8) for each in ("Red", "Green", "Blue")
        },
        "valid": {"cartesianInvalidState": np.zeros(3, np.int8)},
        "rows": {"rowIndex": np.arange(3), "columnIndex": np.arange(3)},
    }
    for name, beside in more.items():
        path = place("e57", f"pye57-points-3d-{name}.e57")
        with pye57.E57(str(path), mode="w") as file:
            file.write_scan_raw(data | beside)
    with pye57.E57(str(place("e57", "pye57-points-3d-scans.e57")), mode="w") as file:
        for k in range(3):
            file.write_scan_raw({name: values[k : k + 1] for name, values in data.items()})
    with pye57.E57(str(place("e57", "pye57-points-3d-moved.e57")), mode="w") as file:
        moved = {
            name: values - shift
            for (name, values), shift in zip(data.items(), (1, 2, 3), strict=True)
        }
        file.write_scan_raw(
            moved, rotation=np.array([1.0, 0, 0, 0]), translation=np.array([1.0, 2, 3])
        )
    with pye57.E57(str(place("e57", "pye57-points-3d-turned.e57")), mode="w") as file:
        turned = {"cartesianX": y, "cartesianY": -x, "cartesianZ": z}  # by -90 degrees
        file.write_scan_raw(
            turned, rotation=np.array([np.sqrt(0.5), 0, 0, np.sqrt(0.5)]), translation=np.zeros(3)
        )
    fields = {
        "single": lambda image: libe57.FloatNode(
            image, 0.0, libe57.FloatPrecision.E57_SINGLE, -1e3, 1e3
        ),
        "double": lambda image: libe57.FloatNode(
            image, 0.0, libe57.FloatPrecision.E57_DOUBLE, -1e3, 1e3
        ),
        "scaled": lambda image: libe57.ScaledIntegerNode(image, 0, -(2**20), 2**20, 0.001, 0.0),
        "offset": lambda image: libe57.ScaledIntegerNode(image, 0, -(2**20), 2**20, 0.001, 5.0),
    }
    for name, node in fields.items():
        by_nodes(
            place("e57", f"libe57-points-3d-{name}.e57"), list(data), list(data.values()), node
        )
    level = np.hypot(x, y)
    by_nodes(
        place("e57", "libe57-points-3d-spherical.e57"),
        ["sphericalRange", "sphericalAzimuth", "sphericalElevation"],
        [np.hypot(level, z), np.arctan2(y, x), np.arctan2(z, level)],
        fields["double"],
    )


def by_nodes(path: Path, names: list[str], columns: list[Any], node: Callable[[Any], Any]) -> None:
    """An E57 file by the nodes of libE57Format, as scanners put them together."""
    from pye57 import libe57

    image = libe57.ImageFile(str(path), "w")
    root = image.root()
    image.extensionsAdd("", libe57.E57_V1_0_URI)
    for name, value in (("formatName", "ASTM E57 3D Imaging Data File"), ("guid", "{tests}")):
        root.set(name, libe57.StringNode(image, value))
    root.set("versionMajor", libe57.IntegerNode(image, 1))
    root.set("versionMinor", libe57.IntegerNode(image, 0))
    scans = libe57.VectorNode(image, True)
    root.set("data3D", scans)
    scan = libe57.StructureNode(image)
    scan.set("guid", libe57.StringNode(image, "{scan}"))
    prototype = libe57.StructureNode(image)
    for name in names:
        prototype.set(name, node(image))
    points = libe57.CompressedVectorNode(image, prototype, libe57.VectorNode(image, True))
    scan.set("points", points)
    scans.append(scan)
    buffers = libe57.VectorSourceDestBuffer()
    kept = [np.ascontiguousarray(each, np.float64) for each in columns]
    for name, values in zip(names, kept, strict=True):
        buffers.append(libe57.SourceDestBuffer(image, name, values, len(values), True, True))
    writer = points.writer(buffers)
    writer.write(len(kept[0]))
    writer.close()
    image.close()


def surfaces() -> None:
    import meshio
    import trimesh
    from plyfile import PlyData, PlyElement

    cube = trimesh.creation.box(bounds=[[0, 0, 0], [1, 1, 1]])
    for kind in ("stl", "stl_ascii", "obj", "ply"):
        made = cube.export(file_type=kind)
        path = place(kind[:3], f"trimesh-cube{kind[3:].replace('_', '-')}.{kind[:3]}")
        path.write_bytes(made if isinstance(made, bytes) else made.encode())
    mesh = meshio.Mesh(cube.vertices, [("triangle", cube.faces)])
    for key, binary in (
        ("stl", True),
        ("stl", False),
        ("obj", None),
        ("ply", True),
        ("ply", False),
    ):
        how = {} if binary is None else {"binary": binary}
        name = "meshio-cube" + {True: "-binary", False: "-ascii", None: ""}[binary]
        mesh.write(place(key, f"{name}.{key}"), file_format=key, **how)
    rows = np.array(XYZ, [("x", "f4"), ("y", "f4"), ("z", "f4")])
    deep = np.array(
        [(*each, 1, 2, 3) for each in XYZ],
        [("x", "f8"), ("y", "f8"), ("z", "f8"), ("red", "u1"), ("green", "u1"), ("blue", "u1")],
    )
    for name, table in (("float", rows), ("colors", deep)):
        for order, how in (
            ("ascii", {"text": True}),
            ("little", {"byte_order": "<"}),
            ("big", {"byte_order": ">"}),
        ):
            PlyData([PlyElement.describe(table, "vertex")], **how).write(
                str(place("ply", f"plyfile-points-3d-{name}-{order}.ply"))
            )


def drawings() -> None:
    import ezdxf

    for version in ("R12", "R2000", "R2004", "R2007", "R2010", "R2013", "R2018"):
        made = ezdxf.new(version, units=6)
        space = made.modelspace()
        if version == "R12":
            space.add_polyline2d(XY, close=True)
        else:
            space.add_lwpolyline(XY, close=True)
        made.saveas(place("dxf", f"ezdxf-ring-{version}.dxf"))
    made = ezdxf.new("R2010")
    block = made.blocks.new("TREE")
    block.add_point((0, 0))
    for each in XY:
        made.modelspace().add_blockref("TREE", each)
    made.saveas(place("dxf", "ezdxf-points-blocks.dxf"))
    made = ezdxf.new("R2018")
    for start, end in zip(XY, [*XY[1:], XY[0]], strict=True):
        made.modelspace().add_line(start, end)
    made.saveas(place("dxf", "ezdxf-loose-lines.dxf"), fmt="bin")


def pictures() -> None:
    import imageio.v3 as imageio
    import tifffile
    from PIL import Image

    rows, columns = np.mgrid[:64, :64] + 0.5
    gray = np.clip((20 - np.hypot(rows - 32, columns - 32)) * 255 / 2 + 127, 0, 255).astype(
        np.uint8
    )
    color = np.stack([gray] * 3, axis=2)
    for name, array, how in (
        ("gray", gray, {}),
        ("color", color, {"photometric": "rgb"}),
        ("deflate", gray, {"compression": "zlib"}),
        ("tiles", gray, {"tile": (16, 16)}),
        ("uint16", gray.astype(np.uint16) * 257, {}),
        ("big", gray, {"bigtiff": True}),
        ("big-endian", gray, {"byteorder": ">"}),
    ):
        tifffile.imwrite(place("image", f"tifffile-circle-{name}.tif"), array, **how)
    for suffix in ("png", "jpg", "bmp", "gif", "webp", "ppm"):
        imageio.imwrite(place("image", f"imageio-circle.{suffix}"), color, plugin="pillow")
    Image.fromarray(gray).convert("P").save(place("image", "pillow-circle-palette.png"))
    Image.fromarray(gray).save(place("image", "pillow-circle-interlaced.tif"), compression="lzw")


def main() -> None:
    warnings.simplefilter("ignore")
    import pyarrow.csv
    import pyarrow.feather  # noqa: F401

    for make in (
        text,
        jsons,
        wkts,
        arrays,
        gdal,
        frames,
        shapefiles,
        by_fiona,
        kmls,
        gpxs,
        books,
        clouds,
        scans,
        surfaces,
        drawings,
        pictures,
    ):
        make()


if __name__ == "__main__":
    main()
