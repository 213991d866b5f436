"""Names of columns: which of them are coordinates and heights, as the trades call them."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Sequence

from crustline.errors import FormatError, InputError

__all__ = ["find_coordinates", "find_pair", "plain_name", "quote_all", "refuse_repeated"]

#: Names of x and y, the surest first.
_PAIRS = (
    ("x", "y"),
    ("lon", "lat"),
    ("longitude", "latitude"),
    ("long", "lat"),
    ("lng", "lat"),
    ("easting", "northing"),
    ("east", "north"),
    ("e", "n"),
    ("este", "norte"),
    ("est", "nord"),
    ("ost", "nord"),
    ("rechtswert", "hochwert"),
    ("px", "py"),
    ("col", "row"),
    ("column", "row"),
    ("points 0", "points 1"),
)
#: Names of sections, whose height is the second coordinate.
_SECTIONS = (("x", "z"), ("r", "z"))
_HEIGHTS = (
    "z",
    "elevation",
    "height",
    "elev",
    "altitude",
    "alt",
    "höhe",
    "cota",
    "quota",
    "points 2",
)
_UNIT = re.compile(r"\s*(?:\[[^\]]*\]|\([^)]*\))\s*$")
_BETWEEN = re.compile(r"(?<=[a-z])(?=[A-Z])|[\W_]+")
_COORDINATE = re.compile(r"^([xyz]) ?coord(?:inate)?s?$")
#: Longer names are none of coordinates; looking for units takes the square of their length.
_LONGEST = 100
#: What names of coordinates hold besides.
_PADDING = {
    "point", "coord", "coords", "coordinate", "pos", "position", "utm", "wgs84", "gps", "deg",
    "decimal",
}  # fmt: skip


def find_coordinates(
    names: Sequence[str], chosen: Sequence[str | int] | None, source: str
) -> list[int]:
    """Return the positions of x, y and, if there is one, z among the names of columns."""
    if chosen is not None:
        positions = [_position(each, names, source) for each in chosen]
        if len(set(positions)) < len(positions):
            raise InputError(f"columns is {tuple(chosen)!r}, a column twice: choose different ones")
        return positions
    pair = find_pair(names)
    if pair is None:
        raise FormatError(
            f"{source} has no columns x and y, only {quote_all(names)}: "
            "choose two of them with columns (--columns X,Y)"
        )
    return [*pair, *(k for k in _first_of(_HEIGHTS, names) if k not in pair)]


def find_pair(names: Sequence[str]) -> tuple[int, int] | None:
    """Return the positions of the first known pair of names, as they are or less their padding."""
    return next(filter(None, map(_pair_among, _spellings(names))), None)


def _pair_among(spelled: list[str]) -> tuple[int, int] | None:
    where = {name: k for k, name in enumerate(spelled)}
    for x, y in (*_PAIRS, *_SECTIONS):
        # Two of a name, such as X_UTM and X_WGS, are for the user to choose from.
        if x in where and y in where and spelled.count(x) == spelled.count(y) == 1:
            return where[x], where[y]
    return None


def is_section(names: Sequence[str], pair: Sequence[int]) -> bool:
    """Return whether a pair of columns is one of a section, such as x and z."""
    return tuple(plain_name(names[k]) for k in pair) in _SECTIONS


def plain_name(name: str) -> str:
    """Return a name in lower case, without units, marks, and words such as coordinate.

    >>> [plain_name(name) for name in ("X [m]", "POINT_X", "xcoord", "decimalLongitude")]
    ['x', 'x', 'x', 'longitude']
    """
    if len(name) > _LONGEST:
        return name
    words = _BETWEEN.sub(" ", _UNIT.sub("", name)).lower().split()
    kept = [word for word in words if word not in _PADDING] or words
    return _COORDINATE.sub(r"\1", " ".join(kept))


def refuse_repeated(names: Sequence[str], source: str) -> None:
    """Refuse names of which one is there more than once."""
    name, count = Counter(names).most_common(1)[0] if names else ("", 1)
    if count > 1:
        raise FormatError(
            f"{source} has the column {name!r:.60} more than once: rename one of them"
        )


def quote_all(names: Sequence[str]) -> str:
    """Return names as a message lists them; a long list, and a long name, is cut."""
    shown = ", ".join(f"{name!r:.40}" for name in names[:12])
    return shown + (f" and {len(names) - 12} more" if len(names) > 12 else "")


def apart(names: Sequence[str]) -> list[str]:
    """Return names of which no two differ by their case alone; a later one becomes input_NAME."""
    taken: dict[str, str] = {}
    for name in names:
        free = name
        while free.lower() in taken:
            free = f"input_{free}"
        taken[free.lower()] = free
    return list(taken.values())


def _first_of(wanted: Sequence[str], names: Sequence[str]) -> list[int]:
    for spelled in _spellings(names):
        found = [spelled.index(name) for name in wanted if name in spelled]
        if found:
            return found[:1]
    return []


def _spellings(names: Sequence[str]) -> Iterator[list[str]]:
    """Yield the names as they are, in lower case, and less their padding, the last if need be."""
    yield list(names)
    yield [name.strip().lower() for name in names]
    yield [plain_name(name) for name in names]


def _position(chosen: str | int, names: Sequence[str], source: str) -> int:
    if isinstance(chosen, str):
        if chosen in names:
            return list(names).index(chosen)
        lower = [name.lower() for name in names]
        if lower.count(chosen.lower()) == 1:
            return lower.index(chosen.lower())
        if chosen.isdecimal():
            chosen = int(chosen)
    if isinstance(chosen, int) and 0 <= chosen < len(names):
        return chosen
    raise FormatError(
        f"{source} has no column {chosen!r:.40}: choose from {quote_all(names)}, "
        f"or a position from 0 to {len(names) - 1}"
    )
