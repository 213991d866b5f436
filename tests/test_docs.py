"""README.md and docs/tutorial.md: each Python block and each line `crustline …` runs as it stands.

A block `text` right after a block is what that one prints; times may differ.
"""

from __future__ import annotations

import re
import shlex
import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest

from crustline.cli import main

ROOT = Path(__file__).resolve().parent.parent
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


@pytest.mark.parametrize("name", ["README.md", "docs/tutorial.md"])
def test_what_the_page_shows_is_what_happens(name, tmp_path, monkeypatch, capfd):
    for module in ("matplotlib", "scipy", "svgelements"):
        pytest.importorskip(module)
    shutil.copytree(ROOT / "examples", tmp_path / "examples")
    # Names that stand for the reader's own files.
    for name_there in ("points.csv", "scan.csv"):
        shutil.copy(ROOT / "examples" / "goose.csv", tmp_path / name_there)
    shutil.copy(ROOT / "examples" / "new_zealand.csv", tmp_path / "islands.csv")
    monkeypatch.chdir(tmp_path)
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
            with pytest.raises(SystemExit) as caught:
                main(arguments)
            assert caught.value.code == 0, (arguments, capfd.readouterr().err)
            count += 1
        printed = "".join(capfd.readouterr())
    assert count >= 4
