"""Running the command `crustline`, which has a Python of its own: progress, cancel, errors."""

import json
import os
import shlex
import shutil
import subprocess
import threading
from pathlib import Path

from processing.core.ProcessingConfig import ProcessingConfig
from qgis.core import QgsProcessingException

#: The setting that names the command.
SETTING = "CRUSTLINE_COMMAND"
#: The part of an algorithm's progress that the command takes, in percent.
FIRST, LAST = 10, 90
_PATIENCE = 5  # seconds that a canceled command has to end


class Canceled(Exception):
    """The user has canceled the algorithm."""


def command():
    """Return the words that start crustline: of the environment, of the setting, or on the path."""
    given = os.environ.get(SETTING) or ProcessingConfig.getSetting(SETTING)
    words = shlex.split(given, posix=os.name == "posix") if given else ["crustline"]
    if shutil.which(words[0]) is None:
        raise QgsProcessingException(
            f"the command {words[0]} is not found: install crustline (pip install crustline), and "
            "name its command in Settings > Options > Processing > Providers > crustline"
        )
    return words


def run(arguments, folder, feedback, layer):
    """Run a command of crustline in a folder, and return its summary; raise what it refuses."""
    words = [*command(), *arguments, "--json"]
    feedback.pushCommandInfo(shlex.join(words))
    said, shares, summary = [], [], []
    with subprocess.Popen(
        words, cwd=folder, env=_environment(), text=True, encoding="utf-8", errors="replace",
        stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        creationflags=getattr(subprocess, "CREATE_NO_WINDOW", 0),
    ) as process:  # fmt: skip
        readers = [
            threading.Thread(target=_listen, args=(process.stderr, said, shares)),
            threading.Thread(target=summary.extend, args=(process.stdout,)),
        ]
        for reader in readers:
            reader.start()
        try:
            _wait(process, shares, feedback)
        finally:
            for reader in readers:
                reader.join()
    said = [line.replace("points.csv", layer) for line in said]
    for line in said:
        if line.startswith("crustline: warning: "):
            feedback.pushWarning(line.partition("warning: ")[2])
    if process.returncode:
        last = said[-1] if said else f"crustline ended with code {process.returncode}"
        raise QgsProcessingException(last.partition("error: ")[2] or last)
    return json.loads("".join(summary))


def _environment():
    """Return the environment without QGIS's own Python, in which crustline would not start."""
    own = ("PYTHONHOME", "PYTHONPATH", "PYTHONSTARTUP")
    kept = {name: value for name, value in os.environ.items() if name not in own}
    return kept | {"CRUSTLINE_PROGRESS": "lines", "PYTHONIOENCODING": "utf-8"}


def _listen(stream, said, shares):
    """Keep what is said, and how far the command is."""
    for line in stream:
        stage, _, percent = line.rstrip().rpartition(": ")
        if stage.startswith("crustline: progress: ") and percent.endswith("%"):
            shares.append(float(percent[:-1]) / 100)
        elif line.strip():
            said.append(line.rstrip())


def _wait(process, shares, feedback):
    """Wait until a process ends; end it if the user cancels. QGIS hears of it on its own thread."""
    while True:
        if shares:
            feedback.setProgress(FIRST + shares[-1] * (LAST - FIRST))
        try:
            process.wait(0.1)
            return
        except subprocess.TimeoutExpired:
            if not feedback.isCanceled():
                continue
        process.terminate()
        try:
            process.wait(_PATIENCE)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
        raise Canceled


def read_features(path):
    """Return the features of a GeoJSON file that the command has written."""
    return json.loads(Path(path).read_text(encoding="utf-8"))["features"]
