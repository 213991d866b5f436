"""The gallery: every figure draws something, and the page and the folder have every figure."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import crustline as cl

pytest.importorskip("matplotlib")
pytest.importorskip("scipy")

from figures import drawing, gallery, paper  # they import matplotlib

ROOT = Path(__file__).resolve().parent.parent
GALLERY = ROOT / "docs" / "gallery"
PAPER = {*(f"figure_{k}" for k in (1, 2, 3, 4, 5, 6, 7, 8, 11, 14, 15)),
         *(f"example_{k}" for k in (1, 2, 3))}  # fmt: skip


@pytest.mark.parametrize("name", list(gallery.FIGURES))
def test_figure_draws_something(name: str) -> None:
    figure = gallery.FIGURES[name]()
    assert figure.axes
    for ax in figure.axes:
        assert ax.lines or ax.collections or ax.patches
        assert not ax.get_legend(), "captions say what is drawn"


def test_all_figures_of_the_paper_are_there() -> None:
    assert set(gallery.FIGURES) >= PAPER | {"goose"}


def test_page_lists_every_figure() -> None:
    page = (GALLERY / "README.md").read_text(encoding="utf-8")
    assert page == gallery.readme(), "run make figures"
    assert re.findall(r"\((\w+)\.png\)", page) == list(gallery.FIGURES)


def test_folder_has_every_figure_and_is_small() -> None:
    pictures = {path.stem: path.stat().st_size for path in GALLERY.glob("*.png")}
    assert set(pictures) == set(gallery.FIGURES)
    assert max(pictures.values()) <= 150_000
    assert sum(pictures.values()) <= 2_000_000


def test_third_example_has_the_unusual_edge() -> None:
    """Paper, §10: an edge of the β-skeleton which is not in the crust."""
    points = paper.noisy_points()
    skeleton, crust = cl.beta_skeleton(points), cl.crust(points)
    assert (~drawing.contained(skeleton, crust)).sum() == 1


def test_captions_name_what_made_them() -> None:
    for draw in gallery.FIGURES.values():
        shows, made = gallery.caption(draw)
        assert shows.endswith(".")
        for name in re.findall(r"`(?:cl|shapes|theory)\.(\w+)`", made):
            assert any(hasattr(part, name) for part in (cl, cl.shapes, cl.theory))
