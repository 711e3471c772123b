"""The provider, with one algorithm."""

from qgis.core import QgsProcessingProvider

from .algorithm import ICON, ExtractBuildings, icon


class Provider(QgsProcessingProvider):
    def id(self):
        return "dem2buildings"

    def name(self):
        return "dem2buildings"

    def icon(self):
        return icon()

    def svgIconPath(self):
        return ICON

    def loadAlgorithms(self):
        self.addAlgorithm(ExtractBuildings())
