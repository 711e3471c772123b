"""A 3D view of QGIS draws the stack, from its style alone, on the terrain of -write_ground. It needs a screen with OpenGL:
    QT_QPA_PLATFORM=xcb xvfb-run -a python3 test_view.py"""

import os
import unittest

from qgis._3d import QgsCameraPose, QgsDirectionalLightSettings, QgsLayoutItem3DMap, Qgs3DMapSettings
from qgis.core import (Qgis, QgsHillshadeRenderer, QgsLayoutExporter, QgsLayoutSize, QgsPrintLayout,
                       QgsProject, QgsRasterLayer, QgsReadWriteContext, QgsVector3D)
from qgis.PyQt.QtCore import QRectF
from qgis.PyQt.QtGui import QColor, QImage
from qgis.PyQt.QtXml import QDomDocument

from desk_case import DeskCase

CENTRE = (391437, 5820407, 235)
SIZE = (160, 104)  # millimetres
TOLERANCE = 0.05


def described(extent, layers, terrain):
    """Settings of a scene: Python has no class for its terrain, but reads the XML of a project."""
    document = QDomDocument()
    scene = document.createElement("qgis3d")
    document.appendChild(scene)

    def add(parent, name, **attributes):
        element = document.createElement(name)
        for key, value in attributes.items():
            element.setAttribute(key.replace("_", "-"), str(value))
        parent.appendChild(element)
        return element

    add(scene, "origin", x=extent.center().x(), y=extent.center().y(), z=0)
    terrain.crs().writeXml(add(scene, "crs"), document)
    ground = add(scene, "terrain", exaggeration=1, texture_size=1024, max_terrain_error=2, max_ground_error=0.5)
    shown = add(ground, "layers")
    for layer in layers:
        add(shown, "layer", id=layer.id())
    add(ground, "generator", type="dem", layer=terrain.id(), resolution=64, skirt_height=10)
    settings = Qgs3DMapSettings()
    settings.setTransformContext(QgsProject.instance().transformContext())
    settings.readXml(scene, QgsReadWriteContext())
    settings.resolveReferences(QgsProject.instance())
    settings.setBackgroundColor(QColor(215, 228, 240))
    light = QgsDirectionalLightSettings()
    light.setDirection(QgsVector3D(0.6, -1, 0.35))
    light.setIntensity(0.9)
    settings.setDirectionalLights([light])
    return settings


@unittest.skipIf(os.environ["QT_QPA_PLATFORM"] == "offscreen", "there is no OpenGL without a screen")
@unittest.skipIf(Qgis.QGIS_VERSION_INT >= 32300, "the picture is that of QGIS 3.22")
class View(DeskCase):
    def test_the_stack_on_its_terrain(self):
        project = QgsProject.instance()
        town = self.make("town.gpkg", "-write_ground", str(self.folder / "ground.tif"))
        stack = self.layer(town, "contours")
        terrain = QgsRasterLayer(str(self.folder / "ground.tif"), "ground")
        terrain.setRenderer(QgsHillshadeRenderer(terrain.dataProvider(), 1, 315, 45))
        project.addMapLayers([stack, terrain])
        extent = terrain.extent()
        layout = QgsPrintLayout(project)
        layout.initializeDefaults()
        layout.pageCollection().page(0).setPageSize(QgsLayoutSize(*SIZE))
        view = QgsLayoutItem3DMap(layout)
        view.attemptSetSceneRect(QRectF(0, 0, *SIZE))
        view.setMapSettings(described(extent, [stack, terrain], terrain))
        camera = QgsCameraPose()
        camera.setCenterPoint(QgsVector3D(CENTRE[0] - extent.center().x(), CENTRE[2], extent.center().y() - CENTRE[1]))
        camera.setDistanceFromCenterPoint(300)
        camera.setPitchAngle(50)
        camera.setHeadingAngle(30)
        view.setCameraPose(camera)
        layout.addLayoutItem(view)
        settings = QgsLayoutExporter.ImageExportSettings()
        settings.dpi = 100
        drawn = str(self.folder / "view.png")
        self.assertEqual(QgsLayoutExporter(layout).exportToImage(drawn, settings), QgsLayoutExporter.Success)
        self.assertLess(self.difference(QImage(drawn), "3d.png"), TOLERANCE)


if __name__ == "__main__":
    unittest.main()
