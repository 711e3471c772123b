"""Counts of real places taken together, by the size of their cells and the points of their scans."""
import numpy as np

from confidence import BINS, by_bin
from tables import table

# The folders of places by the points that their scans have per cell, in the order of the rows. The rasters alone do not
# tell, because those who made them have filled gaps.
POINTS = {"two and more": ("annarbor", "delft", "montpellier_als", "seville", "stbarth"),
          "one to two": ("adelaide_fusa", "bergama", "dallas", "larochelle_2m5", "pacasam_agde"),
          "many, smeared": ("huntington_va_2m",),
          "unknown, heights in whole metres": ("bilbao",)}
REPEATED = ("adelaide_fusa_1m",)  # the scan of another place, on larger cells
FINE_M = 1  # cells up to this size are taken together
WORDS = "no one two three four five six seven eight nine ten eleven twelve".split()


def independent(measured):
    return [figures for figures in measured if figures["place"] not in REPEATED]


def points_of(figures):
    """The row of POINTS, and its words."""
    rows = enumerate(POINTS.items())
    return next(((index, words) for index, (words, folders) in rows if figures["place"] in folders), (len(POINTS), "unknown"))


def places(number):
    return (WORDS[number] if number < len(WORDS) else str(number)) + (" place" if number == 1 else " places")


def span(values, form, unit):
    """The lowest and the highest of values, or one number if both are written alike."""
    known = [value for value in values if value is not None]
    ends = dict.fromkeys(form.format(value) for value in (min(known), max(known))) if known else ["-"]
    return " to ".join(ends) + (f" {unit}" if known else "")


def covered(some, side):
    """How many objects of one side, `reference` or `found`, have at least half of their area in the other."""
    counts = [sum(figures[side][name] for figures in some) for name in ("objects_covered", "objects")]
    return "{:,} of {:,} ".format(*counts) + f"({100 * counts[0] / counts[1]:.0f} %)" if counts[1] else "-"


def figures_of(some):
    return [covered(some, "reference"), covered(some, "found"), span([100 * f["iou"] for f in some], "{:.0f}", "%"),
            span([f["outline_rms_m"] for f in some], "{:.1f}", "m")]


def pooled_table(measured):
    """One row per size of cells and density of points, and one for all."""
    some = independent(measured)
    groups = {}
    for figures in some:
        groups.setdefault((max(round(figures["cell"][1], 1), FINE_M), points_of(figures)), []).append(figures)
    rows = []
    for (_, (_, points)), group in sorted(groups.items()):
        name = group[0]["name"] if len(group) == 1 else places(len(group))
        rows.append([span([f["cell"][1] for f in group], "{:.2g}", "m") + f" ({name})", points, *figures_of(group)])
    rows.append([f"**all** ({places(len(some))})", "", *(f"**{figure}**" for figure in figures_of(some))])
    return table(["cells", "points per cell", "buildings found", "polygons that are buildings", "shared area", "walls off"],
                 rows)


def pooled_confidence_table(measured):
    """How many of all objects are buildings, by their confidence."""
    bins = by_bin(np.concatenate([figures["objects"] for figures in independent(measured)]))
    rows = [[f"{low:.1f} to {high:.1f}", f"{100 * right:.0f} % of {count:,}" if count else "-"]
            for low, high, (count, _, right) in zip(BINS[:-1], BINS[1:], bins)]
    return table(["confidence", "objects that are buildings"], rows)
