"""Slices: curves in which planes cut clouds of points and meshes."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from crustline.errors import InputError
from crustline.methods import as_method, connect
from crustline.scalars import as_flag, as_length, as_positive, as_whole
from crustline.slices.body import as_body
from crustline.slices.cloud import cut_cloud
from crustline.slices.mesh import Mesh, cut_mesh
from crustline.slices.plane import Plane, as_planes, section
from crustline.slices.slice import Slice, Slices

__all__ = ["Plane", "Slice", "Slices", "section", "slices"]


def slices(  # noqa: PLR0913 - all but the first two have a default
    body: Any,
    planes: Any,
    *,
    thickness: float | Sequence[float | None] | None = None,
    fit: bool = True,
    scale: float | None = None,
    merge: float | None = None,
    method: Callable[..., ArrayLike] = connect,
    format: str | None = None,
    crs: str | None = None,
    threads: int | None = None,
    **hints: Any,
) -> Slices:
    """Return the curves in which planes cut a cloud of points or a mesh.

    Parameters
    ----------
    body : path-like, bytes, file-like object, array_like of float (n, 3), Points, or Trimesh
        A cloud: LAS, LAZ, COPC, E57, PLY, PTS, or any other format of points with heights. Files
        are read in pieces, and need the memory of their slices and of one piece. Or a mesh, whose
        vertices and triangles are all read: STL, OBJ, PLY.
    planes : str, Plane, or a sequence of these
        "z=12.5", "x=3" or "y=-1"; "1,0,2=5" for the plane x + 2z = 5; "z=0:30:0.5", and the same
        of any normal, for all planes from 0 to 30, both included, in steps of 0.5. `section` makes
        a vertical strip along a line.
    thickness : float, or one a plane
        The points of a cloud within half of it on either side of a plane are its slice. A mesh has
        none.
    fit : bool, default True
        Whether to fit curves to the band of points, which has many of them across. False joins the
        points as they are.
    scale : float, optional
        With `fit`, how wide bands are in their planes; by default the thickness. Points are thinned
        to one mean in each cell of this size, and curves are fitted to these by `denoise`, with the
        deviation of an even band of this width, scale / √12.
    merge : float, optional
        Of a mesh, how far loose ends of its outlines may be apart to be one; by default those are
        that are a million times nearer to each other than to any other: they differ by rounding.
    method : callable, default `connect`
        Joins the points of a cloud; gaps between what was fitted are left to `connect` alone.
    format, crs : str, optional
        Those of the file, as for `read`.
    threads : int, optional
        How many slices are joined at once; by default one a core.
    **hints
        What is known of the curves, as `connect` takes it, such as ``closed=True``.

    Returns
    -------
    slices : Slices
        A `Slice` for each plane that holds anything, in their order.

    Raises
    ------
    InputError
        If the planes, the thickness or the cloud do not fit, or no plane holds anything.
    FormatError
        If the file cannot be read.
    MissingExtraError
        If packages are not installed: of the extras `lidar` or `mesh`.

    Notes
    -----
    Which points are in a slice is decided in float64 arithmetic of their coordinates; the rest is
    an estimate as `denoise` is. The same for any order of the points and number of threads.

    Of a mesh each segment in which a triangle is cut is kept, and each side of a triangle is cut at
    one place. A corner in the plane counts as above it, so outlines of closed surfaces are closed,
    and a plane in which faces lie cuts what is just below it. Where the surface is not closed, what
    is missing is decided by `close_gaps`, and a `FormatWarning` says so.

    Examples
    --------
    A cylinder, a slice of which is a circle:

    >>> import numpy as np
    >>> rng = np.random.default_rng(0)
    >>> angle = rng.uniform(0, 2 * np.pi, 20_000)
    >>> cloud = np.stack([np.cos(angle), np.sin(angle), rng.uniform(0, 3, 20_000)], axis=1)
    >>> found = slices(cloud + rng.normal(0, 0.005, cloud.shape), "z=1:2:0.5", thickness=0.05)
    >>> found
    <Slices: 3 of 3 planes>
    >>> found[1].curves
    <Curves: 1 ring, 0 polylines, 0 isolated points; 130 points>
    >>> float(found[1].in_space.points.z[0])
    1.5
    """
    chosen, solid = as_planes(planes), as_body(body, format, crs)
    workers = os.cpu_count() or 1 if threads is None else as_whole("threads", threads, 1)
    method = as_method(method, hints)
    if isinstance(solid, Mesh):
        for name, given in (("thickness", thickness), ("scale", scale)):
            if any(each is not None for each in _one_a_plane(given, len(chosen))):
                raise InputError(f"a mesh is cut exactly, without {name}: leave it away")
        tolerance = None if merge is None else as_length("merge", merge)
        made = cut_mesh(solid, chosen, tolerance=tolerance, threads=workers, hints=hints)
    elif merge is not None:
        raise InputError("merge is for meshes: clouds are thinned at their scale")
    else:
        made = cut_cloud(
            solid, chosen, _thickness(thickness, len(chosen)),
            scale=None if scale is None else as_positive("scale", scale),
            fit=as_flag("fit", fit), threads=workers, method=method, hints=hints,
        )  # fmt: skip
    empty = tuple(each.name for each in made if not each.count)
    return Slices(tuple(each for each in made if each.count), empty)


def _one_a_plane(given: Any, count: int) -> list[Any]:
    """Return what is given for each plane, or the same for all."""
    if isinstance(given, np.ndarray) and given.ndim == 1:
        return list(given.tolist())
    return list(given) if isinstance(given, list | tuple) else [given] * count


def _thickness(thickness: Any, count: int) -> list[float]:
    """Return one a plane."""
    each = _one_a_plane(thickness, count)
    if len(each) != count:
        raise InputError(f"thickness has {len(each)} numbers for {count} planes: give one a plane")
    if any(one is None for one in each):
        raise InputError(
            "a slice of a cloud has a thickness: give it, such as thickness=0.05 (--thickness 0.05)"
        )
    return [as_positive("thickness", one) for one in each]
