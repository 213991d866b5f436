"""The command, as its user meets it: exit codes, one line for what is wrong, no file in part."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys

import numpy as np
import pytest

from crustline.cli import main
from crustline.formats import read
from crustline.methods import METHODS

SQUARE = "x,y,name\n0,0,a\n2,0,b\n2,2,c\n0,2,d\n0,0,again\n"


@pytest.fixture
def run(tmp_path, monkeypatch, capfd):
    """Run the command within a folder; return its exit code, standard output and error."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "square.csv").write_text(SQUARE)

    def run(*arguments):
        with pytest.raises(SystemExit) as caught:
            main(arguments)
        return caught.value.code, *capfd.readouterr()

    return run


def test_several_outputs_and_a_summary(run, tmp_path):
    code, out, err = run(
        "reconstruct", "square.csv", "-o", "a.geojson", "-o", "b.svg", "-o", "c.csv"
    )
    assert (code, out) == (0, "")
    assert err.startswith("square.csv: 5 points, 1 duplicate, 1 ring, 0 open curves, 0 branches, ")
    assert err.count("\n") == 1
    assert sorted(os.listdir(tmp_path)) == ["a.geojson", "b.svg", "c.csv", "square.csv"]
    ring = json.loads((tmp_path / "a.geojson").read_text())["features"][0]
    assert ring["geometry"]["coordinates"] == [[0, 0], [2, 0], [2, 2], [0, 2], [0, 0]]
    assert ring["properties"]["name"] == ["a", "b", "c", "d"]
    assert read(tmp_path / "c.csv").columns["name"].tolist()[:4] == ["a", "b", "c", "d"]


def test_json_for_programs(run):
    code, out, err = run("reconstruct", "square.csv", "--json")
    assert (code, err) == (0, "")
    summary = json.loads(out)
    assert summary.pop("seconds") >= 0
    assert summary.pop("isolated") == 0
    assert summary.pop("merged") == 0
    assert 0 <= summary.pop("connection")["confidence"] <= 1
    assert summary == {
        "input": "square.csv",
        "method": "connect",
        "points": 5,
        "duplicates": 1,
        "rings": 1,
        "open_curves": 0,
        "branches": 0,
        "outputs": [],
    }


def test_json_makes_room_for_an_output(run):
    code, out, err = run(
        "reconstruct", "square.csv", "-o", "-", "--output-format", "wkt", "--polygons", "--json"
    )
    assert code == 0
    assert out.startswith("POLYGON ((0.0 0.0, 2.0 0.0, 2.0 2.0, 0.0 2.0, 0.0 0.0))\n")
    assert json.loads(err)["outputs"] == ["-"]


def test_quiet(run):
    assert run("reconstruct", "square.csv", "-o", "a.wkt", "-q") == (0, "", "")


def test_columns_format_and_crs(run, tmp_path):
    (tmp_path / "odd").write_text("a;b\n1;2\n3;4\n")
    code, *_ = run(
        "reconstruct", "odd", "--columns", "b, a", "--input-format", "csv", "--crs", "EPSG:25832",
        "-o", "out.wkt", "--threads", "1",
    )  # fmt: skip
    assert code == 0
    assert (tmp_path / "out.wkt").read_text() == "SRID=25832;LINESTRING (2.0 1.0, 4.0 3.0)\n"


def test_methods_are_listed_with_their_references(run):
    code, out, err = run("methods")
    assert (code, err) == (0, "")
    blocks = out.replace("\n    ", "\t").splitlines()
    assert [block.split("\t")[0] for block in blocks] == list(METHODS)
    for block in blocks:
        _, summary, *_, reference = block.split("\t")
        assert summary.startswith("Return ")
        assert "(1" in reference or "(2" in reference  # its year


@pytest.mark.parametrize("arguments", [(), ("--help",), ("-h",), ("reconstruct", "-h")])
def test_help(run, arguments):
    code, out, err = run(*arguments)
    assert (code, err) == (0, "")
    assert out.startswith("Usage: crustline ")


