"""crustline: curves from unordered points, by the crust and the β-skeleton.

The path that data takes::

    read → triangulate → select → trace → certify → write | plot

`reconstruct(points)` does the middle of it in one call.
"""

from crustline._core import __version__
from crustline.curves import Curve, Curves, reconstruct, trace
from crustline.delaunay import Delaunay
from crustline.errors import CrustlineError, FormatError, InputError, MissingExtraError
from crustline.formats import read, write
from crustline.methods import METHODS, crust, one_step_crust
from crustline.points import Points

__all__ = [
    "METHODS",
    "CrustlineError",
    "Curve",
    "Curves",
    "Delaunay",
    "FormatError",
    "InputError",
    "MissingExtraError",
    "Points",
    "__version__",
    "crust",
    "one_step_crust",
    "read",
    "reconstruct",
    "trace",
    "write",
]
