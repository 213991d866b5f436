"""Clouds of points in space, read piece by piece, and their slices."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any

from crustline.arrays import FloatArray
from crustline.errors import InputError
from crustline.formats.cloud import Chunk
from crustline.slices.band import bands_of, box_of
from crustline.slices.join import joined
from crustline.slices.plane import Plane
from crustline.slices.slice import Slice

__all__ = ["Cloud", "cut_cloud"]


@dataclass(frozen=True, eq=False)
class Cloud:
    """What can be read again and again as pieces of points in space.

    Attributes
    ----------
    name : str
        What messages call it.
    chunks : callable
        Takes a box, least and greatest corner, and yields `Chunk`s; those outside may be left out.
    crs : str or None
        The coordinate reference system.
    """

    name: str
    chunks: Callable[[FloatArray], Iterator[Chunk]]
    crs: str | None = None


def cut_cloud(
    cloud: Cloud,
    planes: Sequence[Plane],
    thickness: Sequence[float],
    *,
    scale: float | None,
    fit: bool,
    threads: int,
    **how: Any,
) -> list[Slice]:
    """Return for each plane the curves through the points near it; none where there are none."""
    bands = bands_of(cloud.chunks(box_of(planes, thickness)), planes, thickness)
    if not any(map(len, bands.points)):
        raise InputError(_said_of_nothing(cloud.name, bands.reach, planes, thickness))

    def cut(number: int) -> Slice:
        size = (scale or thickness[number]) if fit else None
        curves = joined(bands.points[number], size, **how)
        crs = cloud.crs or bands.crs
        return Slice(planes[number], curves, len(bands.points[number]), crs)

    with ThreadPoolExecutor(threads) as pool:
        return list(pool.map(cut, range(len(planes))))


def _said_of_nothing(
    name: str, reach: tuple[float, float], planes: Sequence[Plane], thickness: Sequence[float]
) -> str:
    """Return what is said where no point is near a plane."""
    which = planes[0].name if len(planes) == 1 else f"any of the {len(planes)} planes"
    if reach[0] > reach[1]:
        return f"{name} has no point near {which}: choose another plane"
    return (
        f"{name} has no point within {thickness[0] / 2:g} of {which}, and reaches from "
        f"{reach[0]:.6g} to {reach[1]:.6g} along the normal of {planes[0].name}: choose another "
        "plane"
    )
