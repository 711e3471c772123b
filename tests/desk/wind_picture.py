#!/usr/bin/python3
"""Draws the wind of a case that wind_case.sh has run, at a height above the lowest terrain (5 m):

    xvfb-run -a tests/desk/wind_picture.py <case folder> <picture.png> [<height above the lowest terrain, m>]

Needs python3-vtk9 and an X server, which xvfb-run of Debian's xvfb starts."""
import sys
from pathlib import Path

import vtk


def read(case):
    """Cells with the last velocity, and the walls of the city."""
    marker = Path(case) / "case.foam"
    marker.touch()
    reader = vtk.vtkOpenFOAMReader()
    reader.SetFileName(str(marker))
    reader.UpdateInformation()
    reader.EnableAllPatchArrays()
    reader.DecomposePolyhedraOn()
    reader.UpdateTimeStep(100)
    reader.Update()
    cells, walls = None, vtk.vtkAppendPolyData()
    found = reader.GetOutput().NewIterator()
    while not found.IsDoneWithTraversal():
        block = found.GetCurrentDataObject()
        name = found.GetCurrentMetaData().Get(vtk.vtkCompositeDataSet.NAME()) or ""
        if block.IsA("vtkUnstructuredGrid") and cells is None:
            cells = block
        elif name.startswith("city"):
            walls.AddInputData(block)
        found.GoToNextItem()
    walls.Update()
    return cells, walls.GetOutput()


def colours():
    table = vtk.vtkColorTransferFunction()
    for speed, colour in ((0, (0.19, 0.21, 0.58)), (2, (0.45, 0.68, 0.82)), (4, (0.88, 0.95, 0.97)),
                          (5, (1.0, 0.88, 0.56)), (7, (0.84, 0.19, 0.15))):
        table.AddRGBPoint(speed, *colour)
    return table


def main(case, picture, height):
    cells, walls = read(case)
    low = walls.GetBounds()[4] + height
    plane = vtk.vtkPlane()
    plane.SetOrigin(0, 0, low)
    plane.SetNormal(0, 0, 1)
    cut = vtk.vtkCutter()
    cut.SetCutFunction(plane)
    cut.SetInputData(cells)
    wind = vtk.vtkPolyDataMapper()
    wind.SetInputConnection(cut.GetOutputPort())
    wind.SetScalarModeToUsePointFieldData()
    wind.SelectColorArray("U")
    table = colours()
    table.SetVectorModeToMagnitude()
    wind.SetLookupTable(table)
    city = vtk.vtkPolyDataMapper()
    city.SetInputData(walls)
    city.ScalarVisibilityOff()
    shown = vtk.vtkRenderer()
    shown.SetBackground(1, 1, 1)
    for mapper in (wind, city):
        actor = vtk.vtkActor()
        actor.SetMapper(mapper)
        actor.GetProperty().SetColor(0.82, 0.8, 0.77)
        actor.GetProperty().SetInterpolationToFlat()
        if mapper is wind:
            actor.GetProperty().LightingOff()
        shown.AddActor(actor)
    legend = vtk.vtkScalarBarActor()
    legend.SetLookupTable(table)
    legend.SetTitle("m/s")
    legend.SetNumberOfLabels(8)
    legend.SetLabelFormat("%.0f")
    legend.SetUnconstrainedFontSize(True)
    legend.SetPosition(0.02, 0.55)
    legend.SetWidth(0.05)
    legend.SetHeight(0.42)
    for words in (legend.GetTitleTextProperty(), legend.GetLabelTextProperty()):
        words.SetColor(0, 0, 0)
        words.ItalicOff()
        words.BoldOff()
        words.SetFontSize(15)
    shown.AddActor2D(legend)
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(900, 560)
    window.AddRenderer(shown)
    west, east, south, north, bottom, _ = walls.GetBounds()
    camera = shown.GetActiveCamera()
    camera.SetFocalPoint((west + east) / 2, (south + north) / 2, bottom)
    wide = east - west
    camera.SetPosition((west + east) / 2 - 0.35 * wide, south - 0.75 * wide, bottom + 0.9 * wide)
    camera.SetViewUp(0, 0, 1)
    shown.ResetCamera()
    camera.Zoom(1.45)
    window.Render()
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    write = vtk.vtkPNGWriter()
    write.SetFileName(picture)
    write.SetInputConnection(grab.GetOutputPort())
    write.Write()


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(sys.argv[1], sys.argv[2], float(sys.argv[3]) if len(sys.argv) > 3 else 5)
