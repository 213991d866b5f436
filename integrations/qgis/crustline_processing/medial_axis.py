"""Points to the medial axis of their curves."""

from qgis.core import (
    QgsField,
    QgsFields,
    QgsLineString,
    QgsPoint,
    QgsProcessing,
    QgsProcessingParameterDistance,
    QgsProcessingParameterEnum,
    QgsProcessingParameterFeatureSink,
    QgsWkbTypes,
)
from qgis.PyQt.QtCore import QVariant

from .algorithm import Algorithm
from .vertices import feature

_PARTS = ["all", "inner", "outer"]


class MedialAxis(Algorithm):
    """crustline medial-axis."""

    NAME, TITLE = "medial-axis", "Medial axis"
    HELP = (
        "Finds the medial axis of the curves that points were sampled from, such as the middle "
        "line of a river or a street: the Voronoi edges of the points that no curve crosses.\n\n"
        "Inner is what is inside of rings. Pruning leaves out branches that stand for less than "
        "a length of the curve."
    )

    def add_parameters(self):
        self.addParameter(
            QgsProcessingParameterEnum("PART", "Part", _PARTS, defaultValue="inner",
                                       usesStaticStrings=True)
        )  # fmt: skip
        self.addParameter(
            QgsProcessingParameterDistance("PRUNE", "Prune below", 0.0, "INPUT", False, 0.0)
        )
        self.addParameter(
            QgsProcessingParameterFeatureSink("OUTPUT", "Axis", QgsProcessing.TypeVectorLine)
        )

    def arguments(self, parameters, context):
        part = self.parameterAsEnumString(parameters, "PART", context)
        words = [] if part == "all" else [f"--{part}"]
        return [*words, "--prune", repr(self.parameterAsDouble(parameters, "PRUNE", context))]

    def write(self, vertices, found, summary, run):
        fields = QgsFields()
        fields.append(QgsField("line", QVariant.Int))
        sink, target = self.sink("OUTPUT", fields, QgsWkbTypes.LineString, vertices, run)
        lines = [each for each in found if each["geometry"]["type"] == "LineString"]
        for number, each in enumerate(lines):
            places = [QgsPoint(*place) for place in each["geometry"]["coordinates"]]
            sink.addFeature(feature(fields, QgsLineString(places), [number]))
        return {"OUTPUT": target}
