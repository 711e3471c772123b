"""The program: where it is, which options it has, and how it runs."""

import codecs
import functools
import json
import os
import queue
import re
import shutil
import subprocess
import sys
import threading

from qgis.core import QgsSettings

SETTING = "dem2buildings/program"

# Windows would show a console for each call.
_QUIET = {"creationflags": subprocess.CREATE_NO_WINDOW} if os.name == "nt" else {}


class NotFound(Exception):
    """The program is not where it is looked for."""


def find():
    """The environment comes first, then the setting, then the PATH, then a folder "bin" in the plugin."""
    beside = os.path.join(os.path.dirname(__file__), "bin")
    place = (os.environ.get("DEM2BUILDINGS") or QgsSettings().value(SETTING, "") or shutil.which("dem2buildings")
             or shutil.which("dem2buildings", path=beside))
    if not place:
        raise NotFound(f"The program dem2buildings was not found. {_source(sys.platform)} Or say where it is: "
                       f"set {SETTING} in QGIS's advanced settings, or the variable DEM2BUILDINGS.")
    return place


def _source(platform):
    """The place from which users of a system get the program."""
    if platform == "win32":
        return ("For Windows it comes with the plugin: install the plugin from dem2buildings-<version>-windows.zip of the "
                "release. A program elsewhere is found if its folder is on the PATH of the OSGeo4W shell.")
    if platform == "darwin":
        return "Build it from the sources, as docs/install.md says."
    return "Install the Debian package of the release, or build it from the sources, as docs/install.md says."


@functools.lru_cache(maxsize=4)
def _options(place, _time):
    text = subprocess.run([place, "-options_json"], check=True, capture_output=True, encoding="utf-8", timeout=30,
                          **_QUIET).stdout
    return json.loads(text)["options"]


def options():
    """The program's own table, so that dialog and program cannot differ."""
    place = find()
    try:
        return _options(place, os.stat(place).st_mtime)
    except (OSError, subprocess.SubprocessError, ValueError, KeyError) as error:
        raise NotFound(f"{place} does not list its options ({error}); it may be too old.") from error


def percent_of(text):
    """How far "0...10...20." has come: a number names the percent, each dot after it is worth 2.5."""
    line = re.match(r"[0-9.]*", text).group()
    tens = list(re.finditer(r"[0-9]+(?=\.|$)", line))
    if not tens:
        return 0.0
    return min(100.0, float(tens[-1].group()) + 2.5 * (len(line) - tens[-1].end()))


def _pump(stream, name, lines):
    """Hands on output as it comes, because progress has no line ends."""
    decoder = codecs.getincrementaldecoder("utf-8")("replace")
    while True:
        piece = os.read(stream.fileno(), 4096)
        text = decoder.decode(piece)
        if text or not piece:
            lines.put((name, text))
        if not piece:
            return


def run(arguments, feedback):
    """Runs the program and hands on its progress.
    @return (exit status, its text on stderr, its text on stdout after the progress)"""
    pieces = queue.Queue()
    said = {"stdout": "", "stderr": ""}
    running, stopping = 2, False
    with subprocess.Popen([find(), *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          stdin=subprocess.DEVNULL, **_QUIET) as process:
        for name in said:
            threading.Thread(target=_pump, args=(getattr(process, name), name, pieces), daemon=True).start()
        while running:
            if feedback.isCanceled() and not stopping:
                # The program takes back its unfinished files. SIGINT would be ignored where a script has started QGIS
                # in the background.
                process.terminate()
                stopping = True
            try:
                name, text = pieces.get(timeout=0.2)
            except queue.Empty:
                continue
            running -= not text
            said[name] += text
            feedback.setProgress(percent_of(said["stdout"]))
    return process.returncode, said["stderr"], said["stdout"].partition("done.\n")[2].strip()
