"""Points to the curves that they were sampled from."""

from itertools import islice

from qgis.core import (
    QgsField,
    QgsProcessing,
    QgsProcessingParameterBoolean,
    QgsProcessingParameterDistance,
    QgsProcessingParameterFeatureSink,
)
from qgis.PyQt.QtCore import QVariant

from .algorithm import Algorithm
from .vertices import feature, fields_before, kind_of

_FLAGS = {
    "CLOSED": ("--closed", "All curves are rings"),
    "JUNCTIONS": ("--junctions", "Curves may meet: T, X and Y"),
    "EVERY_POINT": ("--every-point", "No point is left out"),
}


class Reconstruct(Algorithm):
    """crustline reconstruct."""

    NAME, TITLE = "reconstruct", "Reconstruct curves"
    HELP = (
        "Finds the curves that points were sampled from: rings and lines through the points, in "
        "order. No parameter to guess.\n\n"
        "The method connect goes round corners, across gaps, and leaves outliers out; crust is the "
        "exact one of Amenta, Bern and Eppstein, with a theorem for dense samples.\n\n"
        "Curves have the fields curve, closed and points, and those of the layer where all points "
        "of a curve have the same value. The points in order have all fields of the layer, and "
        "curve and place; of points that belong to no curve these are empty. Polygons are the "
        "rings, nested ones as holes."
    )

    def add_parameters(self):
        for name, (_, title) in _FLAGS.items():
            self.addParameter(QgsProcessingParameterBoolean(name, title, False))
        self.addParameter(
            QgsProcessingParameterDistance(
                "MERGE", "Take points within this distance for one", None, "INPUT", True, 0.0
            )
        )
        for name, title, kind, optional in (
            ("OUTPUT", "Curves", QgsProcessing.TypeVectorLine, False),
            ("POLYGONS", "Polygons", QgsProcessing.TypeVectorPolygon, True),
            ("POINTS", "Points in order", QgsProcessing.TypeVectorPoint, True),
        ):
            self.addParameter(
                QgsProcessingParameterFeatureSink(name, title, kind, None, optional, not optional)
            )

    def arguments(self, parameters, context):
        words = [
            flag for name, (flag, _) in _FLAGS.items()
            if self.parameterAsBool(parameters, name, context)
        ]  # fmt: skip
        if parameters.get("MERGE") is not None:
            words += ["--merge", repr(self.parameterAsDouble(parameters, "MERGE", context))]
        return [*words, "--polygons"]

    def write(self, vertices, found, summary, run):
        curves, polygons = [], []
        for each in found:
            if each["properties"]["curve"] is not None:
                parts = _parts(each)
                closed = each["properties"]["closed"]
                curves += [(rows, closed) for rows in parts]
                polygons += [parts] if closed else []
        outputs = {
            "OUTPUT": self._curves(vertices, curves, run),
            "POLYGONS": self._polygons(vertices, polygons, run),
            "POINTS": self._points(vertices, curves, run),
        }
        return {name: target for name, target in outputs.items() if target is not None}

    def _curves(self, vertices, curves, run):
        own = [QgsField("curve", QVariant.Int), QgsField("closed", QVariant.Bool),
               QgsField("points", QVariant.Int)]  # fmt: skip
        fields = fields_before(vertices.source.fields(), *own)
        sink, target = self.sink("OUTPUT", fields, kind_of(vertices, "LineString"), vertices, run)
        for number, (rows, closed) in enumerate(curves):
            values = [number, closed, len(rows), *vertices.shared(rows)]
            sink.addFeature(feature(fields, vertices.line(rows, closed), values))
        return target

    def _polygons(self, vertices, polygons, run):
        own = [QgsField("polygon", QVariant.Int), QgsField("holes", QVariant.Int)]
        fields = fields_before(vertices.source.fields(), *own)
        sink, target = self.sink("POLYGONS", fields, kind_of(vertices, "Polygon"), vertices, run)
        for number, parts in enumerate(polygons if sink else ()):
            rows = [row for part in parts for row in part]
            values = [number, len(parts) - 1, *vertices.shared(rows)]
            sink.addFeature(feature(fields, vertices.polygon(parts), values))
        return target if sink else None

    def _points(self, vertices, curves, run):
        own = [QgsField("curve", QVariant.Int), QgsField("place", QVariant.Int)]
        fields = fields_before(vertices.source.fields(), *own)
        sink, target = self.sink("POINTS", fields, kind_of(vertices, "Point"), vertices, run)
        if sink is None:
            return None
        ordered = [
            (row, number, place)
            for number, (rows, _) in enumerate(curves)
            for place, row in enumerate(rows)
        ]
        left = set(range(len(vertices.places))) - {row for row, _, _ in ordered}
        for row, number, place in [*ordered, *((row, None, None) for row in sorted(left))]:
            values = [number, place, *vertices.of(row)]
            sink.addFeature(feature(fields, vertices.places[row], values))
        return target


def _parts(found):
    """Return the rows of each ring of a polygon, or those of a line."""
    rows = iter(found["properties"]["rows"])
    if found["geometry"]["type"] != "Polygon":
        return [list(rows)]
    return [list(islice(rows, len(ring) - 1)) for ring in found["geometry"]["coordinates"]]
