"""Data in tiles: edges, curves and duplicates are those of one piece, whatever the tiles."""

from __future__ import annotations

import json

import numpy as np
import pytest

import crustline as cl

pytest.importorskip("distributed")
pytest.importorskip("pyarrow")

from crustline.cli import main
from crustline.distributed import Result, partition, reconstruct, run
from crustline.distributed.cuts import Cuts, cut
from crustline.distributed.sight import without
from tiled import (
    KINDS,
    STAGES,
    agrees,
    arcs,
    circles,
    coast,
    half_repeated,
    lattice,
    one_cluster,
    put,
)

pytestmark = pytest.mark.usefixtures("pieces_are_small")


def in_tiles(client, tmp_path, kind, offset=0.0, **options):
    random = np.random.default_rng(15)
    xy = random.permutation(kind(500, random)) + offset
    result = reconstruct(put(tmp_path / "in", xy), tmp_path / "out", client=client, **options)
    agrees(result, xy)
    return result


def named(kind):
    return kind.__name__


@pytest.mark.parametrize("kind", KINDS, ids=named)
@pytest.mark.parametrize(
    ("tile_points", "halo", "rounds"), [(70, None, 8), (230, 0, 8), (70, 0, 0)]
)
def test_tiles_give_what_one_piece_gives(client, tmp_path, kind, tile_points, halo, rounds):
    options = {"tile_points": tile_points, "halo": halo, "rounds": rounds}
    result = in_tiles(client, tmp_path, kind, **options)
    outputs = {"edges", "curves", "chains", "long", "duplicates", "crustline.json", "report.json"}
    assert {path.name for path in result.folder.iterdir()} == outputs


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS, ids=named)
@pytest.mark.parametrize(
    ("tile_points", "halo", "rounds"), [(70, 0, 8), (230, None, 8), (230, 0, 0), (70, None, 0)]
)
def test_all_other_tiles_do_so_too(client, tmp_path, kind, tile_points, halo, rounds):
    in_tiles(client, tmp_path, kind, tile_points=tile_points, halo=halo, rounds=rounds)


@pytest.mark.parametrize(
    "kind", [each if each in (coast, lattice, arcs) else pytest.param(each, marks=pytest.mark.slow)
             for each in KINDS], ids=named
)  # fmt: skip
def test_large_offsets_change_nothing(client, tmp_path, kind):
    in_tiles(client, tmp_path, kind, 6_000_000.0, tile_points=60)


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


def test_tiles_may_be_empty(client, tmp_path, monkeypatch):
    """Tiles where no point is, one of them between others."""

    def cut_through_nothing(*arguments):
        beside = Cuts(np.array([0, -1, -1]), np.array([1e9, 0, 0]), np.array([1, 0, 1]))
        between = Cuts(np.array([1, -1, -1]), np.array([-1e9, 0, 0]), np.array([1, 0, 1]))
        return beside.grafted(0, cut(*arguments)).grafted(2, between)

    monkeypatch.setattr(partition, "cut", cut_through_nothing)
    xy = coast(300, np.random.default_rng(34))
    source = put(tmp_path / "in", xy)
    result = reconstruct(source, tmp_path / "out", client=client, tile_points=60, halo=0)
    sizes = result.report["stages"]["gather"]
    assert sizes["steps"] == result.counts["tiles"] > 5
    agrees(result, xy)


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
