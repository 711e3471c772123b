#!/usr/bin/python3
"""The thesis's tables and figures again, beside the methods that it compared itself with: the figures of
docs/research/thesis_tables.md.

The errors of each method are those of docs/research/thesis_methods.md.

    xvfb-run -a tests/bench/thesis/run.py --cities <folder> build

Prints tables in Markdown; pictures and results.json go to <build>/thesis. Without --cities, a folder that has
stuttgart_csite2/dsm.tif, delft/{dsm,dtm,class6_mask}.tif, and dsm.tif, dtm.tif and reference_buildings.gpkg in
montpellier_als and seville, only the parts that need none. Needs python3-gdal, python3-numpy, python3-scipy and
python3-vtk9; pictures an X server, which xvfb-run of Debian's xvfb starts.
"""
import argparse
import json
import os
import sys
import tempfile
from pathlib import Path

import complexity
import tables
from measure import BUDGETS, OURS, our_trials, rival_trials
from rivals import full_surface
from scene import gdal, open_scene
from search import Search
from thesis_mode import metric, run_natural, run_setting

SAMPLES = Path(__file__).resolve().parents[3] / "sample_dems"
PARTS = ("hotel", "square", "delft", "montpellier", "seville", "complexity")


def say(text):
    print(text, file=sys.stderr, flush=True)


class Bench:
    """The request, and its measurements."""

    def __init__(self, tool, cities, out, budgets, pictures):
        self.tool = tool
        self.cities = cities
        self.out = out
        self.budgets = budgets
        self.pictures = pictures
        self.results = {}

    def draw(self, name, panels, columns, size, closer=1.0):
        if self.pictures:
            from pictures import draw
            draw(self.out / f"thesis_{name}.png", panels, columns, size, closer)

    def keep(self, part, trials):
        self.results[part] = [{key: value for key, value in vars(one).items() if key != "surface"} for one in trials]


def hotel_settings(tool, scene):
    """The thesis's two cases, and the defaults."""
    return [*(run_setting(tool, scene, lod, nf) for lod, nf in tables.THESIS_HOTEL), run_natural(tool, scene)]


def hotel(bench):
    with tempfile.TemporaryDirectory() as folder:
        scene = open_scene("hotel", metric(SAMPLES / "hotel_70x85.tif", folder))
        settings = hotel_settings(bench.tool, scene)
    print("Table 5.1, the hotel\n")
    print(tables.hotel_table(settings, scene.z.size))
    panels = [("70 x 85 points", full_surface(scene))]
    panels += [(f"{one.name}: {one.surface.count():,} points", one.surface) for one in settings]
    bench.draw("hotel", panels, 4, (300, 280), 0.8)


def square(bench):
    with tempfile.TemporaryDirectory() as folder:
        window = Path(folder) / "square.tif"
        gdal.Translate(str(window), str(bench.cities / "stuttgart_csite2/dsm.tif"), srcWin=[60, 150, 242, 249])
        approximate(bench, open_scene("square", window))


def delft(bench):
    folder = bench.cities / "delft"
    approximate(bench, open_scene("delft", folder / "dsm.tif", folder / "dtm.tif", folder / "class6_mask.tif"))


def surveyed(name, folder):
    """A place whose terrain and buildings a survey knows. @return the function that measures it"""
    def measure(bench):
        place = bench.cities / folder
        approximate(bench, open_scene(name, place / "dsm.tif", place / "dtm.tif", place / "reference_buildings.gpkg"))
    return measure


def approximate(bench, scene):
    """The thesis's settings, then every method at every number of points."""
    settings = [run_setting(bench.tool, scene, lod, nf) for lod, nf in tables.THESIS_SQUARE]
    print(f"Table 5.2, {scene.name}: {scene.z.size:,} points, the thesis's settings\n")
    print(tables.settings_table(scene, settings))
    searches = [Search(bench.tool, scene, model) for model in OURS]
    trials = [one for search in searches for one in our_trials(search, bench.budgets, say)]
    print(f"{scene.name}, options found\n")
    print(tables.chosen_table(trials))
    trials += rival_trials(searches[0], bench.budgets, say)
    bench.keep(scene.name, trials)
    for budget in bench.budgets:
        print(tables.trials_table(trials, budget))
    if scene.truth is not None:
        print("(ii), ours beside the best of the others\n")
        print(tables.ratio_table(trials))
    draw_scene(bench, scene, settings, trials)


def draw_scene(bench, scene, settings, trials):
    original = (f"{scene.z.size:,} points", full_surface(scene))
    bench.draw(f"{scene.name}_settings", [original] + [
        (f"{one.name}: {one.surface.count():,} points", one.surface) for one in settings], 2, (480, 330), 1.15)
    ours = [(f"{one.method.removeprefix('dem2buildings, ')}: {one.points:,} points", one.surface) for one in trials if one.method in OURS.values()]
    bench.draw(f"{scene.name}_ours", ours, 2, (480, 330), 1.15)
    budget = sorted(bench.budgets)[len(bench.budgets) // 2 - 1]
    shown = [one for one in trials if one.budget == budget and one.source == "raw"]
    bench.draw(f"{scene.name}_methods", [original] + [
        (f"{one.method}: {one.points:,} points", one.surface) for one in shown], 2, (440, 285), 1.15)


def complexity_part(bench):
    town, tiny = SAMPLES / "town.tif", SAMPLES / "thesis_11x7.tif"
    print("Time over n, -lod 4 -nf 10\n")
    print(tables.complexity_table(complexity.over_n(bench.tool, town, tiny)))
    print("Time over m\n")
    print(tables.complexity_table(complexity.over_m(bench.tool, town, tiny)))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=Path, help="build folder with tools/dem2buildings")
    parser.add_argument("--cities", type=Path, help="folder of the cities")
    parser.add_argument("--parts", default=",".join(PARTS), help="default: %(default)s")
    given = parser.parse_args()
    tool = (given.build / "tools/dem2buildings").resolve()
    if not tool.exists():
        sys.exit(f"There is no {tool}; build it first.")
    parts = given.parts.split(",")
    if unknown := set(parts) - set(PARTS):
        parser.error(f"no such part: {', '.join(sorted(unknown))}")
    out = given.build / "thesis"
    out.mkdir(exist_ok=True)
    pictures = bool(os.environ.get("DISPLAY"))
    if not pictures:
        say("There is no X server, so no pictures are drawn; start this with xvfb-run -a.")
    bench = Bench(tool, given.cities, out, BUDGETS, pictures)
    does = {"hotel": hotel, "square": square, "delft": delft, "montpellier": surveyed("montpellier", "montpellier_als"),
            "seville": surveyed("seville", "seville"), "complexity": complexity_part}
    for part in parts:
        if part not in ("hotel", "complexity") and not (given.cities and given.cities.is_dir()):
            say(f"{part} is left out: it needs --cities.")
            continue
        does[part](bench)
        (out / "results.json").write_text(json.dumps(bench.results, indent=1), encoding="utf-8")


if __name__ == "__main__":
    main()
