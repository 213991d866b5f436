"""What is printed where the encoding lacks some of its characters, such as a Windows pipe."""

from __future__ import annotations

import codecs
import io
import sys

__all__ = ["spell_out"]

_SPELLED = {
    "α": "alpha", "β": "beta", "γ": "gamma", "δ": "delta", "ε": "epsilon", "θ": "theta",
    "π": "pi", "ρ": "rho", "σ": "sigma", "…": "...", "≤": "<=", "≥": ">=", "·": "*", "×": "x",
    "→": "->", "–": "-", "—": "-", "°": " deg", "’": "'", "“": '"', "”": '"',
}  # fmt: skip


def spell_out() -> None:
    """Let standard output and error spell out what their encoding lacks: beta for β, ? for most."""
    codecs.register_error("crustline.spelled", _spelled)
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="crustline.spelled")


def _spelled(error: UnicodeError) -> tuple[str, int]:
    if not isinstance(error, UnicodeEncodeError):
        raise error
    lacking = error.object[error.start : error.end]
    return "".join(_SPELLED.get(each, "?") for each in lacking), error.end
