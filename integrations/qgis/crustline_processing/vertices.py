"""A layer's vertices as rows, and rows as features with the attributes of the layer."""

import csv
from pathlib import Path

from qgis.core import (
    QgsFeature,
    QgsFields,
    QgsGeometry,
    QgsLineString,
    QgsPolygon,
    QgsProcessingException,
    QgsWkbTypes,
)

from .command import FIRST, Canceled


class Vertices:
    """All vertices of a layer, in its order: row k is `places[k]`, of the feature `owners[k]`."""

    def __init__(self, source, feedback):
        self.source = source
        self.places, self.owners, self.attributes = [], [], []
        count = max(1, source.featureCount())
        for number, feature in enumerate(source.getFeatures()):
            if feedback.isCanceled():
                raise Canceled
            self._add(feature)
            feedback.setProgress(min(FIRST, FIRST * number / count))
        if not self.places:
            raise QgsProcessingException("the layer has no points: choose one with some")

    def _add(self, feature):
        places = list(feature.geometry().vertices())
        self.places += places
        self.owners += [len(self.attributes)] * len(places)
        self.attributes.append(feature.attributes())

    def write(self, folder):
        """Write points.csv for the command."""
        with open(Path(folder, "points.csv"), "w", newline="", encoding="utf-8") as file:
            rows = csv.writer(file)
            rows.writerow(["x", "y", "vertex"])
            rows.writerows([repr(p.x()), repr(p.y()), k] for k, p in enumerate(self.places))

    def of(self, row):
        """Return the attributes of a row."""
        return self.attributes[self.owners[row]]

    def shared(self, rows):
        """Return the attributes that all rows have in common; the others are NULL."""
        owners = sorted({self.owners[row] for row in rows})
        columns = zip(*(self.attributes[owner] for owner in owners), strict=False)
        return [values[0] if all(each == values[0] for each in values) else None
                for values in columns]  # fmt: skip

    def line(self, rows, closed):
        """Return the line along rows; a ring ends where it starts."""
        return QgsLineString([self.places[row] for row in _ring(rows, closed)])

    def polygon(self, parts):
        """Return the polygon of a shell and its holes, each as rows."""
        shell, *holes = (self.line(rows, True) for rows in parts)
        polygon = QgsPolygon()
        polygon.setExteriorRing(shell)
        for hole in holes:
            polygon.addInteriorRing(hole)
        return polygon


def _ring(rows, closed):
    return [*rows, rows[0]] if closed else rows


def fields_before(layer_fields, *own):
    """Return fields of our own, then those of a layer; a name that is taken gets underscores."""
    fields = QgsFields()
    for field in own:
        fields.append(field)
    for field in layer_fields:
        renamed = type(field)(field)
        while fields.indexOf(renamed.name()) >= 0:
            renamed.setName(f"{renamed.name()}_")
        fields.append(renamed)
    return fields


def feature(fields, geometry, values):
    """Return a feature."""
    made = QgsFeature(fields)
    made.setGeometry(QgsGeometry(geometry))
    made.setAttributes(list(values))
    return made


def kind_of(vertices, name):
    """Return a type of geometry, with heights and measures where the layer has them."""
    kind = getattr(QgsWkbTypes, name)
    given = vertices.source.wkbType()
    kind = QgsWkbTypes.addZ(kind) if QgsWkbTypes.hasZ(given) else kind
    return QgsWkbTypes.addM(kind) if QgsWkbTypes.hasM(given) else kind
