"""Connection: the answer of `connect`, how sure each edge is, and why it is not the crust."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import numpy.typing as npt

from crustline import _core
from crustline.arrays import FloatArray, IntArray, read_only
from crustline.curves import Curves, trace
from crustline.delaunay import Delaunay, as_delaunay
from crustline.methods.connect import connect
from crustline.methods.hints import as_hints
from crustline.methods.parameters import check_parameters
from crustline.points import Points
from crustline.records import Record

__all__ = ["Connection", "connection"]


@dataclass(frozen=True, eq=False)
class Connection(Record):
    """The edges that `connect` finds, how sure they are, and how they differ from the crust.

    Attributes
    ----------
    points : Points
        The points, with all that they carry.
    edges : ndarray of int64, shape (m, 2)
        What `connect` gives.
    confidence : ndarray of float64, shape (m,)
        The probability that each edge is right, calibrated: see `connection`.
    whole : float
        The probability that the answer is right as a whole: no edge wrong, and none missing.
    left_out : ndarray of int64, shape (k, 2)
        The edges of the crust that are not in the answer, sorted.
    left_out_reasons : tuple of str
        Why, in a word each: "corner", "gap", "outlier", "end", "chord", "noise", "branch", "rival"
        or "hint".
    added : ndarray of int64, shape (l, 2)
        The edges that are not in the crust, sorted.
    added_reasons : tuple of str
        Why, in a word each.
    repeated : ndarray of int64, shape (d,)
        Rows for which others stand: repeated points, and those that were merged; sorted.
    """

    points: Points
    edges: IntArray
    confidence: FloatArray
    whole: float
    left_out: IntArray
    left_out_reasons: tuple[str, ...]
    added: IntArray
    added_reasons: tuple[str, ...]
    repeated: IntArray

    @property
    def outliers(self) -> IntArray:
        """Rows of the points that are on no curve, those that are `repeated` aside; sorted."""
        degrees = np.bincount(self.edges.ravel(), minlength=len(self.points))
        return read_only(np.setdiff1d(np.flatnonzero(degrees == 0), self.repeated))

    @property
    def curves(self) -> Curves:
        """The edges traced; with their confidence, which GeoJSON keeps."""
        return replace(trace(self.points, self.edges), confidence=self.confidence)

    def renamed(self, points: Points, rows: IntArray) -> Connection:
        """Return the same of other points, row k of the old ones being ``rows[k]`` of theirs.

        Where several rows become one, it stands for the others.
        """

        def moved(edges: IntArray) -> tuple[IntArray, IntArray]:
            new = np.sort(rows[edges], axis=1)
            order = np.lexsort((new[:, 1], new[:, 0]))
            return read_only(new[order]), order

        edges, order = moved(self.edges)
        left_out, left_order = moved(self.left_out)
        added, added_order = moved(self.added)
        return Connection(
            points,
            edges,
            read_only(self.confidence[order]),
            self.whole,
            left_out,
            tuple(self.left_out_reasons[k] for k in left_order),
            added,
            tuple(self.added_reasons[k] for k in added_order),
            read_only(np.setdiff1d(np.arange(len(rows)), rows)),
        )

    def summary(self) -> dict[str, Any]:
        """Return the counts that `crustline reconstruct --json` prints.

        Returns
        -------
        summary : dict
            The confidence in the whole and in the least sure edge, the number of edges below 0.9,
            the outliers, and for each reason the number of edges left out and added.
        """
        return {
            "confidence": round(self.whole, 4),
            "least_sure_edge": round(float(self.confidence.min(initial=1.0)), 4),
            "edges_below_0.9": int((self.confidence < 0.9).sum()),
            "outliers": self.outliers.tolist(),
            "not_of_the_crust": dict(sorted(Counter(self.added_reasons).items())),
            "left_out_of_the_crust": dict(sorted(Counter(self.left_out_reasons).items())),
        }

    def __repr__(self) -> str:
        return (
            f"<Connection: {len(self.edges):,} edges, {self.whole:.0%} sure as a whole; "
            f"{len(self.added):,} are not in the crust, {len(self.left_out):,} of it left out>"
        )


def connection(points: npt.ArrayLike | Delaunay, **hints: Any) -> Connection:
    """Return what `connect` finds, how sure each edge is, and why it is not the crust.

    Parameters
    ----------
    points : array_like of float, shape (n, 2), Points or Delaunay
        Coordinates, in any one unit. Finite.
    **hints
        Those of `connect`.

    Returns
    -------
    connection : Connection
        Its edges are those of `connect`.

    Raises
    ------
    InputError
        As `connect`.

    Notes
    -----
    The confidence is a logistic curve of what is known of an edge: by how much the messages prefer
    it to its absence, what rivals it, how much the curve turns nearby, how the steps vary, and
    whether the points around grow in number as along a curve or as over an area. It was fitted on
    one half of generated cases with known truth, and on clouds, lattices and filled disks, in which
    no edge counts as right; [the accuracy page](../accuracy.md) shows on the other half that of the
    edges said to be right with 0.9, nine in ten are. It says nothing of points unlike these cases:
    a smooth wrong explanation looks sure. Edges that the theorem put there have 0.999.

    It costs about as much as `connect` itself, and several times as much in clouds. The same for
    any order of the rows and number of threads, after scaling by a power of two, turns by 90° and
    reflections.

    Examples
    --------
    A corner, which the crust cuts with a chord:

    >>> corner = [(-1.5, 3), (-1, 2), (-0.5, 1), (0, 0), (0.5, 1), (1, 2), (1.5, 3)]
    >>> found = connection(corner)
    >>> found.edges.tolist()
    [[0, 1], [1, 2], [2, 3], [3, 4], [4, 5], [5, 6]]
    >>> list(zip(found.left_out.tolist(), found.left_out_reasons))
    [([2, 4], 'chord')]
    """
    delaunay = as_delaunay(points)
    check_parameters(connect, hints, "connect", "pass {}=…")
    made = delaunay.run(_core.connection, as_hints(delaunay, hints))
    return Connection(
        delaunay.points,
        made["edges"],
        made["confidence"],
        made["whole"],
        made["left_out"][0],
        tuple(made["left_out"][1]),
        made["added"][0],
        tuple(made["added"][1]),
        delaunay.duplicates[:, 0],
    )
