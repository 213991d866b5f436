"""Pages and help are true: Python, lines `crustline …` and links in them hold as they stand.

A block `text` right after a block is what that one prints; times may differ.
"""

from __future__ import annotations

import pkgutil
import re
import shlex
import shutil
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

import numpy as np
import pytest

import crustline as cl
from crustline.cli import commands as entry
from crustline.cli import main

ROOT = Path(__file__).resolve().parent.parent
PAGES = sorted(
    path.relative_to(ROOT)
    for path in [*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md"), *ROOT.glob("examples/*.md")]
)
#: Pages of one trade each; their pictures are those that they make.
TUTORIALS = sorted(
    str(path.relative_to(ROOT))
    for path in ROOT.glob("docs/tutorials/*.md")
    if path.stem != "qgis"  # whose page tests/test_qgis.py runs
)
#: Commands that need no input to show.
WITHOUT_EXAMPLE = {"methods"}
UNTIL_CLOSED = {"edit"}  # editor/tests runs it, in a browser
BLOCK = re.compile(r"```(\w*)\n(.*?)```|((?:^(?: {4}.*)?\n)+)", re.DOTALL | re.MULTILINE)


def blocks(page: str) -> Iterator[tuple[str, str]]:
    """The language and the text of each block; one that is indented has the language ""."""
    for language, fenced, indented in BLOCK.findall(page):
        if fenced or indented.strip():
            yield language, fenced or indented


def commands(block: str) -> list[list[str]]:
    """The arguments of each line that starts with `crustline`."""
    lines = map(str.strip, block.splitlines())
    return [shlex.split(line, comments=True)[1:] for line in lines if line.startswith("crustline ")]


def without_times(text: str) -> str:
    return re.sub(r"\d+\.\d+ s;", "… s;", text).strip()


def run(arguments: list[str], capfd: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit) as caught:
        main(arguments)
    assert caught.value.code == 0, (arguments, capfd.readouterr().err)


def assert_same_picture(one: str, other: str) -> None:
    """Assert that pictures are equal, but for the last digits of sines, which systems differ in.

    Photographs in them are packed otherwise by other versions of their libraries, and edges in
    these are found in single precision.
    """
    digits = 1e-3 if "data:image" in other else 1e-9
    one, other = (re.sub(r'"data:image[^"]*"', "#", each) for each in (one, other))
    number = r"-?\d+\.\d+(?:e-?\d+)?"
    assert re.sub(number, "#", one) == re.sub(number, "#", other)
    numbers = zip(re.findall(number, one), re.findall(number, other), strict=True)
    assert all(float(a) == pytest.approx(float(b), abs=digits) for a, b in numbers)


@pytest.fixture
def readers_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Work where the examples are, and files by the names that stand for the reader's own."""
    shutil.copytree(ROOT / "examples", tmp_path / "examples")
    for name in ("goose.csv", "points.csv", "scan.csv"):
        shutil.copy(ROOT / "examples" / "goose.csv", tmp_path / name)
    shutil.copy(ROOT / "examples" / "new_zealand.csv", tmp_path / "islands.csv")
    shutil.copy(ROOT / "examples" / "tracks.csv", tmp_path / "tracks.csv")
    draw_goose(tmp_path / "photo.png")
    (tmp_path / "lake.wkt").write_text("POLYGON ((0 0, 40 3, 78 -6, 80 4, 42 13, 0 9, 0 0))")
    monkeypatch.chdir(tmp_path)
    make_bodies()


def make_bodies() -> None:
    """Write what slices are made of: a round tower in scan.laz, a drum in part.stl."""
    rng = np.random.default_rng(0)
    angle, z = rng.uniform(0, 2 * np.pi, 40_000), rng.uniform(12, 13, 40_000)
    tower = np.stack([5 + 3 * np.cos(angle), 2 + 3 * np.sin(angle)], axis=1)
    with suppress(ImportError):
        cl.Points(tower, z=z).write("scan.laz")
    with suppress(ImportError):
        import trimesh

        trimesh.creation.cylinder(5, 60).export("part.stl")


def draw_goose(path: Path) -> None:
    """Write a picture of the goose, if there is what draws it."""
    drawing = pytest.importorskip("PIL.ImageDraw")
    goose = cl.reconstruct(cl.read(ROOT / "examples" / "goose.csv"))
    corners = goose.points.xy[goose.polygons()[0].shell]
    corners = (corners - corners.min(axis=0)) / np.ptp(corners, axis=0).max()
    picture = drawing.Image.new("L", (400, 400), 60)
    places = (20 + 360 * corners * (1, -1) + (0, 360)).tolist()
    drawing.Draw(picture).polygon([(x, y) for x, y in places], fill=230)
    picture.save(path)


@pytest.mark.usefixtures("readers_folder")
@pytest.mark.parametrize("name", ["README.md", "docs/tutorial.md", *TUTORIALS])
def test_what_the_page_shows_is_what_happens(name, capfd):
    modules = (
        ("geopandas", "ezdxf", "skimage", "laspy", "trimesh")
        if name in TUTORIALS
        else ("matplotlib", "skimage", "svgelements", "laspy", "trimesh", "ezdxf")
    )
    for module in modules:
        pytest.importorskip(module)
    names: dict[str, object] = {}
    printed, count = "", 0
    for language, block in blocks((ROOT / name).read_text(encoding="utf-8")):
        if language == "text":
            assert without_times(printed) == without_times(block)
            continue
        capfd.readouterr()
        if language == "python":
            exec(compile(block, name, "exec"), names)
            count += 1
        for arguments in commands(block) if language in ("", "sh") else ():
            run(arguments, capfd)
            count += 1
        printed = "".join(capfd.readouterr())
    assert count >= (2 if name in TUTORIALS else 4)
    if name in TUTORIALS:
        picture = Path(name).with_suffix(".svg")
        assert_same_picture(Path(picture.name).read_text(), (ROOT / picture).read_text())


@pytest.mark.usefixtures("readers_folder")
@pytest.mark.parametrize("name", sorted(entry.commands))
def test_what_help_shows_runs(name, capfd):
    for module in ("matplotlib", "scipy"):
        pytest.importorskip(module)
    shown = commands(entry.commands[name].help or "")
    assert shown or name in WITHOUT_EXAMPLE
    for arguments in shown if name not in UNTIL_CLOSED else ():
        run(arguments, capfd)


@pytest.mark.parametrize("page", PAGES, ids=str)
def test_links_lead_somewhere(page):
    text = (ROOT / page).read_text(encoding="utf-8")
    links = re.findall(r"\]\(([^)#\s]+)[^)]*\)", re.sub(r"```.*?```", "", text, flags=re.DOTALL))
    inside = [link for link in links if not re.match(r"\w+:", link)]
    missing = [link for link in inside if not (ROOT / page).parent.joinpath(link).exists()]
    assert not missing


def test_make_has_a_rule_for_each_target_it_names():
    text = (ROOT / "Makefile").read_text(encoding="utf-8")
    phony = re.search(r"^\.PHONY: (.*)$", text, re.MULTILINE)[1].split()
    assert sorted(phony) == sorted(set(re.findall(r"^([\w-]+):.*##", text, re.MULTILINE)))


@pytest.mark.parametrize("page", PAGES, ids=str)
def test_names_on_pages_exist(page):
    text = (ROOT / page).read_text(encoding="utf-8")
    for name in re.findall(r"`(?:cl|crustline)\.(\w+(?:\.\w+)*)", text):
        assert pkgutil.resolve_name(f"crustline.{name}") is not None