def test_version(run):
    import crustline

    assert run("--version") == (0, f"crustline {crustline.__version__}\n", "")


BAD_OPTIONS = [
    (["reconstruct"], ["INPUT"]),
    (["reconstruct", "square.csv", "--frob"], ["--frob"]),
    (["reconstruct", "square.csv", "more.csv"], ["more.csv"]),
    (["frobnicate"], ["frobnicate"]),
    (["reconstruct", "square.csv", "--threads", "0"], ["--threads"]),
    (["reconstruct", "square.csv", "--threads", "many"], ["--threads", "many"]),
    (["reconstruct", "square.csv", "--beta", "big"], ["--beta", "big"]),
    (["reconstruct", "square.csv", "--beta", "1.5"], ["crust", "'beta'"]),
    (["reconstruct", "square.csv", "--method", "magic"], ["'magic'", "crust"]),
    (["reconstruct", "square.csv", "-p", "alpha"], ["'alpha'", "NAME=VALUE"]),
    (["reconstruct", "square.csv", "-p", "alpha=1"], ["crust", "'alpha'"]),
    (["reconstruct", "square.csv", "--columns", "x,q"], ["square.csv", "'q'", "'name'"]),
    (["reconstruct", "square.csv", "--columns", "x"], ["columns"]),
    (["reconstruct", "square.csv", "--columns", "x,name"], ["line 2", "'name'", "'a'"]),
    (["reconstruct", "square.csv", "--input-format", "nef"], ["'nef'"]),
    (["reconstruct", "square.csv", "--input-format", "npy"], ["square.csv", "NPY"]),
    (["reconstruct", "none.csv"], ["none.csv", "no such file"]),
    (["reconstruct", "."], [".", "folder"]),
    (["reconstruct", "square.csv", "-o", "out.nef"], ["out.nef", ".geojson"]),
    (["reconstruct", "square.csv", "-o", "-"], ["--output-format"]),
    (["reconstruct", "square.csv", "-o", "-", "--output-format", "nef"], ["'nef'"]),
    (["reconstruct", "square.csv", "-o", "a.csv", "-o", "none/b.csv"], ["none/b.csv", "folder"]),
    (["reconstruct", "square.csv", "-o", "."], [".", "folder"]),
    (["reconstruct", "square.csv", "-o", "a.csv", "-o", "a.csv"], ["a.csv", "once"]),
]


@pytest.mark.parametrize(("arguments", "words"), BAD_OPTIONS)
def test_a_bad_option_is_one_line_and_no_file(run, tmp_path, arguments, words):
    assert_refused(run(*arguments), tmp_path, words)


def assert_refused(result, folder, words):
    code, out, err = result
    assert (code, out) == (2, "")
    assert err.startswith("crustline: error: ")
    assert err.count("\n") == 1
    for word in words:
        assert word in err
    assert set(os.listdir(folder)) <= {"square.csv", "bad.csv", "bad.npy", "bad.geojson", "bad.wkt"}


BAD_TEXT = [
    ("x,y\n1,2\n3,nan\n", ["line 3", "'y'", "'nan'"]),
    ("x,y\n1,2\n3,inf\n", ["line 3", "'y'", "'inf'"]),
    ("x,y\n1,2\n3,abc\n", ["line 3", "'y'", "'abc'"]),
    ("x,y\n1,2\n3,1+2j\n", ["line 3", "'1+2j'"]),
    ("x,y\n1,2\n3\n", ["line 3", "1 column"]),
    ("x,y\n1,2\n3,\n", ["line 3", "missing"]),
    ("", ["empty"]),
    ("p,q,r\n1,2,3\n", ["'p', 'q', 'r'", "--columns"]),
    ("\x00\x01\x02", ["bad.csv"]),
]


@pytest.mark.parametrize(("text", "words"), BAD_TEXT)
def test_a_bad_file_is_one_line_and_no_file(run, tmp_path, text, words):
    (tmp_path / "bad.csv").write_text(text)
    result = run("reconstruct", "bad.csv", "-o", "out.svg", "-o", "out.csv")
    assert_refused(result, tmp_path, ["bad.csv", *words])


