"""Points: coordinates that keep what a file says beside them."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Self

import numpy as np
import numpy.typing as npt

from crustline.arrays import FloatArray, as_points
from crustline.errors import InputError

Column = npt.NDArray[Any]


class Points(np.ndarray[tuple[int, int], np.dtype[np.float64]]):
    """An (n, 2) float64 array of points that carries heights, other columns and a CRS.

    It behaves as the array of its coordinates. What is computed from it (a slice, a sum, a
    transpose) is a plain ndarray, because the rows beside it would no longer fit; a copy or a
    pickle keeps all.

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

    z: FloatArray | None
    columns: dict[str, Column]
    crs: str | None
    names: tuple[str, str]

    def __new__(
        cls,
        coordinates: npt.ArrayLike,
        *,
        z: npt.ArrayLike | None = None,
        columns: Mapping[str, npt.ArrayLike] | None = None,
        crs: str | None = None,
        names: Sequence[str] = ("x", "y"),
    ) -> Self:
        points = np.array(as_points(coordinates)).view(cls)
        n = len(points)
        points.z = None if z is None else _as_heights(z, n)
        points.columns = {
            name: _as_column(name, values, n) for name, values in (columns or {}).items()
        }
        points.crs = crs
        points.names = (str(names[0]), str(names[1]))
        return points

    def __array_finalize__(self, other: npt.NDArray[Any] | None) -> None:
        self.z = None
        self.columns = {}
        self.crs = None
        self.names = ("x", "y")

    def __getitem__(self, key: Any) -> Any:
        return np.asarray(self)[key]

    def __array_ufunc__(self, ufunc: np.ufunc, method: str, *inputs: Any, **kwargs: Any) -> Any:
        out = kwargs.get("out")
        if out is not None:
            kwargs["out"] = tuple(_plain(each) for each in out)
        result = getattr(ufunc, method)(*map(_plain, inputs), **kwargs)
        # `points += 1` must leave the name bound to the Points, not to its bare coordinates.
        return out[0] if out is not None and len(out) == 1 and out[0] is not None else result

    def __array_function__(self, func: Any, types: Any, args: Any, kwargs: Any) -> Any:
        result = super().__array_function__(func, types, args, kwargs)
        return (
            type(result)(map(_plain, result)) if type(result) in (tuple, list) else _plain(result)
        )

    def __reduce__(self) -> tuple[Any, ...]:
        state = (np.asarray(self), self.z, self.columns, self.crs, self.names)
        return _rebuild, (type(self), *state)

    def __reduce_ex__(self, protocol: Any) -> tuple[Any, ...]:
        return self.__reduce__()

    def copy(self, order: Any = "C") -> Self:
        """Return a copy with copies of all that the points carry."""
        columns = {name: column.copy() for name, column in self.columns.items()}
        z = None if self.z is None else self.z.copy()
        copied: Self = _rebuild(type(self), np.asarray(self), z, columns, self.crs, self.names)
        return copied

    def select(self, rows: npt.ArrayLike) -> Self:
        """Return some of the rows, with all that they carry.

        Parameters
        ----------
        rows : array_like of int, shape (k,), or of bool, shape (n,)
            As in NumPy's own indexing.

        Examples
        --------
        >>> points = Points([(0, 0), (3, 4)], z=[7, 8], columns={"name": ["a", "b"]})
        >>> points.select([1]).columns["name"].tolist()
        ['b']
        """
        chosen = np.asarray(rows)
        chosen = chosen if chosen.size else chosen.astype(np.int64)
        columns = {name: column[chosen] for name, column in self.columns.items()}
        z = None if self.z is None else self.z[chosen]
        selected: Self = _rebuild(type(self), self[chosen], z, columns, self.crs, self.names)
        return selected

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
        from crustline.formats import write_points

        write_points(self, path, format=format)

    def __copy__(self) -> Self:
        return self.copy()

    def __deepcopy__(self, memo: Any) -> Self:
        return self.copy()

    def __repr__(self) -> str:
        carried = ["z"] * (self.z is not None) + list(self.columns)
        beside = f", beside them {', '.join(carried)}" if carried else ""
        return f"<Points: {len(self)} rows of {', '.join(self.names)}{beside}; crs {self.crs}>"


def _plain(value: Any) -> Any:
    return value.view(np.ndarray) if isinstance(value, Points) else value


def _rebuild(
    cls: type[Points], coordinates: FloatArray, z: Any, columns: Any, crs: Any, names: Any
) -> Any:
    return cls(coordinates, z=z, columns=columns, crs=crs, names=names)


def _as_heights(z: npt.ArrayLike, n: int) -> FloatArray:
    try:
        heights = np.array(z, dtype=np.float64)
    except (ValueError, TypeError):
        raise InputError("z: the heights are not all numbers: pass one number a row") from None
    if heights.shape != (n,):
        raise InputError(f"z: the shape is {heights.shape}, not ({n},): pass one height a row")
    finite = np.isfinite(heights)
    if not finite.all():
        row = int(np.argmin(finite))
        raise InputError(f"z: row {row} is {heights[row]}, which is not finite: repair the height")
    return heights


def _as_column(name: str, values: npt.ArrayLike, n: int) -> Column:
    column = np.asarray(values)
    if column.shape != (n,):
        raise InputError(
            f"column {name!r}: the shape is {column.shape}, not ({n},): pass one value a row"
        )
    text = column.dtype.kind == "O" and set(map(type, column.tolist())) <= {str}
    if not text and column.dtype.kind not in "biufcSUmM":
        raise InputError(f"column {name!r} holds Python objects: convert it to numbers or text")
    return column


def _returns_plain(name: str) -> Callable[..., Any]:
    method = getattr(np.ndarray, name)

    def plain_method(self: Points, *args: Any, **kwargs: Any) -> Any:
        return method(np.asarray(self), *args, **kwargs)

    plain_method.__name__ = name
    plain_method.__doc__ = f"Return `ndarray.{name}` of the coordinates, as a plain array."
    return plain_method


def _plain_property(name: str) -> property:
    return property(lambda self: getattr(np.asarray(self), name))


# The methods of ndarray that derive another array; without this the result would be a Points that
# lost its columns. `view` stays, since it is how a Points is made.
# fmt: off
_DERIVING = (
    "all", "any", "argmax", "argmin", "argpartition", "argsort", "astype", "byteswap", "choose",
    "clip", "compress", "conj", "conjugate", "cumprod", "cumsum", "diagonal", "dot", "flatten",
    "max", "mean", "min", "nonzero", "prod", "ravel", "repeat", "reshape", "round", "searchsorted",
    "squeeze", "std", "sum", "swapaxes", "take", "trace", "transpose", "var",
)
# fmt: on
for _name in _DERIVING:
    setattr(Points, _name, _returns_plain(_name))
for _name in ("T", "mT", "real", "imag"):
    setattr(Points, _name, _plain_property(_name))
