"""Slices: the curves in planes, and the same curves in space."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, overload

import numpy as np

from crustline.arrays import IntArray
from crustline.curves import Curves
from crustline.formats import write
from crustline.formats.catalog import format_of_target
from crustline.formats.format import Format
from crustline.formats.target import Target
from crustline.points import Points
from crustline.records import Record
from crustline.slices.plane import Plane

__all__ = ["Slice", "Slices", "layered"]


@dataclass(frozen=True, eq=False)
class Slice(Record):
    """The curves in which a plane cuts something.

    Attributes
    ----------
    plane : Plane
        The plane.
    curves : Curves
        The curves in plane coordinates, those across and up; x and y if the plane is horizontal.
    count : int
        How many points of a cloud are near the plane; of a mesh, how many segments were cut.
    crs : str or None
        The coordinate reference system of what was cut.
    """

    plane: Plane
    curves: Curves
    count: int
    crs: str | None = None

    @property
    def name(self) -> str:
        """What its layer is called."""
        return self.plane.name

    @cached_property
    def in_space(self) -> Curves:
        """The same curves with x, y and z in place of plane coordinates, and a column slice."""
        xyz = self.plane.lift(self.curves.points.xy)
        points = Points(
            xyz[:, :2],
            z=xyz[:, 2],
            columns={"slice": np.full(len(xyz), self.name), **self.curves.points.columns},
            crs=self.crs,
        )
        return replace(self.curves, points=points, shells=self.curves._shells)

    def __repr__(self) -> str:
        return f"<Slice {self.name}: {repr(self.curves)[9:-1]}>"


@dataclass(frozen=True, eq=False)
class Slices(Record, Sequence[Slice]):
    """Several slices, in the order of their planes; a sequence of `Slice`.

    Attributes
    ----------
    slices : tuple of Slice
        Those that hold anything.
    empty : tuple of str
        The names of the planes that hold nothing.
    """

    slices: tuple[Slice, ...]
    empty: tuple[str, ...] = ()

    @overload
    def __getitem__(self, key: int) -> Slice: ...
    @overload
    def __getitem__(self, key: slice) -> Sequence[Slice]: ...
    def __getitem__(self, key: int | slice) -> Slice | Sequence[Slice]:
        return self.slices[key]

    def __len__(self) -> int:
        return len(self.slices)

    def __iter__(self) -> Iterator[Slice]:
        return iter(self.slices)

    def curves(self, *, flat: bool = False) -> Mapping[str, Curves]:
        """Return the curves by the names of their slices, in space, or in plane coordinates."""
        return {each.name: each.curves if flat else each.in_space for each in self}

    def write(
        self,
        path: str | os.PathLike[str],
        *,
        format: str | None = None,
        flat: bool = False,
        **options: Any,
    ) -> None:
        """Write all slices to one file, whole or not at all.

        A single slice is written as any curves are. Several are a layer each in formats that have
        layers (DXF, GeoPackage, KML), and else one after another; the column slice says which.

        Parameters
        ----------
        path, format, **options
            As for `crustline.write`.
        flat : bool, default False
            Whether to write plane coordinates in place of x, y and z.
        """
        by_name = self.curves(flat=flat)
        chosen = format_of_target(Target(path), format, "write_curves")
        write(layered(by_name, chosen)[0], path, format=chosen.name, **options)

    def __repr__(self) -> str:
        some = f", {len(self.empty)} empty" if self.empty else ""
        return f"<Slices: {len(self)} of {len(self) + len(self.empty)} planes{some}>"


def layered(curves: Mapping[str, Curves], format: Format) -> tuple[Any, str]:
    """Return what a format writes of curves by their names, and its task: layers, or all as one."""
    if len(curves) > 1 and format.can("write_layers"):
        return curves, "write_layers"
    return _end_to_end(list(curves.values())), "write_curves"


def _end_to_end(curves: Sequence[Curves]) -> Curves:
    """Return curves as one: the points of each after those of the others."""
    if len(curves) == 1:
        return curves[0]
    rows = np.cumsum([0, *(len(each.points) for each in curves[:-1])])
    ends = np.cumsum([0, *(len(each.indices) for each in curves[:-1])])
    numbers = np.cumsum([0, *(len(each) for each in curves[:-1])])

    def moved(arrays: Iterable[IntArray], by: IntArray) -> IntArray:
        return np.concatenate([each + k for each, k in zip(arrays, by, strict=True)])

    shells = [each._shells for each in curves]
    return Curves(
        _points_end_to_end([each.points for each in curves]),
        moved((each.indices for each in curves), rows),
        np.append(0, moved((each.offsets[1:] for each in curves), ends)),
        np.concatenate([each.closed for each in curves]),
        moved((each.isolated for each in curves), rows),
        orient=curves[0].orient,
        shells=np.where(np.concatenate(shells) < 0, -1, moved(shells, numbers)),
    )


def _points_end_to_end(points: Sequence[Points]) -> Points:
    first = points[0]
    z = None if first.z is None else np.concatenate([each.z for each in points])
    columns = {
        name: np.concatenate([each.columns[name] for each in points]) for name in first.columns
    }
    xy = np.concatenate([each.xy for each in points])
    return Points(xy, z=z, columns=columns, crs=first.crs)
