"""`crustline edit`: the library's formats behind the page, who may use it, and how it ends."""

from __future__ import annotations

import json
import signal
import time
import urllib.error
import urllib.request
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from pages import EXAMPLES, ROOT, Editor, Served

import crustline as cl
from crustline.editor import desk, page

New = Callable[..., Editor]
Serve = Callable[..., Served]


def fetch(url: str, body: bytes | None = None, **headers: str) -> tuple[int, bytes]:
    named = {name.replace("_", "-"): value for name, value in headers.items()}
    request = urllib.request.Request(url, body, named)
    try:
        with urllib.request.urlopen(request, timeout=20) as response:
            return response.status, response.read()
    except urllib.error.HTTPError as error:
        return error.code, error.read()


def geopackage(folder: Path) -> Path:
    rows = [(0, 0), (1, 0), (1, 1), (0, 1), (0.5, 1.4)]
    columns = {"name": list("abcde"), "count": [1, 2, 3, 4, 5]}
    points = cl.Points(rows, z=[5, 6, 7, 8, 9], columns=columns, crs="EPSG:25832")
    points.write(folder / "survey.gpkg")
    return folder / "survey.gpkg"


def test_the_file_of_the_command_is_what_pages_begin_with(new_editor: New, serve: Serve) -> None:
    editor = new_editor().open(serve(str(EXAMPLES / "goose.csv")).address)
    assert editor.status.startswith("2 rings, 1 line · 187 points")
    assert editor.points() == cl.read(EXAMPLES / "goose.csv").xy.ravel().tolist()


def test_geojson_is_the_librarys_byte_for_byte(
    new_editor: New, serve: Serve, tmp_path: Path
) -> None:
    survey = geopackage(tmp_path)
    editor = new_editor().open(serve().address)
    editor.load(survey)
    editor.wait_for_status("5 points")
    cl.reconstruct(cl.read(survey)).write(tmp_path / "curves.geojson")
    assert editor.save("Curves: geojson") == (tmp_path / "curves.geojson").read_bytes()


def test_columns_heights_and_crs_come_back_after_edits(
    new_editor: New, serve: Serve, tmp_path: Path
) -> None:
    editor = new_editor().open(serve().address)
    editor.load(geopackage(tmp_path))
    editor.wait_for_status("5 points")
    editor.drag(editor.place(1, 1), editor.place(1.1, 1.1))
    editor.page.keyboard.press("Delete")
    editor.settle()
    (tmp_path / "edited.gpkg").write_bytes(editor.save("Points: gpkg"))
    edited = cl.read(tmp_path / "edited.gpkg")
    assert edited.crs == "EPSG:25832"
    assert edited.columns["name"].tolist() == list("abde")
    assert edited.z is not None
    assert edited.z.tolist() == [5, 6, 8, 9]


def test_new_points_have_no_height_and_that_is_said(
    new_editor: New, serve: Serve, tmp_path: Path
) -> None:
    editor = new_editor().open(serve().address)
    editor.load(geopackage(tmp_path))
    editor.wait_for_status("5 points")
    editor.use("draw")
    editor.page.mouse.click(*editor.place(0.5, 0.5))
    editor.settle()
    (tmp_path / "edited.csv").write_bytes(editor.save("Points: csv"))
    assert "1 new points have no height" in editor.message
    text = (tmp_path / "edited.csv").read_text().splitlines()
    assert text[0] == "x,y,name,count,heights"
    assert text[-1].endswith(",,nan,nan")


def test_a_bad_file_is_refused_in_the_librarys_sentence(
    new_editor: New, serve: Serve, tmp_path: Path
) -> None:
    editor = new_editor().open(serve(str(EXAMPLES / "goose.csv")).address)
    (tmp_path / "bad.csv").write_text("x,y\n1,2\n3,apple\n")
    editor.load(tmp_path / "bad.csv")
    assert "bad.csv" in editor.message
    assert "apple" in editor.message
    assert len(editor.points()) == 2 * 187


def test_too_large_a_file_is_refused_by_page_and_server(
    new_editor: New, serve: Serve, tmp_path: Path
) -> None:
    served = serve("--limit", "0.01")
    editor = new_editor().open(served.address)
    (tmp_path / "large.csv").write_text("x,y\n" + "1,2\n" * 5000)
    editor.load(tmp_path / "large.csv")
    assert "more than the 0.01 MB allowed" in editor.message
    body = b"x,y\n" + b"1,2\n" * 5000
    status, words = fetch(f"{served.base}api/open?name=a.csv", body, x_token=served.token)
    assert status == 413
    assert b"--limit" in words


