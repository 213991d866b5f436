"""ARCHITECTURE.md against the imports: a module imports from its own line and the lines above."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
CORE = ROOT / "crates" / "core" / "src"
PACKAGE = ROOT / "python" / "crustline"


def layers(part: str) -> dict[str, int]:
    """The line of each module in the list of a part of ARCHITECTURE.md."""
    text = (ROOT / "ARCHITECTURE.md").read_text(encoding="utf-8")
    block = re.search(rf"```{part}\n(.*?)```", text, re.DOTALL)
    assert block, f"ARCHITECTURE.md has no block {part}"
    lines = block[1].splitlines()
    return {module: depth for depth, line in enumerate(lines) for module in line.split()}


def core_imports() -> Iterator[tuple[str, str]]:
    """Pairs of modules of the core: one, and one that it names."""
    for path in CORE.rglob("*.rs"):
        module = path.relative_to(CORE).parts[0].removesuffix(".rs")
        if module != "lib":
            code = re.sub(r"//.*", "", path.read_text(encoding="utf-8"))
            for named in re.findall(r"crate::(?:\{([^}]*)\}|(\w+))", code):
                for name in re.findall(r"\b[a-z_]\w*", named[0]) or [named[1]]:
                    yield module, name


def package_imports() -> Iterator[tuple[str, str]]:
    """Pairs of modules of the package: one, and one that it imports when it is itself imported."""
    for path in PACKAGE.rglob("*.py"):
        module = path.relative_to(PACKAGE).parts[0].removesuffix(".py")
        if module not in ("__init__", "__main__"):
            tree = ast.parse(path.read_text(encoding="utf-8"))
            for node in tree.body:
                if isinstance(node, ast.ImportFrom) and (node.module or "").startswith("crustline"):
                    names = (node.module or "").split(".")[1:2] or [a.name for a in node.names]
                    yield from ((module, name) for name in names)


@pytest.mark.parametrize("part", ["core", "python"])
def test_imports_point_one_way(part: str) -> None:
    depth = layers(part)
    imports = set(core_imports() if part == "core" else package_imports())
    known = {(a, b) for a, b in imports if a != b and b not in ("_core", "Delaunay", "Result")}
    unlisted = {module for pair in known for module in pair} - set(depth)
    assert not unlisted, f"ARCHITECTURE.md does not list {sorted(unlisted)}"
    wrong = sorted((a, b) for a, b in known if depth[b] > depth[a])
    assert not wrong, f"these import against the order of ARCHITECTURE.md: {wrong}"
    assert len(known) > 20


@pytest.mark.parametrize("part", ["core", "python"])
def test_every_module_listed_exists(part: str) -> None:
    folder, suffix = (CORE, ".rs") if part == "core" else (PACKAGE, ".py")
    missing = [
        module
        for module in layers(part)
        if not (folder / module).is_dir() and not (folder / f"{module}{suffix}").is_file()
    ]
    assert not missing