def test_bad_files_of_other_formats(run, tmp_path):
    np.save(tmp_path / "bad.npy", np.array([[1, 2j]]))
    (tmp_path / "bad.geojson").write_text('{"type": "Point", "coordinates": [1]}')
    (tmp_path / "bad.wkt").write_text("POINT (1 x)")
    for name, word in (("bad.npy", "complex"), ("bad.geojson", "feature 0"), ("bad.wkt", "line 1")):
        assert_refused(run("reconstruct", name, "-o", "out.csv"), tmp_path, [name, word])


@pytest.mark.skipif(os.name == "nt", reason="root and Windows write anywhere")
def test_an_output_without_permission(run, tmp_path):
    if os.geteuid() == 0:
        pytest.skip("root may write anywhere")
    (tmp_path / "locked").mkdir(mode=0o500)
    code, _, err = run("reconstruct", "square.csv", "-o", "locked/out.csv")
    assert code == 2
    assert "permission" in err


# What the paper knows


@pytest.fixture
def goose(run, examples, tmp_path):
    """Run a command on the goose, beside which its outputs are written."""
    for name in ("goose.csv", "tracks.csv"):
        (tmp_path / name).write_bytes((examples / name).read_bytes())

    def on_goose(command, *arguments):
        return run(command, "goose.csv", *arguments)

    return on_goose


EXAMPLES = ("reconstruct", "certify", "medial-axis", "thin", "plot", "smooth", "sample")


@pytest.mark.parametrize("command", EXAMPLES)
def test_help_has_an_example_that_runs(run, goose, tmp_path, command):
    _, out, _ = run(command, "--help")
    lines = [line.split() for line in out.splitlines() if line.strip().startswith("crustline ")]
    assert lines
    (tmp_path / "scan.csv").write_bytes((tmp_path / "goose.csv").read_bytes())
    (tmp_path / "lake.wkt").write_text("POLYGON ((0 0, 10 0, 10 1, 0 1, 0 0))")
    for words in lines:
        needed = {"plot": ["matplotlib"], "smooth": ["scipy"], "reconstruct": ["scipy"]}
        for module in needed.get(command, []):
            pytest.importorskip(module)
        code, _, err = run(*words[1:])
        assert code == 0, err


def test_fitted_curves_say_which_rows_how_uncertain_and_what_is_an_outlier(goose, run, tmp_path):
    pytest.importorskip("scipy")
    outputs = ["-o", "path.geojson", "-o", "path.csv"]
    fit = ["--fit", "--noise", "accuracy"]
    code, out, _ = run("reconstruct", "tracks.csv", *fit, *outputs, "--json")
    assert code == 0
    summary = json.loads(out)
    assert (summary["rings"], summary["open_curves"], summary["outliers"]) == (0, 1, 2)
    assert 3 < summary["noise"] < 8
    features = json.loads((tmp_path / "path.geojson").read_text("utf-8"))["features"]
    line, outliers = (each["properties"] for each in features)
    rows = [int(row) for text in line["input_rows"] for row in text.split()]
    assert sorted([*rows, *map(int, outliers["input_rows"])]) == list(range(362))
    assert all(0 < value < 4 for value in line["uncertainty"])
    assert outliers["uncertainty"] == [None, None]
    header = "curve,order,row,x,y,closed,input_rows,uncertainty,noise"
    assert (tmp_path / "path.csv").read_text("utf-8").startswith(header)


def test_a_picture_shows_the_points_beside_the_fit(goose, tmp_path):
    for module in ("matplotlib", "scipy"):
        pytest.importorskip(module)
    for command, picture in (("plot", "fit.svg"), ("reconstruct", "curves.svg")):
        code, _, _ = goose(command, "--fit", "-o", picture)
        assert code == 0
        assert (tmp_path / picture).stat().st_size > 1000


