"""Faults of a shell in an OBJ, in exact arithmetic: open edges, edges of more than two faces, triangles that look
inwards, edges that cross faces, corners within a millimetre of each other."""

import collections
import decimal
import itertools

from snapped_solid import snapped

DECIMALS = 12  # of a coordinate, at most
BUCKET = 8  # m


def read(path):
    """Corners as whole numbers, triangles, and the group of each: roof, wall or ground."""
    corners, triangles, groups, group = [], [], [], ""
    with open(path, encoding="utf-8") as lines:
        for line in lines:
            words = line.split()
            if words and words[0] == "v":
                corners.append(tuple(int(decimal.Decimal(word).scaleb(DECIMALS)) for word in words[1:4]))
            elif words and words[0] == "g":
                group = words[1]
            elif words and words[0] == "f":
                triangles.append(tuple(int(word) - 1 for word in words[1:4]))
                groups.append(group)
    return corners, triangles, groups


def minus(a, b):
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def normal(corners, triangle):
    a, b, c = (corners[i] for i in triangle)
    return cross(minus(b, a), minus(c, a))


def edge_faults(corners, triangles):
    """Edges that are open, and edges of more than two faces; equal corners are one."""
    ways = collections.Counter((corners[t[i]], corners[t[(i + 1) % 3]]) for t in triangles for i in range(3))
    faces = collections.Counter()
    for (a, b), count in ways.items():
        faces[min(a, b), max(a, b)] += count
    open_edges = sum(count == 1 or (count == 2 and ways[edge] != 1) for edge, count in faces.items())
    return open_edges, sum(count > 2 for count in faces.values())


def near_corners(corners):
    """Corners that programs take for another one: those within a millimetre of one before them."""
    metres = [[value / 10 ** DECIMALS for value in corner] for corner in corners]
    return sum(first != number for number, first in enumerate(snapped(metres)))


def parts_of(triangles):
    """Triangles that hang together by their corners, as one list each."""
    of = {}

    def root(corner):
        while of.setdefault(corner, corner) != corner:
            of[corner] = of[of[corner]]
            corner = of[corner]
        return corner

    for a, b, c in triangles:
        of[root(a)] = of[root(b)] = root(c)
    parts = collections.defaultdict(list)
    for triangle in triangles:
        parts[root(triangle[0])].append(triangle)
    return parts.values()


def inverted(corners, triangles, groups, slanted=False):
    """Roofs that do not look straight up, or up where they may be slanted, grounds that do not look down, walls that are not upright, and the triangles of a part
    that encloses nothing: edges are passed once each way, so that in any other part all look outwards."""
    count = 0
    for triangle, group in zip(triangles, groups):
        n = normal(corners, triangle)
        level = n[0] == n[1] == 0
        count += not {"roof": (level or slanted) and n[2] > 0, "ground": level and n[2] < 0, "wall": n[2] == 0 and not level}[group]
    for part in parts_of(triangles):
        if sum(dot(normal(corners, t), corners[t[0]]) for t in part) <= 0:
            count += len(part)
    return count


def side(a, b, c):
    """Side of a line from a to b on which a point of the same plane lies: 1, 0 or -1."""
    twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    return (twice > 0) - (twice < 0)


def edges_meet(a, b, c, d):
    """Whether two edges of one plane meet; touching is meeting."""
    sides = side(a, b, c), side(a, b, d), side(c, d, a), side(c, d, b)
    if not any(sides):
        return all(max(a[i], b[i]) >= min(c[i], d[i]) and max(c[i], d[i]) >= min(a[i], b[i]) for i in (0, 1))
    return sides[0] * sides[1] <= 0 and sides[2] * sides[3] <= 0


def overlaps(start, end, triangle, n):
    """Whether an edge in the plane of a triangle, which is upright to n, meets it."""
    most = max(range(3), key=lambda axis: abs(n[axis]))
    start, end, *corners = ([p[axis] for axis in range(3) if axis != most] for p in (start, end, *triangle))
    pairs = [(corners[i], corners[(i + 1) % 3]) for i in range(3)]
    within = len({side(a, b, start) for a, b in pairs} - {0}) <= 1
    return within or any(edges_meet(start, end, a, b) for a, b in pairs)


def crosses(start, end, triangle):
    """Whether an edge meets a triangle, without rounding."""
    n = cross(minus(triangle[1], triangle[0]), minus(triangle[2], triangle[0]))
    above, below = dot(n, minus(start, triangle[0])), dot(n, minus(end, triangle[0]))
    if above == below == 0:
        return overlaps(start, end, triangle, n)
    if above * below > 0:
        return False
    # The point of the plane, as a multiple of `scale`.
    scale = above - below
    way = minus(end, start)
    point = [a * scale + b * above for a, b in zip(start, way)]
    sign = 1 if scale > 0 else -1
    for a, b in ((0, 1), (1, 2), (2, 0)):
        corner = triangle[a]
        from_corner = [p - c * scale for p, c in zip(point, corner)]
        if sign * dot(cross(minus(triangle[b], corner), from_corner), n) < 0:
            return False
    return True


def buckets_of(points):
    size = BUCKET * 10 ** DECIMALS
    ranges = [range(min(p[axis] for p in points) // size, max(p[axis] for p in points) // size + 1) for axis in (0, 1)]
    return itertools.product(*ranges)


def apart(a, b):
    return any(max(p[axis] for p in a) < min(p[axis] for p in b) or min(p[axis] for p in a) > max(p[axis] for p in b)
               for axis in range(3))


def crossings(corners, triangles):
    """Edges that meet triangles with which they share no corner."""
    places = collections.defaultdict(list)
    for triangle in triangles:
        for bucket in buckets_of([corners[i] for i in triangle]):
            places[bucket].append(triangle)
    edges = {tuple(sorted(pair)) for t in triangles for pair in ((t[0], t[1]), (t[1], t[2]), (t[2], t[0]))}
    count = 0
    for edge in edges:
        ends = [corners[i] for i in edge]
        near = {t for bucket in buckets_of(ends) for t in places[bucket]}
        for triangle in near:
            points = [corners[i] for i in triangle]
            if set(edge).isdisjoint(triangle) and not apart(ends, points) and crosses(*ends, points):
                count += 1
    return count
