"""crustline: curves from unordered points, by the crust and the β-skeleton.

The path that data takes::

    read → triangulate → select → trace → certify → write | plot

`reconstruct(points)` does the middle of it in one call.
"""

from importlib import import_module
from sys import modules
from types import ModuleType
from typing import TYPE_CHECKING, Any

# For type checkers, who take `as` for a promise that the name is public here.
# isort: off
if TYPE_CHECKING:
    from crustline import distributed as distributed, shapes as shapes, theory as theory
    from crustline._core import __version__ as __version__
    from crustline.center_line import center_line as center_line
    from crustline.certify import Certificate as Certificate, certify as certify
    from crustline.connection import Connection as Connection, connection as connection
    from crustline.curves import (
        Curve as Curve,
        Curves as Curves,
        Polygon as Polygon,
        trace as trace,
    )
    from crustline.delaunay import Delaunay as Delaunay
    from crustline.denoise import Denoised as Denoised, denoise as denoise
    from crustline.errors import (
        CrustlineError as CrustlineError,
        FormatError as FormatError,
        InputError as InputError,
        MissingExtraError as MissingExtraError,
    )
    from crustline.formats import read as read, read_curves as read_curves, write as write
    from crustline.interpolant import (
        Interpolant as Interpolant,
        local_feature_size as local_feature_size,
    )
    from crustline.medial_axis import MedialAxis as MedialAxis, medial_axis as medial_axis
    from crustline.merge import Merged as Merged, merge as merge
    from crustline.methods import (
        METHODS as METHODS,
        a_shape as a_shape,
        alpha_shape as alpha_shape,
        beta_skeleton as beta_skeleton,
        by_group as by_group,
        close_gaps as close_gaps,
        compatible_crust as compatible_crust,
        conservative_crust as conservative_crust,
        crawl as crawl,
        crossing_angle_graph as crossing_angle_graph,
        crust as crust,
        gabriel as gabriel,
        gamma_graph as gamma_graph,
        gathan as gathan,
        hnn_crust as hnn_crust,
        in_columns as in_columns,
        minimum_spanning_tree as minimum_spanning_tree,
        nn_crust as nn_crust,
        one_step_crust as one_step_crust,
        peel as peel,
        rcgh as rcgh,
        relative_neighborhood as relative_neighborhood,
        sig_delaunay as sig_delaunay,
    )
    from crustline.methods.connect import connect as connect
    from crustline.points import Points as Points
    from crustline.projection import project as project
    from crustline.reconstruction import (
        Reconstruction as Reconstruction,
        reconstruct as reconstruct,
    )
    from crustline.shapes.ratio import is_r_sample as is_r_sample, sampling_ratio as sampling_ratio
    from crustline.shapes.sampling import (
        Sample as Sample,
        r_sample as r_sample,
        sample_for_error as sample_for_error,
    )
    from crustline.slices import (
        Plane as Plane,
        Slice as Slice,
        Slices as Slices,
        section as section,
        slices as slices,
    )
    from crustline.smooth import Spline as Spline, Splines as Splines, smooth as smooth
    from crustline.stability import (
        beta_interval as beta_interval,
        beta_of as beta_of,
        max_edge_interval as max_edge_interval,
    )
    from crustline.theory import guaranteed_r as guaranteed_r
    from crustline.thinning import thin as thin

# isort: on

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
_MODULES = ("distributed", "shapes", "theory")
__all__ = sorted([*_HOMES, *_MODULES])


class _Package(ModuleType):
    """Imports a public name's module when the name is first asked for, so that `import` is fast."""

    def __getattr__(self, name: str) -> Any:
        if name in _MODULES:
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
