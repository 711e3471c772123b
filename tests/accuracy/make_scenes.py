#!/usr/bin/python3
"""Makes scenes that hold no building, and a town as satellite stereo sees it.

    make_scenes.py TOWN.tif FOLDER

forest.tif   1 km2 of closed forest on hills, 1 m cells: crowns of 3 to 7 m radius, 8 to 28 m high, each with a
             surface that is rough from cell to cell, and gaps through which the ground is seen
forest_fine.tif  a quarter of a square kilometre of the same with 0.5 m cells
fields.tif   1 km2 of fields on a plain, 1 m cells: furrows, noise of 5 cm, ditches, a dike, single trees and bushes
blurred.tif  the town, blurred by a Gaussian of 2 m: walls lean, narrow gaps close
Needs python3-gdal, python3-numpy and python3-scipy. The same version of NumPy makes the same scenes.
"""
import os
import sys

import numpy as np
from osgeo import gdal
from scipy import ndimage

gdal.UseExceptions()


def write(path, z, cell, like=None):
    driver = gdal.GetDriverByName("GTiff")
    raster = driver.Create(path, z.shape[1], z.shape[0], 1, gdal.GDT_Float32, ["COMPRESS=DEFLATE", "TILED=YES"])
    if like is None:
        raster.SetGeoTransform((400000, cell, 0, 5800000, 0, -cell))
        raster.SetProjection('EPSG:25833')
    else:
        raster.SetGeoTransform(like.GetGeoTransform())
        raster.SetProjection(like.GetProjection())
    raster.GetRasterBand(1).WriteArray(z.astype(np.float32))


def relief(size, cell, rise, rng):
    """Hills: smoothed noise."""
    rough = rng.standard_normal((size // 16 + 8, size // 16 + 8))
    smooth = ndimage.zoom(ndimage.gaussian_filter(rough, 120 / cell / 16), 16, order=3)[:size, :size]
    return rise * (smooth - smooth.min()) / np.ptp(smooth)


def plant(surface, ground, trees, cell, rng):
    """Raises crowns: half ellipsoids, rough by a third of their height, with holes."""
    size = surface.shape[0]
    for y, x, radius, height in trees:
        reach = int(np.ceil(radius / cell))
        row, col = int(y / cell), int(x / cell)
        r = slice(max(0, row - reach), min(size, row + reach + 1))
        c = slice(max(0, col - reach), min(size, col + reach + 1))
        rr, cc = np.mgrid[r, c]
        distance = np.hypot((rr + 0.5) * cell - y, (cc + 0.5) * cell - x) / radius
        inside = distance < 1 + 0.15 * rng.standard_normal(distance.shape)
        dome = height * (0.55 + 0.45 * np.sqrt(np.clip(1 - distance**2, 0, 1)))
        top = ground[r, c] + dome - np.abs(rng.standard_normal(distance.shape)) * 0.12 * height
        top[rng.random(distance.shape) < 0.04] = -1e9
        surface[r, c] = np.where(inside, np.maximum(surface[r, c], top), surface[r, c])


def forest(side, cell, seed):
    rng = np.random.default_rng(seed)
    size = int(side / cell)
    ground = relief(size, cell, 40, rng)
    surface = ground + 0.05 * rng.standard_normal(ground.shape)
    count = int(side * side / 45)
    trees = np.column_stack([rng.random(count) * side, rng.random(count) * side, rng.uniform(3, 7, count),
                             rng.uniform(8, 28, count)])
    plant(surface, ground, trees, cell, rng)
    return surface


def fields(side, cell, seed):
    rng = np.random.default_rng(seed)
    size = int(side / cell)
    y, x = np.mgrid[0:size, 0:size] * cell
    ground = 0.004 * x + 0.001 * y
    ground += np.where((x // 180 + y // 240) % 2 == 0, 0.12 * np.sin(2 * np.pi * x / 3), 0)
    ground -= 1.2 * (np.abs(x % 180 - 90) < 1.5)
    ground += np.clip(3.5 - 0.3 * np.abs(y - 700), 0, None)
    surface = ground + 0.05 * rng.standard_normal(ground.shape)
    count = 400
    trees = np.column_stack([rng.random(count) * side, rng.random(count) * side, rng.uniform(1, 5, count),
                             rng.uniform(1, 14, count)])
    plant(surface, ground, trees, cell, rng)
    return surface


def main(town, folder):
    os.makedirs(folder, exist_ok=True)
    write(os.path.join(folder, "forest.tif"), forest(1000, 1.0, 1), 1.0)
    write(os.path.join(folder, "forest_fine.tif"), forest(500, 0.5, 2), 0.5)
    write(os.path.join(folder, "fields.tif"), fields(1000, 1.0, 3), 1.0)
    source = gdal.Open(town)
    sigma = 2 / source.GetGeoTransform()[1]
    write(os.path.join(folder, "blurred.tif"), ndimage.gaussian_filter(source.ReadAsArray().astype(float), sigma), 1,
          source)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
