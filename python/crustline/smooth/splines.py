"""Splines through the rings and polylines of curves, and their pictures."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, overload

import numpy as np

from crustline.arrays import FloatArray
from crustline.curves import Curves
from crustline.path import Path
from crustline.smooth.spline import Spline, bezier_pieces

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True, eq=False)
class Splines(Sequence[Spline]):
    """Splines through rings and polylines; a sequence of `Spline` in the order of the curves.

    Attributes
    ----------
    curves : Curves
        The rings and polylines that the splines run through.
    splines : tuple of Spline
        One for each of them.

    Examples
    --------
    >>> from crustline import reconstruct, shapes, smooth
    >>> smooth(reconstruct(shapes.regular_polygon(12)))
    <Splines: 1 ring, 0 polylines, 0 corners; 12 points>
    """

    curves: Curves
    splines: tuple[Spline, ...]

    def __len__(self) -> int:
        return len(self.splines)

    @overload
    def __getitem__(self, key: int) -> Spline: ...
    @overload
    def __getitem__(self, key: slice) -> tuple[Spline, ...]: ...
    def __getitem__(self, key: int | slice) -> Spline | tuple[Spline, ...]:
        return self.splines[key]

    def __iter__(self) -> Iterator[Spline]:
        return iter(self.splines)

    @property
    def lengths(self) -> FloatArray:
        """The arc length of every spline, shape (c,), in the unit of the points."""
        return np.array([spline.length for spline in self.splines], dtype=np.float64)

    def beziers(self, tolerance: float | None = None) -> list[FloatArray]:
        """Return every spline as cubic Bézier pieces.

        Parameters
        ----------
        tolerance : float, optional
            The largest distance of the pieces to the splines, in the unit of the points. By default
            the pieces are the splines themselves, two between each two neighboring samples.

        Returns
        -------
        beziers : list of ndarray of float64, shape (p, 4, 2)
            The control points of each spline in turn, in its direction; each piece starts exactly
            where the one before it ends, and the last one of a ring ends where the first starts. A
            ring with corners starts at its first corner.

        Raises
        ------
        InputError
            If the tolerance is not a positive number.

        Notes
        -----
        With a tolerance, pieces start and end at samples, or half-way between, and have the
        spline's directions there (G1). That no point of them is farther from the spline than the
        tolerance, nor of the spline from them, is proven piece by piece with the convex hull
        property, up to rounding. The distance to the sampled curve itself is at most that plus the
        spline's own. They are as few as a greedy walk finds: see
        `crustline.smooth.beziers.fewest_pieces`.

        Examples
        --------
        >>> from crustline import reconstruct, shapes, smooth
        >>> splines = smooth(reconstruct(shapes.regular_polygon(100)))
        >>> splines.beziers()[0].shape, splines.beziers(1e-3)[0].shape
        ((200, 4, 2), (4, 4, 2))
        """
        return bezier_pieces(self.splines, tolerance)

    def write(
        self, path: str | os.PathLike[str], *, format: str | None = None, **options: Any
    ) -> None:
        """Write the splines to a file: see `crustline.write`, which says what each format holds."""
        from crustline.formats import write

        write(self, path, format=format, **options)

    def plot(self, ax: Axes | None = None, *, points: bool = True) -> Axes:
        """Draw the splines: rings blue, polylines vermillion.

        Parameters
        ----------
        ax : Axes, optional
            Where to draw; new Axes if not given.
        points : bool, default True
            Whether to draw the samples, too.

        Returns
        -------
        ax : Axes

        Raises
        ------
        MissingExtraError
            If matplotlib is not installed.
        """
        from crustline.plot import BLUE, VERMILLION, plot_points

        ax = plot_points(self.curves.points.xy, ax, size=None if points else 0)
        for closed, color in ((True, BLUE), (False, VERMILLION)):
            _draw([each for each in self.splines if each.closed == closed], color, ax)
        return ax

    def _repr_svg_(self) -> str:
        """Return the picture that notebooks show."""
        from crustline.formats.svg import picture_of_splines

        return picture_of_splines(self)

    def __repr__(self) -> str:
        rings = sum(spline.closed for spline in self.splines)
        corners = sum(len(spline.corners) for spline in self.splines)
        counts = [(rings, "ring"), (len(self) - rings, "polyline"), (corners, "corner")]
        words = ", ".join(f"{count} {word}{'s' * (count != 1)}" for count, word in counts)
        return f"<Splines: {words}; {len(self.curves.points)} points>"


def _draw(splines: Sequence[Spline], color: str, ax: Axes) -> None:
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path as Outline

    if splines:
        path = Path.joined(map(Path.beziers, bezier_pieces(splines, None)))
        outline = Outline(path.vertices, path.codes)
        ax.add_patch(PathPatch(outline, fill=False, edgecolor=color, linewidth=1.8, zorder=3))
