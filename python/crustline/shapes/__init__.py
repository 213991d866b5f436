"""Known smooth curves and point sets: a catalogue with its sources, and samples of them.

A `SmoothCurve` is what the paper (§2) calls a smooth curve: one or more closed loops that neither
cross nor touch. `t` in [0, 1) runs over all of them; with c loops the first has [0, 1/c), the
second [1/c, 2/c), and so on. `curve.local_feature_size` measures it, `crustline.r_sample` samples
it, `crustline.sampling_ratio` says how well points do.
"""

from crustline.shapes.catalogue import (
    blob,
    circle,
    ellipse,
    fourier,
    spline,
    stadium,
    superformula,
    trefoil,
)
from crustline.shapes.curve import Loop, SmoothCurve, union
from crustline.shapes.figures import (
    lattice,
    regular_polygon,
    two_octagons,
    two_octagons_joined,
    two_octagons_separate,
)
from crustline.shapes.medial_axis import CurveMedialAxis
from crustline.shapes.svg_path import bezier_path

__all__ = [
    "CurveMedialAxis",
    "Loop",
    "SmoothCurve",
    "bezier_path",
    "blob",
    "circle",
    "ellipse",
    "fourier",
    "lattice",
    "regular_polygon",
    "spline",
    "stadium",
    "superformula",
    "trefoil",
    "two_octagons",
    "two_octagons_joined",
    "two_octagons_separate",
    "union",
]