def test_medial_axis_is_within_the_box_and_has_its_parts(goose, tmp_path):
    for part in ("--inner", "--outer"):
        code, _, err = goose("medial-axis", "-o", f"{part[2:]}.csv", "-o", f"{part[2:]}.svg", part)
        assert code == 0
        assert f"wrote {part[2:]}.csv, {part[2:]}.svg" in err
    goose("medial-axis", "-o", "all.csv", "--box", "0,0,50,60")
    points, inner, outer = (
        read(tmp_path / f"{name}.csv").xy for name in ("goose", "inner", "outer")
    )
    assert (inner >= points.min(axis=0)).all()
    assert (inner <= points.max(axis=0)).all()
    margin = 0.25 * np.ptp(points, axis=0).max()
    assert np.isclose(outer.min(), points.min(axis=0)[1] - margin)  # where the rays are cut off
    clipped = read(tmp_path / "all.csv").xy
    assert clipped.min() >= 0
    assert (clipped.max(axis=0) <= (50, 60)).all()


def test_medial_axis_is_pruned(goose):
    counts = []
    for length in ("0", "2", "1e6"):
        _, out, _ = goose("medial-axis", "--prune", length, "--json")
        counts.append(json.loads(out)["inner_edges"])
    assert counts[0] > counts[1] > counts[2]


def test_thin_keeps_columns_and_the_curve(run, tmp_path):
    code, _, _ = run("sample", "blob:7", "-r", "0.02", "-o", "scan.csv", "--shuffle", "--seed", "1")
    assert code == 0
    scan = read(tmp_path / "scan.csv")
    code, out, _ = run("thin", "scan.csv", "-r", "0.2", "-o", "a.csv", "-o", "a.geojson", "--json")
    summary = json.loads(out)
    assert code == 0
    assert summary["kept"] < 0.3 * summary["points"]
    for name in ("a.csv", "a.geojson"):
        kept = read(tmp_path / name)
        rows = np.flatnonzero(np.isin(scan.columns["t"], kept.columns["t"]))
        assert len(rows) == summary["kept"]
        assert np.array_equal(kept, scan[rows])
        assert np.array_equal(kept.columns["t"], scan.columns["t"][rows])
    _, out, _ = run("reconstruct", "a.csv", "--json")
    assert json.loads(out)["rings"] == 1
    assert json.loads(out)["isolated"] == json.loads(out)["open_curves"] == 0


def test_sample_is_what_was_asked_for(run, tmp_path):
    from crustline import sampling_ratio, shapes

    for r in (0.2, 0.8):
        assert run("sample", "ellipse:2,b=1", "-r", str(r), "-o", "p.csv", "-q") == (0, "", "")
        points = read(tmp_path / "p.csv")
        assert sampling_ratio(shapes.ellipse(2, 1), points) <= r
        assert np.allclose(shapes.ellipse(2, 1).point(points.columns["t"]), points)
    _, out, _ = run("sample", "circle", "--error", "0.001", "-o", "p.npy", "--json")
    assert json.loads(out)["points"] == 71


def test_a_shuffle_moves_whole_rows(run, tmp_path):
    for name, words in (("a.csv", ()), ("b.csv", ("--shuffle",)), ("c.csv", ("--shuffle",))):
        run("sample", "trefoil", "-r", "0.5", "--seed", "3", "-o", name, *words)
    a, b = read(tmp_path / "a.csv"), read(tmp_path / "b.csv")
    order = np.argsort(b.columns["t"])
    assert np.array_equal(b[order], a[np.argsort(a.columns["t"])])
    assert not np.array_equal(a, b)
    assert (tmp_path / "b.csv").read_bytes() == (tmp_path / "c.csv").read_bytes()


