"""The certificate: whether the theory guarantees edges of the points at hand, and where not."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from crustline import _core
from crustline.arrays import FloatArray, IntArray, read_only
from crustline.delaunay import Delaunay, as_delaunay
from crustline.interpolant import interpolant
from crustline.methods import as_selected
from crustline.notebook import paragraphs
from crustline.points import Points
from crustline.records import Record
from crustline.theory import BETA, guaranteed_r

if TYPE_CHECKING:
    from matplotlib.axes import Axes

__all__ = ["MARGIN", "Certificate", "certify"]

#: By how much an estimate of the sampling ratio may be too small before a guarantee would be wrong.
MARGIN = 0.15

#: The reasons, from none to the gravest; an edge has the gravest of those that hold.
REASONS = np.array(
    ["", "undersampled", "missing", "corner", "endpoint", "branch", "isolated", "unselected"]
)

#: The theorems by the methods that they are about.
_THEOREMS = {
    "beta-skeleton": f"Theorem 20 (β-skeleton, β = {BETA:.2f})",
    "crust": "Theorems 14 and 15 (crust)",
}

Codes = npt.NDArray[np.uint8]
Reasons = npt.NDArray[np.str_]


@dataclass(frozen=True, eq=False)
class Certificate(Record):
    """What is guaranteed about edges, by which theorem, and what breaks the guarantee.

    Attributes
    ----------
    points : Points
        The points, with all that they carry.
    edges : ndarray of int64, shape (m, 2)
        The edges that the certificate is about: i < j in each row, rows sorted.
    ratio : ndarray of float64, shape (m,)
        For each edge an estimate of the sampling ratio there: the distance from the curve Voronoi
        vertex to its two samples over the local feature size, both of the smooth interpolant.
        Infinite where there is no smooth interpolant.
    sampling_ratio : float
        The largest of them; infinite if there are no edges.
    threshold : float
        The r that the theorem asks for; 0 if the edges are those of no method that has a theorem.
    guaranteed : bool
        Whether the edges are all rings, are what a method with a theorem selects, and have a
        sampling ratio below the threshold, with a margin.
    theorem : str
        The theorem that applies to the edges; "" if none does.
    promise : str
        What the theorem says, in one sentence.
    edge_reason : ndarray of str, shape (m,)
        Why an edge breaks the guarantee: "unselected" (no method selects it), "branch",
        "endpoint", "corner" (it touches one) or "undersampled"; "" if it does not.
    point_reason : ndarray of str, shape (n,)
        The same for points: "isolated", "branch", "endpoint", "corner", "missing" (a method has
        an edge here that is not among the edges), "undersampled".
    edge_codes, point_codes : ndarray of uint8
        The reasons as numbers: rows of `REASONS`, 0 if there is none.
    """

    points: Points
    edges: IntArray
    ratio: FloatArray
    sampling_ratio: float
    threshold: float
    guaranteed: bool
    theorem: str
    promise: str
    edge_codes: Codes = field(repr=False)
    point_codes: Codes = field(repr=False)

    # Strings take six times the room of all else, so they are not made before someone asks.
    @cached_property
    def edge_reason(self) -> Reasons:
        """Why each edge breaks the guarantee."""
        return read_only(REASONS[self.edge_codes])

    @cached_property
    def point_reason(self) -> Reasons:
        """Why each point breaks the guarantee."""
        return read_only(REASONS[self.point_codes])

    @property
    def weak(self) -> IntArray:
        """Rows of `edges` that break the guarantee, sorted: more samples are needed there."""
        return np.flatnonzero(self.edge_codes)

    @property
    def weak_points(self) -> IntArray:
        """Rows of `points` that break the guarantee, sorted."""
        return np.flatnonzero(self.point_codes)

    def weak_places(self) -> Points:
        """Return the points that break the guarantee, with their row and the reason beside them.

        What the points carry is kept; columns called row or reason become input_row, input_reason.
        """
        rows = self.weak_points
        weak = self.points.select(rows)
        found = {"row": rows, "reason": self.point_reason[rows]}
        kept = {(f"input_{name}" if name in found else name): v for name, v in weak.columns.items()}
        return weak.replace(columns=found | kept)

    def summary(self) -> str:
        """Return the certificate in words: what is proven, what is estimated, what breaks it."""
        lines = [f"{'Guaranteed' if self.guaranteed else 'Not guaranteed'}: {self._finding()}"]
        if self.theorem:
            lines.append(f"Proven: {self.promise}")
        if len(self.edges):
            lines.append(self._estimate())
        lines.extend(self._breaks())
        return "\n".join(lines)

    __str__ = summary

    def _finding(self) -> str:
        count = f"{len(self.edges)} edges between {len(self.points)} points"
        if not self.theorem:
            return f"{count}, which are not what a method with a theorem selects from the points."
        return f"{count}, the case of {self.theorem}."

    def _estimate(self) -> str:
        worst = int(np.argmax(self.ratio))
        i, j = self.edges[worst]
        verdict = ""
        if self.theorem:
            side = "below" if self._is_dense() else "not below"
            verdict = f"; with a margin of {MARGIN:.0%} this is {side} {self.threshold:.5f}"
        return (
            f"Estimated: they {self.sampling_ratio:.3g}-sample the smooth interpolant of these "
            f"edges, at worst between points {i} and {j}{verdict}. The curve that the points "
            "were taken from is not known; samples too sparse for it may be dense for another one."
        )

    def _is_dense(self) -> bool:
        return (1 + MARGIN) * self.sampling_ratio < self.threshold

    def _breaks(self) -> list[str]:
        lines = []
        for noun, codes in (("edge", self.edge_codes), ("point", self.point_codes)):
            counts = np.bincount(codes, minlength=len(REASONS))
            words = sorted((str(REASONS[k]), int(counts[k])) for k in np.flatnonzero(counts) if k)
            if words:
                parts = (f"{n} {word}" for word, n in words)
                lines.append(f"Broken at {noun}s: {', '.join(parts)}.")
        return lines

    def to_dict(self) -> dict[str, Any]:
        """Return the certificate as plain Python values, for JSON; infinite ratios are None."""
        return {
            "guaranteed": self.guaranteed,
            "theorem": self.theorem,
            "promise": self.promise,
            "threshold": self.threshold,
            "margin": MARGIN,
            "sampling_ratio": _finite(self.sampling_ratio),
            "points": len(self.points),
            "edges": self.edges.tolist(),
            "ratio": [_finite(value) for value in self.ratio.tolist()],
            "weak": _named(self.weak, self.edge_reason),
            "weak_points": _named(self.weak_points, self.point_reason),
            "summary": self.summary(),
        }

    def plot(self, ax: Axes | None = None, **options: Any) -> Axes:
        """Draw the certificate with matplotlib; see `crustline.plot.plot_certificate`."""
        from crustline.plot import plot_certificate

        return plot_certificate(self, ax, **options)

    def _repr_html_(self) -> str:
        """Return the summary, as notebooks show it."""
        return paragraphs(self.summary().splitlines())

    def __repr__(self) -> str:
        word = "guaranteed" if self.guaranteed else f"not guaranteed, {len(self.weak)} weak edges"
        return f"<Certificate: {word}; sampling ratio about {self.sampling_ratio:.3g}>"


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None


def _named(rows: IntArray, reasons: Reasons) -> list[dict[str, Any]]:
    pairs = zip(rows.tolist(), reasons[rows].tolist(), strict=True)
    return [{"row": row, "reason": reason} for row, reason in pairs]


def certify(points: npt.ArrayLike | Delaunay, edges: npt.ArrayLike | None = None) -> Certificate:
    """Return a certificate: whether the theory guarantees edges, and what breaks the guarantee.

    Parameters
    ----------
    points : array_like of float, shape (n, 2), Points or Delaunay
        Coordinates, in any one unit. Finite. Repeated points count once, at their first row.
    edges : array_like of int, shape (m, 2), optional
        Rows of points, from any method or by hand; by default the crust.

    Returns
    -------
    certificate : Certificate
        `certificate.guaranteed` says whether, ``print(certificate)`` why.

    Raises
    ------
    InputError
        If the points or edges do not fit; the message names the first row at fault.

    Notes
    -----
    *Proven*, exactly, about the edges: that they form rings through all points, and that they are
    the crust, or the β-skeleton for β = 1.70, of the points. From the theorem of that method it
    follows: if the points are an r-sample, for an r below the threshold, of any smooth curve
    whatever, then these edges are its polygonal reconstruction. So there is at most one, and it is
    this one.

    *Estimated*: that they are an r-sample of the curve that these edges suggest, their smooth
    interpolant (see `local_feature_size`). The estimate must be below the
    threshold with a margin of 15 % to spare.

    *Not known*: the curve that the points were taken from. Samples that are too sparse for it may
    happen to be dense for another curve; no one could tell from the points.

    A turn of more than 4 arcsin(r/2) at a point is a corner: by Lemma 10 no r-sampled smooth curve
    has it. O(n log n) time.

    Measured (`tests/test_certify.py`): on 10,000 random point sets of curves known to the test, at
    r from 0.1 to 1.2, with the edges of the crust, the β-skeleton and the NN-crust, and with right
    edges changed by hand, no wrong edges were guaranteed, and all right ones up to r = 0.2. For
    right edges with r up to 0.25 the estimate was between 0.95 and 1.23 times the true r. Every
    wrong crust and β-skeleton had an endpoint, a branch or an isolated point.

    References
    ----------
    .. [1] N. Amenta, M. Bern, D. Eppstein, "The Crust and the β-Skeleton: Combinatorial Curve
       Reconstruction", Graphical Models and Image Processing 60 (1998), 125-135. Theorems 14, 15
       and 20, Lemma 10.

    Examples
    --------
    >>> import numpy as np
    >>> angle = np.linspace(0, 2 * np.pi, 24, endpoint=False)
    >>> circle = np.stack([np.cos(angle), np.sin(angle)], axis=1)
    >>> certify(circle)
    <Certificate: guaranteed; sampling ratio about 0.131>
    >>> certify(circle[::4])
    <Certificate: not guaranteed, 6 weak edges; sampling ratio about 0.518>
    """
    delaunay = as_delaunay(points)
    chosen = as_selected(delaunay, edges)
    thresholds = {"beta-skeleton": guaranteed_r("beta_skeleton"), "crust": guaranteed_r("crust")}
    method, guaranteed, ratio, of_edges, of_points, crust = interpolant(delaunay, chosen).run(
        _core.Interpolant.certificate,
        (BETA, thresholds["beta-skeleton"], thresholds["crust"], MARGIN),
        delaunay.kept("crust"),
    )
    if crust is not None:
        delaunay.cached("crust", lambda: crust)
    threshold = thresholds.get(method or "", 0.0)
    return Certificate(
        points=delaunay.points,
        edges=chosen,
        ratio=ratio,
        sampling_ratio=float(ratio.max()) if len(ratio) else math.inf,
        threshold=threshold,
        guaranteed=guaranteed,
        theorem=_THEOREMS.get(method or "", ""),
        promise=_promise(threshold) if method else "",
        edge_codes=of_edges,
        point_codes=of_points,
    )


def _promise(threshold: float) -> str:
    return (
        f"if the points are an r-sample, r < {threshold:.5f}, of any smooth closed curve "
        "(of one or more components), then these edges join exactly the samples adjacent along it."
    )
