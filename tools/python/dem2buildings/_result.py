"""The result of extract()."""

import json


class Result:
    """Buildings and contours in memory.

    buildings, contours, roofs, doubtful, rejected, problems, missing: a Layer, or None if it was not requested
    footprints: with footprints= a GeoDataFrame, its copy with the columns of buildings; otherwise None
    crs: the coordinate reference system as WKT; None if unknown
    metadata: how the result was made, a dict of texts: source, options, thresholds, units, version
    report: the report of the run, a dict, as dem2buildings -json prints it
    """

    def __init__(self, layers, crs, metadata, report):
        by_name = {layer.name: layer for layer in layers}
        self.buildings = by_name.get("buildings")
        self.contours = by_name.get("contours")
        self.roofs = by_name.get("roofs")
        self.doubtful = by_name.get("doubtful")
        self.rejected = by_name.get("rejected")
        self.problems = by_name.get("problems")
        self.missing = by_name.get("missing")
        self.footprints = None
        self.crs = crs or None
        self.metadata = metadata
        self.report = json.loads(report)

    def __repr__(self):
        layers = (self.buildings, self.contours, self.roofs, self.doubtful, self.rejected, self.problems,
                  self.missing)
        counts = ", ".join(f"{len(layer)} {layer.name}" for layer in layers if layer is not None)
        return f"<dem2buildings.Result: {counts}>"
