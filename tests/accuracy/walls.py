"""How far found outlines are from true ones, and to which side."""
import numpy as np
from scipy.spatial import cKDTree

from places import polygons, united

NEAR = 3  # cells: an outline farther away is that of another thing, such as a crown
TRUE_STEP = 0.02  # cells between points of the true outlines
FOUND_STEP = 0.1


def points_along(parts, step):
    """Points at most a step apart on the outlines of polygons, and the direction of the outline at each: the
    inside is on its left. Arrays n x 2, in units of the CRS."""
    places, directions = [np.empty((0, 2))], [np.empty((0, 2))]
    for part in parts:
        for index in range(part.GetGeometryCount()):
            ring = np.array(part.GetGeometryRef(index).GetPoints())[:, :2]
            x, y = ring[:, 0] - ring[0, 0], ring[:, 1] - ring[0, 1]
            turns_left = np.sum(x[:-1] * y[1:] - x[1:] * y[:-1]) > 0
            if turns_left != (index == 0):
                ring = ring[::-1]
            for a, b in zip(ring[:-1], ring[1:]):
                length = np.hypot(*(b - a))
                if length == 0:
                    continue
                count = int(np.ceil(length / step))
                t = (np.arange(count) + 0.5) / count
                places.append(a + t[:, None] * (b - a))
                directions.append(np.repeat([(b - a) / length], count, axis=0))
    return np.concatenate(places), np.concatenate(directions)


def signed_distances(found, true, cell):
    """From points on the outlines of `found` to the nearest point of those of `true`, in cells: positive outside of
    the true ones. Only points nearer than NEAR."""
    places, _ = points_along(found, FOUND_STEP * cell)
    nodes, directions = points_along(true, TRUE_STEP * cell)
    if not len(places) or not len(nodes):
        return np.empty(0)
    distance, nearest = cKDTree(nodes).query(places, distance_upper_bound=NEAR * cell)
    near = np.isfinite(distance)
    away = places[near] - nodes[nearest[near]]
    along = directions[nearest[near]]
    right = away[:, 0] * along[:, 1] - away[:, 1] * along[:, 0]
    return np.where(right > 0, 1, -1) * distance[near] / cell


def distances(out, place):
    """Mean, signed mean and median of the distances of a result's outlines from those of the reference, in cells."""
    cell = place.cell()[0]
    found = united(polygons(out, ("buildings",)))
    area = place.area_of_interest()
    if area is not None:
        found = [part for part in found if part.Within(area)]
    d = signed_distances(found, united(place.blocks()), cell)
    if not len(d):
        return None
    return {"mean": float(np.abs(d).mean()), "signed": float(d.mean()), "median": float(np.median(np.abs(d)))}
