#!/usr/bin/python3
"""Prints the costs of a higher -min_confidence, for the table of docs/tasks/trees.md.

    confidence_price.py <dem2buildings> <folder>...

Each folder has a dsm.tif and a reference_buildings.gpkg. A building is true where half of its area or more lies on those of
the reference. Prints the true and the false ones of 0.5, and then how many of each a higher limit drops. Needs Debian's
python3-gdal.
"""

import pathlib
import subprocess
import sys
import tempfile

from osgeo import gdal, ogr

gdal.UseExceptions()
LIMITS = (0.6, 0.7, 0.8, 0.9)


def polygons(path):
    dataset = gdal.OpenEx(str(path), gdal.OF_VECTOR)
    layer = dataset.GetLayerByName("buildings") or dataset.GetLayer(0)
    geometries = [feature.GetGeometryRef().Clone() for feature in layer]
    return [geometry if geometry.IsValid() else geometry.MakeValid() for geometry in geometries]


def area(geometry):
    """Area of its polygons, because an intersection may have lines and points as well."""
    kind = ogr.GT_Flatten(geometry.GetGeometryType())
    if kind in (ogr.wkbPolygon, ogr.wkbMultiPolygon):
        return geometry.GetArea()
    if kind == ogr.wkbGeometryCollection:
        return sum(area(geometry.GetGeometryRef(i)) for i in range(geometry.GetGeometryCount()))
    return 0.0


def meets(a, b):
    return a[0] < b[1] and b[0] < a[1] and a[2] < b[3] and b[2] < a[3]


def true_and_false(found, reference):
    boxes = [geometry.GetEnvelope() for geometry in reference]
    true = 0
    for building in found:
        box = building.GetEnvelope()
        covered = sum(area(building.Intersection(other)) for other, there in zip(reference, boxes) if meets(box, there))
        true += covered >= building.GetArea() / 2
    return true, len(found) - true


def main(program, *folders):
    for folder in map(pathlib.Path, folders):
        reference = polygons(folder / "reference_buildings.gpkg")
        counts = {}
        with tempfile.TemporaryDirectory() as work:
            for limit in (0.5, *LIMITS):
                result = pathlib.Path(work, f"{limit}.gpkg")
                subprocess.run([program, "-q", "-layers", "buildings", "-min_confidence", str(limit), str(folder / "dsm.tif"),
                                str(result)], check=True, stderr=subprocess.DEVNULL)
                counts[limit] = true_and_false(polygons(result), reference)
        true, false = counts[0.5]
        print(f"{folder.name}: {true} true, {false} false")
        for limit in LIMITS:
            print(f"  {limit}: {true - counts[limit][0]} true lost, {false - counts[limit][1]} false dropped")


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
