"""extract(), extract_file() and score()."""

import contextlib
import json
import os
import warnings

from . import _core
from ._dem import elevations, is_array, is_path, paths, six_terms
from ._errors import Error
from ._footprints import with_columns, written
from ._options import EXTRACT, EXTRACT_FILE, SCORE, whole
from ._result import Result


class _Ears:
    """Takes warnings and errors of the compiled part, and names options in them as the function does."""

    def __init__(self, options, progress=None):
        self._options = options
        self.progress = progress

    def warn(self, text):
        # Warns from here to extract(), and to its caller.
        warnings.warn(self._options.in_python(text), stacklevel=3)

    @contextlib.contextmanager
    def errors(self):
        try:
            yield
        except Error as error:
            error.args = (self._options.in_python(str(error)),)
            raise


@EXTRACT.describe
def extract(dem, *, transform=None, progress=None, **options):
    """Finds the buildings of a DEM and returns them as polygons in memory, a Result.

    dem: a path of anything that GDAL opens or of a folder of rasters, or a list of paths of rasters on one grid, of which
        later ones cover earlier ones; or a NumPy array of rows and columns: float32, float64 or integers. NaN,
        infinite values and masked cells are not valid. An array is not copied, so do not change it during the run.
    transform: for an array, six terms in GDAL's order: (x of the upper left corner, width of a cell, 0, y of that
        corner, 0, -height of a cell) if north is up; or an affine.Affine, as rasterio has it. Without it, coordinates
        are columns and, upwards, rows.
    progress: a function that gets the share of the work done, from 0 to 1, a few times per second. The calling thread
        calls it. If it returns False, or another false value except None, the run ends with Cancelled.
    ground, mask, ndvi: a path, or an array with the shape of the DEM and its transform; ground in the DEM's vertical
        unit. They are copied.
    footprints: a path, or a GeoDataFrame; the result then has footprints, a copy of it with the columns of buildings

    Paths are str, bytes or os.PathLike. If the name of a file is not UTF-8, texts of the result have U+FFFD for its
    invalid bytes.

    Warnings about the result are Python warnings, and in the report. Ctrl-C ends the run. Other Python threads go on
    meanwhile.

    >>> import numpy
    >>> dem = numpy.zeros((40, 50), "float32")
    >>> dem[10:25, 15:35] = 12
    >>> found = extract(dem, transform=(391000, 1, 0, 5820040, 0, -1), crs="EPSG:25833", ground="none")
    >>> found
    <dem2buildings.Result: 1 buildings, 1 contours>
    >>> found.buildings.columns["height"]
    array([12.])
    """
    arrays = _beside(options, dem)
    ears = _Ears(EXTRACT, progress)
    with written(options) as (frame, named), ears.errors():
        given = EXTRACT.given(options)
        if is_path(dem):
            if transform is not None:
                raise TypeError("transform is for an array; a path has its own")
            found = _core.extract_paths(paths(dem), given, arrays, ears)
        else:
            found = _core.extract_array(*elevations(dem), six_terms(transform), given, arrays, ears)
    layers, crs, metadata, report = found
    result = Result(layers, crs, {name: named(text) for name, text in metadata.items()}, named(report))
    if frame is not None:
        result.footprints = with_columns(frame, result.buildings, result.crs)
    return result


@EXTRACT_FILE.describe
def extract_file(src, dst, *, progress=None, **options):
    """Works as the program does: finds the buildings of a raster and writes them to a vector dataset.

    src: a path of anything that GDAL opens or of a folder of rasters, or a list of paths of rasters on one grid
    dst: a path of any format that GDAL writes, by its extension. It keeps its old content or gets the new one, never
        a part of it. An existing dataset is refused without overwrite or append.
    progress, ground, mask, ndvi: as for extract()
    footprints: a path, or a GeoDataFrame, whose columns are written, too

    Returns the report, a dict. Warnings, Ctrl-C and other threads are as in extract().

    >>> import pathlib, tempfile
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     report = extract_file("sample_dems/thesis_50x36.tif", pathlib.Path(folder, "thesis.gpkg"), lod=2)
    >>> report["output"]["buildings"]
    3
    """
    arrays = _beside(options)
    ears = _Ears(EXTRACT_FILE, progress)
    with written(options), ears.errors():
        given = EXTRACT_FILE.given(options)
        return json.loads(_core.extract_file(paths(src), whole(os.fsencode(dst)), given, arrays, ears))


@SCORE.describe
def score(found, reference, **options):
    """Measures how well footprints agree with a reference, as the program dem2buildings_score does.

    found, reference: a path of anything that GDAL opens, or a Result of extract(), whose buildings are compared

    Returns a dict, the same as dem2buildings_score -json prints.

    >>> dem = "sample_dems/thesis_50x36.tif"
    >>> result = score(extract(dem), "sample_dems/samples_truth.gpkg", reference_layer="thesis_50x36", dem=dem)
    >>> result["reference"]["objects"], result["object_completeness"]
    (3, 1.0)
    """
    ears = _Ears(SCORE)
    with ears.errors():
        return json.loads(_core.score(_side(found), _side(reference), SCORE.given(options), ears))


def _beside(options, dem=None):
    """The arrays among the options, as the compiled part takes them. A word stands for each: it is in messages and in
    the metadata of the result."""
    arrays = {name: elevations(options[name], name, dem) for name in ("ground", "mask", "ndvi")
              if is_array(options.get(name))}
    options.update(dict.fromkeys(arrays, "array"))
    # True and False are 1 and 0.
    return {name: (values.view("uint8") if values.dtype == bool else values, mask)
            for name, (values, mask) in arrays.items()}


def _side(footprints):
    if not isinstance(footprints, Result):
        return whole(os.fsencode(footprints))
    if footprints.buildings is None:
        raise ValueError("The result has no buildings to compare; extract them with layers='both'.")
    return footprints.buildings
