"""Conditions that hold for every run, whatever its input."""
import json
import re

from read_result import read_result
from run_tool import RESULT

HIGHEST_M = 1000
# Causes of buildings taller than any real one: the option that mends it stands in the warning.
CAUSES = re.compile(r"-(zunit|snodata|zrange|ground|b|a_srs)\b")

# HDF5 prints its own stack of errors, whoever calls it, before GDAL hears of one.
OF_LIBRARIES = re.compile(r"HDF5-DIAG: |  #\d+: .*[.]c line |    (major|minor): ")


def report_of(text):
    """Infinity and NaN are no JSON. @return the report, faults"""
    def refuse(name):
        raise ValueError(name)
    try:
        return json.loads(text, parse_constant=refuse), []
    except ValueError as error:
        return {}, [f"stdout is not JSON: {error}"]


def faults_of_messages(run):
    """Warnings, a line each, then where it failed one sentence."""
    lines = [line for line in run.err.splitlines() if not OF_LIBRARIES.match(line)]
    errors = [line for line in lines if line.startswith("ERROR: ")]
    faults = [f"a line that is no message: {line}" for line in lines if not line.startswith(("Warning: ", "ERROR: "))]
    faults += [f"no sentence: {line}" for line in lines if not re.search(r"[.?!]['\")]?$", line)]
    if len(errors) != (run.status != 0):
        faults.append(f"{len(errors)} errors with status {run.status}")
    if len(set(lines)) != len(lines):
        faults.append("a message comes twice")
    return faults


def judge_success(run, preset):
    report, faults = report_of(run.out)
    if RESULT not in run.left:
        return "no result", [*faults, "there is no result"]
    result = read_result(str(run.folder / RESULT), preset)
    faults += result.faults[:3]
    for layer, count in result.features.items():
        if (said := report.get("output", {}).get(layer, count)) != count:
            faults.append(f"the report says {said} {layer}, and there are {count}")
    if preset == "buildings" and result.highest >= HIGHEST_M and not CAUSES.search(run.err):
        faults.append(f"a building of {result.highest:.0f} m, and no warning that names the cause")
    if result.features.get("buildings", 0) > 0:
        return "found, with warnings" if run.err else "found", faults
    if not run.err:
        faults.append("nothing was found, and not a word")
    return "nothing found", faults


def judge(run, preset):
    """@return the outcome, and all that must not be"""
    if run.status < 0 or run.hangs:
        return "signal", [f"ended by signal {-run.status}" + (", heedless of SIGTERM" if run.hangs else "")]
    faults = [f"left {name}" for name in run.left if run.status != 0 or name != RESULT]
    if run.too_long:
        return "stopped after a minute", faults
    faults += faults_of_messages(run)
    if run.status == 0:
        outcome, more = judge_success(run, preset)
        return outcome, faults + more
    if run.status not in (1, 2):
        faults.append(f"status {run.status}")
    return "refused", faults