@pytest.mark.parametrize("path", ["", "editor.js", "api/configuration", "api/first", "api/tab"])
def test_without_the_token_nothing_is_answered(serve: Serve, path: str) -> None:
    served = serve()
    for query in ("", "?token=", "?token=wrong"):
        status, words = fetch(f"{served.base}{path}{query}")
        assert status == 403
        assert b"token is missing or wrong" in words


def test_strange_hosts_and_origins_are_refused(serve: Serve) -> None:
    served = serve()
    url = f"{served.base}api/configuration"
    assert fetch(url, x_token=served.token)[0] == 200
    assert fetch(url, x_token=served.token, host="evil.example")[0] == 403
    assert fetch(url, x_token=served.token, origin="http://evil.example")[0] == 403
    assert fetch(url, x_token=served.token, origin=served.base.rstrip("/"))[0] == 200
    assert fetch(f"{served.base}api/open?name=a.csv", b"1,2", x_token="wrong")[0] == 403


def test_names_are_no_paths_and_broken_requests_are_sentences(serve: Serve) -> None:
    served = serve()
    status, words = fetch(
        f"{served.base}api/open?name=../../etc/passwd", b"?", x_token=served.token
    )
    assert status == 422
    assert b"etc" not in words
    for body in (b"", b"{}\n", b'{"count": 3}\n12', b"\xff\xfe"):
        assert fetch(f"{served.base}api/save", body, x_token=served.token)[0] == 422


def test_a_wrong_token_is_said_on_the_page(new_editor: New, serve: Serve) -> None:
    editor = new_editor()
    editor.page.goto(serve().address[:-3] + "abc")
    assert "token is missing or wrong" in editor.page.inner_text("body")


def test_tabs_do_not_mix_and_the_last_one_ends_the_command(
    new_editor: New, serve: Serve, tmp_path: Path
) -> None:
    served = serve()
    first = new_editor().open(served.address)
    second = new_editor().open(served.address)
    first.load(geopackage(tmp_path))
    first.wait_for_status("5 points")
    second.load(EXAMPLES / "two_octagons.csv")
    second.wait_for_status("16 points")
    assert b'"name"' in first.save("Points: geojson")
    first.page.close()
    second.page.reload()
    assert "16 points" in second.status
    assert served.process.poll() is None
    second.page.close()
    assert served.process.wait(20) == 0


def test_ctrl_c_ends_it_at_once_and_the_page_says_so(new_editor: New, serve: Serve) -> None:
    served = serve(str(EXAMPLES / "goose.csv"))
    editor = new_editor().open(served.address)
    start = time.monotonic()
    served.process.send_signal(signal.SIGINT)
    served.process.wait(20)
    assert time.monotonic() - start < 10
    assert "crustline edit has ended" in editor.message
    assert len(editor.points()) == 2 * 187


def test_a_taken_port_is_named(serve: Serve) -> None:
    served = serve()
    port = served.base.rstrip("/").rpartition(":")[2]
    other = serve("--port", port)
    assert other.process.wait(20) == 2
    assert other.process.stderr
    assert f"port {port} cannot be used" in other.process.stderr.read()


def test_a_missing_page_says_what_builds_it(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(page, "_FOLDER", Path("/nowhere"))
    with pytest.raises(cl.CrustlineError, match="run make editor"):
        page.built("index.html")


def test_columns_of_every_kind_get_their_missing_value() -> None:
    columns = {
        "real": [1.5], "whole": [7], "text": ["a"], "flag": [True],
        "object": np.array(["a"], object), "day": np.array(["2020-01-01"], "datetime64[D]"),
    }  # fmt: skip
    points = cl.Points([(0, 0)], columns=columns, crs="EPSG:4326")
    both, warning = desk.edited(points, np.array([(0.0, 0), (1, 1)]), np.array([0, -1]))
    assert not warning
    assert both.crs == "EPSG:4326"
    assert both.columns["text"].tolist() == ["a", ""]
    assert both.columns["object"].tolist() == ["a", ""]
    for name in ("real", "whole", "flag"):
        assert np.isnan(both.columns[name][1])
    assert np.isnat(both.columns["day"][1])


def test_the_version_of_the_npm_package_is_the_librarys() -> None:
    package = json.loads((ROOT / "crates" / "wasm" / "package" / "package.json").read_text())
    assert package["version"] == cl.__version__
