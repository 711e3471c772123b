"""Whether a solid is still one when corners within a millimetre are taken for one and faces may be a centimetre off their
plane, as programs that read solids do by default: closed, a 2-manifold, its faces simple, none there twice, none crossed."""

import collections
import fractions
import itertools
import math

TOLERANCE = 0.001  # m
PLANARITY = 0.01  # m
ROUNDING = 1e-9  # m, of coordinates that are as far apart as the tolerance


def snapped(points):
    """Number of the first point within the tolerance of each point, which may be its own. Points are in metres."""
    size, known, first = 2 * TOLERANCE, collections.defaultdict(list), []
    for number, point in enumerate(points):
        cell = tuple(math.floor(value / size) for value in point)
        near = [other for offset in itertools.product((-1, 0, 1), repeat=3)
                for other in known[tuple(c + o for c, o in zip(cell, offset))]
                if math.dist(points[other], point) <= TOLERANCE + ROUNDING]
        first.append(min(near, default=number))
        if not near:
            known[cell].append(number)
    return first


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def normal(rings, points):
    """Normal of a polygon, twice its area long (Newell)."""
    sums = [0, 0, 0]
    for ring in rings:
        for a, b in zip(ring, ring[1:] + ring[:1]):
            p, q = points[a], points[b]
            for axis in range(3):
                u, v = (axis + 1) % 3, (axis + 2) % 3
                sums[axis] += p[u] * q[v] - p[v] * q[u]
    return sums


def is_plane(rings, metres):
    """Whether all corners are within the tolerance of the plane through their middle."""
    corners = [metres[i] for ring in rings for i in ring]
    middle = [sum(values) / len(corners) for values in zip(*corners)]
    near = {i: minus(metres[i], middle) for ring in rings for i in ring}
    n = normal(rings, near)
    length = math.hypot(*n)
    return length > 0 and all(abs(dot(n, corner)) <= PLANARITY * length for corner in near.values())


def side(a, b, c):
    twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    return (twice > 0) - (twice < 0)


def edges_meet(a, b, c, d):
    """Whether two edges of one plane meet; touching is meeting."""
    if any(max(a[i], b[i]) < min(c[i], d[i]) or max(c[i], d[i]) < min(a[i], b[i]) for i in (0, 1)):
        return False
    return side(a, b, c) * side(a, b, d) <= 0 and side(c, d, a) * side(c, d, b) <= 0


def seen(points, n):
    """Points of a plane that is upright to n, without the axis that it looks along most."""
    most = max(range(3), key=lambda axis: abs(n[axis]))
    return [[p[axis] for axis in range(3) if axis != most] for p in points]


def is_simple(rings, points):
    """Whether no edge of a face meets another one but in the corner that they share. Corners are known to be distinct."""
    n = normal(rings, points)
    edges = [(a, b) for ring in rings for a, b in zip(ring, ring[1:] + ring[:1])]
    flat = [seen([points[a], points[b]], n) for a, b in edges]
    order = sorted(range(len(edges)), key=lambda e: min(flat[e][0][0], flat[e][1][0]))
    for place, e in enumerate(order):
        right = max(flat[e][0][0], flat[e][1][0])
        for other in itertools.islice(order, place + 1, None):
            if min(flat[other][0][0], flat[other][1][0]) > right:
                break
            if set(edges[e]).isdisjoint(edges[other]) and edges_meet(*flat[e], *flat[other]):
                return False
    return True


def is_within(point, rings):
    """Whether a point of the plane is in a polygon or on its border."""
    inside = False
    for ring in rings:
        for a, b in zip(ring, ring[1:] + ring[:1]):
            turn = side(a, b, point)
            if turn == 0 and edges_meet(a, b, point, point):
                return True
            if (a[1] > point[1]) != (b[1] > point[1]) and turn * (1 if b[1] > a[1] else -1) > 0:
                inside = not inside
    return inside


def crosses(edge, rings, points):
    """Whether an edge meets a face with which it shares no corner, without rounding."""
    n = normal(rings, points)
    a, b = points[edge[0]], points[edge[1]]
    above, below = dot(n, minus(a, points[rings[0][0]])), dot(n, minus(b, points[rings[0][0]]))
    flat = [seen([points[i] for i in ring], n) for ring in rings]
    if above == below == 0:
        a, b = seen([a, b], n)
        return is_within(a, flat) or any(edges_meet(a, b, c, d) for ring in flat for c, d in zip(ring, ring[1:] + ring[:1]))
    if above * below > 0:
        return False
    share = fractions.Fraction(above, above - below)
    return is_within(seen([[x + share * (y - x) for x, y in zip(a, b)]], n)[0], flat)


def box(points):
    return [(min(values), max(values)) for values in zip(*points)]


def crossings(faces, points, moved):
    """Edges that meet faces, where a corner of one of them has moved."""
    edges = {tuple(sorted(edge)) for rings in faces for ring in rings for edge in zip(ring, ring[1:] + ring[:1])}
    boxes = {edge: box([points[i] for i in edge]) for edge in edges}
    count = 0
    for rings in faces:
        corners = {i for ring in rings for i in ring}
        around = box([points[i] for i in corners])
        for edge in edges:
            if corners.isdisjoint(edge) and not (moved.isdisjoint(corners) and moved.isdisjoint(edge)) and \
               all(low <= b and a <= high for (low, high), (a, b) in zip(around, boxes[edge])):
                count += crosses(edge, rings, points)
    return count


def has_one_fan(faces):
    """Whether the faces at each corner are one fan, where every edge is passed once each way."""
    fans = collections.defaultdict(dict)
    for rings in faces:
        for ring in rings:
            for i, corner in enumerate(ring):
                fans[corner][ring[(i + 1) % len(ring)]] = ring[i - 1]
    for fan in fans.values():
        first = at = next(iter(fan))
        for count in range(1, len(fan) + 1):
            at = fan[at]
            if at == first:
                break
        if count != len(fan):
            return False
    return True


def faults(faces, points, step):
    """Faults of a shell. @param faces as rings of numbers of points @param points in whole steps @param step metres
    of one along each axis"""
    numbers = sorted({i for rings in faces for ring in rings for i in ring})
    # Near the first point, so that metres are exact enough.
    metres = {i: [(value - origin) * length for value, origin, length in zip(points[i], points[numbers[0]], step)]
              for i in numbers}
    first = dict(zip(numbers, (numbers[i] for i in snapped([metres[i] for i in numbers]))))
    moved = {first[i] for i in numbers if first[i] != i}
    faces = [[[first[i] for i in ring] for ring in rings] for rings in faces]
    if any(len(ring) < 3 or len(set(ring)) < len(ring) for rings in faces for ring in rings) or \
       any(set(a) & set(b) for rings in faces for a, b in itertools.combinations(rings, 2)):
        yield "a face passes a corner twice"
        return
    if not all(is_plane(rings, metres) for rings in faces):
        yield "a face is not plane"
    if not all(is_simple(rings, points) for rings in faces):
        yield "a face crosses itself"
    if len({frozenset(i for ring in rings for i in ring) for rings in faces}) < len(faces):
        yield "a face is there twice"
    ways = collections.Counter(way for rings in faces for ring in rings for way in zip(ring, ring[1:] + ring[:1]))
    if any(count != 1 or ways[way[::-1]] != 1 for way, count in ways.items()):
        yield "an edge is not passed once each way"
        return
    if not has_one_fan(faces):
        yield "the faces at a corner are not one fan"
    if crossings(faces, points, moved):
        yield "an edge crosses a face"
