"""How often a confidence is right."""
import numpy as np
from osgeo import gdal


BINS = np.array([0, 0.2, 0.4, 0.6, 0.8, 1.0])
LEAST_M2 = 50  # smaller ones are buildings or none by the limit of the reference


def objects_of(out):
    """Polygon, confidence and area in square metres of all that may be a building."""
    dataset = gdal.OpenEx(out, gdal.OF_VECTOR)
    for name in ("buildings", "doubtful"):
        layer = dataset.GetLayerByName(name)
        for feature in layer if layer is not None else []:
            yield feature.GetGeometryRef().Clone(), feature["confidence"], feature["area_m2"]


def area_of(geometry):
    """Area of a polygon, or of the polygons of a collection."""
    if geometry.GetGeometryCount() and geometry.GetGeometryName() not in ("POLYGON", "MULTIPOLYGON"):
        return sum(area_of(part) for part in geometry)
    return geometry.Area() if geometry.GetDimension() == 2 else 0.0


def shared_area(geometry, blocks):
    """How much of a polygon polygons that do not overlap cover."""
    box = geometry.GetEnvelope()
    shared = 0.0
    for block, other in blocks:
        if box[0] < other[1] and other[0] < box[1] and box[2] < other[3] and other[2] < box[3]:
            shared += area_of(geometry.Intersection(block))
    return shared


def judged(out, place):
    """Rows of confidence, and whether at least half of the object is in the reference: an array n x 2."""
    blocks = [(block, block.GetEnvelope()) for block in place.blocks()]
    area = place.area_of_interest()
    rows = []
    for geometry, confidence, square_metres in objects_of(out):
        if square_metres < LEAST_M2 or (area is not None and not geometry.Centroid().Within(area)):
            continue
        geometry = geometry if geometry.IsValid() else geometry.MakeValid()
        rows.append((confidence, shared_area(geometry, blocks) >= area_of(geometry) / 2))
    return np.array(rows, float).reshape(-1, 2)


def by_bin(objects):
    """(number, mean confidence, share that is right) for each bin; None for a share of nothing."""
    which = np.clip(np.digitize(objects[:, 0], BINS) - 1, 0, len(BINS) - 2)
    for index in range(len(BINS) - 1):
        rows = objects[which == index]
        yield (len(rows), float(rows[:, 0].mean()), float(rows[:, 1].mean())) if len(rows) else (0, None, None)


def draw(axes, title, measured):
    """A line a place with at least five objects in a bin, and one of all of them together."""
    axes.plot([0, 1], [0, 1], color="0.6", linestyle=":", label="as often as it says")
    everything = np.concatenate([figures["objects"] for figures in measured])
    for name, objects in [*((f["name"], f["objects"]) for f in measured), ("all", everything)]:
        bins = [row for row in by_bin(objects) if row[0] >= 5]
        style = {"color": "black", "linewidth": 3, "markersize": 8} if name == "all" else {"markersize": 4}
        if bins:
            axes.plot([row[1] for row in bins], [row[2] for row in bins], marker="o",
                      label=f"{name} ({len(objects)})", **style)
    axes.set(xlabel="confidence", ylabel="share that is a building", xlim=(0, 1.01), ylim=(0, 1.02), title=title)
    axes.legend(fontsize=7, ncol=3, loc="upper center", bbox_to_anchor=(0.5, -0.12))  # clear of the curves


def plot(path, groups):
    """Share that is right over confidence, for groups of places by title."""
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    known = {title: measured for title, measured in groups.items() if measured}
    figure, axes = pyplot.subplots(1, len(known), figsize=(6 * len(known), 7), squeeze=False)
    for one, (title, measured) in zip(axes[0], known.items()):
        draw(one, title, measured)
    figure.tight_layout()
    figure.savefig(path, dpi=80)
