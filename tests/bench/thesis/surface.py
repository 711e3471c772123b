"""A surface of triangles, and its heights at the middles of a raster's cells."""
from dataclasses import dataclass

import numpy as np
from scipy import ndimage


@dataclass
class Surface:
    """Coordinates in metres: x to the east and y to the north of the middle of the raster's first cell, z up."""
    points: np.ndarray  # n x 3
    triangles: np.ndarray  # m x 3, places in points, counter-clockwise from outside

    def count(self):
        """Distinct (x, y, z) that triangles use, as the thesis counts them."""
        used = self.points[np.unique(self.triangles)]
        return len(np.unique(used.round(6), axis=0))

    def open_edges(self):
        """Directed edges of triangles that have no partner the other way, or more than one: 0 where it is closed."""
        size = len(self.points)
        begin, end = self.triangles.ravel(), np.roll(self.triangles, -1, axis=1).ravel()
        one_way, counts = np.unique(begin * size + end, return_counts=True)
        other_way = np.unique(end * size + begin)
        return int((counts > 1).sum() + len(np.setxor1d(one_way, other_way)))

    def heights(self, shape, cell):
        """The highest that lies over the middle of each cell; beside all triangles as at the nearest cell."""
        found = np.full(shape, -np.inf)
        for rows, cols, z in pieces(self.points / [cell, -cell, 1], self.triangles, shape):
            np.maximum.at(found, (rows, cols), z)
        bare = ~np.isfinite(found)
        if bare.any():
            near = ndimage.distance_transform_edt(bare, return_distances=False, return_indices=True)
            found = found[tuple(near)]
        return found


def pieces(points, triangles, shape, at_once=20000):
    """Rows, columns and heights of the cells in the triangles, some thousand triangles at a time."""
    for first in range(0, len(triangles), at_once):
        yield cells_in(points[triangles[first:first + at_once]], shape)


def repeated(first, last):
    """The numbers first[i] .. last[i] of each i, one after the other, and the i that each belongs to."""
    counts = np.maximum(last - first + 1, 0)
    which = np.repeat(np.arange(len(first)), counts)
    starts = np.repeat(np.cumsum(counts) - counts, counts)
    return which, np.arange(counts.sum()) - starts + first[which]


def cells_in(corners, shape):
    """@param corners: k x 3 x 3, in cells. Triangles that stand upright hold no cell."""
    a, b, c = corners[:, 0], corners[:, 1], corners[:, 2]
    area = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (c[:, 0] - a[:, 0]) * (b[:, 1] - a[:, 1])
    corners = corners[np.abs(area) > 1e-12]
    tiny = 1e-9
    lowest = np.ceil(corners[:, :, 1].min(axis=1) - tiny).clip(0, shape[0]).astype(int)
    highest = np.floor(corners[:, :, 1].max(axis=1) + tiny).clip(-1, shape[0] - 1).astype(int)
    which, rows = repeated(lowest, highest)
    left, right = spans(corners[which], rows)
    first = np.ceil(left - tiny).clip(0, shape[1]).astype(int)
    last = np.floor(right + tiny).clip(-1, shape[1] - 1).astype(int)
    row_of, cols = repeated(first, last)
    rows, which = rows[row_of], which[row_of]
    return rows, cols, plane_heights(corners[which], cols, rows)


def spans(corners, rows):
    """Stretch in which each triangle meets its row, from left to right."""
    left = np.full(len(rows), np.inf)
    right = np.full(len(rows), -np.inf)
    for i in range(3):
        p, q = corners[:, i], corners[:, (i + 1) % 3]
        low, high = np.minimum(p[:, 1], q[:, 1]), np.maximum(p[:, 1], q[:, 1])
        meets = (low <= rows + 1e-9) & (rows - 1e-9 <= high)
        level = high - low < 1e-12
        step = np.where(level, 1, q[:, 1] - p[:, 1])
        along = np.clip((rows - p[:, 1]) / step, 0, 1)
        at = p[:, 0] + along * (q[:, 0] - p[:, 0])
        for x, counts in ((at, meets & ~level), (p[:, 0], meets & level), (q[:, 0], meets & level)):
            left = np.where(counts, np.minimum(left, x), left)
            right = np.where(counts, np.maximum(right, x), right)
    return left, right


def plane_heights(corners, x, y):
    a, u, v = corners[:, 0], corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    area = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    s = ((x - a[:, 0]) * v[:, 1] - (y - a[:, 1]) * v[:, 0]) / area
    t = (u[:, 0] * (y - a[:, 1]) - u[:, 1] * (x - a[:, 0])) / area
    # A needle's plane is steep; no point of a triangle is above its corners.
    z = a[:, 2] + s * u[:, 2] + t * v[:, 2]
    return np.clip(z, corners[:, :, 2].min(axis=1), corners[:, :, 2].max(axis=1))
