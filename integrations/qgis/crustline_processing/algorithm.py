"""What the four algorithms share: a layer of points, a method, a run of the command, outputs."""

from pathlib import Path
from tempfile import TemporaryDirectory

from qgis.core import (
    QgsFeatureSink,
    QgsProcessing,
    QgsProcessingAlgorithm,
    QgsProcessingException,
    QgsProcessingParameterBoolean,
    QgsProcessingParameterEnum,
    QgsProcessingParameterFeatureSource,
)
from qgis.PyQt.QtGui import QIcon

from .command import LAST, Canceled, read_features, run
from .vertices import Vertices

METHODS = [
    "connect", "crust", "one-step-crust", "nn-crust", "hnn-crust", "gathan",
    "crawl", "peel", "gabriel", "relative-neighborhood", "minimum-spanning-tree",
]  # fmt: skip
_GLOBE = "Measure on the globe, if the layer has longitudes and latitudes (needs pyproj)"


class Algorithm(QgsProcessingAlgorithm):
    """An algorithm of the provider; those that derive from it say what is special in it."""

    #: Its name, which is also that of the command and of the icon, and what the toolbox shows.
    NAME = TITLE = HELP = ""

    def name(self):
        return self.NAME

    def displayName(self):
        return self.TITLE

    def shortHelpString(self):
        return self.HELP

    def helpUrl(self):
        return ""

    def icon(self):
        return QIcon(str(Path(__file__).parent / "icons" / f"{self.NAME}.svg"))

    def createInstance(self):
        return type(self)()

    def initAlgorithm(self, configuration=None):
        self.addParameter(
            QgsProcessingParameterFeatureSource(
                "INPUT", "Points, or other features whose vertices count",
                [QgsProcessing.TypeVectorAnyGeometry],
            )
        )  # fmt: skip
        self.addParameter(
            QgsProcessingParameterEnum("METHOD", "Method", METHODS, defaultValue=METHODS[0],
                                       usesStaticStrings=True)
        )  # fmt: skip
        self.addParameter(QgsProcessingParameterBoolean("GLOBE", _GLOBE, True))
        self.add_parameters()

    def processAlgorithm(self, parameters, context, feedback):
        """Read the layer, run the command, and only then make what is written."""
        source = self.parameterAsSource(parameters, "INPUT", context)
        if source is None:
            raise QgsProcessingException(self.invalidSourceError(parameters, "INPUT"))
        try:
            vertices = Vertices(source, feedback)
            with TemporaryDirectory() as folder:
                vertices.write(folder)
                arguments = self._arguments(parameters, context, source.sourceCrs())
                summary = run(arguments, folder, feedback, source.sourceName())
                found = read_features(Path(folder, "found.geojson"))
        except Canceled:
            feedback.reportError("canceled: nothing is written")
            return {}
        feedback.setProgress(LAST)
        return self.write(vertices, found, summary, (parameters, context, feedback))

    def _arguments(self, parameters, context, crs):
        method = self.parameterAsEnumString(parameters, "METHOD", context)
        words = [self.NAME, "points.csv", "-o", "found.geojson", "--method", method]
        if crs.isGeographic() and self.parameterAsBool(parameters, "GLOBE", context):
            words += ["--crs", crs.authid() or crs.toWkt(), "--project", "auto"]
        return words + self.arguments(parameters, context)

    def sink(self, name, fields, kind, vertices, run):
        """Return an output to add features to, and its name for QGIS."""
        parameters, context, _ = run
        anew = QgsFeatureSink.RegeneratePrimaryKey  # of keys like fid, which may come twice
        sink, target = self.parameterAsSink(
            parameters, name, context, fields, kind, vertices.source.sourceCrs(), anew
        )
        if sink is None and parameters.get(name) is not None:
            raise QgsProcessingException(self.invalidSinkError(parameters, name))
        return sink, target
