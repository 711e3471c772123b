"""Pictures of where most goes wrong: the window of a place in which result and reference differ by the largest area."""
import numpy as np
from osgeo import gdal
from scipy import ndimage

from places import burn, polygons

FINE = 2  # parts of a cell, each way
SIDE_M = 250  # of the window
ACROSS = 3  # pictures
MISSED, FALSE, SHARED = (0.84, 0.15, 0.16), (1.0, 0.6, 0.0), (0.12, 0.47, 0.71)


def burnt(parts, raster):
    """Cells of polygons, as booleans, a part of the raster's cells in size."""
    x0, dx, _, y0, _, dy = raster.GetGeoTransform()
    grid = gdal.GetDriverByName("MEM").Create("", raster.RasterXSize * FINE, raster.RasterYSize * FINE)
    grid.SetGeoTransform((x0, dx / FINE, 0, y0, 0, dy / FINE))
    grid.SetProjection(raster.GetProjection())
    burn(grid, parts, 1)
    return grid.ReadAsArray() > 0


def worst_window(wrong, rows, cols):
    """The first row and column of the window of so many rows and columns that holds most of the wrong cells."""
    sums = np.zeros(np.add(wrong.shape, 1), np.int64)
    sums[1:, 1:] = wrong.cumsum(0).cumsum(1)
    held = sums[rows:, cols:] - sums[:-rows, cols:] - sums[rows:, :-cols] + sums[:-rows, :-cols]
    return np.unravel_index(held.argmax(), held.shape)


def shaded(z, cell):
    """Grey from 0 to 1 of a surface that is lit from the north-west; unknown cells are white."""
    known = np.isfinite(z)
    filled = np.where(known, z, np.median(z[known]))
    down, across = np.gradient(filled, cell)
    light = (1 + (across + down) / 2) / np.sqrt(1 + across**2 + down**2) / 1.5
    return np.where(known, np.clip(0.25 + 0.65 * light, 0, 1), 1)


def picture_of(place, out):
    """Picture of the worst window: red, green and blue of each part of a cell, and the share of the place's errors in it."""
    raster = gdal.Open(place.dsm)
    band = raster.GetRasterBand(1)
    z = band.ReadAsArray().astype(float)
    if band.GetNoDataValue() is not None:
        z[z == band.GetNoDataValue()] = np.nan
    cell = place.cell()[1]
    true, found = burnt(place.blocks(), raster), burnt(polygons(out, ("buildings",)), raster)
    area = place.area_of_interest()
    counts = burnt([area], raster) if area is not None else np.ones_like(true)
    wrong = (true ^ found) & counts
    side = [min(round(SIDE_M / cell) * FINE, length) for length in wrong.shape]
    row, col = worst_window(wrong, *side)
    part = np.s_[row:row + side[0], col:col + side[1]]
    grey = np.kron(shaded(z, cell), np.ones((FINE, FINE)))[part]
    colours = np.repeat(grey[..., None], 3, 2)
    for mask, colour in ((true & found, SHARED), (true & ~found, MISSED), (found & ~true, FALSE)):
        inside = (mask & counts)[part]
        border = inside & ~ndimage.binary_erosion(inside)
        colours[inside] = 0.55 * colours[inside] + 0.45 * np.array(colour)
        colours[border] = colour
    return colours, wrong[part].sum() / max(wrong.sum(), 1)


def plot(path, places):
    """@param places (place, its result, its IoU) of each picture"""
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import patches, pyplot
    from PIL import Image
    down = -(-len(places) // ACROSS)
    figure, axes = pyplot.subplots(down, ACROSS, figsize=(5 * ACROSS, 5.3 * down), squeeze=False)
    for one in axes.flat:
        one.axis("off")
    for one, (place, out, iou) in zip(axes.flat, places):
        colours, share = picture_of(place, out)
        one.imshow(colours, interpolation="nearest")
        one.set_title(f"{place.title}: IoU {iou:.2f}, {share:.0%} of its errors", fontsize=11)
    figure.legend(handles=[patches.Patch(color=colour, label=label) for colour, label in (
        (SHARED, "in both"), (MISSED, "in the reference alone"), (FALSE, "in the result alone"))],
        loc="lower center", ncol=3, frameon=False, fontsize=12)
    figure.tight_layout(rect=(0, 0.03, 1, 1))
    figure.savefig(path, dpi=70)
    Image.open(path).quantize(128).save(path, optimize=True)
