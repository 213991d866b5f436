"""A picture of each layer at two sizes, light and dark; with CRUSTLINE_PICTURES=1 the docs', too.

They are written to editor/build/pictures, to be looked at.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from pages import BUILT, ROOT, Editor

New = Callable[..., Editor]

PICTURES = BUILT / "pictures"
DOCS = ROOT / "docs" / "editor"
SIZES: dict[str, dict[str, Any]] = {
    "wide": {"viewport": {"width": 1280, "height": 720}},
    "phone": {"viewport": {"width": 390, "height": 780}, "has_touch": True, "is_mobile": True},
}
LAYERS = (
    "sizes", "triangulation", "voronoi", "axis", "curve", "difference", "smooth", "points",
    "weak", "confidence", "indices",
)  # fmt: skip
#: What the docs show: the layers, the method, and what is compared.
SHOWN = {
    "goose": (["smooth"], "connect", ""),
    "weak-places": (["weak", "axis"], "crust", ""),
    "comparison": (["triangulation", "difference"], "crust", "beta-skeleton"),
    "feature-sizes": (["sizes", "axis"], "crust", ""),
    "confidence": (["confidence"], "connect", ""),
}


def show(editor: Editor, layers: list[str], method: str = "crust", other: str = "") -> None:
    """Show layers beside points and curve."""
    names = [*layers, "points", "curve"]
    editor.app(f"app.shown = new Set({names!r})")
    for name, value in (("method", method), ("other", other)):
        chosen = f"document.querySelector('[name={name}]')"
        code = f"({chosen}.value = {value!r}, {chosen}.dispatchEvent(new Event('change')))"
        editor.app(code)
    editor.settle()
    editor.page.wait_for_timeout(150)


def colors(picture: bytes) -> int:
    """How many colors a picture has, about: a blank one has few."""
    from io import BytesIO

    from PIL import Image

    return len(Image.open(BytesIO(picture)).convert("RGB").quantize(64).getcolors() or [])


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("size", SIZES)
def test_each_layer_has_its_picture(new_editor: New, static: str, size: str, scheme: str) -> None:
    editor = new_editor(color_scheme=scheme, **SIZES[size]).open(static)
    PICTURES.mkdir(exist_ok=True)
    seen = set()
    for layer in LAYERS:
        other = "beta-skeleton" if layer == "difference" else ""
        method = "connect" if layer == "confidence" else "crust"
        show(editor, [layer], method, other)
        picture = editor.page.screenshot(path=PICTURES / f"{layer}-{size}-{scheme}.png")
        seen.add(picture)
        assert colors(picture) > 4
    # The curve and the points are there in all; each other layer adds something of its own.
    assert len(seen) >= len(LAYERS) - 2
    background = editor.page.evaluate(
        "getComputedStyle(document.querySelector('.stage')).backgroundColor"
    )
    assert background == ("rgb(20, 23, 27)" if scheme == "dark" else "rgb(255, 255, 255)")


@pytest.mark.parametrize("size", SIZES)
def test_nothing_sticks_out_and_the_panel_opens(new_editor: New, static: str, size: str) -> None:
    editor = new_editor(**SIZES[size]).open(static)
    assert editor.page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    for button in editor.page.query_selector_all(".bar button, .bar summary, .tools button"):
        box = button.bounding_box()
        if box:
            assert box["x"] >= 0
            assert box["x"] + box["width"] <= SIZES[size]["viewport"]["width"]
    if size == "phone":
        editor.page.tap("[data-action=panel]")
        editor.page.screenshot(path=PICTURES / "panel-phone-light.png")
    assert editor.page.is_visible("[name=method]")


@pytest.mark.skipif("CRUSTLINE_PICTURES" not in os.environ, reason="redraws docs/editor")
@pytest.mark.parametrize("name", SHOWN)
def test_pictures_of_the_docs(new_editor: New, static: str, name: str) -> None:
    layers, method, other = SHOWN[name]
    editor = new_editor(color_scheme="dark" if name == "feature-sizes" else "light").open(static)
    if name == "comparison":
        editor.page.click(".menu:has-text('Examples') summary")
        editor.page.click("button:text('Two octagons')")
    show(editor, layers, method, other)
    editor.page.mouse.move(10, 700)
    editor.page.wait_for_timeout(6500)  # until the hint is gone
    DOCS.mkdir(exist_ok=True)
    editor.page.screenshot(path=Path(DOCS / f"{name}.png"))
