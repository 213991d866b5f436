"""The module against the library: the same edges and curves, ties included; estimates to 1e-12."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from pages import BUILT, EXAMPLES
from playwright.sync_api import Browser, Page

import crustline as cl
from crustline.arrays import FloatArray
from crustline.editor.desk import named
from crustline.methods import METHODS

SETS = 1000
AT_ONCE = 100
CATALOG = json.loads((BUILT / "data" / "catalog.json").read_text(encoding="utf-8"))
#: What parameters are in the tests, where the library has none to begin with.
GIVEN = {"alpha-shape": [1.5], "gamma-graph": [0.2, 0.4], "crossing-angle-graph": [1.4]}
NAMES = [each["name"] for each in CATALOG["methods"] if each["name"] != "a-shape"]

COMPUTE = """([sets, methods, theorems]) => sets.map((points) => {
    const { Delaunay } = globalThis.crustline;
    const delaunay = new Delaunay(Float64Array.from(points));
    const edges = methods.map(([name, given]) => [...delaunay.select(name, given)]);
    const traced = delaunay.trace(Uint32Array.from(edges[1]));
    const crust = Uint32Array.from(edges[0]);
    const certificate = delaunay.certify(crust, Float64Array.from(theorems));
    const axis = delaunay.medialAxis(crust);
    const connection = delaunay.connection();
    return {
        edges,
        triangulation: [...delaunay.edges()],
        curves: ['indices', 'offsets', 'closed', 'isolated'].map((part) => [...traced[part]]),
        sizes: [...delaunay.localFeatureSize(crust)].map(String),
        ratios: [...certificate.ratios].map(String),
        reasons: [[...certificate.edgeReasons], [...certificate.pointReasons]],
        guaranteed: certificate.guaranteed,
        sure: [connection.whole, ...connection.confidence].map(String),
        others: [[...connection.leftOut], connection.leftOutReasons,
            [...connection.added], connection.addedReasons],
        axis: [[...axis.edges], [...axis.samples], [...axis.vertices].map(String)],
    };
})"""


def parameters(name: str) -> list[float]:
    """The numbers that a method is given, in order."""
    if name == "beta-skeleton":
        return [1.7, 0.0]
    known = next(each for each in CATALOG["methods"] if each["name"] == name)
    return GIVEN.get(name) or [each["default"] for each in known["parameters"]]


def random_sets() -> Iterator[FloatArray]:
    """Uniform points, integer grids full of ties, noisy circles, and sets of few points."""
    random = np.random.default_rng(14)
    for k in range(SETS):
        n = int(random.integers(1, 60))
        if k % 4 == 0:
            yield random.random((n, 2))
        elif k % 4 == 1:
            yield random.integers(0, 7, (n, 2)).astype(float)
        elif k % 4 == 2:
            angle = random.random(n) * 2 * math.pi
            circle = np.column_stack([np.cos(angle), np.sin(angle)])
            yield circle * (1 + 0.3 * np.cos(3 * angle))[:, None] + random.normal(0, 0.01, (n, 2))
        else:
            yield np.round(random.random((n, 2)) * 8) / 4 + 6e6


@pytest.fixture(scope="module")
def module(browser: Browser) -> Iterator[Page]:
    """A page with the module of the npm package."""
    page = browser.new_page()

    def fulfill(route: Any) -> None:
        name = route.request.url.rpartition("/")[2]
        if name == "":
            return route.fulfill(body="<!doctype html>", content_type="text/html")
        return route.fulfill(path=BUILT / "module" / name)

    page.route("http://module.test/**", fulfill)
    page.goto("http://module.test/")
    page.evaluate(
        "async () => { const m = await import('http://module.test/crustline.js');"
        " await m.default(); globalThis.crustline = m; }"
    )
    yield page
    page.close()


def computed(module: Page, sets: list[FloatArray]) -> list[dict[str, Any]]:
    methods = [[name, parameters(name)] for name in NAMES]
    theory = CATALOG["theory"]
    theorems = [theory[key] for key in ("beta", "of_skeleton", "of_crust", "margin")]
    flat = [each.ravel().tolist() for each in sets]
    answers: list[dict[str, Any]] = module.evaluate(COMPUTE, [flat, methods, theorems])
    return answers


def check(points: FloatArray, answer: dict[str, Any]) -> None:
    delaunay = cl.Delaunay(points, threads=1)
    assert answer["triangulation"] == delaunay.edges.ravel().tolist()
    for name, edges in zip(NAMES, answer["edges"], strict=True):
        expected = METHODS[name](delaunay, **named(name, parameters(name)))
        assert edges == expected.ravel().tolist(), name
    curves = cl.trace(delaunay, cl.connect(delaunay))
    parts = (curves.indices, curves.offsets, curves.closed.astype(int), curves.isolated)
    assert answer["curves"] == [part.tolist() for part in parts]
    crust = cl.crust(delaunay)
    close(answer["sizes"], cl.local_feature_size(delaunay, crust))
    certificate = cl.certify(delaunay, crust)
    close(answer["ratios"], certificate.ratio)
    codes = [certificate.edge_codes.tolist(), certificate.point_codes.tolist()]
    assert answer["reasons"] == codes
    assert answer["guaranteed"] == certificate.guaranteed
    connection = cl.connection(delaunay)
    close(answer["sure"], np.append(connection.whole, connection.confidence))
    assert answer["others"] == [
        connection.left_out.ravel().tolist(), list(connection.left_out_reasons),
        connection.added.ravel().tolist(), list(connection.added_reasons),
    ]  # fmt: skip
    axis = cl.medial_axis(delaunay, crust)
    assert answer["axis"][:2] == [axis.edges.ravel().tolist(), axis.samples.ravel().tolist()]
    close(answer["axis"][2], axis.vertices.ravel())


def close(texts: list[str], expected: FloatArray) -> None:
    found = np.array([text.replace("Infinity", "inf") for text in texts], float)
    np.testing.assert_allclose(found, expected, rtol=1e-12, atol=0)


def test_methods_are_those_of_the_library() -> None:
    assert [each["name"] for each in CATALOG["methods"]] == list(METHODS)
    assert CATALOG["version"] == cl.__version__


@pytest.mark.parametrize("part", range(SETS // AT_ONCE))
def test_random_sets(module: Page, part: int) -> None:
    sets = list(random_sets())[part * AT_ONCE : (part + 1) * AT_ONCE]
    for points, answer in zip(sets, computed(module, sets), strict=True):
        check(points, answer)


@pytest.mark.parametrize("name", ["goose.csv", "two_octagons.csv", "new_zealand.csv"])
def test_examples(module: Page, name: str) -> None:
    points = cl.read(EXAMPLES / name).xy
    check(points, computed(module, [points])[0])


def test_errors_are_exceptions_with_sentences(module: Page) -> None:
    cases = {
        "[0, NaN]": "points: row 0 has NaN in column 1",
        "[1, 2, 3]": "points: 3 numbers are no pairs",
        "[1e-320, 1e308]": "row 0: the coordinate",
        "[0, 1]).select('nonsense', []": "no method nonsense",
        "[0, 1]).trace([0, 7]": "edge 0: (0, 7)",
    }
    for given, words in cases.items():
        code = f"new crustline.Delaunay({given})"
        caught = f"() => {{ try {{ {code}; return ''; }} catch (e) {{ return e.message; }} }}"
        assert module.evaluate(caught).startswith(words)
