"""The result of extract()."""

import json

from ._frames import frame_of


class Result:
    """Buildings and contours in memory.

    buildings, contours, roofs, doubtful, rejected, problems, missing: a Layer, or None if it was not requested
    footprints: with footprints= a GeoDataFrame, its copy with the columns of buildings; otherwise None
    crs: the coordinate reference system as WKT; None if unknown
    metadata: how the result was made, a dict of texts: source, options, thresholds, units, version
    report: the report of the run, a dict, as dem2buildings -json prints it
    """

    def __init__(self, layers, crs, metadata, report):
        by_name = self._layers = {layer.name: layer for layer in layers}
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

    def to_geodataframe(self, layer="buildings"):
        """A layer as a GeoDataFrame, with its columns, its geometries and the CRS. GeoPandas must be installed.

        layer: its name: buildings, contours, roofs, doubtful, rejected, problems or missing. With footprints= as a
            GeoDataFrame, buildings are a copy of footprints.
        """
        if layer == "buildings" and self.footprints is not None:
            return self.footprints.copy()
        if layer not in self._layers:
            raise ValueError(f"The result has no layer {layer!r}; it has {' and '.join(self._layers)}.")
        return frame_of(self._layers[layer], self.crs)

    def __repr__(self):
        layers = (self.buildings, self.contours, self.roofs, self.doubtful, self.rejected, self.problems,
                  self.missing)
        counts = ", ".join(f"{len(layer)} {layer.name}" for layer in layers if layer is not None)
        return f"<dem2buildings.Result: {counts}>"
