"""Checks a shell in an OBJ: VTK looks for edges that are open or have more than two faces, and exact arithmetic for edges
that cross faces. Prints a line for each, or ends with status 1."""

import collections
import decimal
import itertools
import sys

import vtk

DECIMALS = 12  # of a coordinate, at most
BUCKET = 8  # m


def read(path):
    """Corners as whole numbers, and triangles."""
    corners, triangles = [], []
    for line in open(path, encoding="utf-8"):
        words = line.split()
        if words and words[0] == "v":
            corners.append(tuple(int(decimal.Decimal(word).scaleb(DECIMALS)) for word in words[1:4]))
        elif words and words[0] == "f":
            triangles.append(tuple(int(word) - 1 for word in words[1:4]))
    return corners, triangles


def minus(a, b):
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def crosses(start, end, triangle):
    """Whether an edge meets a triangle, without rounding. What lies in its plane is not asked: where two faces of one
    plane overlap, an edge of a third crosses them, or an edge has more than two faces."""
    n = cross(minus(triangle[1], triangle[0]), minus(triangle[2], triangle[0]))
    above, below = dot(n, minus(start, triangle[0])), dot(n, minus(end, triangle[0]))
    if above * below > 0 or above == below == 0:
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


def edges_of(surface, boundary):
    """How many edges of a surface VTK finds to be open, or to have more than two faces."""
    edges = vtk.vtkFeatureEdges()
    edges.SetInputData(surface)
    edges.SetBoundaryEdges(boundary)
    edges.SetNonManifoldEdges(not boundary)
    edges.FeatureEdgesOff()
    edges.ManifoldEdgesOff()
    edges.Update()
    return edges.GetOutput().GetNumberOfCells()


def seen_by_vtk(path):
    """The surface as VTK reads it, with single precision; equal corners are one."""
    reader = vtk.vtkSTLReader() if path.endswith(".stl") else vtk.vtkOBJReader()
    reader.SetFileName(path)
    merged = vtk.vtkCleanPolyData()
    merged.SetInputConnection(reader.GetOutputPort())
    merged.ToleranceIsAbsoluteOn()
    merged.SetAbsoluteTolerance(0)
    merged.Update()
    return merged.GetOutput()


def main(path):
    surface = seen_by_vtk(path)
    open_edges, more_faces = edges_of(surface, True), edges_of(surface, False)
    mass = vtk.vtkMassProperties()
    mass.SetInputData(surface)
    print(f"VTK: {surface.GetNumberOfPoints()} points, {surface.GetNumberOfCells()} triangles, {open_edges} open edges, "
          f"{more_faces} of more than two faces, {mass.GetVolume():.0f} m3")
    corners, triangles = read(path)
    count = crossings(corners, triangles)
    print(f"exact: {count} edges cross a face")
    flat = surface.GetNumberOfCells() != len(triangles) or surface.GetNumberOfPoints() != len(corners)
    if flat:
        print("corners have become one in single precision", file=sys.stderr)
    return 1 if open_edges or more_faces or count or flat or mass.GetVolume() <= 0 else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
