"""Pack the plugin into the zip that QGIS installs: python integrations/qgis/pack.py dist/qgis."""

from __future__ import annotations

import re
import sys
import zipfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
PLUGIN = "crustline_processing"
#: Zip files begin their time then; the same files give the same bytes.
_TIME = (1980, 1, 1, 0, 0, 0)


def version() -> str:
    """Return the version of the library, which is the plugin's."""
    text = (HERE.parents[1] / "Cargo.toml").read_text(encoding="utf-8")
    found = re.search(r'^version = "(.+)"$', text, re.MULTILINE)
    assert found is not None
    return found[1]


def pack(folder: Path) -> Path:
    """Write the zip into a folder, and return its path."""
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"{PLUGIN}-{version()}.zip"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for each in sorted((HERE / PLUGIN).rglob("*")):
            if each.is_file() and "__pycache__" not in each.parts:
                content = each.read_bytes()
                if each.name == "metadata.txt":
                    content = content.replace(b"version=0.0.0", f"version={version()}".encode())
                archive.writestr(zipfile.ZipInfo(each.relative_to(HERE).as_posix(), _TIME), content)
    return path


if __name__ == "__main__":
    print(pack(Path(sys.argv[1])))
