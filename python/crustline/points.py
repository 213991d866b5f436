"""Points: coordinates that keep what a file says beside them."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import Any

import numpy as np
import numpy.typing as npt

from crustline.arrays import FloatArray, as_floats, as_points, as_rows, equal, read_only
from crustline.errors import InputError, shown
from crustline.notebook import table

Column = npt.NDArray[Any]

_NO_COLUMNS: Mapping[str, Column] = MappingProxyType({})
_X_Y = ("x", "y")


class Points:
    """Points of the plane, with heights, other columns and a CRS beside them; none of it changes.

    Every function of crustline takes them in place of an array, and ``numpy.asarray(points)`` is
    `xy`. They are indexed and iterated as `xy` is; arithmetic is that of ``points.xy``.

    Parameters
    ----------
    coordinates : array_like of float, shape (n, 2)
        Coordinates, in any one unit. Finite. They are copied.
    z : array_like of float, shape (n,), optional
        Heights. Finite.
    columns : mapping of str to array_like, shape (n,), optional
        The other columns by name, in the order of the input: numbers, text (of dtype str, or
        objects that are all str) or dates.
    crs : str, optional
        The coordinate reference system, such as "EPSG:4326".
    names : pair of str, default ("x", "y")
        What the input calls the two coordinate columns.

    Attributes
    ----------
    xy : ndarray of float64, shape (n, 2)
        The coordinates.
    z : ndarray of float64, shape (n,), or None
        The heights.
    columns : mapping of str to ndarray, shape (n,)
        The other columns. All arrays are read-only.
    crs : str or None
        The coordinate reference system.
    names : tuple of str
        What the input calls x and y.

    Raises
    ------
    InputError
        If the coordinates, the heights or a column do not fit; the message names the first row at
        fault.

    Examples
    --------
    >>> points = Points([(0, 0), (3, 4)], z=[7, 8], columns={"name": ["a", "b"]}, crs="EPSG:25832")
    >>> points.z
    array([7., 8.])
    >>> points[1]
    array([3., 4.])
    """

    __slots__ = ("columns", "crs", "names", "xy", "z")

    xy: FloatArray
    z: FloatArray | None
    columns: Mapping[str, Column]
    crs: str | None
    names: tuple[str, str]

    def __init__(
        self,
        coordinates: npt.ArrayLike,
        *,
        z: npt.ArrayLike | None = None,
        columns: Mapping[str, npt.ArrayLike] | None = None,
        crs: str | None = None,
        names: Sequence[str] = _X_Y,
    ) -> None:
        xy = read_only(np.array(as_points(coordinates)))
        self._set(
            xy=xy,
            z=None if z is None else _as_heights(z, len(xy)),
            columns=_NO_COLUMNS if columns is None else _as_columns(columns, len(xy)),
            crs=as_crs(crs),
            names=_X_Y if names is _X_Y else _as_names(names),
        )

    def _set(self, **values: object) -> None:
        for name, value in values.items():
            object.__setattr__(self, name, value)

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f"points do not change: make others with replace({name}=…)")

    def __delattr__(self, name: str) -> None:
        raise AttributeError("points do not change")

    def __len__(self) -> int:
        return len(self.xy)

    def __getitem__(self, key: Any) -> Any:
        return self.xy[key]

    def __iter__(self) -> Iterator[FloatArray]:
        return iter(self.xy)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> npt.NDArray[Any]:
        """Return the coordinates."""
        return np.array(self.xy, dtype=dtype, copy=copy)

    def __eq__(self, other: object) -> bool:
        """Whether coordinates and all that is beside them are equal, NaN to NaN."""
        if not isinstance(other, Points):
            return NotImplemented
        return all(equal(getattr(self, name), getattr(other, name)) for name in self.__slots__)

    __hash__ = None  # type: ignore[assignment]

    def __copy__(self) -> Points:
        return self

    def __deepcopy__(self, memo: object) -> Points:
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        return _rebuild, (self.xy, self.z, dict(self.columns), self.crs, self.names)

    def select(self, rows: npt.ArrayLike) -> Points:
        """Return some of the rows, with all that they carry.

        Parameters
        ----------
        rows : array_like of int, shape (k,), or of bool, shape (n,)
            Which rows, in which order, or whether each is one of them.

        Raises
        ------
        InputError
            If they are no rows of the points.

        Examples
        --------
        >>> points = Points([(0, 0), (3, 4)], z=[7, 8], columns={"name": ["a", "b"]})
        >>> points.select([1]).columns["name"].tolist()
        ['b']
        """
        chosen = as_rows(rows, len(self))
        columns = {name: column[chosen] for name, column in self.columns.items()}
        z = None if self.z is None else self.z[chosen]
        return _rebuild(self.xy[chosen], z, columns, self.crs, self.names)

    def replace(self, **changes: Any) -> Points:
        """Return the points with other `z`, `columns`, `crs` or `names`.

        Examples
        --------
        >>> Points([(8.5, 47.4)], names=("lon", "lat")).replace(crs="EPSG:4326")
        <Points: 1 row of lon, lat; crs EPSG:4326>
        """
        if changes.keys() == {"crs"}:  # read from files they would be copied twice
            return _rebuild(self.xy, self.z, dict(self.columns), as_crs(changes["crs"]), self.names)
        kept = {name: getattr(self, name) for name in self.__slots__ if name != "xy"}
        return Points(self.xy, **(kept | changes))

    def write(self, path: str | os.PathLike[str], *, format: str | None = None) -> None:
        """Write the points to a file, whole or not at all, so that `crustline.read` gets them back.

        Parameters
        ----------
        path : path-like
            The file, which is replaced if it exists; "-" is standard output.
        format : {"csv", "tsv", "xyz", "npy", "npz", "geojson", "wkt", "svg"}, optional
            By default the suffix decides.

        Raises
        ------
        FormatError
            If the file cannot be written; nothing is left behind then.
        InputError
            If the format is unknown.

        Notes
        -----
        Coordinates are written with the fewest digits that give the same float64 again. CSV, TSV,
        NPZ and GeoJSON (a Point feature a row) keep heights and columns, NPZ and GeoJSON the CRS,
        too; XYZ and NPY keep heights; WKT (a MULTIPOINT) keeps heights and the SRID of an EPSG
        code; SVG is a picture, of dots.

        Examples
        --------
        >>> points = Points([(0, 0), (3, 4)], z=[7, 8], columns={"name": ["a", "b"]})
        >>> points.write("-", format="csv")
        x,y,z,name
        0.0,0.0,7.0,a
        3.0,4.0,8.0,b
        """
        from crustline.formats import write

        write(self, path, format=format)

    def _repr_html_(self) -> str:
        """Return the table that notebooks show: the first and the last rows."""
        shown = [*range(min(len(self), 5)), *range(max(5, len(self) - 5), len(self))]
        beside = {"z": self.z} if self.z is not None else {}
        beside |= self.columns
        rows = [(row, *self.xy[row], *(each[row] for each in beside.values())) for row in shown]
        return table(repr(self).strip("<>"), ["row", *self.names, *beside], rows)

    def __repr__(self) -> str:
        carried = ["z"] * (self.z is not None) + list(self.columns)
        beside = f", beside them {', '.join(carried)}" if carried else ""
        rows = f"{len(self):,} row{'s' * (len(self) != 1)} of {', '.join(self.names)}"
        return f"<Points: {rows}{beside}; crs {self.crs}>"


def as_carried(points: Any) -> Points:
    """Return what a caller gives as points, with all that it carries: frames and tables, too."""
    if isinstance(points, Points):
        return points
    if _is_table(points):
        from crustline.formats.objects import points_of_object

        return points_of_object(points)
    return Points(points)


def as_coordinates(points: Any) -> FloatArray:
    """Return the coordinates of what a caller gives as points: the caller's own where they fit."""
    # Of an array nothing has to be asked, which counts where points are few.
    if type(points) is not np.ndarray and (isinstance(points, Points) or _is_table(points)):
        return as_carried(points).xy
    return as_points(points)


