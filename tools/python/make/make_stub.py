"""Writes the types of the package: make_stub.py <file>"""

import inspect
import pathlib
import sys
import textwrap

import dem2buildings
from dem2buildings import _options

HEAD = '''"""{words}"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from os import PathLike
from typing import Any, Literal, Protocol

import numpy

class _HasWkt(Protocol):
    def to_wkt(self) -> str: ...

class _Frame(Protocol):
    def to_file(self, filename: Any, **options: Any) -> None: ...

class _HasGdalTerms(Protocol):
    def to_gdal(self) -> tuple[float, float, float, float, float, float]: ...

_Path = str | bytes | PathLike[str] | PathLike[bytes]
_Raster = _Path | numpy.ndarray[Any, Any]
_Crs = str | int | _HasWkt
_Texts = str | Sequence[str] | Mapping[str, object]

__version__: str

class Error(Exception): ...
class OptionError(Error, ValueError): ...
class InputError(Error): ...
class OutputError(Error, OSError): ...
class Cancelled(Error): ...

class Layer:
    """{layer}"""

    @property
    def name(self) -> str:
        """{layer_name}"""
    @property
    def crs(self) -> str | None:
        """{layer_crs}"""
    @property
    def fields(self) -> dict[str, dict[str, str]]:
        """{layer_fields}"""
    @property
    def columns(self) -> dict[str, numpy.ndarray[Any, Any]]:
        """{layer_columns}"""
    @property
    def wkb(self) -> numpy.ndarray[Any, numpy.dtype[numpy.object_]]:
        """{layer_wkb}"""
    @property
    def __geo_interface__(self) -> dict[str, Any]: ...
    def __len__(self) -> int: ...
    def __iter__(self) -> Iterator[dict[str, Any]]: ...
    def __getitem__(self, index: int) -> dict[str, Any]: ...

class Result:
    """{result}"""

    buildings: Layer | None
    contours: Layer | None
    roofs: Layer | None
    doubtful: Layer | None
    rejected: Layer | None
    problems: Layer | None
    missing: Layer | None
    footprints: Any
    crs: str | None
    metadata: dict[str, str]
    report: dict[str, Any]

    def to_geodataframe(self, layer: str = ...) -> Any:
        """{to_geodataframe}"""
'''

OWN = {
    "dem": "_Path | Sequence[_Path] | numpy.ndarray[Any, Any]",
    "transform": "Sequence[float] | _HasGdalTerms | None",
    "progress": "Callable[[float], object] | None",
    "src": "_Path | Sequence[_Path]",
    "dst": "_Path",
    "ground": "_Raster | None",
    "mask": "_Raster | None",
    "ndvi": "_Raster | None",
    "footprints": "_Path | _Frame | None",
    "found": "_Path | Result",
    "reference": "_Path | Result",
}


def parameter(own, hints):
    name = own.name
    hint = OWN[name] if name in OWN else f"{hints[name]} | None"
    return f"    {name}: {hint}" + (" = ...," if own.default is not inspect.Parameter.empty else ",")


def function(call, options, result):
    hints = {option.argument: option.hint for option in options}
    lines = [f"def {call.__name__}("]
    keyword = False
    for own in inspect.signature(call).parameters.values():
        if own.kind is inspect.Parameter.KEYWORD_ONLY and not keyword:
            lines.append("    *,")
            keyword = True
        lines.append(parameter(own, hints))
    words = textwrap.indent(inspect.getdoc(call), "    ", lambda line: line.strip())
    return "\n".join(lines) + f'\n) -> {result}:\n    """{words.strip()}\n    """\n'


def stub():
    layer = dem2buildings.Layer
    text = HEAD.format(words=inspect.getdoc(dem2buildings), layer=layer.__doc__, result=dem2buildings.Result.__doc__.strip(),
                       to_geodataframe=dem2buildings.Result.to_geodataframe.__doc__.strip(),
                       **{f"layer_{name}": getattr(layer, name).__doc__
                          for name in ("name", "crs", "fields", "columns", "wkb")})
    for call, options, result in ((dem2buildings.extract, _options.EXTRACT, "Result"),
                                  (dem2buildings.extract_file, _options.EXTRACT_FILE, "dict[str, Any]"),
                                  (dem2buildings.score, _options.SCORE, "dict[str, Any]")):
        text += "\n" + function(call, options, result)
    return text


if __name__ == "__main__":
    pathlib.Path(sys.argv[1]).write_text(stub(), encoding="ascii")
