"""The editor in a notebook cell, through anywidget: JupyterLab, VS Code, marimo."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import numpy.typing as npt

from crustline.delaunay import Delaunay
from crustline.editor.desk import edited, named
from crustline.editor.page import built
from crustline.errors import require
from crustline.methods import METHODS
from crustline.points import as_carried
from crustline.reconstruction import Reconstruction
from crustline.scalars import as_choice, as_whole


def widget(
    points: npt.ArrayLike | Delaunay = (), *, method: str = "connect", height: int = 480
) -> Any:
    """Return a widget that shows points and their curves, to draw and to drag.

    Parameters
    ----------
    points : array_like of float, shape (n, 2), Points or Delaunay, optional
        What to begin with; by default nothing.
    method : str, default "connect"
        The name of a method, as `METHODS` has it.
    height : int, default 480
        In pixels.

    Returns
    -------
    widget : anywidget.AnyWidget
        Its `points` are the `Points` as edited, with heights, columns and CRS kept as far as they
        go; `curves` what the library reconstructs of them by the chosen method; `observe` calls
        back on `xy`, the coordinates.

    Raises
    ------
    MissingExtraError
        If anywidget is not installed.
    CrustlineError
        If the front end is not built.
    InputError
        If the points or the method are not what they should be.

    Examples
    --------
    >>> editor = widget([(0, 0), (1, 0), (0, 1)])  # doctest: +SKIP
    >>> editor.curves  # doctest: +SKIP
    <Curves: 1 ring, 0 polylines, 0 isolated points>
    """
    given = points.points if isinstance(points, Delaunay) else as_carried(points)
    as_choice("method", method, list(METHODS))
    return _class()(given, method, as_whole("height", height, 100))


@cache
def _class() -> type:
    require("notebook", "anywidget", "traitlets")
    import anywidget
    import traitlets

    class Editor(anywidget.AnyWidget):
        """Points to edit, and their curves."""

        _esm = built("widget.js")
        _xy = traitlets.Bytes().tag(sync=True)
        _rows = traitlets.Bytes().tag(sync=True)
        method = traitlets.Unicode("connect").tag(sync=True)
        parameters: Any = traitlets.List().tag(sync=True)
        height = traitlets.Int(480).tag(sync=True)

        def __init__(self, given: Any, method: str, height: int) -> None:
            self._given = given
            rows = np.arange(len(given), dtype="<i4").tobytes()
            xy = given.xy.astype("<f8").tobytes()
            super().__init__(_xy=xy, _rows=rows, method=method, height=height)

        @property
        def points(self) -> Any:
            """The points as they are now."""
            xy = np.frombuffer(self._xy, "<f8").reshape(-1, 2)
            rows = np.frombuffer(self._rows, "<i4").astype(np.int64)
            return edited(self._given, xy, rows)[0]

        @property
        def reconstruction(self) -> Reconstruction:
            """The points, the chosen method, and all that follows."""
            return Reconstruction(self.points, METHODS[self.method], **self._named())

        @property
        def curves(self) -> Any:
            """The curves of the points as they are now."""
            return self.reconstruction.curves

        def _named(self) -> dict[str, Any]:
            return named(self.method, list(self.parameters)) if self.parameters else {}

    return Editor
