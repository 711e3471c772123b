"""Markdown of the measurements."""
from measure import OURS
from thesis_mode import FOOT

THESIS_HOTEL = {(1, 30): (139, 200, 258, 135.1), (4, 5): (584, 200, 232, 165.2)}
THESIS_SQUARE = {(1, 40): 623, (4, 40): 2642, (4, 10): 4248}


def table(head, lines):
    rule = ["---"] + ["---:"] * (len(head) - 1)
    return "\n".join("| " + " | ".join(line) + " |" for line in [head, rule, *lines]) + "\n"


def number(value):
    return f"{value:,}"


def figures(errors):
    """RMSE, 95th percentile, largest."""
    return [f"{errors[0]:.2f}", f"{errors[1]:.2f}", f"{errors[2]:.1f}"] if errors else ["", "", ""]


def hotel_table(settings, cells):
    lines = [["the building, thesis", number(5950), "176", "200", "185", "", ""],
             ["the building, sample", number(cells), "176", "200", "185", "", ""]]
    for one in settings:
        if (one.lod, one.nf) in THESIS_HOTEL:
            points, *sizes = THESIS_HOTEL[one.lod, one.nf]
            lines.append([f"{one.name}, thesis", number(points), *map(str, sizes), "", ""])
        feet = [f"{value / FOOT:.1f}" for value in (*one.box, one.height)]
        lines.append([f"{one.name}, ours", number(one.surface.count()), *feet, number(one.corners),
                      number(one.lattice_points) if one.lattice_points else ""])
    head = ["", "points", "width, ft", "length, ft", "height, ft", "corners", "lattice points"]
    return table(head, lines)


def settings_table(scene, settings):
    lines = []
    for one in settings:
        errors, truth = scene.errors(one.surface.heights(scene.z.shape, scene.cell))
        thesis = THESIS_SQUARE[one.lod, one.nf]
        lines.append([one.name, number(thesis), number(one.surface.count()), number(one.corners),
                      number(one.lattice_points), *figures(errors), *figures(truth)[:1 if truth else 0],
                      f"{one.seconds:.2f}"])
    head = ["", "thesis, points", "ours, points", "corners", "lattice points", "RMSE, m", "95 %", "largest"]
    return table(head + (["(ii) RMSE"] if scene.truth is not None else []) + ["s"], lines)


def chosen_table(trials):
    lines = [[number(t.budget), t.method.split(", ")[1], f"`{t.options}`", number(t.points), number(t.blocks), number(t.contours),
              f"{t.seconds:.2f}"] for t in trials if t.method in OURS.values()]
    return table(["points", "model", "options", "used", "of the blocks", "corners of the contours", "s"], lines)


def trials_table(trials, budget):
    """A line a method: against the model from the raw model, and against the survey from both."""
    ours = [t for t in trials if t.budget == budget]
    surveyed = any(t.to_truth for t in ours)
    lines = []
    for one in (t for t in ours if t.source == "raw"):
        line = [f"**{one.method}**" if one.method in OURS.values() else one.method, number(one.points), f"{one.seconds:.2f}",
                *figures(one.to_model)]
        if surveyed:
            bare = [t.to_truth for t in ours if t.method == one.method and t.source == "bare"]
            line += figures(one.to_truth) + figures(bare[0] if bare else None)
        lines.append(line)
    head = [f"about {number(budget)}", "points", "s", "(i) RMSE", "95 %", "largest"]
    more = ["(ii) RMSE", "95 %", "largest", "(ii), no canopy: RMSE", "95 %", "largest"] if surveyed else []
    return table(head + more, lines)


def ratio_table(trials):
    """Ours beside the best of the others on (ii)."""
    lines = []
    for ours in (t for t in trials if t.method in OURS.values()):
        line = [number(ours.budget), ours.method.split(", ")[1], f"{ours.to_truth[0]:.2f}"]
        for source in ("raw", "bare"):
            best = min((t for t in trials if t.method not in OURS.values() and t.budget == ours.budget and t.source == source),
                       key=lambda t: t.to_truth[0])
            line += [f"{best.method}, {best.to_truth[0]:.2f}", f"{ours.to_truth[0] / best.to_truth[0]:.2f}"]
        lines.append(line)
    return table(["points", "model", "ours", "best other, raw", "ratio", "best other, no canopy", "ratio"], lines)


def complexity_table(rows):
    lines = [[row.what, number(row.n), number(row.contours), number(row.m), number(row.corners),
              f"{row.seconds * 1e3:.1f}", f"{row.seconds / row.n * 1e9:.0f}"] for row in rows]
    return table(["", "n", "contours", "m", "corners", "ms", "ns a point"], lines)
