"""Numbers as text spells them: exponents, decimal marks, thousands marks, degrees, hemispheres."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from typing import Literal

import numpy as np

from crustline.arrays import FloatArray

__all__ = ["MISSING", "Mark", "decimal_mark", "looks_numeric", "parse", "parse_all"]

Mark = Literal[".", ","]

#: What stands for a value that is not there.
MISSING = frozenset(["", "nan", "na", "n/a", "null", "none", "nil", "-", "--", "?", "<na>", "#n/a"])

_GROUPS = "'’ \u00a0\u2009\u202f"  # apostrophes and spaces between groups of three digits
_DIGITS = (
    rf"(?:\d{{1,3}}(?:[{_GROUPS}]\d{{3}})+|\d{{1,3}}(?:,\d{{3}})+|\d{{1,3}}(?:\.\d{{3}})+|\d+)"
)
_SIGN = r"[+\-−]?"
_NUMBER = re.compile(
    rf"{_SIGN}(?:{_DIGITS}(?:\.\d*|,\d+)?|[.,]\d+)(?:[eEdD][+-]?\d+)?|{_SIGN}inf(?:inity)?",
    re.IGNORECASE,
)
# Few digits each, and a mark between them: else a long row of digits could be cut in too many ways.
_PART = r"\d{1,3}(?:[.,]\d{0,20})?"
_ANGLE = re.compile(
    rf"(?P<before>[NSEWO])?\s*(?P<sign>{_SIGN})(?P<degrees>{_PART})"
    rf"(?:(?:\s*[°º:d]\s*|\s+)(?P<minutes>{_PART})"
    rf"(?:(?:\s*['’′:m]\s*|\s+)(?P<seconds>{_PART}))?)?"
    r"(?:\s*(?:[°º'’′\"”″]|''))?\s*(?P<after>[NSEWO])?",
    re.IGNORECASE,
)
_AMBIGUOUS = re.compile(rf"{_SIGN}[1-9]\d{{0,2}},\d{{3}}")
_GROUPED = re.compile(rf"{_SIGN}\d{{1,3}}(?:,\d{{3}})+(?:\.\d*)?")

# What spells the same number otherwise, character by character.
_USUAL = {".": str.maketrans("Dd−", "ee-"), ",": str.maketrans("Dd−,", "ee-.")}


def looks_numeric(cell: str) -> bool:
    """Return whether a cell is a number in any spelling, or an angle on the globe."""
    cell = cell.strip()
    return _NUMBER.fullmatch(cell) is not None or _is_angle(cell)


def decimal_mark(cells: Iterable[str]) -> Mark | None:
    """Return the decimal mark of cells that are numbers; None if it cannot be told.

    A comma before three digits may be either mark; any other number tells.
    """
    doubtful = pointed = False
    for cell in cells:
        pointed = pointed or "." in cell
        if "," in cell and _NUMBER.fullmatch(cell.strip()):
            if _AMBIGUOUS.fullmatch(cell.strip()):
                doubtful = True
            else:
                return "." if _GROUPED.fullmatch(cell.strip()) else ","
    return None if doubtful and not pointed else "."


def parse_all(cells: Sequence[str], mark: Mark) -> tuple[FloatArray, int | None]:
    """Return numbers, NaN for what is missing, and the position of the first cell that is none."""
    joined = "\n".join(cells)
    # Python, unlike every file format, reads 1_000 as a number; a quoted cell may hold two lines.
    plain = "_" not in joined and joined.count("\n") == len(cells) - 1
    if plain and not (mark == "," and "." in joined):
        usual = joined.translate(_USUAL[mark]).split("\n")
        try:
            return np.array(usual, dtype=np.object_).astype(np.float64), None
        except ValueError:
            pass
    numbers = np.full(len(cells), np.nan)
    for row, cell in enumerate(cells):
        try:
            numbers[row] = parse(cell, mark)
        except ValueError:
            return numbers, row
    return numbers, None


def parse(cell: str, mark: Mark = ".") -> float:
    """Return the number that a cell spells; NaN if it says that there is none.

    >>> parse("0.6D+03"), parse("1.234,5", ","), parse("40°30'N"), parse("73.5 W")
    (600.0, 1234.5, 40.5, -73.5)
    """
    cell = cell.strip()
    if cell.lower() in MISSING:
        return np.nan
    if _NUMBER.fullmatch(cell):
        return float(_plain(cell, mark))
    if _is_angle(cell):
        return _angle(cell, mark)
    raise ValueError(cell)


def _plain(number: str, mark: Mark) -> str:
    """Return a number as Python spells it, without marks of thousands, which go by threes."""
    other = "," if mark == "." else "."
    number = number.replace("−", "-").translate({ord(each): None for each in _GROUPS})
    whole, point, rest = number.partition(mark)
    if re.fullmatch(rf"[+-]?\d{{1,3}}(?:\{other}\d{{3}})+", whole):
        whole = whole.replace(other, "")
    return re.sub("[dD]", "e", f"{whole}{'.' if point else ''}{rest}")


def _is_angle(cell: str) -> bool:
    """Return whether a cell has a sign of degrees, or the letter of a hemisphere at one end."""
    match = _ANGLE.fullmatch(cell)
    if match is None or (match["before"] and match["after"]):
        return False
    if match["before"]:
        return re.search("[°º.,:'′]", cell) is not None  # E212 is a name
    return bool(match["after"]) or re.search("[°º]", cell) is not None


def _angle(cell: str, mark: Mark) -> float:
    match = _ANGLE.fullmatch(cell)
    assert match is not None
    letter = (match["before"] or match["after"] or "").upper()
    parts = [float(_plain(match[name] or "0", mark)) for name in ("degrees", "minutes", "seconds")]
    # O is west in Romance languages and east in German.
    if letter == "O" or (letter and match["sign"]) or max(parts[1:]) >= 60:
        raise ValueError(cell)
    size = parts[0] + parts[1] / 60 + parts[2] / 3600
    return -size if letter in ("S", "W") or match["sign"] in ("-", "−") else size
