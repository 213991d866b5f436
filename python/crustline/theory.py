"""The inequalities of the paper, and the sampling ratios that follow from them.

Every function here is one formula of Amenta, Bern and Eppstein [1]_ in terms of the sampling ratio
r: "the curve is r-sampled" means that every point p of it is within r · LFS(p) of a sample. Lengths
are in units of the local feature size, angles in radians. A scalar r gives a float, an array of
them an array of the same shape. The thresholds are solved from these formulas, none is typed.

References
----------
.. [1] N. Amenta, M. Bern, D. Eppstein, "The Crust and the β-Skeleton: Combinatorial Curve
   Reconstruction", Graphical Models and Image Processing 60 (1998), 125–135.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache, wraps
from inspect import signature
from typing import Any, Protocol, TypeAlias, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from crustline.arrays import as_floats
from crustline.errors import InputError, shown
from crustline.scalars import as_positive, as_real

__all__ = [
    "BETA",
    "best_beta",
    "beta",
    "central_angle",
    "containing_r",
    "crust_containment",
    "crust_exclusion",
    "excluding_r",
    "guaranteed_r",
    "phi",
    "phi_above_medial_axis",
    "phi_above_neighbors",
    "phi_below_nonadjacent",
    "reconstruction_error",
    "sample_angle",
    "spacing_for_error",
    "tangent_angle",
    "vertex_angle",
]

#: The β of Theorem 20: near the best, see `best_beta`.
BETA = 1.70

Floats: TypeAlias = NDArray[np.float64]
Method: TypeAlias = str | Callable[..., Any]


class Bound(Protocol):
    """A formula in one variable: a float for a float, an array for an array."""

    @overload
    def __call__(self, value: float, /) -> float: ...
    @overload
    def __call__(self, value: ArrayLike, /) -> Floats: ...


def _defined_on(name: str, low: float, high: float) -> Callable[[Callable[[Any], Any]], Bound]:
    """Return a decorator that makes a formula in NumPy a `Bound` on the values in [low, high]."""

    def decorate(formula: Callable[[Any], Any]) -> Bound:
        parameters = signature(formula)

        @wraps(formula)
        def bound(*given: Any, **named: Any) -> Any:
            (value,) = parameters.bind(*given, **named).arguments.values()
            values = as_floats(name, value)
            outside = ~((values >= low) & (values <= high))
            if outside.any():
                raise InputError(
                    f"{formula.__name__} is defined for {name} in [{low:.6g}, {high:.6g}], "
                    f"got {values[outside].flat[0]}"
                )
            with np.errstate(over="ignore"):
                result = formula(values)
            return float(result) if values.ndim == 0 else result

        return bound

    return decorate


# --- Flatness: Observation 8, Lemmas 9 and 10 ---------------------------------------------------


@_defined_on("r", 0, 1)
def central_angle(r: Any) -> Any:
    """Return γ, the angle at the center of a unit circle that sees a chord of length r.

    Observation 8 ii: γ = 2 arcsin(r/2).

    Parameters
    ----------
    r : float or array_like of float
        Sampling ratio, 0 to 1: a sample s is at distance r from p, the unit is LFS(p).

    Returns
    -------
    gamma : float or ndarray of float64
        Radians.

    Examples
    --------
    >>> round(central_angle(1.0), 6) == round(math.pi / 3, 6)
    True
    """
    return 2 * np.arcsin(r / 2)


@_defined_on("r", 0, 1)
def tangent_angle(r: Any) -> Any:
    """Return α, the largest angle between the tangent at p and the segment from p to a sample.

    Observation 8 iii and iv: α = γ/2 = arcsin(r/2).

    Parameters
    ----------
    r : float or array_like of float
        Sampling ratio, 0 to 1.

    Returns
    -------
    alpha : float or ndarray of float64
        Radians.

    Examples
    --------
    >>> tangent_angle(0.0)
    0.0
    """
    return np.arcsin(r / 2)


@_defined_on("r", 0, 1)
def vertex_angle(r: Any) -> Any:
    """Return the least angle at a curve Voronoi vertex between its two adjacent samples.

    Lemma 9: π - 2 arcsin(r/2).

    Parameters
    ----------
    r : float or array_like of float
        Sampling ratio, 0 to 1.

    Returns
    -------
    angle : float or ndarray of float64
        Radians.

    Notes
    -----
    Attained on a circle.

    Examples
    --------
    >>> round(math.degrees(vertex_angle(0.5)), 3)
    151.045
    """
    return math.pi - 2 * np.arcsin(r / 2)


@_defined_on("r", 0, 1)
def sample_angle(r: Any) -> Any:
    """Return the least angle at a sample between the two samples adjacent to it.

    Lemma 10: π - 4 arcsin(r/2).

    Parameters
    ----------
    r : float or array_like of float
        Sampling ratio, 0 to 1.

    Returns
    -------
    angle : float or ndarray of float64
        Radians.

    Notes
    -----
    Attained on a circle. The paper leaves the proof to the reader; `docs/theory.md` has one.

    Examples
    --------
    >>> round(math.degrees(sample_angle(0.252)), 3)
    151.046
    """
    return math.pi - 4 * np.arcsin(r / 2)


# --- The reconstruction is close to the curve: Theorem 13 ---------------------------------------


@_defined_on("r", 0, 1)
def reconstruction_error(r: Any) -> Any:
    """Return how far the curve can be from its polygonal reconstruction, in local feature sizes.

    Theorem 13: r²/2.

    Parameters
    ----------
    r : float or array_like of float
        Sampling ratio, 0 to 1.

    Returns
    -------
    error : float or ndarray of float64
        Distance divided by LFS(p), at the point p of a piece of the curve that is farthest from
        the segment between the two samples of that piece.

    Notes
    -----
    Attained on a circle. The paper's proof is about that farthest point; `docs/theory.md` says what
    follows for the others.

    Examples
    --------
    >>> reconstruction_error(0.5)
    0.125
    """
    return r * r / 2


def spacing_for_error(distance: float, feature_size: ArrayLike) -> Floats:
    """Return how near a sample must be to keep the reconstruction within a distance of the curve.

    The note after Theorem 13: a sample within √(2 d LFS(p)) of every point p of the curve.

    Parameters
    ----------
    distance : float
        d, the distance to keep; positive, in the units of the coordinates.
    feature_size : array_like of float
        LFS(p), in the same units, one value for each p.

    Returns
    -------
    spacing : ndarray of float64, shape of `feature_size`
        At most LFS(p): from d = LFS(p)/2 on, the condition r ≤ 1 of the theorem is what binds.

    Raises
    ------
    InputError
        If the distance is not positive and finite, or a local feature size is negative or no
        number.

    Examples
    --------
    >>> spacing_for_error(0.02, [1.0, 4.0, 0.01]).tolist()
    [0.2, 0.4, 0.01]
    """
    distance = as_positive("distance", distance)
    sizes = as_floats("feature_size", feature_size)
    if not np.all(sizes >= 0):
        raise InputError(f"feature_size must be 0 or more, got {sizes[~(sizes >= 0)].flat[0]}")
    half = sizes / 2
    # Two roots: the product of two large numbers may be beyond all floats, its root is not.
    spacing = np.sqrt(2 * np.minimum(distance, half)) * np.sqrt(sizes)
    return np.where(distance < half, spacing, sizes)


# --- The crust: Theorems 14 and 15 --------------------------------------------------------------


@_defined_on("r", 0, 1)
def crust_containment(r: Any) -> Any:
    """Return how far a Voronoi disk centered in a curve Voronoi disk can reach.

    Theorem 14, the left side: r + 2r sin((π + 2 arcsin(r/2))/4). While it is at most 1 the disk
    cannot hold a point of the medial axis, which it would have to by Lemma 2, so the crust has an
    edge between all adjacent samples.

    Parameters
    ----------
    r : float or array_like of float
        Sampling ratio, 0 to 1.

    Returns
    -------
    reach : float or ndarray of float64
        In local feature sizes. Increases with r.

    Notes
    -----
    It is 1 at r = 0.39265. At the paper's 0.40 it is above 1.

    Examples
    --------
    >>> round(crust_containment(0.40), 4)
    1.0197
    """
    return r + 2 * r * np.sin((math.pi + 2 * np.arcsin(r / 2)) / 4)


@_defined_on("r", 0, 1)
def crust_exclusion(r: Any) -> Any:
    """Return the margin by which the crust leaves out edges between non-adjacent samples.

    Theorem 15: sin(π/4 - 2 arcsin(r/2)) - 2r. While it is positive, the two conditions that such
    an edge would need contradict each other.

    Parameters
    ----------
    r : float or array_like of float
        Sampling ratio, 0 to 1.

    Returns
    -------
    margin : float or ndarray of float64
        Decreases with r.

    Notes
    -----
    It is 0 at r = 0.25335; the paper states 0.252, where it is still positive.

    Examples
    --------
    >>> round(crust_exclusion(0.252), 4)
    0.0039
    """
    return np.sin(math.pi / 4 - 2 * np.arcsin(r / 2)) - 2 * r


# --- The β-skeleton: Observation 16, Lemmas 17 to 19 --------------------------------------------


@_defined_on("beta", 1, math.inf)
def phi(beta: Any) -> Any:
    """Return φ, half the angle at which the two circles of a forbidden region cross.

    Observation 16: φ = arcsin(1/β).

    Parameters
    ----------
    beta : float or array_like of float
        At least 1.

    Returns
    -------
    phi : float or ndarray of float64
        Radians; π/2 at β = 1 (the Gabriel graph), 0 in the limit of large β.

    Examples
    --------
    >>> round(phi(1.70), 5)
    0.62887
    """
    return np.arcsin(1 / beta)


@_defined_on("phi", math.ulp(0.0), math.pi / 2)
def beta(phi: Any) -> Any:
    """Return the β whose forbidden regions have the angle φ.

    Observation 16: β = 1/sin φ.

    Parameters
    ----------
    phi : float or array_like of float
        Radians, above 0 and at most π/2.

    Returns
    -------
    beta : float or ndarray of float64
        At least 1.

    Notes
    -----
    The paper's φ ≈ 0.637 belongs to β = 1.681; its β = 1.70 to φ = 0.62887.

    Examples
    --------
    >>> round(beta(0.637), 3)
    1.681
    """
    return 1 / np.sin(phi)


@_defined_on("r", 0, 1)
def phi_above_neighbors(r: Any) -> Any:
    """Return the φ above which the next sample cannot lie in the forbidden region of an edge.

    Lemma 17, curve (2) of Figure 14: φ > 4 arcsin(r/2).

    Parameters
    ----------
    r : float or array_like of float
        Sampling ratio, 0 to 1.

    Returns
    -------
    phi : float or ndarray of float64
        Radians. Increases with r. Above π/2 no β ≥ 1 satisfies it.

    Examples
    --------
    >>> phi_above_neighbors(0.297) < phi(1.70)
    True
    """
    return 4 * np.arcsin(r / 2)


#: Where 2 sin(2 arcsin(r/2)) reaches 1: Lemma 18 asks nothing that a φ could satisfy beyond.
_LEMMA_18_END = 2 * math.sin(math.pi / 12)


@_defined_on("r", 0, _LEMMA_18_END)
def phi_above_medial_axis(r: Any) -> Any:
    """Return the φ above which the forbidden region of an edge holds no point of the medial axis.

    Lemma 18, curve (3) of Figure 14: φ > arcsin(2 sin(2 arcsin(r/2))), for adjacent samples.

    Parameters
    ----------
    r : float or array_like of float
        Sampling ratio, 0 to 0.5176 (2 sin(π/12), where the arcsine ends).

    Returns
    -------
    phi : float or ndarray of float64
        Radians. Increases with r.

    Notes
    -----
    Sufficient, not necessary: curve (2) already suffices, see `docs/theory.md`.

    Examples
    --------
    >>> phi_above_medial_axis(0.297) < phi(1.70)
    True
    """
    return np.arcsin(np.minimum(2 * np.sin(2 * np.arcsin(r / 2)), 1.0))


@_defined_on("r", 0, 0.5)
def phi_below_nonadjacent(r: Any) -> Any:
    """Return the φ below which the β-skeleton has no edge between non-adjacent samples.

    Lemma 19, curve (1) of Figure 14: φ < arccos(2r) - 2 arcsin(r/2).

    Parameters
    ----------
    r : float or array_like of float
        Sampling ratio, 0 to 0.5 (where the arccosine ends).

    Returns
    -------
    phi : float or ndarray of float64
        Radians. Decreases with r; below 0 no β satisfies it.

    Examples
    --------
    >>> phi_below_nonadjacent(0.297) > phi(1.70)
    True
    """
    return np.arccos(2 * r) - 2 * np.arcsin(r / 2)


# --- The thresholds -----------------------------------------------------------------------------


def _last(holds: Callable[[float], bool], low: float, high: float) -> float:
    """Return the largest double in [low, high] up to which `holds`, a condition that fails once."""
    if holds(high):
        return high
    while True:
        middle = low + (high - low) / 2
        if middle in (low, high):
            return low
        low, high = (middle, high) if holds(middle) else (low, middle)


def _name(method: Method) -> str:
    """Return the name of a method given by its name or as the function itself."""
    name = method if isinstance(method, str) else getattr(method, "__name__", shown(method))
    return name.replace("-", "_")


def _unknown(method: Method, known: str) -> InputError:
    name = shown(method) if isinstance(method, str) else _name(method)[:60]
    return InputError(f"the paper proves nothing of this kind for {name}: ask for {known}")


def containing_r(method: Method, beta: float = BETA) -> float:
    """Return the r below which a method finds every edge between samples adjacent on the curve.

    It may find other edges too: see `guaranteed_r` for the r below which it does not.

    Parameters
    ----------
    method : str or callable
        "delaunay", "crust", "one_step_crust", "beta_skeleton" or "gabriel", or the function.
    beta : float, default 1.70
        At least 1; for "beta_skeleton" only.

    Returns
    -------
    r : float
        A smooth curve that is r'-sampled with any r' < r has all its edges in the answer.

    Raises
    ------
    InputError
        If the paper proves nothing for the method, or β is below 1.

    Notes
    -----
    delaunay: Theorem 12. crust: Theorem 14, solved. one_step_crust: it contains the crust.
    beta_skeleton: Lemmas 17 and 18, solved; gabriel is β = 1. Solved to the last double for which
    the inequality holds as computed.

    Examples
    --------
    >>> containing_r("delaunay"), round(containing_r("crust"), 5)
    (1.0, 0.39265)
    """
    match _name(method):
        case "delaunay" | "Delaunay":
            return 1.0
        case "crust" | "one_step_crust":
            return _crust_containing_r()
        case "beta_skeleton":
            return _skeleton_containing_r(phi(as_real("beta", beta)))
        case "gabriel":
            return _skeleton_containing_r(math.pi / 2)
    raise _unknown(method, "delaunay, crust, one_step_crust, beta_skeleton or gabriel")


def excluding_r(method: Method, beta: float = BETA) -> float:
    """Return the r below which a method finds no edge between non-adjacent samples.

    Parameters
    ----------
    method : str or callable
        "crust" or "beta_skeleton", or the function.
    beta : float, default 1.70
        At least 1; for "beta_skeleton" only. At β = 1 the answer is 0.

    Returns
    -------
    r : float
        A smooth curve that is r'-sampled with any r' < r has no other edges in the answer.

    Raises
    ------
    InputError
        If the paper proves nothing for the method, or β is below 1.

    Notes
    -----
    crust: Theorem 15, solved. beta_skeleton: Lemma 19, solved.

    Examples
    --------
    >>> round(excluding_r("crust"), 5)
    0.25335
    """
    match _name(method):
        case "crust":
            return _crust_excluding_r()
        case "beta_skeleton":
            return _skeleton_excluding_r(phi(as_real("beta", beta)))
    raise _unknown(method, "crust or beta_skeleton")


def guaranteed_r(method: Method, beta: float = BETA) -> float:
    """Return the r below which a method's answer is the polygonal reconstruction of the curve.

    Parameters
    ----------
    method : str or callable
        "crust" or "beta_skeleton", or the function `crustline.crust`, `crustline.beta_skeleton`.
    beta : float, default 1.70
        At least 1; for "beta_skeleton" only.

    Returns
    -------
    r : float
        If every point p of a smooth closed curve (of any number of components) has a sample within
        r' · LFS(p), r' < r, the method joins exactly the samples adjacent along it. Zero if there
        is no such r.

    Raises
    ------
    InputError
        If the paper proves nothing for the method, or β is below 1.

    Notes
    -----
    The lesser of `containing_r` and `excluding_r`: Theorems 14 and 15 for the crust, Theorem 20
    with the β asked for in place of 1.70. The paper rounds down: 0.252 and 0.297.

    Examples
    --------
    >>> round(guaranteed_r("crust"), 5)
    0.25335
    >>> round(guaranteed_r("beta_skeleton"), 5)
    0.29742
    >>> round(guaranteed_r("beta_skeleton", 1.25), 5)
    0.2099
    """
    return min(excluding_r(method, beta), containing_r(method, beta))


def best_beta() -> tuple[float, float]:
    """Return the β whose skeleton is guaranteed for the sparsest samples, and the r it allows.

    Returns
    -------
    beta, r : float
        The tip of the shaded region of Figure 14.

    Notes
    -----
    Theorem 20 rounds both: β = 1.70, r = 0.297. The best by these bounds, which are not tight.

    Examples
    --------
    >>> [round(value, 4) for value in best_beta()]
    [1.694, 0.2985]
    """
    r = _last(lambda r: _lowest_phi(r) < phi_below_nonadjacent(r), 0.0, 0.5)
    return beta(phi_below_nonadjacent(r)), r


def _lowest_phi(r: float) -> float:
    """Return the φ above which the β-skeleton joins all adjacent samples: Lemmas 17 and 18."""
    return max(phi_above_neighbors(r), phi_above_medial_axis(r))


@cache
def _crust_containing_r() -> float:
    return _last(lambda r: crust_containment(r) <= 1, 0.0, 1.0)


@cache
def _crust_excluding_r() -> float:
    return _last(lambda r: crust_exclusion(r) > 0, 0.0, 1.0)


@cache
def _skeleton_containing_r(phi: float) -> float:
    return _last(lambda r: _lowest_phi(r) < phi, 0.0, _LEMMA_18_END)


@cache
def _skeleton_excluding_r(phi: float) -> float:
    return _last(lambda r: phi < phi_below_nonadjacent(r), 0.0, 0.5)
