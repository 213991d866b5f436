"""crustline: curves from unordered points, by the crust and the β-skeleton.

The path that data takes::

    read → triangulate → select → trace → certify → write | plot

`reconstruct(points)` does the middle of it in one call.
"""

from crustline import shapes, theory
from crustline._core import __version__
from crustline.certify import Certificate, certify
from crustline.curves import Curve, Curves, Polygon, trace
from crustline.delaunay import Delaunay
from crustline.denoise import Denoised, denoise
from crustline.errors import CrustlineError, FormatError, InputError, MissingExtraError
from crustline.formats import read, read_curves, write
from crustline.interpolant import Interpolant, local_feature_size
from crustline.medial_axis import MedialAxis, medial_axis
from crustline.merge import Merged, merge
from crustline.methods import (
    METHODS,
    a_shape,
    alpha_shape,
    beta_skeleton,
    by_group,
    compatible_crust,
    connect,
    conservative_crust,
    crawl,
    crossing_angle_graph,
    crust,
    gabriel,
    gamma_graph,
    gathan,
    hnn_crust,
    minimum_spanning_tree,
    nn_crust,
    one_step_crust,
    peel,
    rcgh,
    relative_neighborhood,
    sig_delaunay,
)
from crustline.points import Points
from crustline.projection import project
from crustline.reconstruction import Reconstruction, reconstruct
from crustline.shapes.ratio import is_r_sample, sampling_ratio
from crustline.shapes.sampling import Sample, r_sample, sample_for_error
from crustline.smooth import Spline, Splines, smooth
from crustline.theory import guaranteed_r
from crustline.thinning import thin


def __dir__() -> list[str]:
    """List the public names, and not the modules that they come from."""
    return __all__


__all__ = [
    "METHODS",
    "Certificate",
    "CrustlineError",
    "Curve",
    "Curves",
    "Delaunay",
    "Denoised",
    "FormatError",
    "InputError",
    "Interpolant",
    "MedialAxis",
    "Merged",
    "MissingExtraError",
    "Points",
    "Polygon",
    "Reconstruction",
    "Sample",
    "Spline",
    "Splines",
    "__version__",
    "a_shape",
    "alpha_shape",
    "beta_skeleton",
    "by_group",
    "certify",
    "compatible_crust",
    "connect",
    "conservative_crust",
    "crawl",
    "crossing_angle_graph",
    "crust",
    "denoise",
    "gabriel",
    "gamma_graph",
    "gathan",
    "guaranteed_r",
    "hnn_crust",
    "is_r_sample",
    "local_feature_size",
    "medial_axis",
    "merge",
    "minimum_spanning_tree",
    "nn_crust",
    "one_step_crust",
    "peel",
    "project",
    "r_sample",
    "rcgh",
    "read",
    "read_curves",
    "reconstruct",
    "relative_neighborhood",
    "sample_for_error",
    "sampling_ratio",
    "shapes",
    "sig_delaunay",
    "smooth",
    "theory",
    "thin",
    "trace",
    "write",
]
