"""Elevations that the bench approximates, and a survey's truth about them."""
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from osgeo import gdal
from scipy import ndimage

gdal.UseExceptions()


@dataclass
class Scene:
    """A raster without gaps: cells without a value have that of the nearest, and are not compared."""
    name: str
    path: Path
    z: np.ndarray
    valid: np.ndarray
    place: tuple  # geotransform, not rotated
    truth: np.ndarray = None  # roofs of the survey's buildings on its terrain: no trees

    @property
    def cell(self):
        return self.place[1]

    def errors(self, model):
        """(i) against the surface model, (ii) against the surface without trees, where a survey knows it"""
        first = figures((model - self.z)[self.valid])
        if self.truth is None:
            return first, None
        known = self.valid & np.isfinite(self.truth)
        return first, figures((model - self.truth)[known])


def figures(differences):
    """RMSE, the 95th percentile and the largest of the distances."""
    far = np.abs(differences)
    return float(np.sqrt(np.mean(far ** 2))), float(np.percentile(far, 95)), float(far.max())


def read_filled(path):
    """Elevations with the nearest where there is none, and which cells have one."""
    source = gdal.Open(str(path))
    z = source.ReadAsArray().astype(float)
    valid = (source.GetRasterBand(1).GetMaskBand().ReadAsArray() > 0) & np.isfinite(z)
    near = ndimage.distance_transform_edt(~valid, return_distances=False, return_indices=True)
    return z[tuple(near)], valid


def open_scene(name, path, terrain=None, buildings=None):
    """@param terrain: the survey's, on the same cells. @param buildings: a raster that is not 0 where its class is
    building, or polygons around those cells"""
    z, valid = read_filled(path)
    scene = Scene(name, Path(path), z, valid, gdal.Open(str(path)).GetGeoTransform())
    if terrain is not None:
        bare, known = read_filled(terrain)
        scene.truth = np.where(is_building(path, buildings), z, np.where(known, bare, np.nan))
    return scene


def is_building(like, buildings):
    """Which cells of a raster have their middle in a building."""
    if Path(buildings).suffix == ".tif":
        return gdal.Open(str(buildings)).ReadAsArray() > 0
    model = gdal.Open(str(like))
    burnt = gdal.GetDriverByName("MEM").Create("", model.RasterXSize, model.RasterYSize, 1, gdal.GDT_Byte)
    burnt.SetGeoTransform(model.GetGeoTransform())
    burnt.SetProjection(model.GetProjection())
    polygons = gdal.OpenEx(str(buildings), gdal.OF_VECTOR)
    gdal.RasterizeLayer(burnt, [1], polygons.GetLayer(0), burn_values=[1])
    return burnt.ReadAsArray() > 0


def write_like(path, like, z, valid):
    """Elevations on the cells of another raster."""
    model = gdal.Open(str(like))
    copy = gdal.GetDriverByName("GTiff").Create(str(path), z.shape[1], z.shape[0], 1, gdal.GDT_Float32)
    copy.SetGeoTransform(model.GetGeoTransform())
    copy.SetProjection(model.GetProjection())
    copy.GetRasterBand(1).SetNoDataValue(-9999)
    copy.GetRasterBand(1).WriteArray(np.where(valid, z, -9999).astype(np.float32))
