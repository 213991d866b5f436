"""What a run in tiles takes, and what it says of input, folders and machines that are wrong."""

from __future__ import annotations

import importlib
import shutil

import numpy as np
import pytest

import crustline as cl

pytest.importorskip("distributed")
pytest.importorskip("pyarrow")

import pyarrow as pa
from pyarrow import parquet

from crustline.cli import main
from crustline.distributed import Result, cluster, reconstruct, tile
from fuzz import clouds
from tiled import agrees, circles, coast, put

pytestmark = pytest.mark.usefixtures("pieces_are_small")


def test_too_little_room_on_disk_is_said_before_the_work(client, tmp_path, monkeypatch):
    source = put(tmp_path / "in", coast(300, np.random.default_rng(24)))
    full = shutil.disk_usage(tmp_path)._replace(free=20_000)
    monkeypatch.setattr(shutil, "disk_usage", lambda folder: full)
    with pytest.raises(cl.InputError, match="make room or give another folder"):
        reconstruct(source, tmp_path / "out", client=client, tile_points=100)
    monkeypatch.undo()
    assert reconstruct(source, tmp_path / "out", client=client, tile_points=100).counts["rows"]


def test_another_run_in_the_folder_is_refused(client, tmp_path):
    source = put(tmp_path / "in", coast(200, np.random.default_rng(10)))
    reconstruct(source, tmp_path / "out", client=client, tile_points=100)
    with pytest.raises(cl.InputError, match="another rule"):
        reconstruct(source, tmp_path / "out", cl.one_step_crust, client=client, tile_points=100)
    (tmp_path / "in/00.parquet").touch()
    with pytest.raises(cl.InputError, match="another input"):
        reconstruct(source, tmp_path / "out", client=client, tile_points=100)
    with pytest.raises(cl.InputError, match="other files"):
        reconstruct(source, tmp_path / "in", client=client, tile_points=100)


@pytest.mark.parametrize(
    "method",
    [
        cl.gabriel,
        cl.relative_neighborhood,
        cl.minimum_spanning_tree,
        cl.connect,
        cl.rcgh,
        cl.alpha_shape,
        cl.nn_crust,
    ],
    ids=lambda method: method.__name__,
)
def test_methods_that_are_not_local_are_refused_by_name(tmp_path, method):
    name = method.__name__.replace("_", "-")
    given = {"radius": 1.0} if method is cl.alpha_shape else {}
    with pytest.raises(cl.InputError, match=f"{name} cannot be decided tile by tile"):
        reconstruct("none.parquet", tmp_path / "out", method, **given)
    assert not (tmp_path / "out").exists()


def test_a_beta_of_one_is_refused(tmp_path):
    with pytest.raises(cl.InputError, match="beta above 1"):
        reconstruct("none.parquet", tmp_path / "out", cl.beta_skeleton, beta=1.0)


def test_rows_that_are_not_finite_are_named(client, tmp_path):
    xy = coast(200, np.random.default_rng(11))
    xy[150, 1] = np.nan
    source = put(tmp_path / "in", xy, files=1, group=100)
    with pytest.raises(cl.InputError, match=r"00.parquet, row group 1: row 50 has nan in y"):
        reconstruct(source, tmp_path / "out", client=client, tile_points=100)


def test_files_of_different_types_and_missing_columns_are_refused(client, tmp_path):
    source = put(tmp_path / "in", coast(20, np.random.default_rng(12)), files=1)
    parquet.write_table(pa.table({"x": ["a"], "y": ["b"]}), tmp_path / "in/text.parquet")
    with pytest.raises(cl.FormatError, match=r"text.parquet: the column x holds string"):
        reconstruct(source, tmp_path / "out", client=client)
    parquet.write_table(pa.table({"x": [1], "y": [2]}), tmp_path / "in/text.parquet")
    with pytest.raises(cl.InputError, match=r"as int64, int64, but .* as double, double"):
        reconstruct(source, tmp_path / "out", client=client)
    with pytest.raises(cl.InputError, match=r"no file matches"):
        reconstruct(str(tmp_path / "none*.parquet"), tmp_path / "out", client=client)
    with pytest.raises(cl.FormatError, match="no column 'easting'"):
        reconstruct(source, tmp_path / "out", client=client, columns=["easting", "northing"])


