"""Any number of rings whose every sample is a formula of its row: made and checked in pieces."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from math import gcd, isqrt

import numpy as np

from crustline.arrays import FloatArray, IntArray

#: Samples of a ring.
IN_RING = 500
_GOLDEN = (5**0.5 - 1) / 2


@dataclass(frozen=True)
class Rings:
    """Rings with lobes, each in its cell of side 1, far denser than their distance.

    The rows are shuffled: successive ones are samples of rings far apart, as row r is the sample
    r · step of all, modulo their number.

    Attributes
    ----------
    count : int
        How many rings.
    """

    count: int

    @property
    def points(self) -> int:
        """How many samples there are."""
        return self.count * IN_RING

    @property
    def step(self) -> int:
        """A number near the golden section of `points`, and prime to it."""
        step = max(1, int(self.points * _GOLDEN))
        while gcd(step, self.points) > 1:
            step += 1
        return step

    def samples(self, rows: IntArray) -> IntArray:
        """Return which sample each row is: those of a ring follow one another around it."""
        return rows * self.step % self.points

    def xy(self, rows: IntArray) -> FloatArray:
        """Return the coordinates of rows, shape (k, 2); steps along a ring vary by a tenth."""
        samples = self.samples(rows)
        ring, place = np.divmod(samples, IN_RING)
        angle = (place + 0.1 * (samples * _GOLDEN % 1)) * (2 * np.pi / IN_RING)
        phase = 2 * np.pi * (ring * _GOLDEN % 1)
        radius = 0.3 * (1 + 0.25 * np.sin((2 + ring % 4) * angle + phase))
        center = np.stack(np.divmod(ring, isqrt(self.count - 1) + 1), axis=1) + 0.5
        found: FloatArray = center + radius[:, None] * np.stack(
            [np.cos(angle), np.sin(angle)], axis=1
        )
        return found

    def missing(self, edges: Iterable[IntArray]) -> int:
        """Return how many edges of the rings are not among `edges`, or raise for any other edge."""
        left = np.ones(self.points, bool)
        for part in edges:
            low, high = np.sort(self.samples(part), axis=1).T
            closing = high - low == IN_RING - 1
            starts = np.where(closing, high, low)
            steps = (high - low == 1) | closing
            if not (steps & (low // IN_RING == high // IN_RING)).all() or not left[starts].all():
                raise AssertionError("an edge that no ring has, or has once")
            left[starts] = False
        return int(np.count_nonzero(left))
