"""Pictures of points, triangulations, curves, medial axes and certificates, with matplotlib.

Each `plot_…` function draws into the Axes given, or into those of a new Figure that belongs to no
window, and returns the Axes: ``plot_curves(curves).figure.savefig("curves.svg")``. The colors are
those of Okabe and Ito [1]_, which the color-blind can tell apart.

References
----------
.. [1] M. Okabe, K. Ito, "Color Universal Design", 2008, https://jfly.uni-koeln.de/color/.
"""

from crustline.plot.axes import BLACK, BLUE, GRAY, GREEN, ORANGE, PURPLE, SKY, VERMILLION
from crustline.plot.background import plot_background
from crustline.plot.certificate import plot_certificate
from crustline.plot.connection import plot_connection
from crustline.plot.curves import plot_curves, plot_edges
from crustline.plot.delaunay import plot_delaunay, plot_voronoi
from crustline.plot.denoised import plot_denoised
from crustline.plot.medial_axis import plot_medial_axis
from crustline.plot.picture import LAYERS, picture
from crustline.plot.points import plot_indices, plot_local_feature_size, plot_points

__all__ = [
    "BLACK",
    "BLUE",
    "GRAY",
    "GREEN",
    "LAYERS",
    "ORANGE",
    "PURPLE",
    "SKY",
    "VERMILLION",
    "picture",
    "plot_background",
    "plot_certificate",
    "plot_connection",
    "plot_curves",
    "plot_delaunay",
    "plot_denoised",
    "plot_edges",
    "plot_indices",
    "plot_local_feature_size",
    "plot_medial_axis",
    "plot_points",
    "plot_voronoi",
]
