#!/usr/bin/python3
"""Measures how well changes are found between two surveys of scenes whose truth is exact.

    tests/accuracy/changes.py [--build build] [--work FOLDER] [--seed N ...] [--results] [--least X] [PAIR...]

Makes each scene before and after changes, finds the changes with the defaults, and prints precision and recall of
new, gone, raised and lowered. A pair is <place>_<survey>+<later survey>@<east>,<north>: the second survey may be of
another kind, and its raster displaced by metres. Without names those of 1 m are measured.
--results finds the buildings of both surveys first, and compares these without the rasters
--least   fails where a precision or recall over all pairs is less
A change is right where a building of the truth with that change shares half of the smaller of both. The town
against itself is compared as well, and must be the same throughout.
Needs python3-gdal.
"""
import argparse
import json
import os
import re
import sys
import tempfile
from collections import Counter

from osgeo import ogr

from programs import output_of

ogr.UseExceptions()

KINDS = ("new", "gone", "raised", "lowered")
PAIRS = ("estate_lidar2+lidar2@1.6,-0.9", "village_lidar2+lidar2@0,0", "hamlet_lidar2+lidar2@-2,2",
         "hillside_lidar2+lidar2@0.5,0.5", "outskirts_lidar2+lidar2@-1.3,0.7", "town_lidar2+lidar2@1.2,1.8",
         "rows_lidar2+lidar2@0,-1")
TOWN = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "sample_dems", "town.tif")


def changes_of(path, east=0.0, north=0.0):
    """Pairs of a change and a polygon; those that the new survey shows are displaced back."""
    dataset = ogr.Open(path)
    found = []
    for feature in dataset.GetLayerByName("changes"):
        geometry = feature.GetGeometryRef().Clone()
        change = feature.GetField("change")
        if change != "gone":
            geometry = displaced(geometry, -east, -north)
        found.append((change, geometry))
    return found


def displaced(geometry, east, north):
    if geometry.GetGeometryCount() > 0:
        for i in range(geometry.GetGeometryCount()):
            displaced(geometry.GetGeometryRef(i), east, north)
    else:
        for i in range(geometry.GetPointCount()):
            x, y = geometry.GetPoint_2D(i)
            geometry.SetPoint_2D(i, x + east, y + north)
    return geometry


def shares_half(one, other):
    if not one.Intersects(other):
        return False
    return one.Intersection(other).Area() >= 0.5 * min(one.Area(), other.Area())


def count(found, truth):
    """Numbers of changes by kind: true, found of these, reported, right of these."""
    counts = {kind: Counter() for kind in KINDS}
    for kind in KINDS:
        of_truth = [geometry for change, geometry in truth if change == kind]
        reported = [geometry for change, geometry in found if change == kind]
        counts[kind]["true"] = len(of_truth)
        counts[kind]["found"] = sum(any(shares_half(one, other) for other in reported) for one in of_truth)
        counts[kind]["reported"] = len(reported)
        counts[kind]["right"] = sum(any(shares_half(one, other) for other in of_truth) for one in reported)
    return counts


def share(part, whole):
    return part / whole if whole else 1.0


def rows(title, counts):
    for kind in KINDS:
        c = counts[kind]
        yield (f"| {title} | {kind} | {c['true']} | {c['reported']} | {share(c['right'], c['reported']):.3f} | "
               f"{share(c['found'], c['true']):.3f} |")


def result_of(build, dsm):
    result = dsm.replace(".tif", ".gpkg")
    output_of(os.path.join(build, "tools", "dem2buildings"), "-q", "-overwrite", dsm, result)
    return result


def measure(arguments, pair, seed, work):
    match = re.fullmatch(r"(\w+_\w+)\+(\w+)@([-.\d]+),([-.\d]+)", pair)
    if not match:
        sys.exit(f"{pair} is no pair; give <place>_<survey>+<later survey>@<east>,<north>.")
    name, later, east, north = match.groups()
    folder = os.path.join(work, f"{seed}_{pair}")
    os.makedirs(folder, exist_ok=True)
    output_of(os.path.join(arguments.build, "sample_dems", "d2b_make_scenes"), "-seed", str(seed), "-later", later,
              "-east", east, "-north", north, folder, name)
    place = os.path.join(folder, name)
    out = os.path.join(place, "found.gpkg")
    surveys = [os.path.join(place, f"{moment}.tif") for moment in ("old", "new")]
    if arguments.results:
        surveys = [result_of(arguments.build, dsm) for dsm in surveys]
    told = json.loads(output_of(os.path.join(arguments.build, "tools", "dem2buildings_compare"), "-json", "-overwrite",
                                *surveys, out))
    print(f"{pair}, seed {seed}: shift {told['shift']['east_m']:.2f}, {told['shift']['north_m']:.2f}", file=sys.stderr)
    return count(changes_of(out, float(east), float(north)), changes_of(os.path.join(place, "changes.gpkg")))


def same_town(build):
    told = json.loads(output_of(os.path.join(build, "tools", "dem2buildings_compare"), "-json", TOWN, TOWN))
    return {kind: n for kind, n in told["changes"].items() if n} == {"same": told["new"]["buildings"]}


def main(words):
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("--build", default="build")
    parser.add_argument("--work")
    parser.add_argument("--seed", type=int, nargs="+", default=[1, 2, 3])
    parser.add_argument("--results", action="store_true")
    parser.add_argument("--least", type=float, default=0)
    parser.add_argument("pairs", nargs="*", default=PAIRS)
    arguments = parser.parse_args(words)
    total = {kind: Counter() for kind in KINDS}
    print("| scene | change | true | reported | precision | recall |\n|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as scratch:
        for pair in arguments.pairs:
            of_pair = {kind: Counter() for kind in KINDS}
            for seed in arguments.seed:
                for kind, counts in measure(arguments, pair, seed, arguments.work or scratch).items():
                    of_pair[kind] += counts
                    total[kind] += counts
            print(*rows(pair, of_pair), sep="\n")
    print(*rows("all", total), sep="\n")
    if not same_town(arguments.build):
        sys.exit("The town is not the same as itself.")
    print("town against itself: all same")
    worst = min(min(share(c["right"], c["reported"]), share(c["found"], c["true"])) for c in total.values())
    if worst < arguments.least:
        sys.exit(f"The lowest precision or recall is {worst:.3f}, not {arguments.least} or more.")


if __name__ == "__main__":
    main(sys.argv[1:])
