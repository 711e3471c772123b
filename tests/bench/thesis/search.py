"""Which options give the least error at a number of points: the survey is not looked at."""
import numpy as np

from blocks import run_tool
from closed import heights_unclosed
from scene import figures

AXES = {
    "-lod": [1, 2, 3, 4, 6],
    "-detail": [0.25, 0.5, 1, 1.5, 2, 4, 6, 8],
    "-nf": [5, 10, 20, 40],
    "-simplify": [0, 0.5, 0.75, 1, 1.25, 1.5, 2, 3, 4, 5, 6, 8],
    "-split_height": [0, 2, 3],
}
COARSEST = {"-lod": 1, "-detail": 8, "-nf": 10, "-simplify": 5, "-split_height": 0}
DEFAULTS = {"-lod": 4, "-detail": 0.5, "-nf": 10, "-simplify": 0, "-split_height": 0}
TERRAIN_POINTS = 500  # beside those at the walls; with more the terrain is not what errs


def words(choice):
    given = ["-surface_of", "contours"]
    for name, value in choice.items():
        if name != "-simplify" or value > 0:  # without it walls are straight
            given += [name, f"{value:g}"]
    return given


class Search:
    """Runs of the program on one scene, each kept, and what they come to at a number of points."""

    def __init__(self, tool, scene):
        self.tool = tool
        self.scene = scene
        whole = run_tool(tool, scene, [])
        self.terrain = whole.terrain
        self.bare = np.where(scene.valid, scene.z - whole.canopy, scene.z)  # without trees, by our own account
        self.runs = {}
        self.errors = {}

    def run(self, choice):
        key = tuple(choice.items())
        if key not in self.runs:
            self.runs[key] = run_tool(self.tool, self.scene, words(choice), rasters=False)
        return self.runs[key]

    def error(self, choice, budget):
        """Against our raster without trees; beyond all errors where the points are too many."""
        skin = self.run(choice).skin
        over = skin.count() + 8 - budget
        if over > 0:
            return 1e6 + over
        key = (*choice.items(), budget)
        if key not in self.errors:
            allowed = min(budget, skin.count() + TERRAIN_POINTS)
            model = heights_unclosed(skin, self.terrain, self.scene.cell, allowed, self.scene.valid)
            self.errors[key] = figures((model - self.bare)[self.scene.valid])[0]
        return self.errors[key]

    def best(self, budget, begins):
        """From the best of some choices: one option after the other, up to two values to either side, as long as
        that helps."""
        choice = dict(min(begins, key=lambda begin: self.error(begin, budget)))
        least = self.error(choice, budget)
        helped = True
        while helped:
            helped = False
            for name, values in AXES.items():
                at = values.index(choice[name])
                for value in values[max(0, at - 2):at + 3]:
                    trial = {**choice, name: value}
                    error = self.error(trial, budget)
                    if error < least:
                        choice, least, helped = trial, error, True
        return choice


def smaller_first(search, budgets):
    """The best of each budget; that of the next smaller one is tried first."""
    found = {}
    for budget in sorted(budgets):
        found[budget] = search.best(budget, [COARSEST, DEFAULTS, *found.values()])
    return found
