#!/usr/bin/env python3
"""How much of each block -flow_ready changes, from the files alone.

    block_change.py <buildings.gpkg without it> <buildings.gpkg with it>

A block is a set of touching buildings in the first file. Area in one file alone counts for the block that lost it, or
whose wall it lies along. Prints a line; the status is 1 where it is more than 1 % of any block. Needs shapely and GDAL's
Python.
"""

import sys

from osgeo import ogr
from shapely import wkb
from shapely.ops import unary_union

ogr.UseExceptions()
MOST = 0.01
ALONG = 0.02  # of a change's border, at least, for it to be one of the block


def parts(geometry):
    return list(getattr(geometry, "geoms", [geometry]))


def covered(path):
    data = ogr.Open(path)
    layer = data.GetLayer("buildings")
    return unary_union([wkb.loads(bytes(feature.GetGeometryRef().ExportToWkb())) for feature in layer])


def overlap(a, b):
    return a[0] <= b[2] and b[0] <= a[2] and a[1] <= b[3] and b[1] <= a[3]


def main(without, with_it):
    before, after = covered(without), covered(with_it)
    blocks = parts(before)
    boxes = [block.bounds for block in blocks]
    changed = [0.0] * len(blocks)
    for piece in parts(before.difference(after)) + parts(after.difference(before)):
        box = piece.bounds
        near = [i for i, other in enumerate(boxes) if overlap(other, box)]
        losers = [i for i in near if piece.representative_point().within(blocks[i])]
        for i in losers or near:
            if blocks[i].boundary.intersection(piece.boundary).length > ALONG * piece.length:
                changed[i] += piece.area
    shares = [change / block.area for change, block in zip(changed, blocks)]
    over = sum(share > MOST for share in shares)
    print(f"{len(blocks)} blocks, of one at most {100 * max(shares, default=0):.2f} % changed, {over} by more than {100 * MOST:g} %")
    return 1 if over else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
