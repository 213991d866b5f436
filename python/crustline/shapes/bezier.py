"""Loops of cubic Bézier pieces, and joints made smooth."""

from __future__ import annotations

import math
from functools import partial

import numpy as np

from crustline.arrays import FloatArray
from crustline.errors import InputError
from crustline.shapes.curve import Loop, Three, refuse_extent, unit


def bezier_loop(control: FloatArray) -> Loop:
    """Return the loop of cubic pieces with control points (s, 4, 2), each a share 1/s of u."""
    first = 3 * len(control) * np.diff(control, axis=1)
    second = 2 * len(control) * np.diff(first, axis=1)
    return Loop(partial(_cubics, control, first, second), pieces=len(control))


def _cubics(control: FloatArray, first: FloatArray, second: FloatArray, u: FloatArray) -> Three:
    s = len(control)
    row = np.minimum((u * s).astype(np.int64), s - 1)
    v = (u * s - row)[:, None]
    w = 1 - v
    c, d, e = control[row], first[row], second[row]
    p = w**3 * c[:, 0] + 3 * v * w * (w * c[:, 1] + v * c[:, 2]) + v**3 * c[:, 3]
    return p, w * w * d[:, 0] + 2 * v * w * d[:, 1] + v * v * d[:, 2], w * e[:, 0] + v * e[:, 1]


def smoothed(control: FloatArray, tolerance: float, name: str) -> FloatArray:
    """Return control points with handles exactly opposite at each joint; refuse corners."""
    refuse_extent(control.reshape(-1, 2))
    size = float(np.ptp(control.reshape(-1, 2), axis=0).max())
    gap = np.abs(np.roll(control[:, 0], -1, axis=0) - control[:, 3]).max(axis=1)
    if np.any(gap > 1e-9 * size):
        x, y = control[int(np.argmax(gap)), 3]
        raise InputError(f"{name} is open at ({x:g}, {y:g}): close it with Z, or leave it out")
    out = control.copy()
    out[:, 3] = np.roll(control[:, 0], -1, axis=0)
    ahead, behind = out[:, 1] - out[:, 0], np.roll(out[:, 3] - out[:, 2], 1, axis=0)
    length = np.stack([np.hypot(*ahead.T), np.hypot(*behind.T)])
    if not np.all(length > 0):
        x, y = out[int(np.argmin(length.min(axis=0))), 0]
        raise InputError(
            f"{name} has a handle of length zero at ({x:g}, {y:g}): give it a direction"
        )
    turn = np.abs(np.arctan2(_cross(behind, ahead), np.sum(behind * ahead, axis=1)))
    if np.any(turn > tolerance):
        row = int(np.argmax(turn))
        x, y = out[row, 0]
        raise InputError(
            f"{name} has a corner of {math.degrees(turn[row]):.3g}° at ({x:g}, {y:g}): round it"
        )
    mean = unit(unit(ahead) + unit(behind))
    out[:, 1] = out[:, 0] + length[0][:, None] * mean
    out[:, 2] = out[:, 3] - np.roll(length[1][:, None] * mean, -1, axis=0)
    return out


def _cross(v: FloatArray, w: FloatArray) -> FloatArray:
    return np.asarray(v[:, 0] * w[:, 1] - v[:, 1] * w[:, 0])
