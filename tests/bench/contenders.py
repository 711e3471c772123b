"""Contenders of the benchmark: this project's tool, the peer, and the floors, on synthetic cities."""
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

from measuring import Contender

THESIS = ["-preset", "thesis", "-lod", "4", "-nf", "10"]
PRESETS = {"thesis": THESIS, "default": []}
SMALL = "small"  # in the place of a city's million points


def python_with_gdal():
    """The interpreter that has python3-gdal and python3-numpy."""
    for python in (sys.executable, "/usr/bin/python3"):
        if subprocess.run([python, "-c", "import numpy, osgeo"], capture_output=True, check=False).returncode == 0:
            return python
    raise RuntimeError("The peer needs python3-gdal and python3-numpy; install them.")


class Bench:
    """Makes contenders and their inputs, each once, in a work folder."""

    def __init__(self, programs, work, repeats, small, say, real=None):
        self.programs = programs
        self.work = work
        self.repeats = repeats
        self.small = small
        self.real = real or {}  # surveyed cities: a name, a raster
        self.say = say
        self.warmed = set()
        self.contenders = {}
        self.reports = {}  # by (preset, city): of a run that was not measured

    def city(self, size):
        """A city of so many million points, the small window of one, or a surveyed city."""
        if size in self.real:
            self.warm(self.real[size])
            return self.real[size]
        if size == SMALL:
            return self.small or self.make(self.work / "small.tif", [
                "gdal_translate", "-q", "-srcwin", "400", "400", "242", "249", self.city(4), "{}"])
        path = self.make(self.work / f"city{size}.tif", [self.programs["make_city"], str(size), "{}"])
        self.warm(path)
        return path

    def warm(self, path):
        """Reads it into the system's cache, because disks are not compared."""
        if path not in self.warmed:
            self.warmed.add(path)
            with path.open("rb") as file:
                while file.read(1 << 24):
                    pass

    def make(self, path, command):
        if not path.exists():
            self.say(f"makes {path.name}")
            # A run that is interrupted leaves no half city.
            begun = path.with_stem(path.stem + "_begun")
            subprocess.run([str(word).replace("{}", str(begun)) for word in command], check=True)
            begun.rename(path)
        return path

    def add(self, name, command, heavy=False, out=None):
        """@param heavy: once, whatever the number of repeats; small cities have many
        @param out: where the result goes; a GeoPackage in the work folder"""
        if name not in self.contenders:
            is_small = SMALL in name or any(name.endswith(city) for city in self.real)
            repeats = 1 if heavy else self.repeats * (5 if is_small else 1)
            out = out or self.work / (name.replace(" ", "_") + ".gpkg")
            self.contenders[name] = Contender(name, command, out, repeats)
        return self.contenders[name]

    def ours(self, preset, size):
        return self.add(f"{preset} {size}", [self.programs["dem2buildings"], "-json", *PRESETS[preset],
                                             self.city(size), "{out}"], heavy=size == 1000)

    def ours_with(self, name, options, size):
        """Adds a run with more options; its files begin with the name of the result."""
        return self.add(f"default {size} {name}", [self.programs["dem2buildings"], "-json", *options, self.city(size),
                                                   "{out}"], out=self.work / "extra.gpkg")

    def unwritten(self, preset, size, threads):
        """All stages, with the least of formats in memory in the place of a file: SQLite has one thread."""
        return self.add(f"{preset} {size} threads {threads}",
                        [self.programs["dem2buildings"], "-json", "-threads", str(threads), *PRESETS[preset],
                         "-layers", "contours", "-f", "FlatGeobuf", "-lco", "SPATIAL_INDEX=NO", self.city(size),
                         "{out}"], out=Path("/dev/shm") / f"dem2buildings_{os.getpid()}.fgb")

    def has_threads(self):
        tool = [str(self.programs["dem2buildings"]), "--help"]
        return "-threads" in subprocess.run(tool, capture_output=True, text=True, check=True).stdout

    def result(self, preset, size):
        """Our result as FlatGeobuf: a folder, since a file of that format holds one layer."""
        folder = self.work / f"{preset}_{size}_fgb"
        if (preset, size) not in self.reports:
            shutil.rmtree(folder, ignore_errors=True)
            contender = self.ours(preset, size)
            self.reports[preset, size] = json.loads(contender.run())
            subprocess.run(["ogr2ogr", "-f", "FlatGeobuf", folder, contender.out], check=True)
            contender.forget()
        return folder

    def peer(self, size):
        """Adds the peer with the thresholds that ours chose."""
        self.result("thesis", size)
        levels = [repr(level["threshold"]) for level in self.reports["thesis", size]["levels"][1:]]
        script = Path(__file__).with_name("peer_levels.py")
        return self.add(f"peer {size}", [python_with_gdal(), script, self.city(size), "{out}", *levels])

    def read(self, size):
        return self.add(f"read {size}", [self.programs["read_floor"], self.city(size)])

    def write(self, preset, size):
        return self.add(f"write {preset} {size}", ["ogr2ogr", "-f", "GPKG", "{out}", self.result(preset, size)])
