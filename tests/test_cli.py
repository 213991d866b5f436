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
    assert summary == {
        "input": "square.csv",
        "method": "crust",
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
        _, summary, reference = block.split("\t")
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
    (["reconstruct", "square.csv", "--input-format", "shp"], ["'shp'"]),
    (["reconstruct", "square.csv", "--input-format", "npy"], ["square.csv", "NPY"]),
    (["reconstruct", "none.csv"], ["none.csv", "no such file"]),
    (["reconstruct", "."], [".", "folder"]),
    (["reconstruct", "square.csv", "-o", "out.shp"], ["out.shp", ".geojson"]),
    (["reconstruct", "square.csv", "-o", "-"], ["--output-format"]),
    (["reconstruct", "square.csv", "-o", "-", "--output-format", "shp"], ["'shp'"]),
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
    ("p,q\n1,2\n", ["'p', 'q'", "--columns"]),
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
