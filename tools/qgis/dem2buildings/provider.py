"""The provider, with one algorithm."""

from qgis.core import QgsProcessingProvider

from .algorithm import ExtractBuildings


class Provider(QgsProcessingProvider):
    def id(self):
        return "dem2buildings"

    def name(self):
        return "dem2buildings"

    def loadAlgorithms(self):
        self.addAlgorithm(ExtractBuildings())
