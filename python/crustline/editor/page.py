"""Where the built page is."""

from __future__ import annotations

from pathlib import Path

from crustline.errors import CrustlineError

_FOLDER = Path(__file__).parent / "static"


def built(name: str) -> Path:
    """Return the path of a part of the built front end, or say what builds it."""
    path = _FOLDER / name
    if not path.exists():
        raise CrustlineError(
            "the editor's page is not built: run make editor in crustline's source folder"
        )
    return path
