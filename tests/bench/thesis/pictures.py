"""Surfaces drawn by VTK, all from one viewpoint. Needs an X server; `xvfb-run` gives one without a screen."""
import numpy as np
import vtk
from osgeo import gdal
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

GREY = (0.8, 0.8, 0.8)


def vtk_data(surface):
    data = vtk.vtkPolyData()
    points = vtk.vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(surface.points, dtype=float), deep=1))
    cells = vtk.vtkCellArray()
    triangles = np.ascontiguousarray(surface.triangles, dtype=np.int64)
    cells.SetData(numpy_to_vtk(np.arange(0, triangles.size + 1, 3), deep=1, array_type=vtk.VTK_ID_TYPE),
                  numpy_to_vtk(triangles.ravel(), deep=1, array_type=vtk.VTK_ID_TYPE))
    data.SetPoints(points)
    data.SetPolys(cells)
    return data


def renderer_of(surface, title, camera, height):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(vtk_data(surface))
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    look = actor.GetProperty()
    look.SetColor(*GREY)
    look.SetInterpolationToFlat()
    look.SetAmbient(0.25)
    look.SetDiffuse(0.75)
    words = vtk.vtkTextActor()
    words.SetInput(title)
    words.GetTextProperty().SetColor(0, 0, 0)
    words.GetTextProperty().SetFontSize(15)
    words.SetPosition(8, height - 22)
    light = vtk.vtkLight()
    light.SetLightTypeToSceneLight()
    light.SetPosition(-1, -0.4, 1.1)
    light.SetFocalPoint(0, 0, 0)
    light.PositionalOff()
    made = vtk.vtkRenderer()
    made.AutomaticLightCreationOff()
    made.SetBackground(1, 1, 1)
    made.AddActor(actor)
    made.AddActor2D(words)
    made.AddLight(light)
    made.SetActiveCamera(camera)
    return made


def view_of(surface, closer):
    """View from the south-south-west, 40 degrees above the horizon, onto the middle of a surface."""
    low, high = surface.points.min(axis=0), surface.points.max(axis=0)
    middle = (low + high) / 2
    reach = np.linalg.norm((high - low)[:2]) / closer
    side, up = np.radians(-110), np.radians(40)
    toward = np.array([np.cos(side) * np.cos(up), np.sin(side) * np.cos(up), np.sin(up)])
    camera = vtk.vtkCamera()
    camera.SetFocalPoint(*middle)
    camera.SetPosition(*(middle + toward * reach * 2.2))
    camera.SetViewUp(0, 0, 1)
    camera.SetViewAngle(24)
    return camera


def draw(path, panels, columns, size, closer=1.0):
    """@param panels: titles and surfaces, row by row. @param size: width and height of a panel in pixels"""
    rows = -(-len(panels) // columns)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(columns * size[0], rows * size[1])
    camera = view_of(panels[0][1], closer)
    # Places without a panel are black otherwise.
    paper = vtk.vtkRenderer()
    paper.SetBackground(1, 1, 1)
    window.AddRenderer(paper)
    for place, (title, surface) in enumerate(panels):
        row, column = divmod(place, columns)
        made = renderer_of(surface, title, camera, size[1])
        made.SetViewport(column / columns, 1 - (row + 1) / rows, (column + 1) / columns, 1 - row / rows)
        made.ResetCameraClippingRange()
        window.AddRenderer(made)
    window.Render()
    for made in window.GetRenderers():
        made.ResetCameraClippingRange()
    window.Render()
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    grab.Update()
    write_small(path, grab.GetOutput())


def write_small(path, image):
    """A PNG of 32 greys, which is small: surfaces have no colours."""
    columns, rows, _ = image.GetDimensions()
    pixels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(rows, columns, -1)[::-1, :, :3]
    grey = (pixels.mean(axis=2) / 255 * 31).round() / 31 * 255
    memory = gdal.GetDriverByName("MEM").Create("", columns, rows, 1, gdal.GDT_Byte)
    memory.GetRasterBand(1).WriteArray(grey.astype(np.uint8))
    gdal.GetDriverByName("PNG").CreateCopy(str(path), memory, options=["ZLEVEL=9"])
