#!/usr/bin/env python3
"""Measures the promises of -flow_ready, from the files alone.

    check_flow.py <metres> <buildings.gpkg>...

Of the layer `buildings`: walls and gaps that are shorter than that, narrower parts of a building, corners below 20.7
degrees, and blocks that touch in a point, less those that have a point of the layer `problems` with the state "left"
next to them. Walls that go straight on are one; a gap is where a corner of a block is that near to a wall that shares no
corner with its own two, across open ground, and a narrow part is the same across the building. Corners at which a wall goes straight on within a millimetre, and no other wall begins, are needless
and count as well. Prints a line a file; the status is 1 where anything is left that is not named. Coordinates must be
metres. Needs shapely and GDAL's Python.
"""

import math
import sys
from collections import Counter

from osgeo import ogr
from shapely import wkb
from shapely.geometry import LineString, Point, Polygon
from shapely.ops import unary_union

ogr.UseExceptions()
STRAIGHT = 0.5  # degrees
STRAIGHT_M = 0.001
LEAST_ANGLE = 20.7
ROUNDING = 0.003  # m: corners lie on a lattice


class Near:
    """Finds geometries by their boxes, on a grid; versions of shapely differ in theirs."""

    CELL = 25

    def __init__(self, geometries):
        self.geometries = geometries
        self.cells = {}
        for i, geometry in enumerate(geometries):
            for cell in self.cells_of(geometry):
                self.cells.setdefault(cell, []).append(i)

    def cells_of(self, geometry, reach=0):
        west, south, east, north = geometry.bounds
        return [(x, y) for x in range(int((west - reach) // self.CELL), int((east + reach) // self.CELL) + 1)
                for y in range(int((south - reach) // self.CELL), int((north + reach) // self.CELL) + 1)]

    def within(self, geometry, reach):
        found = sorted({i for cell in self.cells_of(geometry, reach) for i in self.cells.get(cell, ())})
        return [i for i in found if self.geometries[i].distance(geometry) <= reach]


def turn(a, b, c):
    """Degrees between the walls at b."""
    first = math.atan2(a[1] - b[1], a[0] - b[0])
    second = math.atan2(c[1] - b[1], c[0] - b[0])
    return math.degrees((second - first) % (2 * math.pi))


def corners(ring):
    """Corners without those at which a wall goes straight on."""
    points = list(ring.coords)[:-1]
    while True:
        kept = [b for a, b, c in zip(points[-1:] + points[:-1], points, points[1:] + points[:1])
                if abs(turn(a, b, c) - 180) > STRAIGHT]
        if len(kept) == len(points) or len(kept) < 3:
            return points
        points = kept


def rings(polygon):
    return [polygon.exterior, *polygon.interiors]


def polygons_of(geometry):
    return [geometry] if isinstance(geometry, Polygon) else [g for g in geometry.geoms if isinstance(g, Polygon)]


def walls_and_angles(buildings, limit):
    for polygon in buildings:
        for ring in rings(polygon):
            points = corners(ring)
            for a, b, c in zip(points[-1:] + points[:-1], points, points[1:] + points[:1]):
                if math.dist(b, c) < limit - ROUNDING:
                    yield "wall", math.dist(b, c), LineString([b, c])
                degrees = turn(a, b, c)
                if min(degrees, 360 - degrees) < LEAST_ANGLE - 0.1:
                    yield "angle", min(degrees, 360 - degrees), Point(b)


def needless(buildings):
    """Corners in straight walls that nothing needs."""
    walls = {}
    triples = []
    for polygon in buildings:
        for ring in rings(polygon):
            points = list(ring.coords)[:-1]
            for a, b, c in zip(points[-1:] + points[:-1], points, points[1:] + points[:1]):
                walls.setdefault(b, set()).update((a, c))
                triples.append((a, b, c))
    for a, b, c in triples:
        off = LineString([a, c]).distance(Point(b))
        if len(walls[b]) == 2 and off < STRAIGHT_M:
            yield "needless", off, Point(b)


def near_walls(polygons, limit):
    """Each corner with a wall that is nearer than a limit and shares no end with the two of the corner."""
    walls, ends, sides = [], [], []
    for polygon in polygons:
        for ring in rings(polygon):
            points = corners(ring)
            for i, point in enumerate(points):
                after, before = points[(i + 1) % len(points)], points[i - 1]
                walls.append(LineString([point, after]))
                ends.append((point, after))
                sides.append((point, before, after))
    tree = Near(walls)
    for point, before, after in sides:
        here = Point(point)
        for i in tree.within(here, limit):
            if {before, point, after} & set(ends[i]):
                continue
            near = walls[i].interpolate(walls[i].project(here))
            if 0 < here.distance(near) < limit - ROUNDING:
                yield LineString([here, near])


def gaps(blocks, limit):
    solid = Near(blocks)
    for way in near_walls(blocks, limit):
        if all(way.intersection(blocks[b]).length < 1e-6 for b in solid.within(way, 0)):
            yield "gap", way.length, way


def necks(buildings, limit):
    for polygon in buildings:
        around = polygon.buffer(1e-6)
        for way in near_walls([polygon], limit):
            if around.contains(way) and polygon.contains(way.interpolate(0.5, normalized=True)):
                yield "neck", way.length, way


def touches(blocks):
    seen = Counter(point for polygon in blocks for ring in rings(polygon) for point in list(ring.coords)[:-1])
    for point, times in seen.items():
        if times > 1:
            yield "touch", 0, Point(point)


def read(layer):
    return [(wkb.loads(bytes(f.GetGeometryRef().ExportToWkb())), f) for f in layer]


def main(limit, files):
    unnamed = 0
    for file in files:
        dataset = ogr.Open(file)
        buildings = [p for geometry, _ in read(dataset.GetLayer("buildings")) for p in polygons_of(geometry)]
        problems = dataset.GetLayer("problems")
        left = [] if problems is None else [g for g, f in read(problems) if f.GetField("state") == "left"]
        blocks = polygons_of(unary_union(buildings))
        tree = Near(left)
        found, named, worst = Counter(), Counter(), []
        for kind, size, place in [*walls_and_angles(buildings, limit), *gaps(blocks, limit), *necks(buildings, limit),
                                  *touches(blocks), *needless(buildings)]:
            found[kind] += 1
            if tree.within(place, limit):
                named[kind] += 1
            else:
                worst.append((kind, size, place))
        print(f"{file}: {len(buildings)} polygons, {len(blocks)} blocks; " + ", ".join(
            f"{kind} {found[kind]}, {found[kind] - named[kind]} not named" for kind in ("wall", "gap", "neck", "angle", "touch", "needless")))
        for kind, size, place in worst[:5]:
            print(f"  {kind} {size:.4f} {place.wkt}")
        unnamed += len(worst)
    return 1 if unnamed else 0


if __name__ == "__main__":
    sys.exit(main(float(sys.argv[1]), sys.argv[2:]))
