"""Markdown and JSON of the measurements."""
import os
import platform
import subprocess
from pathlib import Path

import timeline
from rows import processor_ratio

STAGES = ["read", "ground", "detect", "levels", "trace", "filter", "outline", "attributes", "surface", "write"]


def table(head, lines):
    rule = ["---"] + ["---:"] * (len(head) - 1)
    return "\n".join("| " + " | ".join(line) + " |" for line in [head, rule, *lines]) + "\n"


def row_line(row):
    beside = f"{row.beside_seconds():.3g}" if row.beside else ""
    processor = f"{processor_ratio(row):.2f}" if row.beside and not row.at_least else ""
    sign = ">=" if row.at_least else "<="
    goal = "" if row.asked is None else f"{sign} {row.asked}"
    met = {None: "", True: "yes", False: "**no**"}[row.met()]
    return [row.what, f"{row.ours.median():.3g}", beside, processor, f"{row.ours.peak():.0f}",
            f"{row.figure(row):.2f}{row.unit}", goal, met]


def asked_table(rows):
    head = ["ours : other", "ours, s", "other, s", "by processor time", "ours, MiB", "ratio", "goal", "met"]
    return table(head, [row_line(row) for row in rows])


def command_text(contender):
    """Text of a command without the folders of one machine."""
    return " ".join(Path(word).name if "/" in str(word) else str(word) for word in contender.command)


def contender_table(contenders):
    head = ["command", "name", "median, s", "least", "most", "runs", "processor, s", "MiB"]
    return table(head, [[f"`{command_text(c)}`", c.name, f"{c.median():.3g}", f"{min(c.seconds):.3g}",
                         f"{max(c.seconds):.3g}", str(len(c.seconds)), f"{c.median_processor():.3g}",
                         f"{c.peak():.0f}"] for c in contenders])


def stage_table(contenders):
    """Time of each stage, by the tool's own report: seconds of all threads together."""
    ours = [c for c in contenders if c.reports]
    lines = [[c.name, *(f"{c.stage(stage):.3f}" for stage in STAGES)] for c in ours]
    return table(["seconds", *STAGES], lines)


def busy_table(reports):
    """How busy the cities are: the thesis preset's contours per million points."""
    lines = []
    for (preset, size), report in reports.items():
        million = report["input"]["valid_points"] / 1e6
        if preset == "thesis":
            lines.append([str(size), f"{report['output']['contours'] / million:.0f}",
                          f"{report['output']['vertices'] / million:.0f}"])
    return table(["city", "contours per million points", "vertices per million points"], lines)


def timeline_table(runs):
    """The share of a run with one thread at work: measured on two, by Amdahl's law on more."""
    lines = []
    for name, (whole, spans) in runs.items():
        seconds = timeline.seconds_by_threads(spans, whole)
        on = {threads: timeline.by_amdahl(seconds, threads) for threads in (1, 4, 8, 16)}
        lines.append([name, f"{whole / 1e6:.2f}", f"{seconds.get(1, 0):.2f}", f"{seconds.get(1, 0) * 1e6 / whole:.0%}",
                      *(f"{on[n][1]:.0%}, {on[1][0] / on[n][0]:.1f} times" for n in (4, 8, 16))])
    return table(["two threads", "seconds", "of one thread", "share", "on 4", "on 8", "on 16"], lines)


def alone_table(name, gaps):
    lines = [[f"{begin:.2f}", f"{seconds:.3f}", after] for begin, seconds, after in gaps]
    return table([f"{name}: one thread from second", "for seconds", "after"], lines)


def machine():
    text = Path("/proc/cpuinfo").read_text(encoding="utf-8") if Path("/proc/cpuinfo").exists() else ""
    models = [line.split(":")[1].strip() for line in text.splitlines() if line.startswith("model name")]
    gdal = subprocess.run(["gdalinfo", "--version"], capture_output=True, text=True, check=True).stdout.strip()
    return {"processor": models[0] if models else platform.processor(), "cores": os.cpu_count(), "gdal": gdal,
            "system": platform.platform(), "load": os.getloadavg()}


def as_json(contenders, reports):
    return {"machine": machine(),
            "results": {f"{preset} {size}": report for (preset, size), report in reports.items()},
            "contenders": [{"name": c.name, "command": command_text(c), "seconds": c.seconds,
                            "processor": c.processor, "peak_mebibytes": c.mebibytes,
                            "stages": [report["stages"] for report in c.reports]} for c in contenders]}
