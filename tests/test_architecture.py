"""ARCHITECTURE.md against the sources: who imports whom, and how long files and functions are."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

import crustline as cl
import imports
from imports import Import, layer

PARTS = {
    "core": (imports.RUST_FILES, imports.rust_imports),
    "python": (imports.PYTHON_FILES, imports.python_imports),
}
LONGEST_FILE, LONGEST_FUNCTION = 450, 45


def block(name: str) -> list[str]:
    """The lines of a block of ARCHITECTURE.md, without what is said of them."""
    text = (imports.ROOT / "ARCHITECTURE.md").read_text(encoding="utf-8")
    found = re.search(rf"```{name}\n(.*?)```", text, re.DOTALL)
    assert found, f"ARCHITECTURE.md has no block {name}"
    return [line.partition("|")[0].strip() for line in found[1].splitlines()]


def layers(part: str) -> list[str]:
    """The modules of a part, from the one that imports none on."""
    return " ".join(block(part)).split()


def doors() -> set[tuple[str, str]]:
    lines = (line.split(" -> ") for line in block("doors"))
    return {(user, used) for user, all_used in lines for used in all_used.split()}


def is_door(found: Import) -> bool:
    ways = {(user, used) for user in (found.user, layer(found.user))
            for used in (found.used, layer(found.used), "*")}  # fmt: skip
    return bool(ways & doors())


def as_text(found: Iterable[Import]) -> list[str]:
    return sorted(f"{each.user} imports {each.used}" for each in found)


@pytest.mark.parametrize("part", PARTS)
def test_layers_name_every_module_and_no_other(part: str) -> None:
    files, _ = PARTS[part]
    there = {layer(name) for name in files} - {"", "__main__", "lib"}
    assert sorted(layers(part)) == sorted(there)


@pytest.mark.parametrize("part", PARTS)
def test_imports_point_one_way(part: str) -> None:
    depth = {module: k for k, module in enumerate(layers(part))}
    found = PARTS[part][1]()
    assert len(found) > 80
    across = [each for each in found if layer(each.user) != layer(each.used)]
    wrong = [each for each in across if depth.get(layer(each.used), 99) > depth[layer(each.user)]]
    assert not as_text(each for each in wrong if not (each.lazy and is_door(each)))


def test_imports_inside_functions_are_doors() -> None:
    lazy = [each for each in imports.python_imports() if each.lazy]
    assert not as_text(each for each in lazy if not is_door(each))


def test_every_door_is_used() -> None:
    lazy = [each for each in imports.python_imports() if each.lazy]
    used = {(user, used) for each in lazy for user in (each.user, layer(each.user))
            for used in (each.used, layer(each.used), "*")}  # fmt: skip
    assert sorted(doors() - used) == []


@pytest.mark.parametrize("part", PARTS)
def test_no_files_import_each_other(part: str) -> None:
    graph: dict[str, set[str]] = {}
    for each in PARTS[part][1]():
        if not is_door(each):
            graph.setdefault(each.user, set()).add(each.used)
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        pytest.fail(" → ".join(error.args[1]))


# --- The reader itself --------------------------------------------------------------------------


def test_use_trees_are_read() -> None:
    assert imports._branches("crate::a::{b, c::{D, e as f}, self}") == [
        "crate::a::b", "crate::a::c::D", "crate::a::c::e", "crate::a::self",
    ]  # fmt: skip
    code = (
        "use super::rings::{HalfEdge, NONE};\nuse crate::point::Point;\npub use super::stars::Star;"
    )
    assert imports._of_rust("delaunay.divide", code) == {"delaunay.rings", "point"}
    assert imports._of_rust("delaunay", "mod divide;\nfn f() { divide::go(); }") == {
        "delaunay.divide"
    }


def test_imports_of_a_module_are_read() -> None:
    code = "from crustline import theory\nimport crustline.errors\n"
    code += "def f():\n    from crustline.plot import x"
    assert list(imports._of_python("curves", ast.parse(code))) == [
        Import("curves", "theory", False), Import("curves", "errors", False),
        Import("curves", "plot", True),
    ]  # fmt: skip


# --- Lengths ------------------------------------------------------------------------------------


def code_lines(text: str, tree: ast.Module) -> list[int]:
    """The numbers of the lines that are no docstrings, comments or blank."""
    strings = {
        number
        for node in ast.walk(tree)
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
        and isinstance(node.value.value, str)
        for number in range(node.lineno, (node.end_lineno or node.lineno) + 1)
    }  # fmt: skip
    lines = enumerate(text.splitlines(), 1)
    return [k for k, line in lines if k not in strings and re.match(r"\s*[^\s#]", line)]


@pytest.mark.parametrize("name", imports.PYTHON_FILES)
def test_no_python_file_or_function_is_long(name: str) -> None:
    text = imports.PYTHON_FILES[name].read_text(encoding="utf-8")
    tree = ast.parse(text)
    lines = code_lines(text, tree)
    assert len(lines) <= LONGEST_FILE
    for node in ast.walk(tree):
        if isinstance(node, ast.FunctionDef):
            own = [k for k in lines if node.lineno <= k <= (node.end_lineno or 0)]
            assert len(own) <= LONGEST_FUNCTION, node.name


@pytest.mark.parametrize("name", imports.RUST_FILES)
def test_no_rust_file_is_long(name: str) -> None:
    """Clippy counts the lines of functions: clippy.toml."""
    text = imports.without_tests(imports.RUST_FILES[name].read_text(encoding="utf-8"))
    assert len(re.findall(r"^\s*(?!//)\S", text, re.MULTILINE)) <= LONGEST_FILE


#: Methods that others are made of, or that pages and certificates speak of by name.
BUILT_ON = {"crust", "connect", "beta_skeleton", "one_step_crust", "gabriel", "gamma_graph"}


def code_of(path: Path) -> str:
    """The text of a file of the package or the core, without comments and docstrings."""
    text = path.read_text(encoding="utf-8")
    if path.suffix == ".rs":
        return re.sub(r"//.*", "", text)
    tree = ast.parse(text)
    documented = (ast.Module, ast.ClassDef, ast.FunctionDef)
    for node in ast.walk(tree):
        if isinstance(node, documented) and ast.get_docstring(node) is not None:
            node.body[0] = ast.Pass()
    return ast.unparse(tree)


def test_a_method_is_named_in_five_files_as_contributing_says() -> None:
    folders = (imports.ROOT / "crates" / "core" / "src", imports.ROOT / "python" / "crustline")
    files = [path for folder in folders for path in folder.rglob("*.[rp][sy]")]
    codes = [code_of(path) for path in files if not path.stem.endswith("tests")]
    for name in {method.replace("-", "_") for method in cl.METHODS} - BUILT_ON:
        assert sum(bool(re.search(rf"\b{name}\b", code)) for code in codes) == 5, name
