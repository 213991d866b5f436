"""The accessor of GeoDataFrames: ``import crustline.accessor``, then ``frame.crustline``.

Importing it registers it with pandas, which `import crustline` alone does not load.
"""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import Any

from crustline.curves import trace
from crustline.errors import InputError, require, shown
from crustline.formats.names import quote_all
from crustline.formats.objects import points_of_object, to_geopandas
from crustline.methods import by_group, connect
from crustline.projection import project as projected_points

__all__ = ["FrameAccessor"]

require("gis", "pandas")


@import_module("pandas.api.extensions").register_dataframe_accessor("crustline")
class FrameAccessor:
    """What crustline does with a GeoDataFrame: ``frame.crustline.reconstruct()``."""

    def __init__(self, frame: Any) -> None:
        if not hasattr(frame, "geometry"):
            raise AttributeError("the frame has no geometries: make it a GeoDataFrame")
        self._frame = frame

    def reconstruct(
        self,
        by: str | None = None,
        method: Callable[..., Any] = connect,
        *,
        project: str | None = None,
        polygons: bool = False,
        orient: str | None = None,
        start: Any = None,
        **parameters: Any,
    ) -> Any:
        """Return a GeoDataFrame of the curves through the vertices of all geometries of a frame.

        Parameters
        ----------
        by : str, optional
            A column: only points of equal value in it are connected.
        method : callable, default `connect`
            Takes points and returns edges.
        project : str, optional
            The CRS to connect the points in, or "auto": see `crustline.project`. The result stays
            in the CRS of the frame.
        polygons : bool, default False
            Whether rings are joined to polygons with holes.
        orient, start
            As for `Curves.oriented`.
        **parameters
            Passed on to the method.

        Returns
        -------
        frame : geopandas.GeoDataFrame
            A row a curve: see `Curves.to_geopandas`. `rows` are those of the vertices, which are
            those of the frame if its geometries are points.

        Raises
        ------
        InputError
            If there is no such column, or the method, a parameter or the CRS does not fit.
        """
        points = points_of_object(self._frame)
        placed = points if project is None else projected_points(points, project)
        if by is None:
            edges = method(placed, **parameters)
        elif by in points.columns:
            edges = by_group(placed, points.columns[by], method, **parameters)
        else:
            names = quote_all(list(points.columns))
            raise InputError(f"by is {shown(by)}, no column of the frame: choose from {names}")
        curves = trace(points, edges)
        return to_geopandas(curves.oriented(orient, start=start, crs=project), polygons)
