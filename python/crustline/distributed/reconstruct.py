"""The door: any input to edges and curves in a folder."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from crustline.distributed.cluster import Crew, crew
from crustline.distributed.report import write_report
from crustline.distributed.result import Result
from crustline.distributed.rules import rule_of
from crustline.distributed.run import (
    Progress,
    Run,
    Settings,
    describe,
    execute,
    open_folder,
    save,
)
from crustline.distributed.sources import open_input
from crustline.errors import require
from crustline.methods import Method, crust
from crustline.scalars import as_length, as_whole


def reconstruct(  # noqa: PLR0913 (all but three have a default)
    source: Any,
    out: Any,
    method: Method = crust,
    *,
    columns: Sequence[str] | None = None,
    client: Any = None,
    tile_points: int | None = None,
    halo: float | None = None,
    rounds: int = 8,
    memory_limit: int | str | None = None,
    progress: Progress | None = None,
    resume: bool = True,
    **parameters: Any,
) -> Result:
    """Reconstruct curves from more points than fit in memory, exactly as in one piece.

    Parameters
    ----------
    source : path-like, list of path-like, or Dask frame
        Files, patterns such as ``"points/*.parquet"``, folders of Parquet files, URLs that fsspec
        knows; Parquet, GeoParquet, LAS, LAZ and every format that `read` reads. Or a frame of Dask
        or dask-geopandas. A row's number counts through the files, sorted by path as text, each in
        its own order, or through the partitions.
    out : path-like
        A new folder, or that of the same run, which goes on. All workers must see it.
    method : callable, default `crust`
        `crust`, `one_step_crust`, `crossing_angle_graph`, or `beta_skeleton` with a `beta` above 1.
    columns : sequence of str, optional
        The columns of x and y; by default those that `read` takes, or the geometry.
    client : distributed.Client or str, optional
        Where to run, or the address of a scheduler; by default a cluster on this machine.
    tile_points : int, optional
        About how many points a tile has; by default what the memory of a worker allows, at most a
        million.
    halo : float, optional
        How far around a tile points are seen at first; by default a guess for each tile. It changes
        what the run takes, never the result.
    rounds : int, default 8
        How often a tile reads what its open edges ask for, before one task decides what is left.
    memory_limit : int or str, optional
        Of all workers on this machine, such as "8GB"; by default 60 % of what the machine or its
        cgroup has.
    progress : callable, optional
        Called with the name of a stage and the fraction of it that is done.
    resume : bool, default True
        Go on with the run that the folder holds. A run of other input or settings is refused.
    **parameters
        Passed on to the method, such as ``beta=1.7``.

    Returns
    -------
    result : Result
        Edges, curves and duplicates, in files, read when asked for.

    Raises
    ------
    InputError
        If the method cannot be decided tile by tile, the input does not fit, or the folder holds
        something else; the message names the file and the row.
    CrustlineError
        If a worker was lost several times, or a file cannot be written.
    MissingExtraError
        Without Dask and pyarrow: ``pip install 'crustline[distributed]'``.

    Notes
    -----
    Exact: edges, curves and duplicates are those of `crustline.reconstruct`, bit for bit, whatever
    the tiles, the workers, or what was killed on the way. Memory is that of a tile a worker. About
    1.3 times the work of one piece, and some 100 bytes of disk a point while it runs.

    References
    ----------
    .. [1] D. Funke, P. Sanders, "Parallel d-D Delaunay Triangulations in Shared and Distributed
       Memory", ALENEX (2017).

    Examples
    --------
    >>> import crustline as cl
    >>> result = cl.distributed.reconstruct("points/*.parquet", "out")  # doctest: +SKIP
    >>> result.edges.head()  # doctest: +SKIP
    """
    rule = rule_of(method, parameters)
    width = None if halo is None else as_length("halo", halo)
    rounds = as_whole("rounds", rounds, 0)
    require("distributed", "distributed", "pyarrow")
    address = client if isinstance(client, str) else None
    with crew(None if address else client, address, memory_limit) as found:
        size = _tile_points(tile_points, found)
        given = open_input(source, columns, size)
        settings = Settings(rule, size, width, rounds)
        folder, about = Path(out).absolute(), describe(given, settings)
        if open_folder(folder, about, resume) is None:
            run = Run(folder, found, progress)
            counts = execute(run, given, settings)
            write_report(run, counts, given.crs)
            save(folder, about, counts)
            run.remove_work()
    return Result(folder)


def _tile_points(given: int | None, found: Crew) -> int:
    return found.tile_points() if given is None else as_whole("tile_points", given, 1)
