"""crustline: curves from unordered points, by the crust and the β-skeleton.

The path that data takes::

    read → triangulate → select → trace → certify → write | plot

`reconstruct(points)` does the middle of it in one call.
"""

from importlib import import_module
from sys import modules
from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from crustline import distributed, shapes, theory
    from crustline._core import __version__
    from crustline.center_line import center_line
    from crustline.certify import Certificate, certify
    from crustline.connection import Connection, connection
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
        close_gaps,
        compatible_crust,
        conservative_crust,
        crawl,
        crossing_angle_graph,
        crust,
        gabriel,
        gamma_graph,
        gathan,
        hnn_crust,
        in_columns,
        minimum_spanning_tree,
        nn_crust,
        one_step_crust,
        peel,
        rcgh,
        relative_neighborhood,
        sig_delaunay,
    )
    from crustline.methods.connect import connect
    from crustline.points import Points
    from crustline.projection import project
    from crustline.reconstruction import Reconstruction, reconstruct
    from crustline.shapes.ratio import is_r_sample, sampling_ratio
    from crustline.shapes.sampling import Sample, r_sample, sample_for_error
    from crustline.slices import Plane, Slice, Slices, section, slices
    from crustline.smooth import Spline, Splines, smooth
    from crustline.stability import beta_interval, beta_of, max_edge_interval
    from crustline.theory import guaranteed_r
    from crustline.thinning import thin

#: Where the public names are; a test holds this against what type checkers are told above.
_NAMES = {
    "_core": "__version__",
    "center_line": "center_line",
    "certify": "Certificate certify",
    "connection": "Connection connection",
    "curves": "Curve Curves Polygon trace",
    "delaunay": "Delaunay",
    "denoise": "Denoised denoise",
    "errors": "CrustlineError FormatError InputError MissingExtraError",
    "formats": "read read_curves write",
    "interpolant": "Interpolant local_feature_size",
    "medial_axis": "MedialAxis medial_axis",
    "merge": "Merged merge",
    "methods": (
        "METHODS a_shape alpha_shape beta_skeleton by_group close_gaps compatible_crust "
        "conservative_crust crawl crossing_angle_graph crust gabriel gamma_graph gathan "
        "hnn_crust in_columns minimum_spanning_tree nn_crust one_step_crust peel rcgh "
        "relative_neighborhood sig_delaunay"
    ),
    "methods.connect": "connect",
    "points": "Points",
    "projection": "project",
    "reconstruction": "Reconstruction reconstruct",
    "shapes.ratio": "is_r_sample sampling_ratio",
    "shapes.sampling": "Sample r_sample sample_for_error",
    "slices": "Plane Slice Slices section slices",
    "stability": "beta_interval beta_of max_edge_interval",
    "smooth": "Spline Splines smooth",
    "theory": "guaranteed_r",
    "thinning": "thin",
}
_HOMES = {name: f"crustline.{module}" for module, names in _NAMES.items() for name in names.split()}


class _Package(ModuleType):
    """Imports a public name's module when the name is first asked for, so that `import` is fast."""

    def __getattr__(self, name: str) -> Any:
        if name in ("distributed", "shapes", "theory"):
            return import_module(f"crustline.{name}")
        if name not in _HOMES:
            raise AttributeError(f"module 'crustline' has no attribute {name!r}")
        thing = getattr(import_module(_HOMES[name]), name)
        setattr(self, name, thing)
        return thing

    def __setattr__(self, name: str, value: object) -> None:
        # The function `merge`, not the module `crustline.merge` that an import puts here.
        if not (isinstance(value, ModuleType) and name in _HOMES):
            super().__setattr__(name, value)

    def __reduce__(self) -> tuple[Any, ...]:
        # As modules have it of joblib and Dask, which send functions with what they use.
        return import_module, (self.__name__,)

    def __dir__(self) -> list[str]:
        """List the public names, and not the modules that they come from."""
        return __all__


modules[__name__].__class__ = _Package

__all__ = [
    "METHODS",
    "Certificate",
    "Connection",
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
    "Plane",
    "Points",
    "Polygon",
    "Reconstruction",
    "Sample",
    "Slice",
    "Slices",
    "Spline",
    "Splines",
    "__version__",
    "a_shape",
    "alpha_shape",
    "beta_interval",
    "beta_of",
    "beta_skeleton",
    "by_group",
    "center_line",
    "certify",
    "close_gaps",
    "compatible_crust",
    "connect",
    "connection",
    "conservative_crust",
    "crawl",
    "crossing_angle_graph",
    "crust",
    "denoise",
    "distributed",
    "gabriel",
    "gamma_graph",
    "gathan",
    "guaranteed_r",
    "hnn_crust",
    "in_columns",
    "is_r_sample",
    "local_feature_size",
    "max_edge_interval",
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
    "section",
    "shapes",
    "sig_delaunay",
    "slices",
    "smooth",
    "theory",
    "thin",
    "trace",
    "write",
]
