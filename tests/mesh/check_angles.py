#!/usr/bin/python3
"""Where a mesh of dem2buildings_mesh has angles below a bound, and whether the plan forces them:

    check_angles.py <mesh.obj> [<degrees>]

Measures the OBJ alone. The plan's edges are those between different roofs, or a roof and terrain. An angle is at a
sharp corner where two of these edges meet there at less than 60 degrees, and beside one where the triangle stands on
the line of such an edge, or has a corner within 1 m of the sharp one, across a gap: elsewhere none should be. Ends with
1 where there are some. Needs python3-numpy."""
import sys
from collections import defaultdict

import numpy as np

SHARP = 60
NEAR = 1


def read(path):
    """Points, triangles that look up, and of each the roof or the terrain that it belongs to."""
    points, faces, regions, name, group = [], [], [], "", ""
    for line in open(path, encoding="utf-8"):
        kind, _, rest = line.partition(" ")
        if kind == "v":
            points.append([float(word) for word in rest.split()])
        elif kind == "o":
            name = rest.strip()
        elif kind == "g":
            group = rest.strip()
        elif kind == "f" and group in ("roof", "terrain"):
            faces.append([int(word) - 1 for word in rest.split()])
            regions.append((name, points[faces[-1][0]][2] if group == "roof" else None))
    numbers = {region: i for i, region in enumerate(dict.fromkeys(regions))}
    return np.array(points), np.array(faces), np.array([numbers[region] for region in regions])


def angles(points, faces):
    """Degrees at the corners of each triangle, seen from above."""
    plan = points[faces][:, :, :2]
    to, back = np.roll(plan, -1, axis=1) - plan, np.roll(plan, 1, axis=1) - plan
    turn = to[:, :, 0] * back[:, :, 1] - to[:, :, 1] * back[:, :, 0]
    return np.degrees(np.arctan2(np.abs(turn), (to * back).sum(axis=2)))


def nodes_of(points):
    """One number a place of the plan: roofs and terrain meet there at different heights."""
    _, which = np.unique(points[:, :2], axis=0, return_inverse=True)
    return which.ravel()


def borders(faces, regions, node):
    """Edges of the plan, by their nodes: each triangle's other side has another region, or none."""
    sides = defaultdict(set)
    for face, region in zip(node[faces].tolist(), regions.tolist()):
        for a, b in zip(face, face[1:] + face[:1]):
            sides[min(a, b), max(a, b)].add(region)
    seen = defaultdict(int)
    for face in node[faces].tolist():
        for a, b in zip(face, face[1:] + face[:1]):
            seen[min(a, b), max(a, b)] += 1
    return [edge for edge, around in sides.items() if len(around) > 1 or seen[edge] == 1]


def lines_of_sharp_corners(edges, plan):
    """Nodes at which edges meet at less than SHARP degrees, and all nodes of the lines that leave them so."""
    around = defaultdict(list)
    for a, b in edges:
        around[a].append(b)
        around[b].append(a)

    def direction(a, b):
        return np.arctan2(*(plan[b] - plan[a])[::-1])

    def apart(first, second):
        return abs(np.degrees((first - second + np.pi) % (2 * np.pi) - np.pi))

    corners, beside = set(), set()
    for a, ends in around.items():
        for b in ends:
            if all(apart(direction(a, b), direction(a, c)) >= SHARP for c in ends if c != b):
                continue
            corners.add(a)
            last, at = a, b
            while at is not None:  # along the line of the edge
                beside.add(at)
                ahead = [c for c in around[at] if c != last and apart(direction(last, at), direction(at, c)) < 0.5]
                last, at = at, ahead[0] if ahead else None
    for corner in corners:
        beside.update(np.flatnonzero(np.hypot(*(plan - plan[corner]).T) < NEAR).tolist())
    return corners, beside - corners


def main(path, bound):
    points, faces, regions = read(path)
    node = nodes_of(points)
    plan = np.zeros((node.max() + 1, 2))
    plan[node] = points[:, :2]
    corners, beside = lines_of_sharp_corners(borders(faces, regions, node), plan)
    least = angles(points, faces).min(axis=1)
    count = {"at sharp corners": 0, "beside them": 0, "elsewhere": 0}
    for face in node[faces[least < bound]].tolist():
        where = "at sharp corners" if corners & set(face) else "beside them" if beside & set(face) else "elsewhere"
        count[where] += 1
    places = ", ".join(f"{n} {where}" for where, n in count.items())
    print(f"{len(np.unique(node[faces]))} points of the plan, {len(faces)} triangles, "
          f"smallest angle {least.min():.3f}, below {bound:g}: {places}")
    return 1 if count["elsewhere"] else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], float(sys.argv[2]) if len(sys.argv) > 2 else 20.7))
