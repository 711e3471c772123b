#!/usr/bin/python3
"""The rows of docs/research/surfaces.md that are about the sample town: made here and compared with the page.

    surface_rows.py <dem2buildings> <source folder> [--write]

Prints each row that differs and ends with status 1; with --write the page gets the rows. OpenFOAM's verdict, in the last
cell of a row, stays as it stands. Needs Debian's python3-gdal and python3-shapely.
"""

import pathlib
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(sys.argv[2])
sys.path[:0] = [str(SOURCE / "tests/surface"), str(SOURCE / "tests/solids")]

import block_change  # noqa: E402
import check_flow  # noqa: E402
import exact_shell  # noqa: E402

KINDS = ("wall", "gap", "angle", "touch")


def make(program, folder, name, *options):
    """Runs the program on the town. @return the paths of its layers and of its shell"""
    layers, shell = folder / f"{name}.gpkg", folder / f"{name}.obj"
    subprocess.run([program, "-q", *options, "-surface", str(shell), str(SOURCE / "sample_dems/town.tif"), str(layers)],
                   check=True, stderr=subprocess.DEVNULL)
    return str(layers), str(shell)


def polygons(layers):
    dataset = check_flow.ogr.Open(layers)
    return [part for geometry, _ in check_flow.read(dataset.GetLayer("buildings")) for part in check_flow.polygons_of(geometry)]


def short_of(layers):
    """How many walls, gaps, angles and touching corners fall short of 1 m."""
    buildings = polygons(layers)
    blocks = check_flow.polygons_of(check_flow.unary_union(buildings))
    found = [kind for kind, _, _ in (*check_flow.walls_and_angles(buildings, 1), *check_flow.gaps(blocks, 1),
                                     *check_flow.touches(blocks))]
    return [found.count(kind) for kind in KINDS]


def flow_row(plain, ready):
    counts = [f"{before}, then {after}" for before, after in zip(short_of(plain), short_of(ready))]
    before, after = block_change.covered(plain), block_change.covered(ready)
    changed = 100 * before.symmetric_difference(after).area / before.area
    done = subprocess.run([sys.executable, str(SOURCE / "tests/surface/block_change.py"), plain, ready], capture_output=True, text=True)
    most = done.stdout.split(" at most ")[1].split(" ")[0]
    return ["sample town (1 m)", f"{len(polygons(plain))}", *counts, f"{changed:.2f} %", f"{most} %"]


def shell_row(of, shell):
    corners, triangles, _ = exact_shell.read(shell)
    opened, many = exact_shell.edge_faults(corners, triangles)
    return [f"sample town, {of}", f"{len(triangles):,}", f"{opened}", f"{many}"]


def corners_row(layers, shell):
    points = {point for polygon in polygons(layers) for ring in check_flow.rings(polygon) for point in ring.coords}
    corners = len(exact_shell.read(shell)[0])
    return ["corners of the sample town's, likewise", f"{corners:,} : {len(points):,} = {corners / len(points):.2f}"]


def cells(line):
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


def main(program, write):
    with tempfile.TemporaryDirectory() as place:
        folder = pathlib.Path(place)
        plain, shell = make(program, folder, "plain", "-split_height", "3", "-layers", "buildings")
        ready, _ = make(program, folder, "ready", "-split_height", "3", "-layers", "buildings", "-flow_ready", "1")
        _, stack = make(program, folder, "stack", "-surface_of", "contours")
        rows = [flow_row(plain, ready), shell_row("buildings", shell), shell_row("contours", stack), corners_row(plain, shell)]
    page = SOURCE / "docs/research/surfaces.md"
    lines = page.read_text(encoding="utf-8").split("\n")
    wrong = 0
    for row in rows:
        found = [i for i, line in enumerate(lines) if line.startswith("|") and cells(line)[0] == row[0]]
        if len(found) != 1:
            sys.exit(f"{page.name} has {len(found)} rows '{row[0]}'; give it one.")
        here = cells(lines[found[0]])
        if here[:len(row)] != row:
            wrong += 1
            print(f"{page.name} says   {' | '.join(here)}\nit is now {' | '.join(row)}")
            lines[found[0]] = "| " + " | ".join(row + here[len(row):]) + " |"
    if write:
        page.write_text("\n".join(lines), encoding="utf-8")
    return 1 if wrong and not write else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], "--write" in sys.argv[3:]))
