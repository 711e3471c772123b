"""One closed surface: terrain with the blocks' outlines cut in, their walls from the terrain up, sides and a plate."""
import numpy as np
from scipy import ndimage, spatial

from constrained import Triangulation
from surface import Surface, cells_in, pieces

BELOW = 1.0  # metres from the lowest terrain to the plate
LEAST_WALL = 0.05  # metres


def feet_of(skin):
    """Directed edges at which roofs and walls end, the blocks at their left."""
    begin, end = skin.triangles.ravel(), np.roll(skin.triangles, -1, axis=1).ravel()
    there = set(zip(begin.tolist(), end.tolist()))
    return [edge for edge in there if edge[::-1] not in there]


def below_roofs(skin, shape, cell):
    """Cells that the terrain is not asked for: under the blocks or cut by their walls."""
    covered = np.zeros(shape, bool)
    if len(skin.triangles):
        rows, cols, _ = cells_in((skin.points / [cell, -cell, 1])[skin.triangles], shape)
        covered[rows, cols] = True
    return ndimage.binary_dilation(covered, np.ones((3, 3)))


def window_corners(shape, cell, plan):
    """A cell outside the raster's points, and outside blocks whose walls leave it, so that no block stands at a
    side: counter-clockwise from the south-west."""
    middles = np.array([(0, 0), (shape[1] - 1, 1 - shape[0])]) * cell
    around = np.concatenate([middles, plan])
    (left, bottom), (right, top) = around.min(axis=0) - cell, around.max(axis=0) + cell
    return np.array([(left, bottom), (right, bottom), (right, top), (left, top)])


def at(z, plan, cell):
    """Heights of a raster at points between its cells."""
    place = [-plan[:, 1] / cell, plan[:, 0] / cell]
    return ndimage.map_coordinates(z, place, order=1, mode="nearest")


def terrain_points(z, wanted, cell, begun, count):
    """Adds up to so many cells to points that are given: in the triangles with the largest sums of squares the cell
    that is farthest away, as Garland and Heckbert (1995) insert, but for the mean error.
    @param wanted: cells that count
    @return all points and the largest distance that is left"""
    points, (rows, cols) = begun, np.nonzero(wanted)
    plan = np.column_stack([cols * cell, -rows * cell])
    heights = z[rows, cols]
    while True:
        net = spatial.Delaunay(points[:, :2])
        which = net.find_simplex(plan)
        away = np.where(which < 0, 0, np.abs(plane(points[net.simplices[which]], plan) - heights))
        left = count - (len(points) - len(begun))
        if left <= 0 or not len(away) or away.max() < 1e-3:
            return points, float(away.max(initial=0))
        sums = np.bincount(which.clip(0), away ** 2, len(net.simplices))
        order = np.argsort(-away, kind="stable")
        triangles, firsts = np.unique(which[order], return_index=True)
        farthest = dict(zip(triangles.tolist(), order[firsts].tolist()))
        largest = np.argsort(-sums, kind="stable")
        best = [farthest[t] for t in largest[:left].tolist() if sums[t] > 0.1 * sums[largest[0]] and t in farthest]
        points = np.concatenate([points, np.column_stack([plan[best], heights[best]])])


def plane(corners, plan):
    a, u, v = corners[:, 0], corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    area = u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]
    area = np.where(np.abs(area) < 1e-12, 1, area)
    d = plan - a[:, :2]
    s = (d[:, 0] * v[:, 1] - d[:, 1] * v[:, 0]) / area
    t = (u[:, 0] * d[:, 1] - u[:, 1] * d[:, 0]) / area
    return a[:, 2] + s * u[:, 2] + t * v[:, 2]


def stood_on(skin, feet, z, cell):
    """The skin with its feet at the heights of a raster, but below the points over them."""
    points = skin.points.copy()
    nodes = np.array(sorted({a for a, _ in feet}), dtype=int)
    if not len(nodes):
        return points, nodes
    over = {}
    used = np.unique(skin.triangles)
    for node in used[~np.isin(used, nodes)]:
        place = tuple(points[node, :2].round(6))
        over[place] = min(over.get(place, np.inf), points[node, 2])
    ceiling = np.array([over.get(tuple(points[node, :2].round(6)), np.inf) for node in nodes])
    points[nodes, 2] = np.minimum(at(z, points[nodes, :2], cell), ceiling - LEAST_WALL)
    return points, nodes


def parts(skin, terrain, cell, budget, valid):
    """The skin on its terrain, its feet and their edges, the points of the terrain and how far it is off."""
    feet = feet_of(skin)
    points, nodes = stood_on(skin, feet, terrain, cell)
    window = window_corners(terrain.shape, cell, points[nodes, :2])
    begun = np.concatenate([points[nodes], np.column_stack([window, at(terrain, window, cell)])])
    skin = Surface(points, skin.triangles)
    left = max(0, budget - skin.count() - 8)  # of the window and the plate
    wanted = ~below_roofs(skin, terrain.shape, cell) & valid
    return skin, nodes, feet, *terrain_points(terrain, wanted, cell, begun, left)


def close(skin, terrain, cell, budget, valid=True):
    """@param budget: most points of all, or as many as the blocks need
    @param valid: cells that have an elevation
    @return the surface, and the largest distance of its terrain from the raster's cells"""
    *found, error = parts(skin, terrain, cell, budget, valid)
    return assembled(*found), error


def heights_unclosed(skin, terrain, cell, budget, valid=True):
    """Nearly those of close(), sooner: outlines are not cut in, which moves cells at walls alone."""
    skin, _, _, ground, _ = parts(skin, terrain, cell, budget, valid)
    found = Surface(ground, spatial.Delaunay(ground[:, :2]).simplices).heights(terrain.shape, cell)
    roofs = np.full(terrain.shape, -np.inf)
    for rows, cols, z in pieces(skin.points / [cell, -cell, 1], skin.triangles, terrain.shape):
        np.maximum.at(roofs, (rows, cols), z)
    return np.where(np.isfinite(roofs), roofs, found)


def assembled(skin, nodes, feet, ground):
    """@param ground: the terrain's points: the feet, the corners of the window, and the added ones"""
    place = {node: i for i, node in enumerate(nodes.tolist())}
    inside = [(place[a], place[b]) for a, b in feet]
    net = Triangulation(ground[:, :2])
    if not all(net.hold(a, b) for a, b in inside):
        raise RuntimeError("An outline could not be cut into the terrain.")
    land = net.triangles_without(inside)
    # The skin's points, then the ground's that are no feet, then the plate.
    number = np.concatenate([nodes, np.arange(len(ground) - len(nodes)) + len(skin.points)]).astype(int)
    corner = number[len(nodes):len(nodes) + 4]
    plate = ground[len(nodes):len(nodes) + 4] * [1, 1, 0] + [0, 0, ground[:, 2].min() - BELOW]
    points = np.concatenate([skin.points, ground[len(nodes):], plate])
    low = np.arange(4) + len(points) - 4
    after = np.roll(np.arange(4), -1)
    sides = [np.column_stack([low, low[after], corner]), np.column_stack([low[after], corner[after], corner])]
    return Surface(points, np.concatenate([skin.triangles, number[land], *sides, low[[[0, 2, 1], [0, 3, 2]]]]))
