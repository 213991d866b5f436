"""One path of moves, lines, cubics and closings, from which every drawing of curves is made."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Literal

import numpy as np
import numpy.typing as npt

from crustline.arrays import FloatArray, IntArray
from crustline.curves import Feature

__all__ = ["CLOSE", "CUBIC", "LINE", "MOVE", "Path"]

#: What leads to a vertex. The numbers are those of `matplotlib.path.Path`.
MOVE, LINE, CUBIC, CLOSE = 1, 2, 4, 79

Verb = Literal["move", "line", "cubic", "close"]
Codes = npt.NDArray[np.uint8]


@dataclass(frozen=True, eq=False)
class Path:
    """Strokes in the plane: each moves to its start, runs along lines and cubics, and may close.

    `matplotlib.path.Path(path.vertices, path.codes)` is the same path there; `svg` and `commands`
    are for all else.

    Attributes
    ----------
    vertices : ndarray of float64, shape (k, 2)
        Where each step leads; a cubic takes three rows, two handles and the end; a closing repeats
        the start of its stroke.
    codes : ndarray of uint8, shape (k,)
        `MOVE`, `LINE`, `CUBIC` (in all three rows) or `CLOSE`.

    Examples
    --------
    >>> Path.through(np.array([(0.0, 0.0), (1.0, 0.0), (0.0, 1.5)]), closed=True).svg()
    'M0 0L1 0L0 1.5Z'
    """

    vertices: FloatArray
    codes: Codes

    @classmethod
    def through(cls, points: FloatArray, closed: bool = False) -> Path:
        """Return the polygon through points (k, 2), k ≥ 1."""
        codes = np.full(len(points) + closed, LINE, np.uint8)
        codes[0] = MOVE
        if closed:
            codes[-1] = CLOSE
            points = np.concatenate([points, points[:1]])
        return cls(points, codes)

    @classmethod
    def through_all(cls, points: FloatArray, starts: IntArray) -> Path:
        """Return open polygons through points (k, 2), a new one at each of the rows `starts`."""
        codes = np.full(len(points), LINE, np.uint8)
        codes[starts] = MOVE
        return cls(points, codes)

    @classmethod
    def beziers(cls, control: FloatArray, closed: bool = False) -> Path:
        """Return cubic Bézier pieces (p, 4, 2), p ≥ 1, each of which starts where another ends."""
        vertices = np.concatenate([control[0, :1], control[:, 1:].reshape(-1, 2)])
        codes = np.full(len(vertices), CUBIC, np.uint8)
        codes[0] = MOVE
        path = cls(vertices, codes)
        return (
            cls.joined([path, cls(vertices[:1], np.array([CLOSE], np.uint8))]) if closed else path
        )

    @classmethod
    def dots(cls, points: FloatArray) -> Path:
        """Return strokes of no length at points (k, 2), which round ends make visible."""
        return cls.through_all(np.repeat(points, 2, axis=0), np.arange(0, 2 * len(points), 2))

    @classmethod
    def of_feature(cls, feature: Feature, coordinates: FloatArray) -> Path:
        """Return the rings, the line or the dots of a feature of curves."""
        if feature.kind == "points":
            return cls.dots(coordinates[feature.parts[0]])
        return cls.joined(
            [cls.through(coordinates[part], feature.closed) for part in feature.parts]
        )

    @classmethod
    def joined(cls, paths: Iterable[Path]) -> Path:
        """Return the strokes of all paths, one after another."""
        every = [cls(np.empty((0, 2)), np.empty(0, np.uint8)), *paths]
        vertices = np.concatenate([path.vertices for path in every])
        return cls(vertices, np.concatenate([path.codes for path in every]))

    def __len__(self) -> int:
        return len(self.codes)

    def commands(self) -> Iterator[tuple[Verb, list[list[float]]]]:
        """Yield each step: its verb, and one vertex, three for a cubic, none for a closing."""
        vertices, row = self.vertices.tolist(), 0
        verbs: dict[int, tuple[Verb, int]] = {
            MOVE: ("move", 1), LINE: ("line", 1), CUBIC: ("cubic", 3), CLOSE: ("close", 0),
        }  # fmt: skip
        codes = self.codes.tolist()
        while row < len(codes):
            verb, count = verbs[codes[row]]
            yield verb, vertices[row : row + count]
            row += max(count, 1)

    def svg(self) -> str:
        """Return the path as the attribute d of SVG; numbers have the fewest digits."""
        letters = np.array(["M", "L", "C", " ", "Z", "h0"])[self._letters()].tolist()
        x, y = (map(_short, each) for each in self.vertices.T.tolist())
        steps = zip(letters, x, y, strict=True)
        return "".join(c if c in ("Z", "h0") else f"{c}{x} {y}" for c, x, y in steps)

    def _letters(self) -> IntArray:
        """Return for each row the number of its letter; a cubic has one at its first handle."""
        line, cubic = self.codes == LINE, self.codes == CUBIC
        later = cubic & ((np.cumsum(cubic) - 1) % 3 > 0)
        still = line & (self.vertices == np.roll(self.vertices, 1, axis=0)).all(axis=1)
        kinds = [still, line, later, cubic, self.codes == CLOSE]
        return np.select(kinds, [5, 1, 3, 2, 4], default=0)


def _short(number: float) -> str:
    """Return the shortest text of a number that gives it again, integers without a point."""
    return repr(number).removesuffix(".0")
