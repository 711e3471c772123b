"""An array as the compiled part takes it."""

import os

import numpy

from ._options import whole


def is_path(value):
    """Whether it is a path, or several in a list or tuple."""
    if isinstance(value, (list, tuple)):
        return bool(value) and all(isinstance(path, (str, bytes, os.PathLike)) for path in value)
    return isinstance(value, (str, bytes, os.PathLike))


def paths(source):
    """The bytes of a path, or of each of several."""
    several = isinstance(source, (list, tuple))
    if several and not source:
        raise ValueError("The list of sources is empty; give at least one path.")
    return [whole(os.fsencode(path)) for path in (source if several else [source])]


def is_array(value):
    """Whether it is an array, of NumPy or another package, and not a number of NumPy's."""
    return hasattr(value, "__array__") and not isinstance(value, numpy.generic)


def elevations(dem, argument="dem", beside=None):
    """The values and the mask of an array; the mask is None where nothing is masked. Copies nothing unless the bytes
    of the values are in the order of another machine. beside: the DEM, whose shape an error names"""
    if not hasattr(dem, "__array__"):
        raise TypeError(f"{argument} must be a path or a NumPy array, not {type(dem).__name__}")
    array = numpy.asanyarray(dem)
    if array.ndim != 2:
        of_dem = f" and the DEM the shape {numpy.shape(beside)}" if is_array(beside) else ""
        raise ValueError(f"{argument} has the shape {array.shape}{of_dem}; give an array of two dimensions, rows and "
                         "columns")
    mask = numpy.ma.getmask(array)
    values = numpy.ma.getdata(array)
    native = values.dtype.newbyteorder("=")
    return values.astype(native, copy=False), None if mask is numpy.ma.nomask else mask


def six_terms(transform):
    """Terms in GDAL's order. An affine.Affine, as rasterio has it, knows them by itself."""
    if transform is None:
        return None
    terms = [float(term) for term in (transform.to_gdal() if hasattr(transform, "to_gdal") else transform)]
    if len(terms) != 6:
        raise TypeError(f"transform must have six terms in GDAL's order, not {len(terms)}")
    return terms
