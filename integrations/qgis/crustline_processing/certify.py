"""Whether the theory guarantees the curves through points, and where not."""

from qgis.core import (
    QgsField,
    QgsProcessing,
    QgsProcessingOutputBoolean,
    QgsProcessingOutputNumber,
    QgsProcessingOutputString,
    QgsProcessingParameterFeatureSink,
)
from qgis.PyQt.QtCore import QVariant

from .algorithm import Algorithm
from .vertices import feature, fields_before, kind_of


class Certify(Algorithm):
    """crustline certify."""

    NAME, TITLE = "certify", "Certificate"
    HELP = (
        "Says whether a theorem guarantees the curves through points, and gives the points that "
        "break it: there more samples are needed. They have the field reason, and all fields of "
        "the layer. The log tells the rest."
    )

    def add_parameters(self):
        self.addParameter(
            QgsProcessingParameterFeatureSink(
                "OUTPUT", "Weak places", QgsProcessing.TypeVectorPoint
            )
        )
        self.addOutput(QgsProcessingOutputBoolean("GUARANTEED", "Guaranteed"))
        self.addOutput(QgsProcessingOutputNumber("RATIO", "Sampling ratio"))
        self.addOutput(QgsProcessingOutputString("SUMMARY", "Summary"))

    def arguments(self, parameters, context):
        return []

    def write(self, vertices, found, summary, run):
        fields = fields_before(vertices.source.fields(), QgsField("reason", QVariant.String))
        sink, target = self.sink("OUTPUT", fields, kind_of(vertices, "Point"), vertices, run)
        for each in found:
            row, reason = each["properties"]["row"], each["properties"]["reason"]
            values = [reason, *vertices.of(row)]
            sink.addFeature(feature(fields, vertices.places[row], values))
        run[2].pushInfo(summary["summary"])
        return {
            "OUTPUT": target,
            "GUARANTEED": summary["guaranteed"],
            "RATIO": summary["sampling_ratio"],
            "SUMMARY": summary["summary"],
        }
