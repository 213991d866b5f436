"""The plugin of QGIS: layer in, layer out, by `qgis_process` and by a session without windows."""

from __future__ import annotations

import contextlib
import io
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import numpy as np
import pytest

import crustline as cl
from crustline.cli.progress import progress_bar

ROOT = Path(__file__).resolve().parent.parent
# Debian's wrapper gives qgis_process an option that it does not know.
PROCESS = shutil.which("qgis_process.bin") or shutil.which("qgis_process")
PYTHON = "/usr/bin/python3"
PLUGIN = "crustline_processing"

needs_qgis = pytest.mark.skipif(PROCESS is None, reason="qgis_process is not installed")

#: A session of QGIS: runs algorithms one after the other, and prints a line of JSON for each.
SESSION = """
import json, sys, time
sys.path[:0] = ["/usr/share/qgis/python/plugins", sys.argv[1]]
from qgis.core import QgsApplication, QgsProcessingFeedback
application = QgsApplication([], False)
application.initQgis()
import processing
from processing.core.Processing import Processing
Processing.initialize()
import crustline_processing
plugin = crustline_processing.classFactory(None)
plugin.initProcessing()

class Feedback(QgsProcessingFeedback):
    def __init__(self, seconds):
        super().__init__(False)
        self.end, self.shares = time.monotonic() + seconds, []
        self.progressChanged.connect(self.shares.append)
    def isCanceled(self):
        return time.monotonic() > self.end
    def reportError(self, text, fatal=False):
        pass

for name, parameters, seconds in json.loads(sys.argv[2]):
    feedback = Feedback(seconds)
    started = time.monotonic()
    try:
        found = processing.run(name, parameters, feedback=feedback)
        said = {"found": found}
    except Exception as error:
        said = {"error": f"{error}"}
    said |= {"seconds": time.monotonic() - started, "shares": feedback.shares}
    print("SAID", json.dumps(said, default=str), flush=True)
about = [
    [each.name(), len(each.shortHelpString()), each.icon().isNull()]
    for each in plugin.provider.algorithms()
]
print("SAID", json.dumps(about))
plugin.unload()
"""


def test_the_zip_is_what_qgis_installs(tmp_path):
    first, second = (pack(tmp_path / name) for name in "ab")
    assert first.read_bytes() == second.read_bytes()
    with zipfile.ZipFile(first) as archive:
        names = archive.namelist()
        about = archive.read(f"{PLUGIN}/metadata.txt").decode()
    assert {name.split("/")[0] for name in names} == {PLUGIN}
    assert {f"{PLUGIN}/{each}" for each in ("__init__.py", "LICENSE", "icons/thin.svg")} <= {*names}
    assert f"\nversion={cl.__version__}\n" in about
    assert "license=MIT" in about
    assert not [name for name in names if "pycache" in name]


def test_progress_comes_in_lines_for_those_that_ask(monkeypatch, capsys):
    monkeypatch.setenv("CRUSTLINE_PROGRESS", "lines")
    with progress_bar(quiet=True) as progress:
        assert progress is not None
        for share in (0.0, 0.001, 0.5, 1.0):
            progress("triangulating", share)
    assert capsys.readouterr().err.splitlines() == [
        f"crustline: progress: triangulating: {percent}%" for percent in (0, 50, 100)
    ]


def pack(folder: Path) -> Path:
    packer = [sys.executable, str(ROOT / "integrations/qgis/pack.py"), str(folder)]
    return Path(subprocess.run(packer, check=True, capture_output=True, text=True).stdout.strip())


