"""The command where standard output is not UTF-8, as pipes on Windows are not."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

#: Every help, and a message of each kind; run in one process, for starting one takes longest.
SCRIPT = r"""
import sys
from crustline.cli import commands, main
def run(*words):
    try:
        main(words)
    except SystemExit as end:
        assert end.code in (0, 2), (words, end.code)
points, lost = sys.argv[1:]
run("--help")
for name in commands.commands:
    run(name, "--help")
run("methods")
run("info", points)
run("info", points, "-v")
run("certify", points)
run("certify", points, "--json")
run("info", lost)
run("reconstruct", points, "--method", "\u03b2")
run("reconstruct", points, "--columns", "\u03b2,y")
run("reconstruct", points, "-o", "\u03b2.none")
run("reconstruct", points, "--method", "beta-skeleton", "-p", "beta=1.5", "-o", "-",
    "--output-format", "geojson")
"""

ENCODINGS = {
    "cp1252": {"PYTHONIOENCODING": "cp1252"},
    "ascii": {"PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0", "LC_ALL": "C"},
    "cp437": {"PYTHONIOENCODING": "cp437"},
    "utf-8": {"PYTHONIOENCODING": "utf-8"},
}


@pytest.mark.parametrize("encoding", ENCODINGS)
def test_everything_is_said_in_any_encoding(encoding: str, tmp_path: Path) -> None:
    """β in `--help` under cp1252 was a UnicodeEncodeError."""
    points = tmp_path / "β.csv"
    points.write_text("x,y,β\n0,0,β\n1,0,日\n0,1,é\n", encoding="utf-8")
    unset = {"PYTHONIOENCODING", "PYTHONUTF8", "LC_ALL", "LANG", "LC_CTYPE"}
    plain = {key: value for key, value in os.environ.items() if key not in unset}
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT, points, tmp_path / "no-β.csv"],
        env=plain | ENCODINGS[encoding], capture_output=True, check=False, cwd=tmp_path,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr.decode("utf-8", "replace")
    said, brace, written = done.stdout.partition(b'{"type"')
    # Where the encoding is said to be ASCII, click takes this for a mistake and says UTF-8.
    spoken = "utf-8" if encoding == "ascii" else encoding
    text = (said + done.stderr).decode(spoken)
    assert "Traceback" not in text
    assert ("β" if "β".encode(spoken, "ignore") else "beta") in text
    # What is written, not said, is UTF-8 whatever the encoding.
    (feature,) = json.loads(brace + written)["features"]
    assert feature["properties"]["β"] == ["β", "日", "é"]
