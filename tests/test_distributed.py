"""Data in tiles: edges, curves and duplicates are those of one piece, whatever the tiles."""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import crustline as cl

pytest.importorskip("distributed")
pytest.importorskip("pyarrow")

import pyarrow as pa
from distributed import Client, LocalCluster
from pyarrow import parquet

from crustline.cli import main
from crustline.distributed import Result, partition, reconstruct, run
from crustline.distributed.cuts import cut
from crustline.distributed.sight import without


@pytest.fixture(scope="module")
def client():
    """One worker in this process: what runs there is what runs on a cluster."""
    with Client(
        processes=False, n_workers=1, threads_per_worker=1, dashboard_address="127.0.0.1:0"
    ) as opened:
        yield opened


@pytest.fixture(autouse=True)
def pieces_are_small(monkeypatch):
    """Else each file of these small inputs would be one piece."""
    monkeypatch.setattr(run, "_PIECE", 1)


def circles(count, random):
    t = random.random(count) * 2 * np.pi
    center = random.integers(0, 4, (count, 2)) * 3.0
    return center + np.stack([np.cos(t), np.sin(t)], axis=1)


def curves(n, random):
    return circles(n, random)


def coast(n, random):
    t = np.arange(n) * 2 * np.pi / n
    r = 5 + sum(np.sin(k * t + random.random() * 6) / k for k in range(1, 12))
    return np.stack([r * np.cos(t), r * np.sin(t)], axis=1)


def one_circle(n, random):
    t = np.arange(n) * 2 * np.pi / n
    return np.stack([np.cos(t), np.sin(t)], axis=1)


def lattice(n, random):
    side = int(np.sqrt(n))
    return np.stack(np.divmod(np.arange(side * side), side), axis=1).astype(float)


def uniform(n, random):
    return random.random((n, 2))


def noisy(n, random):
    return coast(n, random) + random.normal(0, 0.02, (n, 2))


def clustered(n, random):
    return random.normal(0, 1, (n, 2)) * random.choice([1, 0.01, 1e-4], (n, 1)) + random.integers(
        0, 3, (n, 2)
    )


def arcs(n, random):
    t = random.random(n - 20) * np.pi / 2
    center = random.integers(0, 4, (n - 20, 2)) * 2.5
    drawn = center + np.stack([np.cos(t), np.sin(t)], axis=1)
    return np.concatenate([drawn, random.random((20, 2)) * 10])


def far_islands(n, random):
    return circles(n, random) + random.choice([0, 1e4, 1e7], (n, 1))


