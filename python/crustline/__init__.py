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
from crustline.errors import CrustlineError, FormatError, InputError, MissingExtraError
from crustline.formats import read, write
from crustline.interpolant import Interpolant, local_feature_size
from crustline.medial_axis import MedialAxis, medial_axis
from crustline.methods import (
    METHODS,
    a_shape,
    alpha_shape,
    beta_skeleton,
    connect,
    crossing_angle_graph,
    crust,
    gabriel,
    gamma_graph,
    minimum_spanning_tree,
    nn_crust,
    one_step_crust,
    rcgh,
    relative_neighborhood,
)
from crustline.points import Points
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
    "FormatError",
    "InputError",
    "Interpolant",
    "MedialAxis",
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
    "certify",
    "connect",
    "crossing_angle_graph",
    "crust",
    "gabriel",
    "gamma_graph",
    "guaranteed_r",
    "is_r_sample",
    "local_feature_size",
    "medial_axis",
    "minimum_spanning_tree",
    "nn_crust",
    "one_step_crust",
    "r_sample",
    "rcgh",
    "read",
    "reconstruct",
    "relative_neighborhood",
    "sample_for_error",
    "sampling_ratio",
    "shapes",
    "smooth",
    "theory",
    "thin",
    "trace",
    "write",
]
