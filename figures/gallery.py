"""The gallery: all figures, and docs/gallery/README.md, which lists them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from matplotlib import rc_context, rcdefaults
from matplotlib.figure import Figure

from figures.paper import (
    example_1,
    example_2,
    example_3,
    figure_1,
    figure_2,
    figure_3,
    figure_4,
    figure_5,
    figure_6,
    figure_7,
    figure_8,
    figure_11,
    figure_14,
    figure_15,
    goose,
)

ROOT = Path(__file__).resolve().parent.parent
GALLERY = ROOT / "docs" / "gallery"
DPI = 110
FIGURES: dict[str, Callable[[], Figure]] = {
    draw.__name__: draw
    for draw in (
        goose, figure_1, figure_2, figure_3, figure_4, figure_5, figure_6, figure_7, figure_8,
        figure_11, figure_14, example_1, example_2, example_3, figure_15,
    )
}  # fmt: skip
"""The name of each picture, and the function that draws it, in the order of the paper."""
HEAD = """# Gallery

The figures of the paper, redrawn by `make figures` from [`figures/`](../../figures/paper.py).
Everything is computed by crustline; the point sets are our own. Figures 9, 10, 12 and 13, steps of
proofs, are not drawn: [`tests/test_theory.py`](../../tests/test_theory.py) measures them.
"""


def caption(draw: Callable[[], Figure]) -> tuple[str, str]:
    """Return what a figure shows, and what made it, from its docstring."""
    shows, made = (draw.__doc__ or "").split("\n\n")
    return " ".join(shows.split()), " ".join(made.split())


def readme() -> str:
    """Return the page that lists all figures."""
    parts = [HEAD]
    for name, draw in FIGURES.items():
        shows, made = caption(draw)
        title = name.replace("_", " ").capitalize()
        parts.append(f"## {title}\n\n![{title}]({name}.png)\n\n{shows} *{made}*\n")
    return "\n".join(parts)


def write(names: Sequence[str]) -> None:
    """Write the figures of these names, or all, and the page that lists them."""
    GALLERY.mkdir(exist_ok=True)
    for name in names or FIGURES:
        # Matplotlib's own settings, not the user's.
        with rc_context():
            rcdefaults()
            figure = FIGURES[name]()
            figure.savefig(GALLERY / f"{name}.png", dpi=DPI, metadata={"Software": None})
    (GALLERY / "README.md").write_text(readme(), encoding="utf-8")
    print(f"{GALLERY.relative_to(ROOT)}: {len(list(GALLERY.glob('*.png')))} pictures")
