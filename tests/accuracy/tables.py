"""Tables of figures, as lines of Markdown."""
import re

import numpy as np

from confidence import BINS, by_bin


def mean(values):
    known = [value for value in values if value is not None]
    return sum(known) / len(known) if known else None


def text(value, digits=3):
    return "-" if value is None else f"{value:.{digits}f}"


def table(head, rows):
    return ["| " + " | ".join(head) + " |", "|" + "---|" * len(head),
            *("| " + " | ".join(row) + " |" for row in rows)]


COLUMNS = [("IoU", lambda f: f["iou"]), ("IoU, ground given", lambda f: f.get("iou_ground")),
           ("objects found", lambda f: f["object_completeness"]),
           ("objects right", lambda f: f["object_correctness"]),
           ("outline RMS, m", lambda f: f["outline_rms_m"]),
           ("walls off, cells", lambda f: f["walls"] and f["walls"]["mean"]),
           ("median", lambda f: f["walls"] and f["walls"]["median"]),
           ("outward, cells", lambda f: f["walls"] and f["walls"]["signed"]),
           ("vertices", lambda f: f["vertex_ratio"])]


def figures_table(measured):
    rows = [[f["name"], f"{f['cell'][1]:.2g} m", *(text(get(f)) for _, get in COLUMNS)] for f in measured]
    means = ["**mean**", "", *(f"**{text(mean([get(f) for f in measured]))}**" for _, get in COLUMNS)]
    return table(["place", "cells", *(name for name, _ in COLUMNS)], [*rows, means])


def empty_table(measured):
    rows = [[f["name"], f"{f['cell'][1]:.2g} m", text(f["km2"], 2), str(f["found"]["objects"]),
             text(f["found"]["objects"] / f["km2"], 2)] for f in measured]
    return table(["place", "cells", "km²", "found above 50 m²", "a km²"], rows)


def confidence_table(measured):
    head = ["place", *(f"{low:.1f} to {high:.1f}" for low, high in zip(BINS[:-1], BINS[1:]))]
    everything = np.concatenate([f["objects"] for f in measured])
    rows = []
    for name, objects in [*((f["name"], f["objects"]) for f in measured), ("**all**", everything)]:
        rows.append([name, *(f"{text(right, 2)} of {count}" if count else "-"
                             for count, _, right in by_bin(objects))])
    return table(head, rows)


def coarse_table(measured):
    """Means over the places that a scan shows."""
    scans = dict.fromkeys(f["name"].split(", ")[-1] for f in measured)
    rows = []
    for scan in scans:
        some = [f for f in measured if f["name"].endswith(", " + scan)]
        rows.append([scan, f"{some[0]['cell'][1]:.2g} m", *(text(mean([get(f) for f in some])) for _, get in COLUMNS[:5])])
    return table(["scan", "cells", *(name for name, _ in COLUMNS[:5])], rows)


def all_tables(made, real, coarse=()):
    """Lines by the name of the table."""
    found = {"scenes": figures_table([f for f in made if f["built"]])} if any(f["built"] for f in made) else {}
    if any(not f["built"] for f in made):
        found["empty"] = empty_table([f for f in made if not f["built"]])
    if made:
        found["scenes_confidence"] = confidence_table(made)
    if real:
        found["places"] = figures_table(real)
        found["places_confidence"] = confidence_table(real)
    if coarse:
        found["coarse"] = coarse_table(coarse)
    return found


def put_into(page, found):
    """Replaces the text between `<!-- table NAME -->` and `<!-- end -->`."""
    with open(page, encoding="utf-8") as file:
        content = file.read()
    for name, lines in found.items():
        content = re.sub(f"(<!-- table {name} -->\n).*?(<!-- end -->)",
                         lambda match, lines=lines: match[1] + "\n" + "\n".join(lines) + "\n\n" + match[2], content,
                         flags=re.DOTALL)
    with open(page, "w", encoding="utf-8") as file:
        file.write(content)