def test_a_smooth_ring_can_be_sampled_again(run, tmp_path):
    pytest.importorskip("scipy")
    pytest.importorskip("svgelements")
    run("sample", "blob:3", "-r", "0.2", "--shuffle", "-o", "p.csv")
    code, out, _ = run("smooth", "p.csv", "-o", "ring.svg", "--json")
    assert (code, json.loads(out)["curves"], json.loads(out)["corners"]) == (0, 1, 0)
    code, _, _ = run("sample", "ring.svg", "-r", "0.25", "-o", "again.csv")
    assert code == 0
    _, out, _ = run("reconstruct", "again.csv", "--json")
    assert json.loads(out)["rings"] == 1


def test_tolerance_makes_few_pieces(goose):
    pytest.importorskip("scipy")
    _, out, _ = goose("smooth", "-o", "a.svg", "--json")
    _, fewer, err = goose(
        "smooth", "-o", "-", "--output-format", "svg", "--tolerance", "0.5", "--json"
    )
    assert fewer.startswith("<svg")
    assert json.loads(err)["pieces"] < json.loads(out)["pieces"] / 3


def test_pictures_of_all_layers(goose, tmp_path):
    pytest.importorskip("matplotlib")
    starts = {"a.png": b"\x89PNG", "a.svg": b"<?xml", "a.pdf": b"%PDF"}
    outputs = [word for name in starts for word in ("-o", name)]
    code, _, err = goose("plot", *outputs, "--show", "delaunay, voronoi,medial-axis,lfs,indices")
    assert code == 0
    assert "wrote a.png, a.svg, a.pdf" in err
    for name, start in starts.items():
        assert (tmp_path / name).read_bytes().startswith(start)


