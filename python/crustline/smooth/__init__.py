"""Smooth reconstruction: C2 cubic splines through rings and polylines, and few Bézier pieces."""

from crustline.smooth.fit import CORNER_ANGLE, Ends, smooth
from crustline.smooth.spline import Spline
from crustline.smooth.splines import Splines

__all__ = ["CORNER_ANGLE", "Ends", "Spline", "Splines", "smooth"]