def half_repeated(n, random):
    half = circles(n // 2, random)
    return np.concatenate([half, half[random.permutation(len(half))]])


def dashes(n, random):
    along = np.arange(n) * 0.01
    return np.stack([along + 2.0 * (np.arange(n) // 25), np.zeros(n)], axis=1)


def sparse(n, random):
    return random.random((60, 2)) * 1000


def one_cluster(n, random):
    return np.concatenate([random.random((n - 50, 2)) * 1e-9, random.random((50, 2))])


def line(n, random):
    return np.stack([np.arange(n) * 3.0, np.arange(n) * 1.0], axis=1)


KINDS = [
    curves, coast, one_circle, lattice, uniform, noisy, clustered, arcs, far_islands,
    half_repeated, dashes, sparse, one_cluster, line,
]  # fmt: skip


def put(folder: Path, xy: np.ndarray, files: int = 2, group: int = 90) -> str:
    """Write points to Parquet files, and return the pattern of their names."""
    folder.mkdir()
    for k, part in enumerate(np.array_split(xy, files)):
        table = pa.table({"x": part[:, 0], "y": part[:, 1]})
        parquet.write_table(table, folder / f"{k:02}.parquet", row_group_size=group)
    return str(folder / "*.parquet")


def table(frame) -> np.ndarray:
    rows = frame.compute().to_numpy()
    return rows[np.lexsort(rows.T[::-1])]


def agrees(result: Result, xy, method=cl.crust, **parameters) -> None:
    """Assert that edges, curves, isolated points and duplicates are those of one piece."""
    delaunay = cl.Delaunay(xy)
    edges = method(delaunay, **parameters)
    assert np.array_equal(table(result.edges), edges)
    assert np.array_equal(table(result.duplicates), delaunay.duplicates)
    expected = cl.trace(xy, edges)
    found = result.traced()
    assert [rows.tolist() for rows, _ in found] == [each.indices.tolist() for each in expected]
    assert [closed for _, closed in found] == [each.closed for each in expected]
    assert result.counts["isolated"] == len(expected.isolated)
    assert result.counts["curves"] == len(expected)
    assert result.counts["rows"] == len(xy)


@pytest.mark.parametrize("kind", KINDS, ids=lambda kind: kind.__name__)
@pytest.mark.parametrize(
    ("tile_points", "halo", "rounds"), [(70, None, 8), (230, 0, 8), (70, 0, 0)]
)
def test_tiles_give_what_one_piece_gives(client, tmp_path, kind, tile_points, halo, rounds):
    random = np.random.default_rng(15)
    xy = random.permutation(kind(500, random))
    source = put(tmp_path / "in", xy)
    options = {"tile_points": tile_points, "halo": halo, "rounds": rounds}
    result = reconstruct(source, tmp_path / "out", client=client, **options)
    agrees(result, xy)
    names = {path.name for path in (tmp_path / "out").iterdir()}
    outputs = {"edges", "curves", "chains", "long", "duplicates", "crustline.json", "report.json"}
    assert names == outputs


@pytest.mark.parametrize("kind", [curves, lattice, arcs])
def test_large_offsets_change_nothing(client, tmp_path, kind):
    random = np.random.default_rng(3)
    xy = kind(400, random) + 6_000_000.0
    result = reconstruct(put(tmp_path / "in", xy), tmp_path / "out", client=client, tile_points=60)
    agrees(result, xy)


@pytest.mark.parametrize(
    ("method", "parameters"),
    [
        (cl.one_step_crust, {}),
        (cl.beta_skeleton, {"beta": 1.2}),
        (cl.beta_skeleton, {"beta": 1.7}),
        (cl.crossing_angle_graph, {"angle": 1.2}),
    ],
)
def test_every_local_method_has_its_rule(client, tmp_path, method, parameters):
    random = np.random.default_rng(4)
    xy = np.concatenate([arcs(300, random), lattice(100, random)])
    source = put(tmp_path / "in", xy)
    options = {"client": client, "tile_points": 60, "halo": 0}
    result = reconstruct(source, tmp_path / "out", method, **options, **parameters)
    agrees(result, xy, method, **parameters)


def test_points_and_duplicates_on_cuts_and_across_files(client, tmp_path):
    random = np.random.default_rng(5)
    xy = random.integers(0, 6, (600, 2)).astype(float)
    xy[::7] *= -0.0
    source = put(tmp_path / "in", xy, files=5, group=17)
    agrees(reconstruct(source, tmp_path / "out", client=client, tile_points=5, halo=0), xy)


def star(n):
    t = np.arange(n) * 2 * np.pi / n
    return np.concatenate([np.stack([np.cos(t), np.sin(t)], axis=1), [[0.1, 0.05]]])


@pytest.mark.parametrize(
    "xy",
    [
        np.empty((0, 2)),
        np.zeros((1, 2)),
        np.ones((300, 2)),
        np.stack([np.zeros(300), np.arange(300.0)], axis=1),
        star(400),
    ],
    ids=["none", "one", "all equal", "on a vertical line", "a point inside a dense circle"],
)
def test_skew(client, tmp_path, xy):
    source = put(tmp_path / "in", xy, files=1)
    agrees(reconstruct(source, tmp_path / "out", client=client, tile_points=40, halo=0), xy)


def test_everything_in_one_tile(client, tmp_path):
    xy = coast(300, np.random.default_rng(6))
    source = put(tmp_path / "in", xy)
    result = reconstruct(source, tmp_path / "out", client=client, tile_points=10_000)
    assert result.counts["tiles"] == 1
    agrees(result, xy)


def test_overfull_tiles_are_cut_again(client, tmp_path, monkeypatch):
    monkeypatch.setattr(partition, "SAMPLE", 1)
    random = np.random.default_rng(7)
    xy = one_cluster(900, random)
    source = put(tmp_path / "in", xy)
    result = reconstruct(source, tmp_path / "out", client=client, tile_points=60)
    assert any(name.startswith("balance 1") for name in result.report["stages"])
    agrees(result, xy)


def test_pieces_are_regrouped_where_tiles_are_many(client, tmp_path, monkeypatch):
    monkeypatch.setattr(run, "_DIRECT", 3)
    xy = half_repeated(900, np.random.default_rng(27))
    source = put(tmp_path / "in", xy, files=3, group=40)
    result = reconstruct(source, tmp_path / "out", client=client, tile_points=60)
    assert 1 < result.report["stages"]["regroup"]["steps"] < result.counts["tiles"]
    agrees(result, xy)


def test_a_run_that_has_ended_is_not_done_again(client, tmp_path):
    source = put(tmp_path / "in", coast(300, np.random.default_rng(8)))
    options = {"client": client, "tile_points": 100}
    reconstruct(source, tmp_path / "out", **options)
    seen = []
    reconstruct(source, tmp_path / "out", **options, progress=lambda *state: seen.append(state))
    assert not seen


STAGES = ["read", "scatter 0", "gather", "tiles", "rounds", "coordinator", "trace", "join 0"]


@pytest.mark.parametrize("stage", STAGES)
def test_a_run_goes_on_where_it_was_stopped(client, tmp_path, stage):
    """Also after a file that was whole has been damaged."""
    random = np.random.default_rng(9)
    xy = arcs(500, random)
    source = put(tmp_path / "in", xy)
    options = {"client": client, "tile_points": 60, "halo": 0, "rounds": 1}

    def stop(name, fraction):
        if name == stage:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        reconstruct(source, tmp_path / "out", **options, progress=stop)
    with pytest.raises(cl.InputError, match=r"has not ended"):
        Result(tmp_path / "out")
    lines = (tmp_path / "out/work/ledger.jsonl").read_text().splitlines()
    last = json.loads(lines[-1])["files"][0]["path"]
    damaged = tmp_path / "out" / last
    content = bytearray(damaged.read_bytes())
    content[len(content) // 2] ^= 1
    damaged.write_bytes(content)
    agrees(reconstruct(source, tmp_path / "out", **options), xy)
    assert not list((tmp_path / "out").rglob("*.part"))


def test_too_little_room_on_disk_is_said_before_the_work(client, tmp_path, monkeypatch):
    source = put(tmp_path / "in", coast(300, np.random.default_rng(24)))
    full = shutil.disk_usage(tmp_path)._replace(free=20_000)
    monkeypatch.setattr(shutil, "disk_usage", lambda folder: full)
    with pytest.raises(cl.InputError, match="make room or give another folder"):
        reconstruct(source, tmp_path / "out", client=client, tile_points=100)
    monkeypatch.undo()
    assert reconstruct(source, tmp_path / "out", client=client, tile_points=100).counts["rows"]


def test_the_report_in_lines_says_what_was_seen_and_left_open(client, tmp_path):
    xy = arcs(500, np.random.default_rng(25))
    source = put(tmp_path / "in", xy)
    result = cl.distributed.reconstruct(
        source, tmp_path / "out", client=client, tile_points=60, halo=0, rounds=1
    )
    tiles, openness, processors, files = result.summary().splitlines()
    assert tiles.startswith(f"tiles: {result.counts['tiles']} of 500 points; 0 more seen")
    stages = result.report["stages"]
    left = stages["tiles"]["open_vertices"] + stages["tiles"]["open_edges"]
    assert left
    assert f"open: {left} after the tiles" in openness
    assert all(stage["files"] <= stage["cpu"] + 0.01 for stage in stages.values())
    assert "s for files" in processors
    assert "MB written" in files


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


def test_curves_are_geoparquet(client, tmp_path):
    shapely = pytest.importorskip("shapely")
    random = np.random.default_rng(17)
    xy = np.concatenate([circles(300, random), [[50, 50]]])
    result = reconstruct(put(tmp_path / "in", xy), tmp_path / "out", client=client, tile_points=80)
    frame = result.curves.compute()
    lines = shapely.from_wkb(frame["geometry"].to_numpy())
    for line_string, closed, rows, length in zip(
        lines, frame["closed"], frame["rows"], frame["length"], strict=True
    ):
        places = xy[[*rows, rows[0]] if closed else list(rows)]
        assert np.array_equal(shapely.get_coordinates(line_string), places)
        assert line_string.length == pytest.approx(length)


def test_a_cut_puts_equal_points_into_one_box():
    random = np.random.default_rng(18)
    xy = random.integers(0, 9, (500, 2)).astype(float)
    cuts = cut(xy, np.ones(len(xy)), 40)
    leaf = cuts.leaf_of(xy)
    assert cuts.leaves == leaf.max() + 1
    assert np.bincount(leaf).max() <= 80
    _, kinds = np.unique(xy, axis=0, return_inverse=True)
    assert len({*zip(kinds.tolist(), leaf.tolist(), strict=True)}) == kinds.max() + 1


def test_what_is_left_of_a_rectangle_and_its_part_are_all_of_it():
    random = np.random.default_rng(19)
    rectangle = np.array([[0.0, 0.0, 1.0, 2.0]])
    low, high = np.array([[0.2, 0.5]]), np.array([[0.6, 2.0]])
    part = np.concatenate([low, high], axis=1)
    rest, _ = without(rectangle, part)
    places = random.random((1000, 2)) * [1, 2]
    places[:200, 0] = random.choice([0.2, 0.6, np.nextafter(0.2, 0), 1.0], 200)
    inside = ((low <= places) & (places <= high)).all(axis=1)
    pieces = [((each[:2] <= places) & (places <= each[2:])).all(axis=1) for each in rest]
    assert np.array_equal(sum(pieces, inside.astype(int)), np.ones(1000))


# The command.


@pytest.fixture
def command(capsys):
    """Run the command; return its exit code, and what it wrote to either stream."""

    def run(*arguments):
        with pytest.raises(SystemExit) as ended:
            main(["reconstruct", *map(str, arguments)])
        captured = capsys.readouterr()
        return ended.value.code or 0, captured.out, captured.err

    return run


def test_the_command_writes_a_folder(client, tmp_path, command):
    xy = coast(300, np.random.default_rng(23))
    source, out = put(tmp_path / "in", xy), tmp_path / "out"
    options = ("--distributed", "--scheduler", client.scheduler.address, "--tile-points", 90)
    code, told, fault = command(source, "-o", out, *options, "--json")
    assert code == 0, fault
    summary = json.loads(told)
    assert (summary["method"], summary["rows"], summary["outputs"]) == ("crust", 300, [str(out)])
    agrees(Result(out), xy)
    assert "resume is off" in command(source, "-o", out, *options)[2]
    code, _, fault = command(source, "-o", out, *options, "--resume", "-v")
    assert code == 0
    assert Result(out).summary() in fault


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        (["--resume"], "--resume is for --distributed: add that"),
        (["--distributed"], "give one with -o FOLDER"),
        (["--distributed", "-o", "-"], "give one with -o FOLDER"),
        (["--distributed", "-o", "out", "--by", "z"], "--by is not for --distributed"),
        (["--distributed", "-o", "out", "--method", "gabriel"], "gabriel cannot be decided"),
        (["--distributed", "-o", "out", "--memory", "lots"], "give bytes, or a size such as"),
    ],
)
def test_what_the_command_refuses_is_refused_in_a_sentence(tmp_path, command, options, sentence):
    code, told, fault = command(tmp_path / "points.parquet", *options)
    assert (code, told, fault.count("\n")) == (2, "", 1)
    assert sentence in fault


# On processes of their own.


@pytest.mark.slow
@pytest.mark.parametrize("workers", [1, 3])
def test_the_number_of_workers_changes_nothing(tmp_path, workers):
    random = np.random.default_rng(20)
    xy = arcs(2000, random)
    source = put(tmp_path / "in", xy)
    with (
        LocalCluster(
            n_workers=workers, threads_per_worker=1, dashboard_address="127.0.0.1:0"
        ) as cluster,
        Client(cluster) as opened,
    ):
        result = reconstruct(source, tmp_path / "out", client=opened, tile_points=100, halo=0)
    agrees(result, xy)


STEPS = {
    "partition": ("partition", "scatter"),
    "gather": ("partition", "gather"),
    "tiles": ("tile", "decide"),
    "rounds": ("tile", "settle"),
    "coordinator": ("tile", "coordinate"),
    "trace": ("stitch", "trace"),
    "stitch": ("stitch", "join"),
}


@pytest.mark.slow
@pytest.mark.parametrize(("module", "step"), STEPS.values(), ids=STEPS)
def test_a_worker_is_killed_before_its_file_has_its_name(tmp_path, module, step):
    def die_once(module, step, sentinel):
        import importlib

        owner = importlib.import_module(f"crustline.distributed.{module}")
        store = importlib.import_module("crustline.distributed.store")
        original = getattr(owner, step)

        def die(path):
            os.kill(os.getpid(), signal.SIGKILL)

        def dying(*arguments, **options):
            if not sentinel.exists():
                sentinel.touch()
                setattr(store, "_digest", die)  # noqa: B010 (a module has no such attribute for mypy)
            return original(*arguments, **options)

        setattr(owner, step, dying)

    xy = arcs(1000, np.random.default_rng(21))
    source, sentinel = put(tmp_path / "in", xy), tmp_path / "killed"
    with (
        LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address="127.0.0.1:0") as cluster,
        Client(cluster) as opened,
    ):
        opened.run(die_once, module, step, sentinel)
        options = {"tile_points": 60, "halo": 0, "rounds": 1}
        result = reconstruct(source, tmp_path / "out", client=opened, **options)
        agrees(result, xy)
    assert sentinel.exists()
    assert not list((tmp_path / "out").rglob("*.part"))


CLIENT = """
import sys
import crustline.distributed as distributed
from distributed import Client

def say(name, fraction):
    print(name, flush=True)
    if name == sys.argv[3]:
        sys.stdin.read()

if __name__ == "__main__":
    with Client(processes=False, n_workers=1, dashboard_address="127.0.0.1:0") as client:
        distributed.reconstruct(
            sys.argv[1], sys.argv[2], client=client, tile_points=60, halo=0, rounds=1, progress=say
        )
"""


@pytest.mark.slow
@pytest.mark.parametrize("stage", STAGES)
def test_the_client_is_killed_and_the_run_resumed(client, tmp_path, stage):
    random = np.random.default_rng(22)
    xy = arcs(600, random)
    source = put(tmp_path / "in", xy)
    (tmp_path / "client.py").write_text(CLIENT)
    paths = [str(tmp_path / "client.py"), source, str(tmp_path / "out")]
    with subprocess.Popen(
        [sys.executable, *paths, stage], text=True, stdin=subprocess.PIPE, stdout=subprocess.PIPE
    ) as running:
        assert running.stdout is not None
        assert any(line.strip() == stage for line in running.stdout)
        running.kill()
    result = reconstruct(source, tmp_path / "out", client=client, tile_points=60, halo=0, rounds=1)
    agrees(result, xy)
    assert not list((tmp_path / "out").rglob("*.part"))


def test_memory_does_not_grow_with_the_points(tmp_path, monkeypatch):
    """The points take five times what a worker has beyond its memory for a tenth of them."""
    monkeypatch.undo()
    random = np.random.default_rng(26)
    few, many = 250_000, 2_500_000
    xy = coast(many, random)[random.permutation(many)]
    with (
        LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address="127.0.0.1:0") as cluster,
        Client(cluster) as opened,
    ):
        peaks = []
        for count in (few, many):
            source = put(tmp_path / f"in-{count}", xy[:count], files=4, group=25_000)
            options = {"client": opened, "tile_points": 15_000}
            result = reconstruct(source, tmp_path / f"out-{count}", **options)
            assert result.counts["rows"] == count
            peaks += result.report["peak_memory"].values()
        assert len(peaks) == 2, "a worker was lost"
    assert peaks[1] - peaks[0] < many * 24 / 5