def test_a_missing_extra_is_named(goose, monkeypatch, tmp_path):
    for module in ("matplotlib", "scipy", "svgelements", "scipy.interpolate"):
        monkeypatch.setitem(sys.modules, module, None)
    (tmp_path / "ring.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg"/>')
    with pytest.raises(SystemExit):
        main(["sample", "ring.svg", "-r", "0.2", "-o", "a.csv"])
    for arguments, extra in (
        (["plot", "-o", "a.png"], "plot"),
        (["smooth", "-o", "a.svg"], "smooth"),
    ):
        code, out, err = goose(*arguments)
        assert (code, out) == (2, "")
        assert f"pip install 'crustline[{extra}]'" in err.splitlines()[-1]


BAD_USES = [
    (["certify"], ["INPUT"]),
    (["certify", "none.csv"], ["none.csv"]),
    (["certify", "square.csv", "-o", "weak.nef"], ["weak.nef", ".xyz"]),
    (["medial-axis", "square.csv", "--prune", "-1"], ["--prune", "-1"]),
    (["medial-axis", "square.csv", "--prune", "nan"], ["--prune", "nan"]),
    (["medial-axis", "square.csv", "--box", "1,2,3"], ["--box", "1,2,3"]),
    (["medial-axis", "square.csv", "--box", "1,2,0,3"], ["--box", "1,2,0,3"]),
    (["medial-axis", "square.csv", "--box", "0,0,inf,inf"], ["--box", "inf"]),
    (["medial-axis", "square.csv", "-o", "none/a.csv"], ["none/a.csv", "folder"]),
    (["thin", "square.csv"], ["-r"]),
    (["thin", "square.csv", "-r", "0"], ["-r", "0.0"]),
    (["thin", "square.csv", "-r", "1.5"], ["-r", "1.5"]),
    (["thin", "square.csv", "-r", "nan"], ["-r", "nan"]),
    (["thin", "square.csv", "-r", "much"], ["-r", "much"]),
    (["thin", "square.csv", "-r", "0.2", "-o", "-"], ["--output-format"]),
    (["sample", "square", "-r", "0.2", "-o", "a.csv"], ["'square'", "ellipse", "SVG"]),
    (["sample", "ellipse:2,1", "-o", "a.csv"], ["-r"]),
    (["sample", "ellipse:2,1", "-r", "0.2"], ["--output"]),
    (["sample", "ellipse:2,1", "-r", "2", "-o", "a.csv"], ["r must be", "2"]),
    (["sample", "ellipse:2,1", "--error", "0", "-o", "a.csv"], ["--error", "0"]),
    (["sample", "ellipse:2", "-r", "0.2", "-o", "a.csv"], ["'ellipse:2'", "a, b"]),
    (["sample", "ellipse:2,x", "-r", "0.2", "-o", "a.csv"], ["'ellipse:2,x'", "'x'"]),
    (["sample", "ellipse:2,1e300", "-r", "0.2", "-o", "a.csv"], ["b must be between", "1e+300"]),
    (["sample", "blob:1.5", "-r", "0.2", "-o", "a.csv"], ["seed", "1.5"]),
    (["sample", "blob:-1", "-r", "0.2", "-o", "a.csv"], ["seed", "-1"]),
    (["sample", "ellipse:1e9,1", "-r", "0.2", "-o", "a.csv"], ["1,000,000 samples"]),
    (["sample", "trefoil:2.5", "-r", "0.2", "-o", "a.csv"], ["lobes", "2.5"]),
    (["sample", "none.svg", "-r", "0.2", "-o", "a.csv"], ["none.svg", "no such file"]),
    (["sample", "circle", "-r", "0.2", "-o", "a.csv", "--mode", "odd"], ["--mode", "odd"]),
    (["reconstruct", "square.csv", "--noise", "1"], ["--noise is for --fit"]),
    (["reconstruct", "square.csv", "--fit", "--by", "name"], ["--by and --fit"]),
    (["reconstruct", "square.csv", "--fit", "--noise", "x1"], ["--noise 'x1'", "neither"]),
    (["reconstruct", "square.csv", "--fit", "--noise", "-1"], ["noise must be 0 or more", "-1"]),
    (["reconstruct", "square.csv", "--fit", "--noise", "50"], ["larger than the extent"]),
    (["plot", "square.csv"], ["--output"]),
    (["plot", "square.csv", "-o", "a.gif"], ["a.gif", ".pdf"]),
    (["plot", "square.csv", "-o", "-"], ["'-'", ".pdf"]),
    (["plot", "square.csv", "-o", "a.png", "--show", "points,magic"], ["'magic'", "medial-axis"]),
    (["plot", "square.csv", "-o", "none/a.png"], ["none/a.png", "folder"]),
    (["smooth", "square.csv", "-o", "a.png"], ["a.png", ".svg"]),
    (["smooth", "square.csv", "-o", "a.svg", "--tolerance", "0"], ["--tolerance", "0"]),
    (["smooth", "square.csv", "-o", "a.svg", "--corner-angle", "181"], ["--corner-angle", "181"]),
]


@pytest.mark.parametrize(("arguments", "words"), BAD_USES)
def test_a_bad_use_is_one_line_and_no_file(run, tmp_path, arguments, words):
    assert_refused(run(*arguments), tmp_path, words)


def test_a_broken_svg_is_one_line(run, tmp_path):
    pytest.importorskip("svgelements")
    head = '<svg xmlns="http://www.w3.org/2000/svg">'
    for name, text, word in (
        ("cut.svg", "<svg", "no SVG"),
        ("none.svg", f"{head}</svg>", "no path"),
        ("open.svg", f'{head}<path d="M0 0L1 0L1 1"/></svg>', "open"),
        ("square.svg", f'{head}<path d="M0 0H1V1H0Z"/></svg>', "corner"),
    ):
        (tmp_path / name).write_text(text)
        code, out, err = run("sample", name, "-r", "0.2", "-o", "a.csv")
        assert (code, out, err.count("\n")) == (2, "", 1)
        assert f"error: {name}" in err
        assert word in err


def test_certify_says_why_in_words_and_in_json(run, tmp_path):
    run("sample", "circle", "-r", "0.2", "-o", "dense.csv", "--shuffle")
    code, out, err = run("certify", "dense.csv", "--strict")
    assert (code, err) == (0, "")
    assert out.startswith("Guaranteed")
    code, out, err = run("certify", "dense.csv", "--json")
    report = json.loads(out)
    assert (code, err, report["guaranteed"], report["input"]) == (0, "", True, "dense.csv")
    assert run("certify", "dense.csv", "-q") == (0, "", "")


def test_certify_writes_where_more_samples_are_needed(run, tmp_path):
    assert run("certify", "square.csv", "--strict", "-q")[0] == 1
    code, out, _ = run("certify", "square.csv", "-o", "weak.csv", "-o", "weak.geojson")
    assert code == 0
    assert out.startswith("Not guaranteed")
    for name in ("weak.csv", "weak.geojson"):
        weak = read(tmp_path / name)
        square = read(tmp_path / "square.csv")
        assert len(weak)
        assert np.array_equal(weak, square[weak.columns["row"]])
        assert set(weak.columns["reason"]) <= {"undersampled", "corner"}
        assert weak.columns["name"].tolist() == square.columns["name"][weak.columns["row"]].tolist()
    code, out, err = run("certify", "square.csv", "-o", "-", "--output-format", "csv", "--json")
    assert out.startswith("x,y,row,reason,name\n")
    assert json.loads(err)["guaranteed"] is False


def process(*arguments, **options):
    command = [sys.executable, "-m", "crustline", *arguments]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, **options)


