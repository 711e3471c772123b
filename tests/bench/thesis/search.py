"""Which options give the least error at a number of points: the survey is not looked at."""
import numpy as np

from blocks import run_tool
from closed import heights_unclosed
from scene import figures

STRAIGHT = [("-flow_ready", length) for length in (0, 1, 2, 3, 5, 8, 12, 20)]
SIMPLIFIED = [("-simplify", tolerance) for tolerance in (0.5, 0.75, 1, 1.25, 1.5, 2, 3, 4, 5, 6, 8)]
# Kinds by the value of -surface_of: stacks of tiers, and slanted roofs, which -flow_ready does not take.
KINDS = {"contours": (STRAIGHT, SIMPLIFIED), "roofs": ([STRAIGHT[0], *SIMPLIFIED],)}
WALLS = {"walls": None}  # values of one kind: it stays
SMALLEST = {"-min_area": [10, 30, 50, 80], "-min_height": [1.5, 2, 3]}
AXES = {
    "contours": {
        "-lod": [1, 2, 3, 4, 6],
        "-detail": [0.25, 0.5, 1, 1.5, 2, 3, 4, 6, 8],
        "-nf": [5, 10, 20, 40],
        **WALLS,
        "-split_height": [0, 1.5, 2, 3, 4],
        **SMALLEST,
    },
    "roofs": {
        "-detail": [0.25, 0.5, 1, 1.5, 2, 3, 4, 6, 8],
        "-roof_min_area": [4, 8, 15, 30, 60],
        **WALLS,
        **SMALLEST,
    },
}
LEVELS = {
    "contours": [{"-lod": 1, "-detail": 6, "-nf": 10, "-split_height": 4, "-min_area": 50, "-min_height": 3},
                 {"-lod": 3, "-detail": 2, "-nf": 20, "-split_height": 1.5, "-min_area": 50, "-min_height": 2},
                 {"-lod": 4, "-detail": 0.5, "-nf": 10, "-split_height": 1.5, "-min_area": 30, "-min_height": 2}],
    "roofs": [{"-detail": 6, "-roof_min_area": 60, "-min_area": 50, "-min_height": 3},
              {"-detail": 2, "-roof_min_area": 15, "-min_area": 50, "-min_height": 2},
              {"-detail": 0.5, "-roof_min_area": 4, "-min_area": 30, "-min_height": 2}],
}
BEGINS = {model: [{**level, "walls": walls} for level in levels for kind in KINDS[model] for walls in kind[::3]]
          for model, levels in LEVELS.items()}
TERRAIN_POINTS = 500  # beside those at the walls; with more the terrain hardly errs


def words(choice):
    given = []
    for name, value in choice.items():
        name, value = value if name == "walls" else (name, value)
        if name != "-flow_ready" or value > 0:
            given += [name, f"{value:g}"]
    return given


def beside(choice, name, values, reach):
    """The choice with other values of one option, at most so many places up or down."""
    at = values.index(choice[name])
    return [{**choice, name: value} for value in values[max(0, at - reach):at + reach + 1] if value != choice[name]]


class Search:
    """Runs of the program on one scene, each kept, and their errors at a number of points."""

    def __init__(self, tool, scene, model):
        """@param model: value of -surface_of"""
        self.tool = tool
        self.scene = scene
        self.model = model
        whole = run_tool(tool, scene, [])
        self.terrain = whole.terrain
        self.bare = np.where(scene.valid, scene.z - whole.canopy, scene.z)  # without trees, by our own account
        self.runs = {}
        self.errors = {}

    def run(self, choice):
        key = tuple(choice.items())
        if key not in self.runs:
            self.runs[key] = run_tool(self.tool, self.scene, ["-surface_of", self.model, *words(choice)], rasters=False)
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
        """The best that is found from the best beginning of each kind of walls."""
        found = []
        for kind in KINDS[self.model]:
            of_kind = [begin for begin in begins if begin["walls"] in kind]
            found.append(self.descend(budget, min(of_kind, key=lambda begin: self.error(begin, budget))))
        return min(found, key=lambda choice: self.error(choice, budget))

    def descend(self, budget, choice):
        """One option after the other, up to two values to either side, as long as that helps."""
        while True:
            before = choice
            for name, values in AXES[self.model].items():
                values = values or next(kind for kind in KINDS[self.model] if choice["walls"] in kind)
                choice = min([choice, *beside(choice, name, values, 2)], key=lambda trial: self.error(trial, budget))
            if choice == before:
                return choice


def smaller_first(search, budgets):
    """The best of each budget; that of the next smaller one is tried first."""
    found = {}
    for budget in sorted(budgets):
        found[budget] = search.best(budget, [*BEGINS[search.model], *found.values()])
    return found