def test_csv_is_read_by_blocks(client, tmp_path):
    xy = circles(300, np.random.default_rng(13))
    path = tmp_path / "points.csv"
    path.write_text("x,y\n" + "".join(f"{x!r},{y!r}\n" for x, y in xy.tolist()))
    agrees(reconstruct(path, tmp_path / "out", client=client, tile_points=50), xy)


def test_dask_frames_are_read_by_partitions(client, tmp_path):
    dd, pd = pytest.importorskip("dask.dataframe"), pytest.importorskip("pandas")
    xy = circles(300, np.random.default_rng(14))
    frame = dd.from_pandas(pd.DataFrame({"x": xy[:, 0], "y": xy[:, 1]}), npartitions=3)
    agrees(reconstruct(frame, tmp_path / "out", client=client, tile_points=50), xy)


def test_geoparquet_and_its_crs(client, tmp_path):
    geopandas = pytest.importorskip("geopandas")
    xy = coast(200, np.random.default_rng(15))
    points = geopandas.GeoDataFrame(geometry=geopandas.points_from_xy(*xy.T), crs="EPSG:25832")
    points.to_parquet(tmp_path / "points.parquet")
    path = tmp_path / "points.parquet"
    result = reconstruct(path, tmp_path / "out", client=client, tile_points=60)
    agrees(result, xy)
    drawn = [geopandas.read_parquet(each) for each in sorted(result.folder.glob("curves/*"))]
    assert all(each.crs == "EPSG:25832" for each in drawn)


def test_las_is_read_by_chunks(client, tmp_path):
    laspy = pytest.importorskip("laspy")
    cloud = laspy.create()
    cloud.header.scales = [0.001] * 3
    cloud.x, cloud.y = circles(300, np.random.default_rng(16)).T
    cloud.z = np.zeros(300)
    cloud.write(str(tmp_path / "points.las"))
    path = tmp_path / "points.las"
    result = reconstruct(path, tmp_path / "out", client=client, tile_points=60)
    agrees(result, np.stack([cloud.x, cloud.y], axis=1))


def test_object_stores_are_read_through_fsspec(client, tmp_path):
    """Of one in this process, as of any other that fsspec knows."""
    fsspec = pytest.importorskip("fsspec")
    xy = circles(300, np.random.default_rng(28))
    store = fsspec.filesystem("memory")
    for k, part in enumerate(np.array_split(xy, 2)):
        with store.open(f"/survey/{k}.parquet", "wb") as file:
            parquet.write_table(pa.table({"x": part[:, 0], "y": part[:, 1]}), file)
    source = "memory://survey/*.parquet"
    agrees(reconstruct(source, tmp_path / "out", client=client, tile_points=60), xy)
    store.rm("/survey", recursive=True)


# Clouds and frames.


@pytest.mark.parametrize("kind", ["laz", "copc.laz"])
def test_packed_clouds_are_read_by_chunks(client, tmp_path, kind):
    laspy = pytest.importorskip("laspy")
    pytest.importorskip("lazrs")
    path = tmp_path / f"points.{kind}"
    path.write_bytes(clouds.las(6, True) if kind == "laz" else clouds.copc())
    whole = laspy.read(path)
    result = reconstruct(path, tmp_path / "out", client=client, tile_points=30)
    agrees(result, np.stack([whole.x, whole.y], axis=1))


