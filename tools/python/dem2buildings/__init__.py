"""Building footprints and stacked contours from the elevation raster of a city.

extract() takes a path or a NumPy array and gives polygons in memory, extract_file() writes them to a file, and score()
measures how well they agree with a reference. The options are those of the program dem2buildings.
"""

from . import _core
from ._core import Layer
from ._errors import Cancelled, Error, InputError, OptionError, OutputError
from ._extract import extract, extract_file, score
from ._result import Result

__all__ = ["Cancelled", "Error", "InputError", "Layer", "OptionError", "OutputError", "Result", "extract", "extract_file",
           "score"]
__version__ = _core.version
