"""The fewest points that keep the curves."""

from qgis.core import (
    QgsProcessing,
    QgsProcessingParameterFeatureSink,
    QgsProcessingParameterNumber,
)

from .algorithm import Algorithm
from .vertices import feature, kind_of


class Thin(Algorithm):
    """crustline thin."""

    NAME, TITLE = "thin", "Thin points"
    HELP = (
        "Drops the points that the curves do not need: each point keeps one within R times its "
        "distance to the medial axis. With R = 0.2 the crust of what is kept is in general the "
        "same curve. All fields are kept."
    )

    def add_parameters(self):
        self.addParameter(
            QgsProcessingParameterNumber(
                "R", "R", QgsProcessingParameterNumber.Double, 0.2, False, 0.0, 1.0
            )
        )
        self.addParameter(
            QgsProcessingParameterFeatureSink("OUTPUT", "Points", QgsProcessing.TypeVectorPoint)
        )

    def arguments(self, parameters, context):
        return ["-r", repr(self.parameterAsDouble(parameters, "R", context))]

    def write(self, vertices, found, summary, run):
        fields = vertices.source.fields()
        sink, target = self.sink("OUTPUT", fields, kind_of(vertices, "Point"), vertices, run)
        for each in found:
            row = each["properties"]["vertex"]
            sink.addFeature(feature(fields, vertices.places[row], vertices.of(row)))
        return {"OUTPUT": target}
