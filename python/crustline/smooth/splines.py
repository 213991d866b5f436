"""Splines through the rings and polylines of curves, and their pictures."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import PurePath
from typing import TYPE_CHECKING, overload

import numpy as np

from crustline.arrays import FloatArray
from crustline.curves import Curves
from crustline.errors import InputError
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

    def write(self, path: str | os.PathLike[str], *, tolerance: float | None = None) -> None:
        """Write the curves to an SVG file as cubic Bézier paths, whole or not at all.

        Parameters
        ----------
        path : path-like
            The file, with the suffix .svg, which is replaced if it exists; "-" is standard output.
        tolerance : float, optional
            As for `beziers`: fewer pieces within this distance. By default exact.

        Raises
        ------
        FormatError
            If the file cannot be written; nothing is left behind then.
        InputError
            If the suffix is another one, or the tolerance is not a positive number.

        Notes
        -----
        A path for each curve, closed by Z if it is a ring, y upwards, dots for the isolated points:
        the drawing of `Curves.write`, with curves in place of lines. Numbers have the fewest digits
        that give the same float64 again.
        """
        from crustline.formats.file import replace_file

        if os.fspath(path) != "-" and PurePath(path).suffix.lower() != ".svg":
            raise InputError(
                f"no format for smooth curves is known for {os.fspath(path)!r}: name it .svg"
            )
        replace_file(path, _svg(self, tolerance))

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
        return _svg(self, None).decode()

    def __repr__(self) -> str:
        rings = sum(spline.closed for spline in self.splines)
        corners = sum(len(spline.corners) for spline in self.splines)
        counts = [(rings, "ring"), (len(self) - rings, "polyline"), (corners, "corner")]
        words = ", ".join(f"{count} {word}{'s' * (count != 1)}" for count, word in counts)
        return f"<Splines: {words}; {len(self.curves.points)} points>"


def _svg(curves: Splines, tolerance: float | None) -> bytes:
    """Return the drawing of `formats.svg`, with Bézier pieces in place of lines."""
    from crustline.formats import svg

    beziers = curves.beziers(tolerance)
    lonely = curves.curves.points.xy[curves.curves.isolated]
    # Control points enclose their curve.
    frame = svg.frame_of(np.concatenate([lonely, *(each.reshape(-1, 2) for each in beziers)]))
    paths = _svg_paths(curves, [frame.place(each) for each in beziers])
    return svg.document(frame, curves.curves, [*paths, *svg.dots(frame.place(lonely))])


def _svg_paths(curves: Splines, beziers: list[FloatArray]) -> Iterator[str]:
    from crustline.formats.svg import element, short

    for spline, control in zip(curves, beziers, strict=True):
        start = " ".join(map(short, control[0, 0].tolist()))
        rest = " ".join(map(short, control[:, 1:].ravel().tolist()))
        yield element(f"M{start}C{rest}{'Z' if spline.closed else ''}")


def _draw(splines: Sequence[Spline], color: str, ax: Axes) -> None:
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path as Outline

    if not splines:
        return
    outlines = []
    for control in bezier_pieces(splines, None):
        vertices = np.concatenate([control[0, :1], control[:, 1:].reshape(-1, 2)])
        codes = np.full(len(vertices), Outline.CURVE4, np.uint8)
        codes[0] = Outline.MOVETO
        outlines.append(Outline(vertices, codes))
    outline = Outline.make_compound_path(*outlines)
    ax.add_patch(PathPatch(outline, fill=False, edgecolor=color, linewidth=1.8, zorder=3))
