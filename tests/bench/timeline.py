"""Which thread works when: a trace in Chrome's format, and how long one thread works alone."""
import json
import re
import subprocess
from dataclasses import dataclass


@dataclass
class Span:
    thread: int
    begin: int  # microseconds
    end: int
    what: str


# Functions that have threads work for others, and the words of mangled names.
WRAPPERS = {"std", "d2b", "Executor", "for_each", "for_each_in_room", "for_pieces", "in_order", "for_row_bands", "for_cells",
            "sum_of_row_bands", "for_band_copies", "for_runs_by_label", "ElevationReader", "for_each_below", "pass",
            "_GLOBAL__N_1"}


def mangled_names(work):
    """The names in text that no demangler takes: each has its length before it."""
    at = 0
    while found := re.compile(r"\d+").search(work, at):
        at = found.end() + int(found.group())
        yield work[found.end():at]


def short_name(work):
    """The function of the library that had the threads work: the innermost one of those whose lambdas they called."""
    if "(" not in work:
        return next((name for name in mangled_names(work) if name not in WRAPPERS), work)
    before = work.split("::{lambda", 1)[0].replace("(anonymous namespace)::", "")
    depth, end = 0, len(before)
    for at in range(len(before) - 1, -1, -1):  # past the parameters
        depth += (before[at] == ")") - (before[at] == "(")
        if before[at] == "(" and depth == 0:
            end = at
            break
    return re.split(r"[<>, ]", before[:end])[-1].removeprefix("d2b::") or work


def run_once(program, options, dem, out):
    """@return microseconds of the run, and the stretches in which threads shared work"""
    done = subprocess.run([program, *options, dem, out], capture_output=True, text=True, check=True)
    lines = [line.split("\t") for line in done.stdout.splitlines()]
    spans = [Span(int(thread), int(begin), int(end), short_name(work))
             for thread, begin, end, work in lines if thread != "run"]
    return int(lines[0][2]), sorted(spans, key=lambda span: span.begin)


def alone(spans, whole):
    """The stretches in which the caller's thread works by itself: between those that threads share."""
    at, found = 0, []
    for span in [*spans, Span(0, whole, whole, "")]:
        if span.begin > at:
            found.append(Span(0, at, span.begin, "one thread"))
        at = max(at, span.end)
    return found


def seconds_by_threads(spans, whole):
    """How many seconds as many threads were at work, by their number; the caller's where no others are."""
    changes = sorted([(span.begin, 1) for span in spans] + [(span.end, -1) for span in spans])
    seconds, at, working = {}, 0, 0
    for when, change in [*changes, (whole, 0)]:
        threads = max(working, 1)
        seconds[threads] = seconds.get(threads, 0) + (when - at) / 1e6
        at, working = when, working + change
    return seconds


def by_amdahl(seconds, threads):
    """Wall time on so many threads, and the share of it in which one works alone, from measurements on some."""
    serial = seconds.get(1, 0)
    shared = sum(number * time for number, time in seconds.items() if number > 1)
    return serial + shared / threads, serial / (serial + shared / threads)


def write_chrome(path, runs):
    """@param runs by name: microseconds and stretches"""
    events = []
    for process, (name, (whole, spans)) in enumerate(runs.items()):
        events.append({"ph": "M", "name": "process_name", "pid": process, "args": {"name": name}})
        events += [{"ph": "X", "name": span.what, "pid": process, "tid": span.thread, "ts": span.begin,
                    "dur": span.end - span.begin} for span in [*spans, *alone(spans, whole)]]
    path.write_text(json.dumps({"traceEvents": events}))


def longest_alone(spans, whole, number=8):
    """The longest of the stretches of one thread with the work before them, because that is where to look."""
    found = sorted(alone(spans, whole), key=lambda span: span.begin - span.end)[:number]
    after = [max((s for s in spans if s.end <= gap.begin), key=lambda s: s.end, default=None) for gap in found]
    return [(gap.begin / 1e6, (gap.end - gap.begin) / 1e6, before.what if before else "the start")
            for gap, before in zip(found, after)]
