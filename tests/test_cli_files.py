"""The command and its files: what it says about one, and that it never ruins one."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable
from itertools import groupby
from pathlib import Path

import pytest

from crustline import read
from crustline.cli import main
from crustline.cli.sections import HEADINGS
from crustline.formats import FORMATS
from crustline.formats.catalog import options_for

Run = Callable[..., tuple[int, str, str]]
TABLE = "made by hand\nx;y;name\n1,5;2,5;a\n3,5;4,5;b\n5,5;2,5;c\n"


@pytest.fixture
def run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]) -> Run:
    """Run the command within a folder that holds table.csv."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "table.csv").write_text(TABLE)

    def run(*arguments: str) -> tuple[int, str, str]:
        with pytest.raises(SystemExit) as caught:
            main(arguments)
        return (int(caught.value.code or 0), *capfd.readouterr())

    return run


def test_info_says_how_a_file_was_understood(run: Run) -> None:
    code, out, err = run("info", "table.csv")
    assert (code, err) == (0, "")
    facts = dict(line.split("  ", 1) for line in out.splitlines())
    facts = {name: value.strip() for name, value in facts.items()}
    assert facts["title"] == "made by hand"
    assert (facts["separator"], facts["decimal mark"]) == ("semicolon", "comma")
    assert facts["extent"] == "1.5, 2.5, 5.5, 4.5"
    assert facts["columns"] == "name (object)"


def test_info_for_programs(run: Run) -> None:
    _, out, _ = run("info", "table.csv", "--json")
    facts = json.loads(out)
    assert (facts["points"], facts["duplicates"], facts["format"]) == (3, 0, "CSV")
    assert facts["spacing"][0] == pytest.approx(8**0.5, rel=1e-5)


def test_convert_keeps_what_the_format_holds(run: Run) -> None:
    assert run("convert", "table.csv", "-o", "a.geojson", "-o", "b.xyz", "-q") == (0, "", "")
    assert read("a.geojson").columns["name"].tolist() == ["a", "b", "c"]
    assert read("b.xyz").xy.tolist() == [[1.5, 2.5], [3.5, 4.5], [5.5, 2.5]]


@pytest.mark.parametrize("where", ["table.csv", "./table.csv", "link.csv"])
def test_the_input_is_never_overwritten(run: Run, where: str) -> None:
    os.symlink("table.csv", "link.csv")
    code, _, err = run("convert", "table.csv", "-o", where)
    assert code == 2
    assert "is the input" in err
    assert Path("table.csv").read_text() == TABLE


def test_two_outputs_to_one_file_are_refused(run: Run) -> None:
    code, _, err = run("convert", "table.csv", "-o", "a.csv", "-o", "./a.csv")
    assert (code, "more than once" in err) == (2, True)
    assert not Path("a.csv").exists()


def test_inner_and_outer_exclude_each_other(run: Run) -> None:
    code, _, err = run("medial-axis", "table.csv", "--inner", "--outer")
    assert (code, "exclude each other" in err) == (2, True)


def test_an_empty_crs_is_refused(run: Run) -> None:
    code, _, err = run("convert", "table.csv", "-o", "a.csv", "--crs", "")
    assert (code, "EPSG:4326" in err) == (2, True)


