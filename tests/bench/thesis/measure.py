"""Every method at every number of points, on one scene."""
from dataclasses import dataclass
from time import process_time

from closed import close
from rivals import METHODS
from search import smaller_first, words

OURS = {"contours": "dem2buildings, tiers", "roofs": "dem2buildings, roofs"}  # by the value of -surface_of
BUDGETS = (623, 2642, 4248, 25621)  # of table 5.2


@dataclass
class Trial:
    """One surface and its errors: RMSE, 95th percentile and largest distance in m."""
    method: str
    budget: int
    source: str  # raw: the surface model; bare: the same without the canopy that ours found
    points: int
    seconds: float  # of a processor, which other work on the machine disturbs least
    to_model: tuple
    to_truth: tuple
    surface: object


def trial(method, budget, source, scene, make):
    start = process_time()
    surface = make()
    seconds = process_time() - start
    first, second = scene.errors(surface.heights(scene.z.shape, scene.cell))
    return Trial(method, budget, source, surface.count(), seconds, first, second, surface)


def our_trials(search, budgets, say):
    """Ours, with the options that the search chose."""
    scene, found, choices = search.scene, [], smaller_first(search, budgets)
    for budget, choice in choices.items():
        run = search.run(choice)
        ours = trial(OURS[search.model], budget, "raw", scene, lambda: close(run.skin, search.terrain, scene.cell, budget, scene.valid)[0])
        ours.seconds += run.seconds
        ours.options = " ".join(words(choice))
        ours.blocks = run.skin.count()
        ours.contours = run.report["output"]["vertices"]
        if ours.surface.open_edges():
            raise RuntimeError(f"The surface with {ours.options} is not closed.")
        say(f"{scene.name}, {ours.method}, {budget}: {ours.options}, {ours.points} points, RMSE {ours.to_model[0]:.2f} m")
        found.append(ours)
    return found


def rival_trials(search, budgets, say):
    scene, found = search.scene, []
    sources = {"raw": scene.z} if scene.truth is None else {"raw": scene.z, "bare": search.bare}
    for budget in budgets:
        for method, make in METHODS.items():
            for source, z in sources.items():
                found.append(trial(method, budget, source, scene, lambda: make(z, scene.cell, budget)))
                say(f"{scene.name}, {budget}, {source}: {method}, {found[-1].points} points, "
                    f"RMSE {found[-1].to_model[0]:.2f} m")
    return found
