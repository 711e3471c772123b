"""Checks a CityJSON: the rules of the format, and that each of its solids is one. Prints a line, or ends with status 1."""

import collections
import json
import pathlib
import sys

import jsonschema

RULES = json.loads((pathlib.Path(__file__).parent / "cityjson_rules.json").read_text())


def normal(rings, vertices):
    """Of a polygon, twice its area long, in whole steps (Newell)."""
    sums = [0, 0, 0]
    for ring in rings:
        for a, b in zip(ring, ring[1:] + ring[:1]):
            p, q = vertices[a], vertices[b]
            for axis in range(3):
                u, v = (axis + 1) % 3, (axis + 2) % 3
                sums[axis] += p[u] * q[v] - p[v] * q[u]
    return sums


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def face_faults(rings, kind, vertices):
    n = normal(rings, vertices)
    first = vertices[rings[0][0]]
    if any(dot(n, [a - b for a, b in zip(vertices[i], first)]) for ring in rings for i in ring):
        yield "a face is not plane"
    right = {"RoofSurface": n[0] == n[1] == 0 < n[2], "GroundSurface": n[0] == n[1] == 0 > n[2],
             "WallSurface": n[2] == 0 and n != [0, 0, 0]}
    if not right[kind]:
        yield f"a {kind} looks to {n}"


def solid_faults(solid, vertices):
    """The ways along its edges, its faces, and the six volumes of it."""
    faces = solid["boundaries"][0]
    kinds = solid["semantics"]["values"][0]
    ways = collections.Counter()
    volume = 0
    if len(kinds) != len(faces):
        yield "not every face has a kind"
    for rings, kind in zip(faces, kinds):
        yield from face_faults(rings, solid["semantics"]["surfaces"][kind]["type"], vertices)
        volume += dot(normal(rings, vertices), vertices[rings[0][0]])
        for ring in rings:
            ways.update((tuple(vertices[a]), tuple(vertices[b])) for a, b in zip(ring, ring[1:] + ring[:1]))
    if any(count != 1 or ways[way[::-1]] != 1 for way, count in ways.items()):
        yield "an edge is not passed once each way"
    if volume <= 0:
        yield "it encloses nothing"


def faults(city):
    validator = jsonschema.Draft7Validator(RULES)
    broken = [f"{'/'.join(map(str, error.path))}: {error.message[:200]}" for error in validator.iter_errors(city)]
    if broken:
        yield from broken
        return
    vertices = city["vertices"]
    used = set()
    for name, building in city["CityObjects"].items():
        solid = building["geometry"][0]
        numbers = {i for face in solid["boundaries"][0] for ring in face for i in ring}
        if not numbers <= set(range(len(vertices))):
            yield f"{name} has a vertex that is not there"
            return
        used |= numbers
        yield from (f"{name}: {fault}" for fault in solid_faults(solid, vertices))
    if len(used) != len(vertices):
        yield f"{len(vertices) - len(used)} vertices are not used"
    if len(set(map(tuple, vertices))) != len(vertices):
        yield "a vertex is there twice"


def main(path):
    city = json.loads(pathlib.Path(path).read_text())
    found = list(faults(city))
    for fault in found:
        print(f"{path}: {fault}", file=sys.stderr)
    if not found:
        print(f"CityJSON: {len(city['CityObjects'])} solids of {len(city['vertices'])} vertices, all valid")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
