"""The curves of the experiment."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from figures.curves import HOOK, LEAF, PEAR

from crustline import shapes


def families() -> dict[str, list[shapes.SmoothCurve]]:
    """Return the curves of the experiment, of one or more components, by family."""
    return {
        "ellipses": [shapes.ellipse(a, 1) for a in (1.1, 1.5, 2, 3, 4, 6)],
        "stadiums": [shapes.stadium(length, 1) for length in (1, 2, 4, 8)],
        "trefoils": [shapes.trefoil(k, d) for k in (2, 3, 4, 5, 6) for d in (0.1, 0.3)],
        "superformulas": [
            shapes.superformula(m, n1, n, n)
            for m, n1, n in ((2, 3, 4), (4, 4, 4), (4, 8, 6), (6, 3, 3), (6, 6, 3), (8, 5, 4))
        ],
        "blobs": [
            shapes.blob(k, harmonics=3 + k % 6, roughness=0.2 + 0.05 * (k % 7)) for k in range(40)
        ],
        "bent strips": [_bent(rows, k) for rows in (HOOK, LEAF, PEAR) for k in range(4)],
        "compound curves": [_pair(k) for k in range(10)] + [_nested(k) for k in range(6)],
    }


def _bent(rows: Sequence[tuple[float, float]], seed: int) -> shapes.SmoothCurve:
    """Return a spline through control points, moved a little for all seeds but 0."""
    shift = np.random.default_rng(seed).normal(0, 0.07, (len(rows), 2))
    return shapes.spline(np.array(rows) + (shift if seed else 0))


def _pair(seed: int) -> shapes.SmoothCurve:
    """Return two blobs side by side, with a gap that may be narrow."""
    rng = np.random.default_rng(seed)
    left, right = (shapes.blob(100 + 2 * seed + k, harmonics=4) for k in range(2))
    t = np.linspace(0, 1, 500)
    gap = rng.uniform(0.1, 0.6)
    step = left.point(t)[:, 0].max() - right.point(t)[:, 0].min() + gap
    return left + right.moved(offset=(step, rng.uniform(-0.5, 0.5)))


def _nested(seed: int) -> shapes.SmoothCurve:
    """Return an ellipse with a smaller, turned one inside."""
    rng = np.random.default_rng(seed)
    inner = shapes.ellipse(rng.uniform(0.5, 1.2), rng.uniform(0.2, 0.5))
    return shapes.ellipse(2, 1.5) + inner.moved(
        angle=rng.uniform(0, math.pi), offset=rng.uniform(-0.2, 0.2, 2)
    )


def measured_curves() -> dict[str, shapes.SmoothCurve]:
    """Return the curves on which errors are measured."""
    return {
        "circle": shapes.circle(),
        "ellipse 1.1:1": shapes.ellipse(1.1, 1),
        "ellipse 2:1": shapes.ellipse(2, 1),
        "ellipse 6:1": shapes.ellipse(6, 1),
        "stadium 2": shapes.stadium(2, 1),
        "trefoil": shapes.trefoil(3, 0.3),
        "superformula": shapes.superformula(6, 6, 3, 3),
        **{f"blob {k}": shapes.blob(k) for k in (1, 3, 5, 7)},
    }