def _is_table(points: Any) -> bool:
    return hasattr(points, "__arrow_c_stream__") or hasattr(points, "geom_type")


def own_points(
    xy: FloatArray,
    *,
    z: FloatArray | None = None,
    columns: Mapping[str, Column] | None = None,
    crs: str | None = None,
) -> Points:
    """Return points of arrays that nobody else holds: checked as `Points` does, but not copied."""
    xy = as_points(xy)
    beside = {name: _as_column(name, each, len(xy), np.asarray) for name, each in
              (columns or {}).items()}  # fmt: skip
    heights = None if z is None else _as_finite(np.asarray(z, dtype=np.float64), len(xy))
    return _rebuild(xy, heights, beside, as_crs(crs), _X_Y)


def _rebuild(
    xy: FloatArray,
    z: FloatArray | None,
    columns: dict[str, Column],
    crs: str | None,
    names: tuple[str, str],
) -> Points:
    """Return Points of arrays that fit already and that no one else holds."""
    points = object.__new__(Points)
    frozen = {name: read_only(column) for name, column in columns.items()}
    points._set(
        xy=read_only(xy),
        z=None if z is None else read_only(z),
        columns=MappingProxyType(frozen),
        crs=crs,
        names=names,
    )
    return points


def _as_heights(z: npt.ArrayLike, n: int) -> FloatArray:
    return _as_finite(as_floats("z", z), n)


