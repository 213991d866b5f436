"""Samples that satisfy the paper's condition (§5): each point p within r · LFS(p) of one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal, get_args

import numpy as np
import numpy.typing as npt

from crustline.arrays import FloatArray, IntArray
from crustline.delaunay import Progress
from crustline.errors import InputError
from crustline.scalars import as_choice, as_positive, as_share, as_whole
from crustline.shapes.curve import SmoothCurve
from crustline.shapes.progress import tell, told_to
from crustline.shapes.ratio import Allowance, supremum
from crustline.shapes.walk import Walk, tables
from crustline.theory import guaranteed_r, spacing_for_error

Mode = Literal["sparsest", "random"]
# Steps are made shorter by this share, so that the proof by `sampling_ratio`, whose own error is
# 1e-4, goes through.
MARGIN = 3e-4
MOST_ROUNDS = 60


@dataclass(frozen=True, eq=False)
class Sample:
    """Samples of a smooth curve, in order along each of its loops.

    Attributes
    ----------
    points : ndarray of float64, shape (n, 2)
        The samples. The object itself serves as an array of points in every function of crustline.
    t : ndarray of float64, shape (n,)
        Where on the curve they are.
    edges : ndarray of int64, shape (n, 2)
        The polygonal reconstruction (paper, §2): the pairs adjacent along the curve, i < j, rows
        sorted.

    Examples
    --------
    >>> from crustline.shapes import circle
    >>> sample = r_sample(circle(), 0.25)
    >>> len(sample), sample.edges[0].tolist(), np.asarray(sample).shape
    (13, [0, 1], (13, 2))
    """

    points: FloatArray
    t: FloatArray
    edges: IntArray

    def __len__(self) -> int:
        return len(self.points)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> npt.NDArray[Any]:
        """Return the points."""
        return np.array(self.points, dtype=dtype, copy=copy)


def r_sample(
    curve: SmoothCurve,
    r: float,
    *,
    seed: int | None = None,
    mode: Mode = "sparsest",
    progress: Progress | None = None,
) -> Sample:
    """Return samples of a smooth curve such that each of its points p has one within r · LFS(p).

    Parameters
    ----------
    curve : SmoothCurve
        What to sample; each of its loops gets samples.
    r : float
        In (0, 1], the paper's range. Below `guaranteed_r("crust")`, 0.2533, the crust of the
        samples is sure to reconstruct the curve.
    seed : int, optional
        Seeds `numpy.random.default_rng`, which draws where each loop's first sample lies, and the
        random steps. With None each loop starts at its t = 0, and random steps differ from call to
        call.
    mode : {"sparsest", "random"}
        "sparsest": each step along the curve is as long as the condition allows, and the last one
        of a loop what is left. "random": each step is between half and the whole of that,
        uniformly.
    progress : callable, optional
        Called now and then with the name of a stage ("axis", "walk", "measure") and the fraction of
        it that is done; "axis" and "measure" may go round more than once.

    Returns
    -------
    sample : Sample
        Points, their t, and the true edges.

    Raises
    ------
    InputError
        If r is not in (0, 1], the mode has another name, the seed is no whole number from 0 on, the
        curve crosses itself, or it needs more than 1,000,000 samples.

    Notes
    -----
    The result is proven against the definition over the whole curve, not only at the
    samples: `sampling_ratio(curve, sample) <= r` holds. Steps are up to 0.03 % shorter than the
    longest possible for that. The sparsest sample of a loop has at most one point more than any in
    which each point of the loop is served by one of its two neighbors along the loop. An ellipse
    whose axes have the ratio a ≫ 1 needs about πa/r samples. A sample takes about 0.2 ms on a
    plain loop, and about 1 ms on one of many bends.

    References
    ----------
    .. [1] N. Amenta, M. Bern, D. Eppstein, "The Crust and the β-Skeleton: Combinatorial Curve
       Reconstruction", Graphical Models and Image Processing 60 (1998), 125–135. Section 5.

    Examples
    --------
    >>> from crustline.shapes import ellipse
    >>> [len(r_sample(ellipse(2, 1), r)) for r in (0.2, 0.5, 1.0)]
    [34, 14, 7]
    """
    r = as_share("r", r)
    with told_to(progress):
        return _sample(curve, lambda lfs: r * lfs, r, seed, mode)


def sample_for_error(
    curve: SmoothCurve,
    d: float,
    *,
    r: float | None = None,
    seed: int | None = None,
    mode: Mode = "sparsest",
    progress: Progress | None = None,
) -> Sample:
    """Return samples whose polygonal reconstruction stays within the distance d of the curve.

    Parameters
    ----------
    curve : SmoothCurve
        What to sample.
    d : float
        The largest distance allowed from a point of the curve to the reconstruction, in the units
        of the curve.
    r : float, optional
        In (0, 1]. The samples are also an r-sample. By default `guaranteed_r("crust")`, up to which
        the crust is proven to find the reconstruction; a larger one gives fewer samples where d is
        large.
    seed, mode, progress
        As for `r_sample`.

    Returns
    -------
    sample : Sample
        Points, their t, and the true edges.

    Raises
    ------
    InputError
        If d is not positive and finite, or as for `r_sample`.

    Notes
    -----
    The note after Theorem 13: a sample within √(2 d LFS(p)) of every point p keeps the
    reconstruction within d. Where that is more than r · LFS(p), the latter holds. Proven over the
    whole curve, as for `r_sample`.

    Examples
    --------
    >>> from crustline.shapes import circle
    >>> [len(sample_for_error(circle(), d)) for d in (1e-1, 1e-3, 1e-5)]
    [13, 71, 703]
    """
    share = guaranteed_r("crust") if r is None else as_share("r", r)
    d = as_positive("d", d)

    def allowance(lfs: FloatArray) -> FloatArray:
        return np.minimum(spacing_for_error(d, lfs), share * lfs)

    with told_to(progress):
        return _sample(curve, allowance, share, seed, mode)


def _sample(
    curve: SmoothCurve, allowance: Allowance, r: float, seed: int | None, mode: Mode
) -> Sample:
    """Return a sample with a point within allowance(LFS(p)), r-Lipschitz, of each p."""
    as_choice("mode", mode, get_args(Mode))
    seed = None if seed is None else as_whole("seed", seed, 0)
    walks = [Walk(table) for table in tables(curve, allowance)]
    share = 1 - MARGIN
    for _ in range(MOST_ROUNDS):
        rng = np.random.default_rng(seed)
        starts = np.zeros(len(walks)) if seed is None else rng.random(len(walks))
        steps = None if mode == "sparsest" else rng
        loops = []
        for walk, u in zip(walks, starts, strict=True):
            loops.append(walk.samples(u, share, steps))
            tell("walk", len(loops) / len(walks))
        sample = _assembled(curve, loops)
        excess = supremum(curve, sample.points, allowance, r, 1e-4)
        if excess <= 1:
            return sample
        # For r near 1 the curve may come back towards a sample, which the walk does not foresee.
        share *= 0.999 / max(excess, 1.0)
    raise InputError(f"no sample was found for r = {r}: try a smaller r")


def _assembled(curve: SmoothCurve, loops: list[FloatArray]) -> Sample:
    u, counts = np.concatenate(loops), np.array([len(each) for each in loops])
    loop = np.repeat(np.arange(len(loops)), counts)
    starts = np.cumsum(counts) - counts
    i = np.arange(len(u))
    following = np.where(i + 1 < (starts + counts)[loop], i + 1, starts[loop])
    pairs = np.unique(np.sort(np.stack([i, following], -1), axis=1), axis=0)
    points = curve._on_loops(loop, u)[0]
    return Sample(points, (loop + u) / len(loops), pairs[pairs[:, 0] < pairs[:, 1]])