@pytest.fixture(scope="module")
def home(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A home with the plugin installed, and the command."""
    home = tmp_path_factory.mktemp("home")
    plugins = home / ".local/share/QGIS/QGIS3/profiles/default/python/plugins"
    zipfile.ZipFile(pack(home)).extractall(plugins)
    command = home / "crustline"
    path = os.pathsep.join(filter(None, [str(ROOT / "python"), os.environ.get("PYTHONPATH")]))
    command.write_text(
        f'#!/bin/sh\nPYTHONPATH="{path}" exec "{sys.executable}" -m crustline "$@"\n'
    )
    command.chmod(0o755)
    run(home, PROCESS, "plugins", "enable", PLUGIN)
    return home


def run(
    home: Path, *words: str | Path, code: int = 0, command: str = "", at: Path | None = None
) -> str:
    """Run a program of QGIS, and return what it says."""
    done = subprocess.run(
        words, cwd=at or home, text=True, capture_output=True, timeout=300, check=False,
        env={  # nothing of the Python that runs this, which QGIS would take for its own
            "HOME": str(home), "PATH": "/usr/bin:/bin", "LANG": "C.UTF-8",
            "XDG_RUNTIME_DIR": str(home), "QT_QPA_PLATFORM": "offscreen",
            "CRUSTLINE_COMMAND": command or str(home / "crustline"),
        },
    )  # fmt: skip
    assert done.returncode == code, done.stderr
    return done.stdout + done.stderr


def session(home: Path, *runs: tuple[str, dict, float], command: str = "") -> list:
    """Run algorithms in one session, each with the seconds after which it is canceled."""
    plugins = home / ".local/share/QGIS/QGIS3/profiles/default/python/plugins"
    text = run(home, PYTHON, "-c", SESSION, plugins, json.dumps(runs), command=command)
    return [json.loads(line[5:]) for line in text.splitlines() if line.startswith("SAID ")]


def annulus() -> tuple[cl.Points, np.ndarray]:
    """A ring with a hole and an arc beside them, shuffled; and which of them each point is of."""
    turn = np.arange(60) * (2 * np.pi / 60)
    circle = np.column_stack([np.cos(turn), np.sin(turn)])
    xy = np.concatenate([10 * circle, 5 * circle[::2], [(30, 0)] + 8 * circle[:30]])
    of = np.repeat(["shell", "hole", "arc"], [60, 30, 30])
    order = np.random.default_rng(2).permutation(len(xy))
    columns = {"of": of[order], "number": order, "site": np.full(len(xy), "A")}
    place = (400_000.0, 5_000_000.0)
    points = cl.Points(xy[order] + place, z=order * 0.5, columns=columns, crs="EPSG:25832")
    return points, order


@needs_qgis
def test_qgis_process_reconstructs_a_layer(home, tmp_path):
    geopandas = pytest.importorskip("geopandas")
    points, _ = annulus()
    points.write(tmp_path / "points.gpkg")
    outputs = {name: tmp_path / f"{name}.gpkg" for name in ("OUTPUT", "POLYGONS", "POINTS")}
    given = {"INPUT": tmp_path / "points.gpkg", **outputs}
    words = [f"{name}={path}" for name, path in given.items()]
    run(home, PROCESS, "run", "crustline:reconstruct", "--", *words)
    curves, polygons, ordered = map(geopandas.read_file, outputs.values())
    assert {each.crs.to_epsg() for each in (curves, polygons, ordered)} == {25832}
    # Each curve is one of the three, and keeps what its points have in common.
    found = {each.of: each for each in curves.itertuples()}
    assert {name: (each.closed, each.points) for name, each in found.items()} == {
        "shell": (True, 60), "hole": (True, 30), "arc": (False, 30),
    }  # fmt: skip
    assert set(curves.site) == {"A"}
    assert curves.number.isna().all()
    assert found["arc"].geometry.length == pytest.approx(8 * 29 * 2 * np.sin(np.pi / 60))
    assert all(each.geometry.has_z for each in found.values())
    # The polygon is the ring with its hole.
    assert polygons.holes.tolist() == [1]
    area = 60 / 2 * 100 * np.sin(np.pi / 30) - 30 / 2 * 25 * np.sin(np.pi / 15)
    assert polygons.geometry.area.tolist() == pytest.approx([area])
    # Along each curve the points come in the order in which they were made, and none is lost.
    assert sorted(ordered.number) == list(range(120))
    for _, each in ordered.groupby("curve"):
        steps = np.abs(np.diff(each.number.to_numpy()))
        assert np.count_nonzero(steps != 1) <= 1
    assert [p.z for p in ordered.geometry] == (ordered.number * 0.5).tolist()


@needs_qgis
def test_a_session_runs_every_algorithm(home, tmp_path):
    geopandas = pytest.importorskip("geopandas")
    points, _ = annulus()
    points.select(np.flatnonzero(points.columns["of"] == "shell")).write(tmp_path / "points.gpkg")
    given = {"INPUT": str(tmp_path / "points.gpkg"), "METHOD": "crust"}
    outputs = {name: str(tmp_path / f"{name}.gpkg") for name in ("medial-axis", "certify", "thin")}
    more: dict[str, dict] = {"medial-axis": {"PART": "inner"}, "certify": {}, "thin": {"R": 0.2}}
    axis, certificate, thinned, algorithms = session(home, *(
        (f"crustline:{name}", given | {"OUTPUT": outputs[name]} | more[name], 300)
        for name in outputs
    ))  # fmt: skip
    # The middle of a circle is its center.
    lines = geopandas.read_file(axis["found"]["OUTPUT"])
    assert lines.crs.to_epsg() == 25832
    places = lines.geometry.get_coordinates().to_numpy()
    assert np.abs(places - (400_000, 5_000_000)).max() < 1e-6
    assert certificate["found"]["GUARANTEED"] is True
    assert certificate["found"]["RATIO"] == pytest.approx(np.sin(np.pi / 60), rel=0.01)
    assert len(geopandas.read_file(certificate["found"]["OUTPUT"])) == 0
    kept = geopandas.read_file(thinned["found"]["OUTPUT"])
    assert 15 < len(kept) < 60
    assert list(kept.columns) == ["of", "number", "site", "geometry"]
    for each in (axis, certificate, thinned):
        assert each["shares"] == sorted(each["shares"])
        assert len(each["shares"]) > 2
    assert len(algorithms) == 4
    assert all(length > 100 and not without for _, length, without in algorithms)


#: Draws layers over each other, as QGIS shows them: water, shores, fixes.
RENDERING = """
import sys
from qgis.core import *
from qgis.PyQt.QtCore import QSize
from qgis.PyQt.QtGui import QColor
application = QgsApplication([], True)
application.initQgis()
styles = {
    "fixes": QgsMarkerSymbol.createSimple(
        {"color": "#c2410c", "size": "1.3", "outline_style": "no"}
    ),
    "shores": QgsLineSymbol.createSimple({"color": "#1f5fa8", "width": "0.5"}),
    "water": QgsFillSymbol.createSimple({"color": "#d6e4f2", "outline_style": "no"}),
}
layers = [QgsVectorLayer(f"{name}.gpkg", name) for name in styles]
for layer, symbol in zip(layers, styles.values()):
    assert layer.isValid()
    layer.renderer().setSymbol(symbol)
settings = QgsMapSettings()
settings.setLayers(layers)
settings.setDestinationCrs(layers[0].crs())
settings.setOutputSize(QSize(800, 640))
settings.setOutputDpi(130)
settings.setBackgroundColor(QColor("white"))
extent = layers[0].extent()
extent.scale(1.08)
settings.setExtent(extent)
job = QgsMapRendererSequentialJob(settings)
job.start()
job.waitForFinished()
job.renderedImage().save(sys.argv[1])
"""


@needs_qgis
def test_what_the_page_shows_is_what_happens(home, tmp_path, monkeypatch):
    """Its picture is docs/tutorials/qgis.png: written anew where CRUSTLINE_PICTURES is set."""
    pytest.importorskip("geopandas")
    monkeypatch.chdir(tmp_path)
    page = (ROOT / "docs/tutorials/qgis.md").read_text(encoding="utf-8")
    names: dict[str, object] = {}
    printed, compared = io.StringIO(), 0
    for language, block in re.findall(r"```(\w*)\n(.*?)```", page, re.DOTALL):
        if language == "python":
            printed = io.StringIO()
            with contextlib.redirect_stdout(printed):
                exec(compile(block, "qgis.md", "exec"), names)
        elif language == "sh":
            run(home, PROCESS, *shlex.split(block)[1:], at=tmp_path)
        else:
            assert printed.getvalue().strip() == block.strip()
            compared += 1
    assert compared == 1
    run(home, PYTHON, "-c", RENDERING, "map.png", at=tmp_path)
    kept = ROOT / "docs/tutorials/qgis.png"
    if os.environ.get("CRUSTLINE_PICTURES"):
        shutil.copy("map.png", kept)
    image = pytest.importorskip("PIL.Image")
    ours, theirs = (
        np.asarray(image.open(path).convert("RGB"), float) for path in ("map.png", kept)
    )
    assert ours.shape == theirs.shape
    assert np.mean(np.abs(ours - theirs).max(axis=2) > 40) < 0.01  # but for smoothed edges


@needs_qgis
def test_vertices_of_lines_count_and_their_keys_may_come_twice(home, tmp_path):
    geopandas = pytest.importorskip("geopandas")
    shapely = pytest.importorskip("shapely")
    circle = annulus()[0].xy[np.argsort(annulus()[1])][:60]
    lines = [shapely.LineString(circle[k : k + 2]) for k in range(0, 60, 2)]
    layer = geopandas.GeoDataFrame({"key": range(30)}, geometry=lines, crs="EPSG:25832")
    layer.to_file(tmp_path / "lines.gpkg", engine="pyogrio")
    given = {"INPUT": "lines.gpkg", "OUTPUT": "curves.gpkg", "POINTS": "points.gpkg"}
    given = {name: str(tmp_path / file) for name, file in given.items()}
    found = session(home, ("crustline:reconstruct", given, 300))[0]["found"]
    assert geopandas.read_file(found["OUTPUT"]).points.tolist() == [60]
    keys = geopandas.read_file(found["POINTS"]).key
    assert sorted(keys) == sorted([*range(30), *range(30)])


@needs_qgis
def test_what_goes_wrong_is_an_error_of_qgis(home, tmp_path):
    geopandas = pytest.importorskip("geopandas")
    cl.Points([(0, 0), (1, 1)], crs="EPSG:4326").write(tmp_path / "points.geojson")
    empty = geopandas.GeoDataFrame({"a": []}, geometry=[], crs="EPSG:4326")
    empty.to_file(tmp_path / "empty.gpkg", engine="pyogrio", geometry_type="Point")
    output = tmp_path / "out.gpkg"
    name = "crustline:reconstruct"

    def given(layer, **more):
        return {"INPUT": str(tmp_path / layer), "OUTPUT": str(output), **more}

    runs = [
        (name, given("missing.gpkg"), 300),
        (name, given("empty.gpkg"), 300),
        (name, given("points.geojson", METHOD="crust", CLOSED=True), 300),
    ]
    errors = [each["error"] for each in session(home, *runs)[:-1]]
    assert "Could not load source layer" in errors[0]
    assert "the layer has no points: choose one with some" in errors[1]
    assert "closed" in errors[2]
    assert not any("\n" in each for each in errors[1:])
    missing = session(home, (name, given("points.geojson"), 300), command="/nowhere/crustline")
    assert "the command /nowhere/crustline is not found: install crustline" in missing[0]["error"]
    assert not output.exists()


@needs_qgis
def test_a_canceled_run_ends_the_command_and_writes_nothing(home, tmp_path):
    cl.Points([(0, 0), (1, 1)], crs="EPSG:4326").write(tmp_path / "points.geojson")
    endless = tmp_path / "endless"
    endless.write_text(f"#!/bin/sh\necho $$ > {tmp_path}/pid\nexec sleep 600\n")
    endless.chmod(0o755)
    given = {"INPUT": str(tmp_path / "points.geojson"), "OUTPUT": str(tmp_path / "out.gpkg")}
    said = session(home, ("crustline:reconstruct", given, 2.0), command=str(endless))[0]
    assert said["seconds"] < 60
    assert not (tmp_path / "out.gpkg").exists()
    assert not Path(f"/proc/{(tmp_path / 'pid').read_text().strip()}").exists()
