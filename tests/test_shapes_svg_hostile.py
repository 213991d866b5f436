"""SVG files that are broken or hostile: each ends in one sentence, soon."""

from __future__ import annotations

import random
from contextlib import suppress
from pathlib import Path

import pytest

from crustline import CrustlineError, FormatError, InputError, shapes

pytest.importorskip("svgelements")

CIRCLE = '<circle id="c" cx="1" cy="2" r="3"/>'
SOUND = f"""<?xml version="1.0"?>
<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"
 viewBox="0 0 9 9">
<g transform="rotate(30 1 1) scale(2)">{CIRCLE}</g>
<path d="M 0 0 C 0 1.5 2 1.5 2 0 C 2 -1.5 0 -1.5 0 0 Z" style="fill:#ff0000"/>
<ellipse cx="50%" cy="2mm" rx="3" ry="1"/><use xlink:href="#c" x="5"/></svg>"""


def refused(tmp_path: Path, body: str) -> str:
    path = tmp_path / "a.svg"
    path.write_text(body)
    with pytest.raises((FormatError, InputError)) as caught:
        shapes.bezier_path(path)
    message = str(caught.value)
    assert "\n" not in message
    assert len(message) < 400
    return message


def drawing(body: str) -> str:
    return f'<svg xmlns="http://www.w3.org/2000/svg">{body}</svg>'


def test_what_is_sound_is_read(tmp_path: Path) -> None:
    (tmp_path / "a.svg").write_text(SOUND)
    assert len(shapes.bezier_path(tmp_path / "a.svg").loops) == 4


def test_groups_that_are_nested_too_deep_are_refused(tmp_path: Path) -> None:
    assert "deep" in refused(tmp_path, drawing("<g>" * 20_000 + CIRCLE + "</g>" * 20_000))


def test_a_use_of_itself_is_refused(tmp_path: Path) -> None:
    assert "deep" in refused(tmp_path, drawing('<g id="a"><use href="#a"/></g>'))


def test_uses_that_multiply_are_refused(tmp_path: Path) -> None:
    levels = [f'<g id="l{k}">{f"""<use href="#l{k + 1}"/>""" * 10}</g>' for k in range(8)]
    body = "".join(levels) + f'<g id="l8">{CIRCLE}</g><use href="#l0"/>'
    assert "elements" in refused(tmp_path, drawing(body))


def test_entities_are_refused(tmp_path: Path) -> None:
    body = f'<!DOCTYPE svg [<!ENTITY a "aaaa">]>{drawing(CIRCLE)}'
    assert "entities" in refused(tmp_path, body)


@pytest.mark.parametrize(
    "body",
    [
        '<path d="M 0 0 C 1e999 0 0 1 0 0 Z"/>',
        '<g transform="scale(1/0)"><circle r="1e400"/></g>',
        '<circle r="a"/>',
        '<path d="M"/>',
        '<path d="M 0 0 A 1 1 0 0 1"/>',
    ],
)
def test_values_that_are_none_are_refused(tmp_path: Path, body: str) -> None:
    refused(tmp_path, drawing(body))


@pytest.mark.parametrize(
    "text", ["M 0 0 C", "Q", "M 0 0 L 1e999 0 Z", "\0", "M" * 5000, "A 1 1 0 0"]
)
def test_text_that_is_no_path_is_refused(text: str) -> None:
    with pytest.raises(InputError):
        shapes.bezier_path(text)


def test_mutated_files_end_in_an_answer_or_a_sentence(tmp_path: Path) -> None:
    rng = random.Random(7)
    path = tmp_path / "a.svg"
    for _ in range(300):
        text = list(SOUND)
        for _ in range(rng.randint(1, 6)):
            place = rng.randrange(len(text))
            text[place : place + rng.randint(0, 4)] = rng.choice(
                ["", "9", "<", "#", "e9", "-", "/"]
            )
        path.write_text("".join(text))
        with suppress(CrustlineError):
            shapes.bezier_path(path)
