"""Layers as GeoDataFrames."""

import numpy


def column(values):
    """A column as pandas takes it: gaps of integers in Int64, of texts None, of other numbers NaN."""
    if not isinstance(values, numpy.ma.MaskedArray):
        return values
    if values.dtype.kind == "i":
        import pandas  # GeoPandas has brought it
        return pandas.array(values.tolist(), dtype="Int64")
    return numpy.array(values.tolist(), object) if values.dtype.kind == "O" else values.filled(numpy.nan)


def frame_of(layer, crs):
    """A GeoDataFrame of the features of a layer, in their order."""
    try:
        import geopandas
    except ImportError as error:
        raise ImportError("to_geodataframe() needs GeoPandas; install python3-geopandas of Debian, or geopandas with pip, "
                          "or use the columns and the wkb of a layer") from error
    columns = {name: column(values) for name, values in layer.columns.items()}
    return geopandas.GeoDataFrame(columns, geometry=geopandas.GeoSeries.from_wkb(layer.wkb), crs=crs)