def test_a_warning_is_one_line(run: Run) -> None:
    Path("odd.csv").write_text("a,b\n1,2\n3,4\n")
    code, _, err = run("convert", "odd.csv", "-o", "a.csv", "-q")
    assert code == 0
    assert err.startswith("crustline: warning: odd.csv: takes 'a', 'b' for x and y")
    assert err.count("\n") == 1


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs /dev/full")
def test_a_full_standard_output_is_named(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text(TABLE)
    with open("/dev/full", "w") as full:
        for command in (
            ["info", "a.csv"],
            ["convert", "a.csv", "-o", "-", "--output-format", "csv"],
        ):
            ran = subprocess.run(
                [sys.executable, "-m", "crustline", *command],
                cwd=tmp_path, stdout=full, stderr=subprocess.PIPE, text=True, check=False,
            )  # fmt: skip
            assert ran.returncode == 2
            assert ran.stderr.endswith(
                "standard output cannot be written: No space left on device"
                + (": check the place and its free space" * (len(command) > 2))
                + "\n"
            )


def test_help_is_written_in_any_encoding(tmp_path: Path) -> None:
    ran = subprocess.run(
        [sys.executable, "-m", "crustline", "reconstruct", "--help"],
        env={**os.environ, "PYTHONIOENCODING": "ascii"}, capture_output=True, check=False,
    )  # fmt: skip
    assert (ran.returncode, ran.stderr) == (0, b"")


def test_every_option_of_a_format_is_in_the_help(run: Run) -> None:
    _, out, _ = run("reconstruct", "--help")
    for task in ("read", "write_curves"):
        for option in options_for(task):
            assert option.spelling in out


def test_options_are_what_functions_take() -> None:
    tasks = [
        "read", "read_curves", "stream", "write_points", "write_curves", "write_splines",
    ]  # fmt: skip
    for each in FORMATS.values():
        taken = {option for task in tasks for option in each.options_of(task)}
        assert taken == set(each.options), each.name


GROUPS = "name,x,y\n" + "".join(
    f"{name},{x + shift},{y}\n"
    for x, y in [(0, 0), (1, 0), (1, 1), (0, 1)]
    for name, shift in (("a", 0), ("b", 0.5))
)


def test_points_of_one_group_are_joined_only(run: Run) -> None:
    """310 shapes of one file once gave 310 open curves."""
    Path("groups.csv").write_text(GROUPS)
    code, _, err = run("reconstruct", "groups.csv", "--by", "name", "-o", "a.geojson")
    assert (code, "2 rings, 0 open curves" in err) == (0, True)
    names = [
        each["properties"]["name"] for each in json.loads(Path("a.geojson").read_text())["features"]
    ]
    assert sorted(map(set, names), key=sorted) == [{"a"}, {"b"}]
    code, _, err = run("reconstruct", "groups.csv", "--by", "shape")
    assert (code, "'name'" in err) == (2, True)


def test_a_dry_run_writes_nothing(run: Run) -> None:
    code, _, err = run("reconstruct", "table.csv", "-o", "a.geojson", "--dry-run")
    assert (code, "would write a.geojson" in err) == (0, True)
    assert not Path("a.geojson").exists()


def test_verbose_says_how_the_input_was_understood(run: Run) -> None:
    code, _, err = run("convert", "table.csv", "-o", "a.csv", "-v")
    assert (code, "decimal mark: comma" in err) == (0, True)


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_many_files_in_one_run(run: Run, jobs: str) -> None:
    Path("groups.csv").write_text(GROUPS)
    code, _, err = run("batch", "*.csv", "-o", "{stem}.geojson", "-j", jobs)
    assert (code, err.startswith("2 files done, 0 failed")) == (0, True)
    assert len(read("groups.geojson")) == 8


def test_many_files_go_on_after_a_failure_if_asked(run: Run) -> None:
    Path("bad.csv").write_text("x,y\n1,a\n")
    code, _, err = run("batch", "bad.csv", "table.csv", "-o", "{stem}.wkt", "-j", "1")
    assert (code, "1 not tried: add --keep-going" in err) == (2, True)
    assert not Path("table.wkt").exists()
    code, _, err = run(
        "batch", "bad.csv", "table.csv", "-o", "{stem}.wkt", "-j", "1", "--keep-going"
    )
    assert (code, "1 file done, 1 failed" in err, "line 2" in err) == (2, True, True)
    assert Path("table.wkt").exists()


@pytest.mark.parametrize(
    ("arguments", "word"),
    [
        (["batch", "none*.csv", "-o", "{stem}.wkt"], "none*.csv"),
        (["batch", "table.csv", "table.csv", "-o", "a.wkt"], "{stem}"),
        (["batch", "table.csv", "./table.csv", "-o", "{stem}.wkt"], "twice"),
        (["batch", "table.csv", "-o", "{stem}.csv"], "is an input"),
        (["batch", "table.csv", "-o", "{stem}.csv.q"], "no format"),
        (["batch", "table.csv", "-o", "none/{stem}.wkt"], "no folder"),
    ],
)
def test_many_files_that_would_ruin_something(run: Run, arguments: list[str], word: str) -> None:
    code, _, err = run(*arguments)
    assert (code, word in err, err.count("\n")) == (2, True, 1)


def test_many_files_are_projected_in_other_processes(run: Run) -> None:
    """A method that no other process could take once made the run wait for ever."""
    pytest.importorskip("pyproj")
    for name in ("a", "b"):
        Path(f"{name}.txt").write_text("8,47\n8.1,47\n8.1,47.1\n8,47.1\n")
    options = ["--crs", "EPSG:4326", "--project", "auto", "-j", "2"]
    code, _, err = run("batch", "a.txt", "b.txt", "-o", "{stem}.geojson", *options)
    assert (code, "2 files done, 0 failed" in err) == (0, True)


@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_completion_of_shells(run: Run, shell: str) -> None:
    code, out, _ = run("completion", shell)
    assert (code, "_CRUSTLINE_COMPLETE" in out) == (0, True)


def test_manual_pages_hold_what_help_says(tmp_path: Path) -> None:
    from crustline.cli.manual import write_pages

    pages = {path.name: path.read_text(encoding="utf-8") for path in write_pages(tmp_path / "man")}
    assert "crustline\\-reconstruct" in pages["crustline.1"]
    text = pages["crustline-reconstruct.1"]
    assert [line[4:] for line in text.splitlines() if line.startswith(".SH ")] == [
        "NAME", "SYNOPSIS", "DESCRIPTION", *(heading.upper() for heading in HEADINGS),
    ]  # fmt: skip
    assert "\\-\\-skip\\-lines" in text
    assert "crustline reconstruct goose.csv" in text


def test_help_is_in_sections(run: Run) -> None:
    """Sixty options stood in one list."""
    _, out, _ = run("reconstruct", "--help")
    lines = out.splitlines()
    assert [line[:-1] for line in lines if line[:1].isalpha() and line.endswith(":")] == [*HEADINGS]
    place = {word: k for k, line in enumerate(lines) for word in line.split()[:1]}
    assert place["--by"] < place["--crs"] < place["--orient"] < place["--beta"]
    assert max(sum(1 for _ in group) for key, group in groupby(lines, key=bool) if key) < 40


def test_longitudes_without_a_crs_are_told(run: Run, tmp_path: Path) -> None:
    """A ring across 180° E became a ring and a line, with nothing said."""
    pytest.importorskip("pyproj")
    rows = "-178,-17\n-179,-16\n179.2,-15\n178,-16\n179,-18\n-179.5,-18.5\n"
    (tmp_path / "fiji.csv").write_text(f"lon,lat\n{rows}")
    advice = "--crs EPSG:4326 --project auto"
    _, _, err = run("reconstruct", "fiji.csv")
    assert advice in err
    _, out, _ = run("info", "fiji.csv")
    assert advice in out
    _, _, err = run("reconstruct", "fiji.csv", *advice.split())
    assert "warning" not in err
    assert "1 ring, 0 open curves" in err


def test_info_says_what_to_try(run: Run, tmp_path: Path) -> None:
    rows = "".join(f"{name},{x},{y}\n" for name in "ab" for x, y in ((0, 0), (1, 0), (0, 1.5)))
    (tmp_path / "by shape.csv").write_text(f"Shape,X,Y\n{rows}")
    _, out, _ = run("info", "by shape.csv")
    assert "crustline reconstruct 'by shape.csv' --by Shape -o curves.geojson" in out
    (tmp_path / "near.csv").write_text("x,y\n0,0\n1,0\n1.000000001,0\n0,1\n")
    _, out, _ = run("info", "near.csv")
    assert "--merge 1.1e-09" in out
