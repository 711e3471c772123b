"""Methods that the thesis compares itself with, and later ones: surfaces of about as many points as asked for."""
import bisect
import heapq
import struct

import numpy as np
import vtk
from osgeo import ogr
from scipy import interpolate, ndimage, spatial
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

from surface import Surface


def grid_points(z, cell, rows, cols):
    rr, cc = np.meshgrid(rows, cols, indexing="ij")
    return np.column_stack([cc.ravel() * cell, -rr.ravel() * cell, z[rr, cc].ravel()])


def grid_triangles(rows, cols):
    """Two a square, on points in the order of rows."""
    at = np.arange(rows * cols).reshape(rows, cols)
    a, b, c, d = (part.ravel() for part in (at[:-1, :-1], at[:-1, 1:], at[1:, :-1], at[1:, 1:]))
    return np.concatenate([np.column_stack([a, c, b]), np.column_stack([b, c, d])])


def full_surface(scene):
    """All points of a raster."""
    rows, cols = (np.arange(size) for size in scene.z.shape)
    return Surface(grid_points(scene.z, scene.cell, rows, cols), grid_triangles(*scene.z.shape))


def spread(count, size):
    return np.unique(np.linspace(0, size - 1, count).round().astype(int))


def grid_of(shape, budget):
    """Rows and columns of a coarser grid of at most so many points."""
    rows = max(2, int(np.sqrt(budget * shape[0] / shape[1])))
    return min(rows, shape[0]), min(max(2, budget // rows), shape[1])


def regular(z, cell, budget):
    """Every k-th row and column."""
    rows, cols = (spread(n, size) for n, size in zip(grid_of(z.shape, budget), z.shape))
    return Surface(grid_points(z, cell, rows, cols), grid_triangles(len(rows), len(cols)))


def delaunay(z, cell, picked):
    """@param picked: rows and columns"""
    picked = np.unique(picked, axis=0)
    points = np.column_stack([picked[:, 1] * cell, -picked[:, 0] * cell, z[picked[:, 0], picked[:, 1]]])
    return Surface(points, spatial.Delaunay(picked).simplices)


def corners_of(shape):
    return np.array([(r, c) for r in (0, shape[0] - 1) for c in (0, shape[1] - 1)])


def square_error(z, box):
    """The largest distance from the plane through three corners and the fourth: bilinear."""
    top, left, bottom, right = box
    part = z[top:bottom + 1, left:right + 1]
    s = np.linspace(0, 1, part.shape[0])[:, None]
    t = np.linspace(0, 1, part.shape[1])[None, :]
    flat = (1 - s) * ((1 - t) * part[0, 0] + t * part[0, -1]) + s * ((1 - t) * part[-1, 0] + t * part[-1, -1])
    return float(np.abs(part - flat).max())


def quadtree(z, cell, budget):
    """The square with the largest error is divided in four, as long as points are left."""
    whole = (0, 0, z.shape[0] - 1, z.shape[1] - 1)
    points = {(r, c) for r in (0, whole[2]) for c in (0, whole[3])}
    waiting = [(-square_error(z, whole), whole)]
    while waiting and len(points) + 5 <= budget:
        _, (top, left, bottom, right) = heapq.heappop(waiting)
        row, col = (top + bottom) // 2, (left + right) // 2
        points |= {(r, c) for r in (top, row, bottom) for c in (left, col, right)}
        halves = [(top, row), (row, bottom)] if bottom - top > 1 else [(top, bottom)]
        for low, high in halves:
            for first, last in ([(left, col), (col, right)] if right - left > 1 else [(left, right)]):
                box = (low, first, high, last)
                if high - low > 1 or last - first > 1:
                    heapq.heappush(waiting, (-square_error(z, box), box))
    return delaunay(z, cell, np.array(sorted(points)))


def sobel(z, cell, budget):
    """The points of the steepest slopes, by Sobel's operators over 3 x 3 points, and Delaunay's triangles."""
    slope = np.hypot(ndimage.sobel(z, 0), ndimage.sobel(z, 1))
    best = np.argsort(-slope, axis=None, kind="stable")[:budget - 4]
    picked = np.column_stack(np.unravel_index(best, z.shape))
    return delaunay(z, cell, np.concatenate([corners_of(z.shape), picked]))


def vtk_image(z, cell):
    image = vtk.vtkImageData()
    image.SetDimensions(z.shape[1], z.shape[0], 1)
    image.SetSpacing(cell, cell, 1)
    image.GetPointData().SetScalars(numpy_to_vtk(z.ravel(), deep=1))
    return image


def from_vtk(data):
    """Surface of an image; VTK counts its rows to the north."""
    points = vtk_to_numpy(data.GetPoints().GetData()).astype(float) * [1, -1, 1]
    return Surface(points, vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3).astype(int))


def triangles_of(points):
    """Triangles of a surface of so many points, with about as many on its border as a square grid would have."""
    return int(2 * points - 2 - 3.2 * np.sqrt(points))


def greedy(z, cell, budget):
    """The point that is farthest from the triangles becomes one of theirs (Garland and Heckbert 1995): TERRA's way."""
    work = vtk.vtkGreedyTerrainDecimation()
    work.SetInputData(vtk_image(z, cell))
    work.SetErrorMeasureToNumberOfTriangles()
    work.SetNumberOfTriangles(triangles_of(budget))
    work.Update()
    return from_vtk(work.GetOutput())


def full_mesh(z, cell):
    points = grid_points(z, cell, np.arange(z.shape[0]), np.arange(z.shape[1])) * [1, -1, 1]
    data = vtk.vtkPolyData()
    corners = vtk.vtkPoints()
    corners.SetData(numpy_to_vtk(points, deep=1))
    data.SetPoints(corners)
    triangles = grid_triangles(*z.shape)
    cells = vtk.vtkCellArray()
    places = np.arange(0, 3 * len(triangles) + 1, 3)
    cells.SetData(numpy_to_vtk(places, deep=1, array_type=vtk.VTK_ID_TYPE),
                  numpy_to_vtk(triangles.ravel(), deep=1, array_type=vtk.VTK_ID_TYPE))
    data.SetPolys(cells)
    return data


def decimate_pro(z, cell, budget):
    """Takes points away while the topology stays (Schroeder 1992), as in the thesis. Also those on sharp
    edges: with VTK's default angle of 15 degrees it ends at a third to a half of all points."""
    work = vtk.vtkDecimatePro()
    work.PreserveTopologyOn()
    work.SplittingOff()
    work.SetFeatureAngle(180)
    return decimated(work, z, cell, budget)


def quadric(z, cell, budget):
    """Edges are drawn together at the least squared distance to their planes (Garland and Heckbert 1997)."""
    return decimated(vtk.vtkQuadricDecimation(), z, cell, budget)


def decimated(work, z, cell, budget):
    work.SetInputData(full_mesh(z, cell))
    work.SetTargetReduction(1 - triangles_of(budget) / (2 * (z.shape[0] - 1) * (z.shape[1] - 1)))
    work.Update()
    return from_vtk(work.GetOutput())


def contour_lines(z, cell, levels):
    """Marching squares: lines at so many heights, their points between those of the grid."""
    work = vtk.vtkContourFilter()
    work.SetInputData(vtk_image(z, cell))
    for place, level in enumerate(np.linspace(z.min(), z.max(), levels + 2)[1:-1]):
        work.SetValue(place, level)
    strips = vtk.vtkStripper()
    strips.SetMaximumLength(1 << 30)
    strips.JoinContiguousSegmentsOn()
    strips.SetInputConnection(work.GetOutputPort())
    strips.Update()
    data = strips.GetOutput()
    points = vtk_to_numpy(data.GetPoints().GetData()).astype(float) * [1, -1, 0]
    points[:, 2] = vtk_to_numpy(data.GetPointData().GetScalars())
    at = vtk_to_numpy(data.GetLines().GetConnectivityArray())
    ends = vtk_to_numpy(data.GetLines().GetOffsetsArray())
    return [ogr_line(points[at[first:last]]) for first, last in zip(ends, ends[1:])]


def ogr_line(points):
    line = ogr.wkbLineString | ogr.wkb25DBit
    head = struct.pack("<BII", 1, line & 0xffffffff, len(points))
    return ogr.CreateGeometryFromWkb(head + points.astype("<f8").tobytes())


def straightened(lines, tolerance):
    """Simplifies by Douglas and Peucker the lines that are longer than twice the tolerance."""
    kept = []
    for line in lines:
        left, right, bottom, top = line.GetEnvelope()
        if np.hypot(right - left, top - bottom) >= 2 * tolerance:
            kept.append(line.Simplify(tolerance))
    return kept


def contours(z, cell, budget):
    """Marching squares' lines and Delaunay's triangles: of 2 to 32 heights, each with the least tolerance that leaves
    no more points than asked for, those that err least."""
    rows, cols = corners_of(z.shape).T
    corners = np.column_stack([cols * cell, -rows * cell, z[rows, cols]])
    best = None
    for levels in (2, 8, 32):
        lines = contour_lines(z, cell, levels)
        tolerances = [0, *cell * np.geomspace(0.05, max(z.shape), 30)]
        fits = bisect.bisect_left(tolerances, True, key=lambda far: 4 + sum(
            line.GetPointCount() for line in straightened(lines, far)) <= budget)
        points = np.concatenate([corners, *(line.GetPoints() for line in straightened(lines, tolerances[fits]))])
        _, first = np.unique(points[:, :2].round(6), axis=0, return_index=True)
        surface = Surface(points[first], spatial.Delaunay(points[first, :2]).simplices)
        error = np.sqrt(np.mean((surface.heights(z.shape, cell) - z) ** 2))
        best = min(best or (error, surface), (error, surface), key=lambda pair: pair[0])
    return best[1]


class Spline(Surface):
    """A surface between control points, drawn at the points of the grid."""

    def __init__(self, drawn, cell, controls):
        rows, cols = (np.arange(size) for size in drawn.shape)
        super().__init__(grid_points(drawn, cell, rows, cols), grid_triangles(*drawn.shape))
        self.controls = controls

    def count(self):
        return self.controls


def knots(size, controls):
    """Knots of a cubic spline with so many controls, evenly spread."""
    inner = np.linspace(0, size - 1, controls - 2)[1:-1]
    return np.concatenate([[0] * 4, inner, [size - 1] * 4])


def spline(z, cell, budget):
    """Cubic B-splines along rows and columns by least squares; the thesis calls it a NURBS surface, and its points
    are its controls."""
    rows, cols = (max(4, min(n, size)) for n, size in zip(grid_of(z.shape, budget), z.shape))
    along = interpolate.make_lsq_spline(np.arange(z.shape[0]), z, knots(z.shape[0], rows))(np.arange(z.shape[0]))
    drawn = interpolate.make_lsq_spline(np.arange(z.shape[1]), along.T, knots(z.shape[1], cols))(np.arange(z.shape[1])).T
    return Spline(drawn, cell, rows * cols)


METHODS = {
    "regular subsampling": regular,
    "quadtree": quadtree,
    "Sobel, Delaunay": sobel,
    "greedy insertion": greedy,
    "vtkDecimatePro": decimate_pro,
    "vtkQuadricDecimation": quadric,
    "marching squares": contours,
    "B-spline surface": spline,
}
