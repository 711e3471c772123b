"""Folders of a place: its surface, its reference, perhaps its bare earth."""
import os
import re
from dataclasses import dataclass

from osgeo import gdal, ogr, osr

gdal.UseExceptions()


@dataclass
class Place:
    name: str
    title: str
    folder: str

    @property
    def dsm(self):
        return os.path.join(self.folder, "dsm.tif")

    @property
    def dtm(self):
        return os.path.join(self.folder, "dtm.tif")

    @property
    def reference(self):
        return os.path.join(self.folder, "reference_buildings.gpkg")

    def cell(self):
        """The side of a cell in units of the CRS, and in metres."""
        raster = gdal.Open(self.dsm)
        side = abs(raster.GetGeoTransform()[1] * raster.GetGeoTransform()[5]) ** 0.5
        return side, side * osr.SpatialReference(raster.GetProjection()).GetLinearUnits()

    def km2(self):
        raster = gdal.Open(self.dsm)
        return raster.RasterXSize * raster.RasterYSize * self.cell()[1] ** 2 / 1e6

    def blocks(self):
        """Polygons of the reference without shared walls, in the CRS of the raster."""
        return polygons(self.reference, ("blocks_dissolved", "buildings"))

    def area_of_interest(self):
        """Area with a complete reference; None if that is everywhere."""
        found = polygons(self.reference, ("aoi",))
        return found[0] if found else None


def scene(folder, name):
    place, survey = name.split("_")
    return Place(name, f"{place}, {survey}", os.path.join(folder, name))


def title_of(folder):
    """Name of a place in the heading of its note, up to the first comma or bracket, else that of the folder in words."""
    name = os.path.basename(folder)
    words = name.replace("_", " ").capitalize()
    note = os.path.join(folder, "NOTE.md")
    if not os.path.exists(note):
        return words
    with open(note, encoding="utf-8") as lines:
        heading = lines.readline().lstrip("# ").removeprefix(f"{name}: ")
    title = re.split(r"[,(]", heading)[0].strip()
    return words if title[:1].islower() else title  # a sentence is not a name


def polygons(path, names):
    """Polygons of the first layer of some names that there is."""
    dataset = gdal.OpenEx(path, gdal.OF_VECTOR)
    layer = next((found for found in map(dataset.GetLayerByName, names) if found is not None), None)
    if layer is None:
        return []
    kept = []
    for feature in layer:
        geometry = feature.GetGeometryRef().GetLinearGeometry()
        geometry = geometry if geometry.IsValid() else geometry.MakeValid()
        parts = [geometry] if geometry.GetGeometryName() == "POLYGON" else geometry
        kept += [part.Clone() for part in parts if part.GetGeometryName() == "POLYGON"]
    return kept


def burn(raster, parts, value):
    """Gives a value to the cells of a raster whose middles lie in polygons of its CRS."""
    memory = ogr.GetDriverByName("Memory").CreateDataSource("m")
    layer = memory.CreateLayer("l", raster.GetSpatialRef())
    for part in parts:
        feature = ogr.Feature(layer.GetLayerDefn())
        feature.SetGeometry(part)
        layer.CreateFeature(feature)
    gdal.RasterizeLayer(raster, [1], layer, burn_values=[value])


def united(parts):
    """The union of polygons, in polygons without shared walls."""
    many = ogr.Geometry(ogr.wkbMultiPolygon)
    for part in parts:
        many.AddGeometry(part)
    if many.IsEmpty():
        return []
    union = many.UnionCascaded()
    parts = [union] if union.GetGeometryName() == "POLYGON" else union
    return [part.Clone() for part in parts]
