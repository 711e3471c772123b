#!/usr/bin/python3
"""Measures accuracy: on scenes whose truth is exact, and on real places where there are some.

    tests/accuracy/run.py [--build build] [--work FOLDER] [--seed N] [--cities FOLDER] [--plot FILE.png]
                          [--failures FILE.png] [--learn] [--write PAGE.md ...] [--least-iou X] [SCENE...]

Makes the scenes (all that are measured, or those that are named), finds buildings with the defaults, and prints
tables: areas, objects, walls, places without buildings, and how often a confidence is right.
--cities   a folder with a folder a place: dsm.tif, reference_buildings.gpkg, perhaps dtm.tif and NOTE.md; those of fine
           cells are measured as scans of 2 and 2.5 m cells show them as well
--write    puts the tables into pages, between the lines `<!-- table NAME -->` and `<!-- end -->`
--plot     draws how often a confidence is right (needs python3-matplotlib)
--failures draws of each real place, and of the scenes with the lowest IoU, where most goes wrong (matplotlib as well)
--learn    fits the weights of the judge to the real places and to scenes of another seed, and tries them on each
           place with that place left out; those for sparse points to all places and scenes as thin scans show them
--least-iou  fails where the mean IoU of the scenes is less
Needs python3-gdal and python3-scipy.
"""
import argparse
import json
import os
import sys
import tempfile

import confidence
import failures
import learning
import pooled
import tables
import thinning
import walls
from places import Place, scene, title_of
from programs import output_of

PLACES = ("village", "hamlet", "pines", "hillside", "rows", "outskirts", "park", "town", "forest", "fields")
THIN = [f"{place}_{survey}" for place in PLACES for survey in thinning.SCANS]


def find(tools, place, out, *options):
    """Finds the buildings of a place with the defaults."""
    output_of(os.path.join(tools, "dem2buildings"), "-q", "-overwrite", "-write_doubtful", *options, place.dsm, out)


def score(tools, place, out):
    return json.loads(output_of(os.path.join(tools, "dem2buildings_score"), "-json", "-dem", place.dsm, out,
                                place.reference))


def measure(tools, place, work):
    """All figures of a place, by name."""
    out = os.path.join(work, place.name + ".gpkg")
    find(tools, place, out)
    figures = score(tools, place, out)
    figures["name"] = place.title
    figures["place"] = place.name
    figures["drawn"] = (place, out, figures["iou"])
    figures["cell"] = place.cell()
    figures["km2"] = place.km2()
    figures["built"] = figures["reference"]["features"] > 0
    figures["walls"] = walls.distances(out, place)
    figures["objects"] = confidence.judged(out, place)
    if figures["built"] and os.path.exists(place.dtm):
        given = os.path.join(work, place.name + "_ground.gpkg")
        find(tools, place, given, "-ground", place.dtm)
        figures["iou_ground"] = score(tools, place, given)["iou"]
    print(f"{place.name}: IoU {figures['iou']:.3f}", file=sys.stderr)
    return figures


def make_scenes(build, work, seed, names):
    made = output_of(os.path.join(build, "sample_dems", "d2b_make_scenes"), "-seed", str(seed), work, *names)
    return [scene(work, name) for name in made.split()]


def cities(folder):
    return [Place(name, title_of(os.path.join(folder, name)), os.path.join(folder, name))
            for name in sorted(os.listdir(folder))
            if all(os.path.exists(os.path.join(folder, name, file))
                   for file in ("dsm.tif", "reference_buildings.gpkg"))]


def learn(arguments, work):
    """Tables of weights that are fitted to scenes of another seed and to the real places, and the real places as they
    were left out."""
    with tempfile.TemporaryDirectory(dir=work) as folder:
        others = make_scenes(arguments.build, folder, arguments.seed + 100, arguments.scenes)
        real = cities(arguments.cities) if arguments.cities else []
        more = thinning.thinned_places(real, folder)
        if not arguments.scenes:
            made = {place.name for place in others}
            more += make_scenes(arguments.build, folder, arguments.seed + 100, [name for name in THIN if name not in made])
        found, tried = learning.learned(arguments.build, real + others, folder, more)
        titles = [place.title for place in real]
        return found, [place for place in tried if place["name"] in titles]


def measure_all(arguments, work):
    """The figures of scenes, of real places, and of these as scans of coarse cells show them, and the result of learn()."""
    tools = os.path.join(arguments.build, "tools")
    made = make_scenes(arguments.build, work, arguments.seed, arguments.scenes)
    real = cities(arguments.cities) if arguments.cities else []
    with tempfile.TemporaryDirectory(dir=work) as folder:
        copies = thinning.thinned_places(real, folder, [*thinning.DENSE, *thinning.SCANS])
        coarse = [measure(tools, place, folder) for place in copies]
    return ([measure(tools, place, work) for place in made], [measure(tools, place, work) for place in real], coarse,
            *(learn(arguments, work) if arguments.learn else ({}, [])))


def drawn(real, made):
    """Pictures of --failures: all real places, then as many scenes as fill the last row."""
    worst = sorted((figures for figures in made if figures["built"]), key=lambda figures: figures["iou"])
    scenes = worst[:-len(real) % failures.ACROSS or failures.ACROSS]
    return [figures["drawn"] for figures in real + scenes]


def main(words):
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("--build", default="build")
    parser.add_argument("--work")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--cities")
    parser.add_argument("--plot")
    parser.add_argument("--failures")
    parser.add_argument("--learn", action="store_true")
    parser.add_argument("--write", nargs="+", default=[])
    parser.add_argument("--least-iou", type=float, default=0)
    parser.add_argument("scenes", nargs="*")
    arguments = parser.parse_args(words)
    if arguments.cities and not os.path.isdir(arguments.cities):
        sys.exit(f"There is no folder {arguments.cities}; --cities needs one with a folder a place.")
    with tempfile.TemporaryDirectory() as scratch:
        if arguments.work:
            os.makedirs(arguments.work, exist_ok=True)
        made, real, coarse, more, tried = measure_all(arguments, arguments.work or scratch)
        shown = drawn(real, made) if arguments.failures else []
        if shown:
            failures.plot(arguments.failures, shown)
    found = tables.all_tables(made, real, coarse) | more
    if real:
        found |= {"pooled": pooled.pooled_table(real), "pooled_confidence": pooled.pooled_confidence_table(real)}
    for name, lines in found.items():
        print(f"\n{name}\n", *lines, sep="\n")
    if arguments.plot:
        confidence.plot(arguments.plot, {"real places": real, "each left out, weights of all others": tried,
                                          "scenes": made})
    for page in arguments.write:
        tables.put_into(page, found)
    mean = tables.mean([figures["iou"] for figures in made if figures["built"]])
    if arguments.least_iou and (mean is None or mean < arguments.least_iou):
        sys.exit(f"The mean IoU of the scenes is {mean}, not {arguments.least_iou} or more.")


if __name__ == "__main__":
    main(sys.argv[1:])
