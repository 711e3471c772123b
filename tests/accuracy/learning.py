"""The weights of the judge (lib/detect/judge.cpp), fitted to objects whose truth is known, and tried on places
that took no part."""
import csv
import os
import subprocess

import numpy as np
from osgeo import gdal, ogr

from tables import table, text

NAMES = ("smooth", "ln step", "ln tilt", "ln segment", "constant")
LEAST_M2 = 50
RIDGE = 1e-3  # of the squares of the weights: what only one place has gets none


def mask_of(place, path):
    """Writes a raster on the grid of a place: 1 where its reference has a building, 255 where that does not say."""
    surface = gdal.Open(place.dsm)
    raster = gdal.GetDriverByName("GTiff").Create(path, surface.RasterXSize, surface.RasterYSize, 1, gdal.GDT_Byte)
    raster.SetGeoTransform(surface.GetGeoTransform())
    raster.SetProjection(surface.GetProjection())
    raster.GetRasterBand(1).SetNoDataValue(255)
    area = place.area_of_interest()
    raster.GetRasterBand(1).Fill(0 if area is None else 255)
    for value, parts in ((0, [] if area is None else [area]), (1, place.blocks())):
        memory = ogr.GetDriverByName("Memory").CreateDataSource("m")
        layer = memory.CreateLayer("l", surface.GetSpatialRef())
        for part in parts:
            feature = ogr.Feature(layer.GetLayerDefn())
            feature.SetGeometry(part)
            layer.CreateFeature(feature)
        gdal.RasterizeLayer(raster, [1], layer, burn_values=[value])


def evidence(build, place, work):
    """Objects of a place: what the judge sees as an array n x 5, whether they are buildings, their confidence now."""
    mask = os.path.join(work, place.name + "_truth.tif")
    mask_of(place, mask)
    program = os.path.join(build, "tests", "accuracy", "d2b_evidence")
    lines = subprocess.run([program, place.dsm, mask], check=True, capture_output=True, text=True).stdout
    rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(lines.splitlines())]
    rows = [row for row in rows if row["cells"] * row["cell_m"] ** 2 >= LEAST_M2 and row["confidence"] > 0
            and row["known"] >= 0.5]
    features = [(row["smooth"], np.log(max(row["step_m"], 0.1)), np.log(row["tilt"]),
                 np.log(max(row["segment"], 1)), 1) for row in rows]
    return (np.array(features, float).reshape(-1, len(NAMES)), np.array([row["right"] >= 0.5 for row in rows], float),
            np.array([row["confidence"] for row in rows], float))


def chances(features, weights):
    return 1 / (1 + np.exp(-features @ weights))


def fit(places):
    """The weights that make what is known most likely, each place as heavy as the others: by Newton's method."""
    features = np.concatenate([place[0] for place in places])
    right = np.concatenate([place[1] for place in places])
    heavy = np.concatenate([np.full(len(place[1]), 1 / len(place[1])) for place in places if len(place[1])])
    weights = np.zeros(len(NAMES))
    ridge = RIDGE * np.diag([1] * (len(NAMES) - 1) + [0])
    for _ in range(50):
        p = chances(features, weights)
        gradient = features.T @ (heavy * (right - p)) - ridge @ weights
        curvature = (features * (heavy * p * (1 - p))[:, None]).T @ features + ridge
        step = np.linalg.solve(curvature, gradient)
        weights = weights + step
        if np.abs(step).max() < 1e-10:
            break
    return weights


def loss(right, confidence):
    """Mean of -ln of the chance that was given to what is so; 0.69 for one that knows nothing."""
    p = np.clip(confidence, 1e-3, 1 - 1e-3)
    return float(-(right * np.log(p) + (1 - right) * np.log(1 - p)).mean()) if len(right) else None


def agreed(right, confidence):
    return float(((confidence >= 0.5) == (right > 0)).mean()) if len(right) else None


def kind(place):
    """Scenes of one place are left out together."""
    return place.title.split(",")[0]


def left_out(known):
    """For each place: its objects with the chances that the weights of all others give, in two columns with whether
    they are buildings, and the confidences of the program."""
    for place, (features, right, now) in known:
        others = [seen for other, seen in known if kind(other) != kind(place)]
        if len(right) and others:
            yield {"name": place.title, "now": now,
                   "objects": np.column_stack([chances(features, fit(others)), right])}


def left_out_table(tried):
    rows = []
    for place in tried:
        p, right = place["objects"].T
        rows.append([place["name"], str(len(right)), text(right.mean(), 2), text(agreed(right, place["now"])),
                     text(agreed(right, p)), text(loss(right, place["now"])), text(loss(right, p))])
    return table(["place", "objects", "buildings", "agreed", "agreed, left out", "loss", "loss, left out"], rows)


def learned(build, places, work):
    """Tables by name, and the places as they were left out."""
    known = [(place, evidence(build, place, work)) for place in places]
    tried = list(left_out(known))
    weights = fit([seen for _, seen in known])
    return {"left_out": left_out_table(tried),
            "weights": table(NAMES, [[text(weight, 2) for weight in weights]])}, tried
