"""The weights of the judge (lib/detect/classify.cpp), fitted to objects whose truth is known, and tried on places
that took no part."""
import csv
import os
import subprocess

import numpy as np
from osgeo import gdal

from places import burn
from tables import table, text

NAMES = ("smooth", "ln step", "ln tilt", "ln segment", "right angles", "constant")
THIN_NAMES = ("ln segment", "walled", "ln beside", "ln area", "right angles", "gentle", "form", "constant")
THIN = 0.05  # share of filled cells
SCENES_HEAVY = 0.4  # of a real place: made crowns and houses are all alike
CAUTION = 0.95  # off the constant: woods are larger than houses, and the scenes have few
LEAST_M2 = 50
COMPACT_M2 = 150  # from this to HOUSE_M2 the form of an object says less and less
EVEN_COMPACTNESS = 0.905
HOUSE_M2 = 300  # the larger is the likelier a building up to this; woods are larger than houses


def form_of(row):
    """The evidence of a small object's form, as a logarithm."""
    small = np.clip((HOUSE_M2 - row["area_m2"]) / (HOUSE_M2 - COMPACT_M2), 0, 1)
    return small * max(np.log(min(row["compactness"], 3 / np.pi) / EVEN_COMPACTNESS), -0.4)


COLUMNS = {"smooth": lambda row: row["smooth"], "ln step": lambda row: np.log(max(row["step_m"], 0.1)),
           "ln tilt": lambda row: np.log(row["tilt"]), "ln segment": lambda row: np.log(max(row["segment"], 1)),
           "walled": lambda row: row["walled"], "ln beside": lambda row: np.log(row["beside_m"] + 0.5),
           "ln area": lambda row: np.log(min(row["area_m2"], HOUSE_M2)), "right angles": lambda row: row["right_angles"],
           "gentle": lambda row: row["gentle"], "form": form_of,
           "constant": lambda row: 1}
RIDGE = 1e-3  # of the squares of the weights: a property of only one place gets none


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
        burn(raster, parts, value)


def objects_of(build, place, work):
    """The judge's evidence of the objects of a place: a dictionary each."""
    mask = os.path.join(work, place.name + "_truth.tif")
    mask_of(place, mask)
    program = os.path.join(build, "tests", "accuracy", "d2b_evidence")
    lines = subprocess.run([program, place.dsm, mask], check=True, capture_output=True, text=True).stdout
    rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(lines.splitlines())]
    return [row for row in rows if row["area_m2"] >= LEAST_M2 and row["confidence"] > 0 and row["known"] >= 0.5]


def seen(rows, names):
    """Objects as an array n x names, whether they are buildings, their confidence now."""
    features = [[COLUMNS[name](row) for name in names] for row in rows]
    return (np.array(features, float).reshape(-1, len(names)), np.array([row["right"] >= 0.5 for row in rows], float),
            np.array([row["confidence"] for row in rows], float))


def chances(features, weights):
    return 1 / (1 + np.exp(-features @ weights))


def fit(places, heaviness=None):
    """The weights that make the known truth most likely, each place as heavy as the others or as `heaviness` says: by
    Newton's method. The last is the constant."""
    heaviness = [1] * len(places) if heaviness is None else heaviness
    features = np.concatenate([place[0] for place in places])
    right = np.concatenate([place[1] for place in places])
    heavy = np.concatenate([np.full(len(place[1]), share / len(place[1])) for place, share in zip(places, heaviness)
                            if len(place[1])])
    weights = np.zeros(features.shape[1])
    ridge = RIDGE * np.diag([1] * (len(weights) - 1) + [0])
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
    """Mean of -ln of the chance that was given to the truth; 0.69 for one that knows nothing."""
    p = np.clip(confidence, 1e-3, 1 - 1e-3)
    return float(-(right * np.log(p) + (1 - right) * np.log(1 - p)).mean()) if len(right) else None


def agreed(right, confidence):
    return float(((confidence >= 0.5) == (right > 0)).mean()) if len(right) else None


def kind(place):
    """Scenes of one place are left out together."""
    return place.title.split(",")[0]


def left_out(known, fitted=fit):
    """For each place: its objects with the chances that the weights of all others give, in two columns with whether
    they are buildings, and the confidences of the program. `known` has rows of a place and the result of seen()."""
    for place, (features, right, now) in known:
        others = [row for row in known if kind(row[0]) != kind(place)]
        if len(right) and others:
            weights = fitted([row[1] for row in others]) if fitted is fit else fitted(others)
            yield {"name": place.title, "now": now, "objects": np.column_stack([chances(features, weights), right])}


def left_out_table(tried):
    rows = []
    for place in tried:
        p, right = place["objects"].T
        rows.append([place["name"], str(len(right)), text(right.mean(), 2), text(agreed(right, place["now"])),
                     text(agreed(right, p)), text(loss(right, place["now"])), text(loss(right, p))])
    return table(["place", "objects", "buildings", "agreed", "agreed, left out", "loss", "loss, left out"], rows)


def is_scene(place):
    return "_" in place.name and place.name == place.title.replace(", ", "_")


def fit_thin(known):
    """The weights for sparse points, as the program has them."""
    weights = fit([row[1] for row in known], [SCENES_HEAVY if is_scene(row[0]) else 1 for row in known])
    weights[-1] -= CAUTION
    return weights


def with_zeros(known, weights):
    """Rows of a name, its weight, and where it says nothing: half way between the means of buildings and of others.
    The constant is the rest."""
    features = np.concatenate([row[1][0] for row in known])
    right = np.concatenate([row[1][1] for row in known]) > 0
    zeros = (features[right].mean(axis=0) + features[~right].mean(axis=0)) / 2
    rows = [[name, text(weight, 2), text(zero, 2)] for name, weight, zero in zip(THIN_NAMES, weights, zeros)]
    rows[-1][1:] = [text(float(weights @ np.append(zeros[:-1], 1)), 2), ""]
    return rows


def learned(build, places, work, more=()):
    """Tables by name, and the places as they were left out.
    :param more: places that only the weights for sparse points are fitted to"""
    objects = [(place, objects_of(build, place, work)) for place in [*places, *more]]
    known = [(place, seen(rows, NAMES)) for place, rows in objects[:len(places)]]
    thin = [(place, seen(rows, THIN_NAMES)) for place, rows in objects if rows and rows[0]["filled"] > THIN]
    tried = list(left_out(known))
    weights = fit([row[1] for row in known])
    found = {"left_out": left_out_table(tried), "weights": table(NAMES, [[text(weight, 2) for weight in weights]])}
    if thin:
        found["thin_left_out"] = left_out_table(list(left_out(thin, fit_thin)))
        found["thin_weights"] = table(["", "weight", "zero at"], with_zeros(thin, fit_thin(thin)))
    return found, tried