def test_python_m_is_the_same_command():
    with process(
        "reconstruct", "-", "-o", "-", "--output-format", "wkt", stdin=subprocess.PIPE
    ) as run:
        out, err = run.communicate(SQUARE.encode())
    assert run.returncode == 0
    assert out.startswith(b"LINESTRING (0.0 0.0, 2.0 0.0, 2.0 2.0, 0.0 2.0, 0.0 0.0)")
    assert err.startswith(b"-: 5 points")


@pytest.mark.skipif(os.name == "nt", reason="signals of POSIX")
def test_control_c_is_one_line(tmp_path):
    os.mkfifo(tmp_path / "pipe.csv")
    run = process("reconstruct", str(tmp_path / "pipe.csv"), "-o", str(tmp_path / "a.csv"))
    with run, open(tmp_path / "pipe.csv", "w"):  # the command waits for what comes
        run.send_signal(signal.SIGINT)
        _, err = run.communicate()
    assert run.returncode == 130
    assert err.strip() == b"crustline: interrupted"
    assert os.listdir(tmp_path) == ["pipe.csv"]


@pytest.mark.skipif(os.name == "nt", reason="pipes of POSIX")
def test_a_reader_that_goes_away_is_no_error(tmp_path):
    rows = np.random.default_rng(0).random((20_000, 2))
    np.save(tmp_path / "p.npy", rows)
    with process(
        "reconstruct", str(tmp_path / "p.npy"), "-q", "-o", "-", "--output-format", "csv"
    ) as run:
        run.stdout.close()
        err = run.stderr.read()
    assert err == b""
    assert run.returncode == 1


def test_starting_is_quick():
    """No heavy package is imported before it is needed."""
    code = "import sys, crustline.cli; print(*sorted(sys.modules))"
    loaded = subprocess.check_output([sys.executable, "-c", code], text=True).split()
    assert not {"rich", "matplotlib", "scipy", "json.tool", "xml"} & set(loaded)


def test_a_polygon_has_a_center_line(run, tmp_path):
    """Of its corners alone it had 0 inner edges, and nothing said what to do."""
    (tmp_path / "lake.wkt").write_text("POLYGON ((0 0, 10 0, 10 1, 0 1, 0 0))")
    code, _, err = run("medial-axis", "lake.wkt")
    assert code == 0
    assert "add --edges-from-file" in err
    code, _, err = run("medial-axis", "lake.wkt", "--edges-from-file", "-o", "axis.wkt")
    assert code == 0
    assert not err.startswith("lake.wkt: 0 inner edges")
    for options in (["--accuracy", "0.1"], ["--edges-from-file", "--outer"]):
        code, _, err = run("medial-axis", "lake.wkt", *options)
        assert (code, err.count("\n")) == (2, 1)