def _as_finite(heights: FloatArray, n: int) -> FloatArray:
    if heights.shape != (n,):
        raise InputError(f"z: the shape is {heights.shape}, not ({n},): pass one height a row")
    finite = np.isfinite(heights)
    if not finite.all():
        row = int(np.argmin(finite))
        raise InputError(f"z: row {row} is {heights[row]}, which is not finite: repair the height")
    return read_only(heights)


def _as_columns(columns: object, n: int) -> Mapping[str, Column]:
    if not isinstance(columns, Mapping):
        raise InputError(f"columns is {shown(columns)}, not a mapping: pass {{name: values}}")
    for name in columns:
        if not isinstance(name, str):
            raise InputError(f"columns: the name {shown(name)} is not text: pass names of type str")
    return MappingProxyType({name: _as_column(name, each, n) for name, each in columns.items()})


def _as_column(
    name: str, values: npt.ArrayLike, n: int, taken: Callable[..., Column] = np.array
) -> Column:
    try:
        column = taken(values)
    except (ValueError, TypeError, OverflowError):
        raise InputError(f"column {shown(name)} is not one value a row: pass a flat list") from None
    if column.shape != (n,):
        raise InputError(
            f"column {shown(name)}: the shape is {column.shape}, not ({n},): pass one value a row"
        )
    text = column.dtype.kind == "O" and set(map(type, column.tolist())) <= {str}
    if not text and column.dtype.kind not in "biufcSUmM":
        raise InputError(
            f"column {shown(name)} holds Python objects: convert it to numbers or text"
        )
    return read_only(column)


def as_crs(crs: object) -> str | None:
    """Return a CRS that is text, or None."""
    if crs is None or (isinstance(crs, str) and crs.strip()):
        return crs
    is_code = isinstance(crs, int) and 0 < crs < 10**6
    advice = f"EPSG:{crs}" if is_code else "EPSG:4326"
    raise InputError(f"crs is {shown(crs)}, not text: write it as crs={advice!r}")


def _as_names(names: object) -> tuple[str, str]:
    match names:
        case str() | bytes():
            pass
        case [str(x), str(y)] if x != y:
            return x, y
    raise InputError(f"names is {shown(names)}: pass two different names, such as ('x', 'y')")
