"""Real places as scans on coarse cells would show them, with few pulses or many."""
import os
import shutil
import zlib

import numpy as np
from osgeo import gdal
from scipy import ndimage

from places import Place

NOISE = 0.03  # metres
REACH = 1.5  # cells: a cell that no pulse met gets the height of the nearest that one met, if it is as near
NO_DATA = -9999
SCANS = {"thin": (2.0, 0.6), "thinned": (2.5, 0.3)}  # cells in metres, pulses a square metre
DENSE = {"coarse": (2.0, 4.0), "coarser": (2.5, 2.0)}  # the same, where no cell is without a pulse


def pulses(z, count, random):
    """Row, column and height of so many pulses a cell, on the average, that fall anywhere."""
    number = random.poisson(count * z.size)
    rows, cols = random.uniform(0, z.shape[0], number), random.uniform(0, z.shape[1], number)
    heights = z[rows.astype(int), cols.astype(int)] + random.normal(0, NOISE, number)
    hit = np.isfinite(heights)
    return rows[hit], cols[hit], heights[hit]


def highest(rows, cols, heights, shape):
    """The highest pulse of each cell, or the height of the nearest cell that has one; not a number beyond REACH."""
    z = np.full(shape, -np.inf)
    inside = (rows < shape[0]) & (cols < shape[1])
    np.maximum.at(z, (rows[inside].astype(int), cols[inside].astype(int)), heights[inside])
    empty = np.isinf(z)
    if empty.all():
        return np.full(shape, np.nan)
    distance, (row, col) = ndimage.distance_transform_edt(empty, return_indices=True)
    return np.where(distance <= REACH, z[row, col], np.nan)


def surface_of(place):
    raster = gdal.Open(place.dsm)
    band = raster.GetRasterBand(1)
    z = band.ReadAsArray().astype(float)
    if band.GetNoDataValue() is not None:
        z[z == band.GetNoDataValue()] = np.nan
    return raster, z


def write(path, z, raster, larger):
    copy = gdal.GetDriverByName("GTiff").Create(path, z.shape[1], z.shape[0], 1, gdal.GDT_Float32)
    west, across, _, north, _, down = raster.GetGeoTransform()
    copy.SetGeoTransform((west, across * larger, 0, north, 0, down * larger))
    copy.SetProjection(raster.GetProjection())
    band = copy.GetRasterBand(1)
    band.SetUnitType(raster.GetRasterBand(1).GetUnitType())
    band.SetNoDataValue(NO_DATA)
    band.WriteArray(np.where(np.isnan(z), NO_DATA, z))


def thinned(place, scan, folder):
    """The place as one of SCANS or DENSE shows it, in a folder of its own."""
    side, density = (SCANS | DENSE)[scan]
    cell = place.cell()[1]
    raster, z = surface_of(place)
    larger = side / cell
    shape = (int(z.shape[0] / larger), int(z.shape[1] / larger))
    random = np.random.default_rng(zlib.crc32(f"{place.name} {scan}".encode()))
    rows, cols, heights = pulses(z, density * cell * cell, random)
    made = Place(f"{place.name}_{scan}", f"{place.title}, {scan}", os.path.join(folder, f"{place.name}_{scan}"))
    os.makedirs(made.folder)
    write(made.dsm, highest(rows / larger, cols / larger, heights, shape), raster, larger)
    shutil.copy(place.reference, made.reference)
    if os.path.exists(place.dtm):
        write_means(place.dtm, made)
    return made


def write_means(terrain, made):
    """The terrain of a place on the cells of a copy of it."""
    grid = gdal.Open(made.dsm)
    west, across, _, north, _, down = grid.GetGeoTransform()
    bounds = (west, north + down * grid.RasterYSize, west + across * grid.RasterXSize, north)
    gdal.Warp(made.dtm, terrain, outputBounds=bounds, width=grid.RasterXSize, height=grid.RasterYSize,
              resampleAlg="average", dstNodata=NO_DATA)


def thinned_places(places, folder, scans=tuple(SCANS)):
    """Some scans of each place of finer cells than theirs."""
    return [thinned(place, scan, folder) for place in places if place.cell()[1] <= 1 for scan in scans]
