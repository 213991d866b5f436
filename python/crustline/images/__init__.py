"""Points of pictures: of edges, of the boundaries of areas, of the middles of strokes.

Pixel coordinates are those of drawings: x to the right, y upwards, the upper left corner of the
picture at (0, 0), a pixel one unit wide. All y of a picture are therefore negative, the middle of
the first pixel is (0.5, -0.5), and a drawing of the points shows them the right way up.
"""

from crustline.images.axes import Axes
from crustline.images.boundary import boundary_points
from crustline.images.edges import edge_points
from crustline.images.strokes import stroke_points

__all__ = ["Axes", "boundary_points", "edge_points", "stroke_points"]
