#!/usr/bin/python3
"""Draws levels with stock Debian, without this project: NumPy cuts the DEM into classes, GDALPolygonize draws each level.

    peer_levels.py <dem> <out.gpkg> <threshold>...

A layer a threshold, with a polygon for every 4-connected set of cells above it. Needs python3-gdal, python3-numpy.
"""
import sys

import numpy
from osgeo import gdal, ogr

gdal.UseExceptions()


def count_levels(dem, thresholds):
    """How many thresholds each cell exceeds; none where there is no data."""
    band = dem.GetRasterBand(1)
    counts = numpy.digitize(band.ReadAsArray(), thresholds, right=True).astype(numpy.uint8)
    counts[band.GetMaskBand().ReadAsArray() == 0] = 0
    return counts


def mask_like(dem, cells):
    """A raster in memory of the DEM's place."""
    raster = gdal.GetDriverByName("MEM").Create("", dem.RasterXSize, dem.RasterYSize, 1, gdal.GDT_Byte)
    raster.SetGeoTransform(dem.GetGeoTransform())
    raster.GetRasterBand(1).WriteArray(cells.astype(numpy.uint8))
    return raster


def main(source, destination, *levels):
    thresholds = sorted(float(level) for level in levels)
    dem = gdal.Open(source)
    counts = count_levels(dem, thresholds)
    target = ogr.GetDriverByName("GPKG").CreateDataSource(destination)
    for level in range(1, len(thresholds) + 1):
        raster = mask_like(dem, counts >= level)
        layer = target.CreateLayer(f"above_{level}", dem.GetSpatialRef(), ogr.wkbPolygon)
        layer.CreateField(ogr.FieldDefn("inside", ogr.OFTInteger))
        layer.StartTransaction()
        band = raster.GetRasterBand(1)
        gdal.Polygonize(band, band, layer, 0)
        layer.CommitTransaction()


if __name__ == "__main__":
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