def test_a_cloud_that_was_cut_off_is_not_taken_for_whole(client, tmp_path):
    pytest.importorskip("laspy")
    content = clouds.las(3, False)
    (tmp_path / "points.las").write_bytes(content[: len(content) // 2])
    with pytest.raises(cl.FormatError, match=r"points\.las.*cut off"):
        reconstruct(tmp_path / "points.las", tmp_path / "out", client=client)
    with pytest.raises(cl.InputError, match="has not ended"):
        Result(tmp_path / "out")


def of_geometries(geometries, parts):
    geopandas = pytest.importorskip("geopandas")
    dask_geopandas = pytest.importorskip("dask_geopandas")
    frame = geopandas.GeoDataFrame(geometry=geometries, crs="EPSG:25832")
    return dask_geopandas.from_geopandas(frame, npartitions=parts)


def test_frames_of_dask_geopandas_are_read_by_partitions(client, tmp_path):
    geopandas = pytest.importorskip("geopandas")
    xy = circles(300, np.random.default_rng(14))
    frame = of_geometries(geopandas.points_from_xy(*xy.T), 3)
    result = reconstruct(frame, tmp_path / "out", client=client, tile_points=50)
    agrees(result, xy)
    drawn = geopandas.read_parquet(min(result.folder.glob("curves/*")))
    assert drawn.crs == "EPSG:25832"


def test_geometries_that_are_no_points_are_named(client, tmp_path):
    shapely = pytest.importorskip("shapely")
    geometries = [shapely.Point(k, k) for k in range(20)]
    geometries[13] = shapely.LineString([(0, 0), (1, 1)])
    with pytest.raises(cl.InputError, match="partition 1: row 3 has a geometry that is no point"):
        reconstruct(of_geometries(geometries, 2), tmp_path / "out", client=client)


# Files that are wrong, or do not stay.


def test_the_row_is_counted_from_the_start_of_its_row_group(client, tmp_path):
    """However small the pieces are in which the row group is read."""
    xy = coast(200, np.random.default_rng(11))
    xy[170, 0] = np.inf
    source = put(tmp_path / "in", xy, files=1, group=150)
    options = {"client": client, "tile_points": 7}
    with pytest.raises(cl.InputError, match=r"00.parquet, row group 1: row 20 has inf in x"):
        reconstruct(source, tmp_path / "out", **options)
    xy[170, 0] = 0
    table = pa.table({"x": pa.array(xy[:, 0], mask=np.arange(200) == 90), "y": xy[:, 1]})
    parquet.write_table(table, tmp_path / "in/00.parquet", row_group_size=150)
    with pytest.raises(cl.InputError, match=r"00.parquet, row group 0: row 90 has no x"):
        reconstruct(source, tmp_path / "other", **options)


def test_a_file_without_the_column_of_the_others_is_named(client, tmp_path):
    source = put(tmp_path / "in", coast(20, np.random.default_rng(12)), files=1)
    parquet.write_table(pa.table({"x": [1.0], "height": [2.0]}), tmp_path / "in/01.parquet")
    with pytest.raises(cl.FormatError, match=r"01.parquet has no column 'y'"):
        reconstruct(source, tmp_path / "out", client=client, columns=["x", "y"])
    assert not (tmp_path / "out").exists()


def test_a_damaged_page_is_a_fault_of_the_input(client, tmp_path):
    source = put(tmp_path / "in", coast(2000, np.random.default_rng(13)), files=1, group=2000)
    path = tmp_path / "in/00.parquet"
    content = bytearray(path.read_bytes())
    content[4:3000] = bytes(2996)
    path.write_bytes(content)
    with pytest.raises(cl.InputError, match=r"00.parquet cannot be read \(.*copy it again"):
        reconstruct(source, tmp_path / "out", client=client)


def once_the_folder_is_open(monkeypatch, act):
    """Act after the input was looked at, and before it is read."""
    module = importlib.import_module("crustline.distributed.reconstruct")
    opened = module.open_folder

    def open_folder(*arguments):
        act()
        return opened(*arguments)

    monkeypatch.setattr(module, "open_folder", open_folder)


CHANGES = {
    "vanishes": (lambda path: path.unlink(), "is not there, or cannot be read"),
    "changes": (lambda path: path.write_bytes(path.read_bytes() + b" "), "has changed since"),
}


@pytest.mark.parametrize("name", ["01.parquet", "points.csv"])
@pytest.mark.parametrize(("change", "sentence"), CHANGES.values(), ids=CHANGES)
def test_a_file_that_does_not_stay_is_named(client, tmp_path, monkeypatch, name, change, sentence):
    put(tmp_path / "in", coast(200, np.random.default_rng(30)))
    (tmp_path / "in/points.csv").write_text("x,y\n1,2\n3,4\n")
    source = [tmp_path / "in/00.parquet", tmp_path / "in" / name]
    kept = source[1].read_bytes()
    with monkeypatch.context() as patched:
        once_the_folder_is_open(patched, lambda: change(source[1]))
        with pytest.raises(cl.InputError, match=rf"{name} {sentence}"):
            reconstruct(source, tmp_path / "out", client=client, tile_points=50)
    with pytest.raises(cl.InputError, match="has not ended"):
        Result(tmp_path / "out")
    source[1].write_bytes(kept)
    with pytest.raises(cl.InputError, match="holds another input"):
        reconstruct(source, tmp_path / "out", client=client, tile_points=50)
    result = reconstruct(source, tmp_path / "anew", client=client, tile_points=50)
    assert result.counts["rows"] == len(np.concatenate([cl.read(path).xy for path in source]))


# Disks, memory and schedulers that are not there.


def test_a_disk_that_is_full_in_the_middle_is_said_and_the_run_goes_on_later(client, tmp_path):
    xy = coast(3000, np.random.default_rng(31))
    source = put(tmp_path / "in", xy)
    resource = pytest.importorskip("resource")
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    options = {"client": client, "tile_points": 500}
    resource.setrlimit(resource.RLIMIT_FSIZE, (10_000, hard))
    try:
        with pytest.raises(cl.CrustlineError, match=r"cannot be written .*make room"):
            reconstruct(source, tmp_path / "out", **options)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    with pytest.raises(cl.InputError, match="has not ended"):
        Result(tmp_path / "out")
    agrees(reconstruct(source, tmp_path / "out", **options), xy)
    assert not list((tmp_path / "out").rglob("*.part"))


def test_a_step_that_finds_no_memory_is_said_and_the_run_goes_on_later(
    client, tmp_path, monkeypatch
):
    xy = coast(300, np.random.default_rng(32))
    source = put(tmp_path / "in", xy)
    options = {"client": client, "tile_points": 60}

    def decide(*arguments, **more):
        raise MemoryError("an array of 3 GB")

    with monkeypatch.context() as patched:
        patched.setattr(tile, "decide", decide)
        with pytest.raises(cl.CrustlineError, match=r"stage 'tiles' found no memory: give more"):
            reconstruct(source, tmp_path / "out", **options)
    agrees(reconstruct(source, tmp_path / "out", **options), xy)


def test_a_scheduler_that_does_not_answer_is_said(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(cluster, "_PATIENCE", 0.3)
    source = put(tmp_path / "in", coast(20, np.random.default_rng(33)))
    nowhere = "tcp://127.0.0.1:9"
    with pytest.raises(cl.InputError, match=f"no scheduler answers at {nowhere}"):
        reconstruct(source, tmp_path / "out", client=nowhere)
    options = ["--distributed", "--scheduler", nowhere, "-o", str(tmp_path / "out")]
    with pytest.raises(SystemExit) as ended:
        main(["reconstruct", source, *options])
    assert ended.value.code == 2
    assert capsys.readouterr().err.count("\n") == 1
    assert not (tmp_path / "out").exists()
