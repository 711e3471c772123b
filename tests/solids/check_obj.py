"""Checks a shell in an OBJ: VTK looks for edges that are open or have more than two faces, and exact arithmetic for edges
that cross faces and for corners that others take for one; with `slanted` as second argument roofs need not be level. Prints a line for each, or ends with status 1."""

import sys

import vtk

from exact_shell import crossings, inverted, near_corners, read


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


def main(path, slanted=False):
    surface = seen_by_vtk(path)
    open_edges, more_faces = edges_of(surface, True), edges_of(surface, False)
    mass = vtk.vtkMassProperties()
    mass.SetInputData(surface)
    print(f"VTK: {surface.GetNumberOfPoints()} points, {surface.GetNumberOfCells()} triangles, {open_edges} open edges, "
          f"{more_faces} of more than two faces, {mass.GetVolume():.0f} m3")
    corners, triangles, groups = read(path)
    count = crossings(corners, triangles)
    wrong = inverted(corners, triangles, groups, slanted)
    near = near_corners(corners)
    print(f"exact: {count} edges cross a face, {wrong} triangles look the wrong way, {near} corners are within a millimetre of "
          "another")
    flat = surface.GetNumberOfCells() != len(triangles) or surface.GetNumberOfPoints() != len(corners)
    if flat:
        print("corners have become one in single precision", file=sys.stderr)
    return 1 if open_edges or more_faces or count or wrong or near or flat or mass.GetVolume() <= 0 else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], "slanted" in sys.argv[2:]))
