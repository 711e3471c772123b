"""Results of the program: its blocks as `-surface` writes them, and its terrain."""
import json
import resource
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from scene import read_filled
from surface import Surface


@dataclass
class Found:
    """A run of the program. Coordinates are a Surface's."""
    options: list
    report: dict
    skin: Surface  # roofs and walls, open at their feet
    seconds: float  # of a processor
    terrain: np.ndarray = None
    canopy: np.ndarray = None


def children_seconds():
    """Processor time of the processes that were started and have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def run_tool(tool, scene, options, rasters=True):
    """@param rasters: also the terrain and the heights of trees, which -preset thesis does not know"""
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        command = [str(tool), "-json", *options, "-surface", folder / "blocks.obj"]
        if rasters:
            command += ["-write_ground", folder / "ground.tif", "-write_canopy", folder / "canopy.tif"]
        start = children_seconds()
        done = subprocess.run([*map(str, command), str(scene.path), str(folder / "out.gpkg")], capture_output=True,
                              text=True, check=False)
        seconds = children_seconds() - start
        if done.returncode:
            raise RuntimeError(f"{' '.join(map(str, command))}\nfailed: {done.stderr}")
        found = Found(options, json.loads(done.stdout), read_skin(folder / "blocks.obj", scene), seconds)
        if rasters:
            found.terrain = read_filled(folder / "ground.tif")[0]
            found.canopy = read_filled(folder / "canopy.tif")[0]
        return found


def read_skin(path, scene):
    """Roofs and walls of an OBJ of `-surface`. Lengths of the scene are metres, or become it by its unit."""
    points, triangles, group, origin = [], [], "", np.zeros(3)
    for line in path.read_text(encoding="utf-8").splitlines():
        kind, _, rest = line.partition(" ")
        if line.startswith("# origin:"):
            origin = np.array([float(word) for word in line.split()[2:]])
        elif kind == "v":
            points.append([float(word) for word in rest.split()])
        elif kind == "g":
            group = rest
        elif kind == "f" and group != "ground":
            triangles.append([int(word) - 1 for word in rest.split()])
    first = np.array([scene.place[0] + scene.cell / 2, scene.place[3] - scene.cell / 2, 0])
    points = np.array(points).reshape(-1, 3) + origin - first
    return Surface(points, np.array(triangles, dtype=int).reshape(-1, 3))
