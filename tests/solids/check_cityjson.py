"""Checks a CityJSON: the rules of the format, and that each of its solids is one. Prints a line, or ends with status 1."""

import collections
import json
import pathlib
import sys

import jsonschema
import numpy

import snapped_solid
from snapped_solid import dot, normal

RULES = json.loads((pathlib.Path(__file__).parent / "cityjson_rules.json").read_text())


PLANE = 0.001  # m


def off_plane(rings, vertices, step):
    """Largest distance of a corner from the plane that fits all corners best, in m."""
    corners = numpy.array([vertices[i] for ring in rings for i in ring]) * step
    corners -= corners.mean(axis=0)
    return numpy.abs(corners @ numpy.linalg.svd(corners)[2][2]).max()


def face_faults(rings, kind, vertices, step, slanted=False):
    n = normal(rings, vertices)
    first = vertices[rings[0][0]]
    if slanted and kind == "RoofSurface":
        if (off := off_plane(rings, vertices, step)) > PLANE:
            yield f"a roof is {1000 * off:.2f} mm from a plane"
    elif any(dot(n, [a - b for a, b in zip(vertices[i], first)]) for ring in rings for i in ring):
        yield "a face is not plane"
    right = {"RoofSurface": n[2] > 0 and (slanted or n[0] == n[1] == 0), "GroundSurface": n[0] == n[1] == 0 > n[2],
             "WallSurface": n[2] == 0 and n != [0, 0, 0]}
    if not right[kind]:
        yield f"a {kind} looks to {n}"


def metres_in_a_unit(city):
    """Unit of the coordinates: metres if the file has no CRS."""
    name = city.get("metadata", {}).get("referenceSystem", "")
    if not name:
        return 1.0
    from osgeo import osr  # files without a CRS do not need it
    crs = osr.SpatialReference()
    crs.ImportFromEPSG(int(name.rsplit("/", 1)[1]))
    return crs.GetLinearUnits()


def solid_faults(solid, vertices, step):
    """The ways along its edges, its faces, and the six volumes of it; then as others read it, see snapped_solid."""
    faces = solid["boundaries"][0]
    kinds = solid["semantics"]["values"][0]
    ways = collections.Counter()
    volume = 0
    if len(kinds) != len(faces):
        yield "not every face has a kind"
    for rings, kind in zip(faces, kinds):
        surface = solid["semantics"]["surfaces"][kind]
        yield from face_faults(rings, surface["type"], vertices, step, "slope" in surface)
        volume += dot(normal(rings, vertices), vertices[rings[0][0]])
        for ring in rings:
            ways.update((tuple(vertices[a]), tuple(vertices[b])) for a, b in zip(ring, ring[1:] + ring[:1]))
    if any(count != 1 or ways[way[::-1]] != 1 for way, count in ways.items()):
        yield "an edge is not passed once each way"
    if volume <= 0:
        yield "it encloses nothing"
    yield from (f"with corners within a millimetre as one {fault}" for fault in snapped_solid.faults(faces, vertices, step))


def surface_faults(geometry, vertices, step):
    """Faults of a building's triangles, or of a relief, which looks up."""
    if geometry["type"] == "CompositeSurface":
        if any(normal(face, vertices)[2] <= 0 for face in geometry["boundaries"]):
            yield "terrain does not look up"
        return
    kinds = geometry["semantics"]["values"]
    if len(kinds) != len(geometry["boundaries"]):
        yield "not every face has a kind"
    for face, kind in zip(geometry["boundaries"], kinds):
        yield from face_faults(face, geometry["semantics"]["surfaces"][kind]["type"], vertices, step, geometry["lod"] == "2.2")


def shell_faults(triangles, vertices, has_border):
    """Faults of all triangles: no edge is passed twice the same way, and but for the border of a terrain each is passed
    once each way; the border is one ring."""
    ways = collections.Counter((tuple(vertices[a]), tuple(vertices[b])) for t in triangles for a, b in zip(t, t[1:] + t[:1]))
    if any(count != 1 for count in ways.values()):
        yield "an edge is passed twice the same way"
        return
    border = {a: b for a, b in ways if (b, a) not in ways}
    if border and not has_border:
        yield "the surface is open"
    elif border:
        at, length = next(iter(border)), 0
        first = at
        while length == 0 or (at != first and length <= len(border)):
            at, length = border.get(at, first), length + 1
        if length != len(border):
            yield "the surface is open within the terrain's border"


def family_faults(things):
    """Parts name their building, which names its parts."""
    for name, thing in things.items():
        for parent in thing.get("parents", []):
            if name not in things.get(parent, {}).get("children", []):
                yield f"{name} is no child of {parent}"
        for child in thing.get("children", []):
            if name not in things.get(child, {}).get("parents", []):
                yield f"{child} is no part of {name}"


def faults(city):
    validator = jsonschema.Draft7Validator(RULES)
    broken = [f"{'/'.join(map(str, error.path))}: {error.message[:200]}" for error in validator.iter_errors(city)]
    if broken:
        yield from broken
        return
    yield from family_faults(city["CityObjects"])
    vertices = city["vertices"]
    step = [length * metres_in_a_unit(city) for length in city["transform"]["scale"]]
    used, shell = set(), []
    for name, thing in city["CityObjects"].items():
        if "geometry" not in thing:
            continue
        geometry = thing["geometry"][0]
        faces = geometry["boundaries"][0] if geometry["type"] == "Solid" else geometry["boundaries"]
        numbers = {i for face in faces for ring in face for i in ring}
        if not numbers <= set(range(len(vertices))):
            yield f"{name} has a vertex that is not there"
            return
        used |= numbers
        if geometry["type"] == "Solid":
            yield from (f"{name}: {fault}" for fault in solid_faults(geometry, vertices, step))
        else:
            shell += [face[0] for face in faces]
            yield from (f"{name}: {fault}" for fault in surface_faults(geometry, vertices, step))
    yield from shell_faults(shell, vertices, any(t["type"] == "TINRelief" for t in city["CityObjects"].values()))
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
        kinds = collections.Counter(thing["geometry"][0]["type"] for thing in city["CityObjects"].values()
                                    if "geometry" in thing)
        print("CityJSON: " + ", ".join(f"{count} {kind}" for kind, count in kinds.items()) +
              f" of {len(city['vertices'])} vertices, all valid")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
