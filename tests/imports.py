"""Which file imports which, read from the sources of the package and of the core."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PACKAGE = ROOT / "python" / "crustline"
CORE = ROOT / "crates" / "core" / "src"


@dataclass(frozen=True)
class Import:
    """One file imports another; both are dotted names below the package or the core."""

    user: str
    used: str
    lazy: bool  # inside of a function


def layer(module: str) -> str:
    """The module or folder of the first level that a file belongs to."""
    return module.partition(".")[0]


def _names(folder: Path, suffix: str, face: str) -> dict[str, Path]:
    """The dotted name of each source file; a folder's face has the name of the folder."""
    names = {}
    for path in sorted(folder.rglob(f"*{suffix}")):
        parts = path.relative_to(folder).with_suffix("").parts
        names[".".join(parts[:-1] if parts[-1] == face else parts)] = path
    return names


PYTHON_FILES = _names(PACKAGE, ".py", "__init__")
RUST_FILES = _names(CORE, ".rs", "mod")


def _deepest(path: str, files: dict[str, Path]) -> str:
    """The file that a path names, or holds the thing that it names."""
    while path and path not in files:
        path = path.rpartition(".")[0]
    return path


# --- Python -------------------------------------------------------------------------------------


def python_imports() -> list[Import]:
    """All imports of crustline in crustline, but for those of `__init__` and `__main__`."""
    return [
        found
        for module, path in PYTHON_FILES.items()
        if module not in ("", "__main__")
        for found in _of_python(module, ast.parse(path.read_text(encoding="utf-8")))
    ]


def _of_python(module: str, tree: ast.AST, lazy: bool = False) -> Iterator[Import]:
    for node in ast.iter_child_nodes(tree):
        inner = lazy or isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
        for path in _paths(node):
            used = _deepest(path, PYTHON_FILES)
            if used != module and not path.startswith("_core"):
                yield Import(module, used, lazy)
        yield from _of_python(module, node, inner)


def _paths(node: ast.AST) -> list[str]:
    """The dotted paths below crustline that a statement imports."""
    if isinstance(node, ast.Import):
        full = [alias.name for alias in node.names]
    elif isinstance(node, ast.ImportFrom):
        full = [f"{node.module}.{alias.name}" for alias in node.names]
    else:
        return []
    return [path.removeprefix("crustline.") for path in full if path.startswith("crustline.")]


# --- Rust ---------------------------------------------------------------------------------------


def rust_imports() -> list[Import]:
    """All uses of one file of the core by another, but for what faces pass on, and tests."""
    return [
        Import(module, used, lazy=False)
        for module, path in RUST_FILES.items()
        if module not in ("", "lib") and not module.endswith("tests")
        for used in sorted(_of_rust(module, path.read_text(encoding="utf-8")))
    ]


def without_tests(text: str) -> str:
    """Rust without what only tests compile: modules, fields and statements under `cfg(test)`."""
    item = r"#\[cfg\(test\)\]\n\s*(?:mod \w+ \{.*?^\}|[^\n]*,\n|[^;]*;)"
    return re.sub(item, "", text, flags=re.DOTALL | re.MULTILINE)


def _of_rust(module: str, text: str) -> set[str]:
    code = without_tests(re.sub(r"//.*", "", text))
    children = re.findall(r"^\s*(?:pub(?:\(.*?\))?\s+)?mod (\w+);", code, re.MULTILINE)
    trees = [tree for public, tree in re.findall(r"(pub\s+)?use\s+([^;]+);", code) if not public]
    code = re.sub(r"\buse\s+[^;]+;", "", code)
    paths = [path for tree in trees for path in _branches(tree)]
    paths += re.findall(r"(?<![\w:])\w+(?:::\w+)+", code)
    found = (_resolved(module, path.split("::"), children) for path in paths)
    return {used for used in found if used and used != module}


def _branches(tree: str) -> list[str]:
    """The paths of a `use` tree such as a::{b, c::{d, e}}."""
    tree = tree.strip()
    if not (parts := re.fullmatch(r"((?:\w+::)*)\{(.*)\}", tree, re.DOTALL)):
        return [tree.partition(" as ")[0]]
    # The commas that are in no inner braces.
    inner, depth, start = [], 0, 0
    for at, letter in enumerate(text := parts[2] + ","):
        depth += (letter == "{") - (letter == "}")
        if letter == "," and depth == 0:
            inner.append(text[start:at])
            start = at + 1
    return [parts[1] + path for part in inner if part.strip() for path in _branches(part)]


def _resolved(module: str, path: list[str], children: list[str]) -> str:
    """The file that a path in a module means, or nothing if it is none of the core's."""
    here = module.split(".")
    if path[0] == "crate":
        whole = path[1:]
    elif path[0] in ("self", *children):
        whole = here + path[path[0] == "self" :]
    elif path[0] == "super":
        up = next((k for k, part in enumerate(path) if part != "super"), len(path))
        whole = here[: len(here) - up] + path[up:]
    else:
        return ""
    return _deepest(".".join(whole), RUST_FILES)
