"""Footprints that exist, as a GeoDataFrame."""

import contextlib
import os
import tempfile

from ._frames import column

_WORD = "GeoDataFrame"  # their name in messages and metadata


def _is_frame(value):
    return hasattr(value, "to_file") and hasattr(value, "geometry")


@contextlib.contextmanager
def written(options):
    """Writes a GeoDataFrame among the options to a temporary file, whose path takes its place. Gives the frame, and a
    function that puts a word for the path into a text; None and a function that changes nothing if there is none."""
    frame = options.get("footprints")
    if not _is_frame(frame):
        yield None, lambda text: text
        return
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "footprints.gpkg")
        frame.to_file(path, driver="GPKG", layer="footprints", index=False)
        options["footprints"] = path
        yield frame, lambda text: text.replace(path, _WORD)


def with_columns(frame, layer, crs):
    """A copy of the frame, in the CRS of the result, with the columns of a layer that has a feature for each of its
    rows, in their order."""
    copy = frame.copy() if frame.crs is None or crs is None else frame.to_crs(crs)
    for name, values in layer.columns.items():
        copy[name] = column(values)
    return copy
