"""The gallery: every figure draws something, and the page and the folder have every figure."""

from __future__ import annotations

import importlib
import re
import sys
from pathlib import Path
from types import ModuleType

import pytest

pytest.importorskip("matplotlib")
pytest.importorskip("scipy")

ROOT = Path(__file__).resolve().parent.parent
GALLERY = ROOT / "docs" / "gallery"
PAPER = {*(f"figure_{k}" for k in (1, 2, 3, 4, 5, 6, 7, 8, 11, 14, 15)),
         *(f"example_{k}" for k in (1, 2, 3))}  # fmt: skip


def load() -> ModuleType:
    """The script docs/figures.py, which is in no package."""
    sys.path.insert(0, str(ROOT))
    try:
        return importlib.import_module("docs.figures")
    finally:
        sys.path.remove(str(ROOT))


figures = load()


@pytest.mark.parametrize("name", list(figures.FIGURES))
def test_figure_draws_something(name: str) -> None:
    figure = figures.FIGURES[name]()
    assert figure.axes
    for ax in figure.axes:
        assert ax.lines or ax.collections or ax.patches
        assert not ax.get_legend(), "captions say what is drawn"


def test_all_figures_of_the_paper_are_there() -> None:
    assert set(figures.FIGURES) >= PAPER | {"goose"}


def test_page_lists_every_figure() -> None:
    page = (GALLERY / "README.md").read_text(encoding="utf-8")
    assert page == figures.readme(), "run make figures"
    assert re.findall(r"\((\w+)\.png\)", page) == list(figures.FIGURES)


def test_folder_has_every_figure_and_is_small() -> None:
    pictures = {path.stem: path.stat().st_size for path in GALLERY.glob("*.png")}
    assert set(pictures) == set(figures.FIGURES)
    assert max(pictures.values()) <= 150_000
    assert sum(pictures.values()) <= 2_000_000


def test_third_example_has_the_unusual_edge() -> None:
    """Paper, §10: an edge of the β-skeleton which is not in the crust."""
    points = figures.noisy_points()
    skeleton, crust = figures.cl.beta_skeleton(points), figures.cl.crust(points)
    assert (~figures._contained(skeleton, crust)).sum() == 1


def test_captions_name_what_made_them() -> None:
    for draw in figures.FIGURES.values():
        shows, made = figures.caption(draw)
        assert shows.endswith(".")
        for name in re.findall(r"`(?:cl|shapes|theory)\.(\w+)`", made):
            assert any(hasattr(part, name) for part in (figures.cl, figures.shapes, figures.theory))
