#!/usr/bin/env python3
"""Compares the volume of each solid of a CityJSON of -surface with the volume_m3 of its attributes, and all with their sum.
Prints a line, or ends with status 1 where one differs by more than a thousandth. Coordinates are taken for metres unless
their length in metres is given: check_volumes.py town.city.json [0.3048]"""

import json
import pathlib
import sys

from check_cityjson import dot, normal


def volume(geometry, vertices):
    """Volume in cubed steps."""
    return sum(dot(normal(rings, vertices), vertices[rings[0][0]]) for rings in geometry["boundaries"][0]) / 6


def shares(city, metres=1.0):
    """Volume of each solid over that of its attributes, and the sums of both."""
    x, y, z = city["transform"]["scale"]
    found, sums = {}, [0.0, 0.0]
    for name, thing in city["CityObjects"].items():
        for geometry in thing.get("geometry", []):
            here = volume(geometry, city["vertices"]) * x * y * z * metres ** 3
            told = thing["attributes"]["volume_m3"]
            found[name] = here / told
            sums = [sums[0] + here, sums[1] + told]
    return found, sums


def main(path, metres=1.0):
    found, sums = shares(json.loads(pathlib.Path(path).read_text()), float(metres))
    off = {name: share for name, share in found.items() if abs(share - 1) > 0.001}
    for name, share in off.items():
        print(f"{path}: {name} encloses {share:.4f} times its volume_m3", file=sys.stderr)
    worst = max((abs(share - 1) for share in found.values()), default=0)
    print(f"{len(found)} solids, {sums[0]:.0f} m3, {100 * (sums[0] / sums[1] - 1):+.3f} % of volume_m3, "
          f"one by {100 * worst:.3f} % at most")
    return 1 if off else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
