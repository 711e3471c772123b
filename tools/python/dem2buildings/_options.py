"""The program's table of options as Python sees it: names of arguments, signatures, docstrings, and values as texts."""

import collections.abc
import dataclasses
import difflib
import inspect
import json
import os
import re
import textwrap

import numpy

from . import _core


def whole(text):
    """The same bytes, which no null character may end early."""
    if b"\0" in text:
        raise ValueError(f"{text!r} has a null character; leave it out")
    return text


@dataclasses.dataclass(frozen=True)
class Option:
    """A row of the table of options."""

    name: str  # of the program, without dash
    argument: str  # of a function
    row: dict

    @property
    def help(self):
        """The text on it for people, a sentence after another."""
        row = self.row
        unit = row.get("unit") and f"Unit: {row['unit']}."
        default = row.get("default") and f"Default: {row['default']}."
        return " ".join(text for text in (row["help"], row.get("details"), unit, default) if text)

    @property
    def hint(self):
        """Its type, for the stub."""
        kind = self.row["kind"]
        words = ", ".join(f'"{word}"' for word in self.row.get("choices", []))
        simple = {"switch": "bool", "whole": "int", "number": "float", "numbers": "Sequence[float]",
                  "extent": "Sequence[float]", "crs": "_Crs", "choice": f"Literal[{words}]"}
        if kind in simple:
            return simple[kind]
        if kind == "text":
            return "_Texts" if self._repeatable else "str"
        return "_Path | Sequence[_Path]" if self._repeatable else "_Path"

    @property
    def takes(self):
        """The same for people."""
        kind = self.row["kind"]
        simple = {"switch": "bool", "whole": "int", "number": "float", "numbers": "numbers", "extent": "4 numbers",
                  "crs": "CRS", "choice": " or ".join(map(repr, self.row.get("choices", []))), "text": "str"}
        several = self._repeatable and (kind == "text" or kind not in simple)
        return simple.get(kind, "path") + (", one or several" if several else "")

    @property
    def is_path(self):
        """Whether its value is the name of a file or dataset."""
        return self.hint.startswith("_Path")

    @property
    def _repeatable(self):
        return self.row.get("repeatable", False)

    def texts(self, value):
        """The value as the program would be given it: a list of lists of str, one each time the option is given. Bytes
        of a path that are not text stand there as os.fsdecode() has them."""
        kind = self.row["kind"]
        if kind == "switch":
            if not isinstance(value, (bool, numpy.bool_)):
                raise TypeError(f"{self.argument} is a switch and must be True or False, not {value!r}")
            return [[]] if value else []
        if self.name == "snodata" and value != value:  # rasterio's NoData may be NaN, which is never valid
            return []
        if isinstance(value, collections.abc.Mapping):
            value = [f"{key}={item}" for key, item in value.items()]
        several = isinstance(value, collections.abc.Iterable) and not isinstance(value, (str, bytes, os.PathLike))
        texts = [self._text(item) for item in (value if several else [value])]
        if kind in ("numbers", "extent"):
            return [texts]
        if several and not self._repeatable:
            raise TypeError(f"{self.argument} takes one value, not {value!r}")
        return [[text] for text in texts]

    def encoded(self, text):
        """The bytes of one of these texts: of a path those of its name, else UTF-8."""
        return whole(os.fsencode(text) if self.is_path else text.encode("utf-8", "surrogateescape"))

    def _text(self, value):
        if self.is_path and isinstance(value, (str, bytes, os.PathLike)):
            return os.fsdecode(value)
        if isinstance(value, (str, os.PathLike)) and isinstance(os.fspath(value), str):
            return os.fspath(value)
        if self.row["kind"] == "crs":
            return _crs_text(self.argument, value)
        if hasattr(value, "item"):  # a number of NumPy's
            value = value.item()
        if isinstance(value, (int, float)) and not isinstance(value, bool):
            return repr(value)
        raise TypeError(f"{self.argument} cannot be {value!r}")


def _crs_text(argument, crs):
    """A code is one of EPSG; objects of pyproj, rasterio and geopandas say themselves as WKT."""
    if isinstance(crs, int):
        return f"EPSG:{crs}"
    if hasattr(crs, "to_wkt"):
        return crs.to_wkt()
    raise TypeError(f"{argument} must be a text, a code of EPSG or an object with to_wkt(), not {crs!r}")


class OptionSet:
    """The options that a function takes."""

    def __init__(self, function, rows):
        self._function = function
        self._options = {}
        for row in rows:
            argument = row["python"]["name"] if "python" in row else row["name"]
            self._options[argument] = Option(row["name"], argument, row)

    def __iter__(self):
        return iter(self._options.values())

    def given(self, values):
        """The program's words: pairs of names and values in bytes. None marks an option that is not given."""
        pairs = []
        for argument, value in values.items():
            if argument not in self._options:
                near = difflib.get_close_matches(argument, self._options, 1)
                hint = f"; did you mean {near[0]!r}?" if near else ""
                raise TypeError(f"{self._function}() has no argument {argument!r}{hint}")
            if value is not None:
                option = self._options[argument]
                pairs += [(option.name, [option.encoded(text) for text in texts]) for texts in option.texts(value)]
        return pairs

    def describe(self, function):
        """Gives the function the signature and the docstring that belong to its options."""
        own = [parameter for parameter in inspect.signature(function).parameters.values()
               if parameter.kind is not inspect.Parameter.VAR_KEYWORD]
        options = [inspect.Parameter(option.argument, inspect.Parameter.KEYWORD_ONLY, default=None) for option in self]
        function.__signature__ = inspect.Signature(own + options)
        function.__doc__ = inspect.cleandoc(function.__doc__) + "\n\nOptions:\n" + "".join(map(self._entry, self))
        return function

    def _entry(self, option):
        indent = 8 * " "
        text = textwrap.fill(self.in_python(option.help), 100, initial_indent=indent, subsequent_indent=indent)
        return f"    {option.argument}: {option.takes}\n{text}\n"

    def in_python(self, message):
        """A message in which options have the names of arguments: "-3d" is "with_z=". Names of files stay."""
        names = {option.name: option.argument for option in self}
        alternatives = "|".join(sorted(map(re.escape, names), key=len, reverse=True))
        pattern = rf"""('[^']*'|"[^"]*")|(?<![\w-])-({alternatives})(?![\w-])"""
        return re.sub(pattern, lambda match: match[1] or names[match[2]] + "=", message)


def _taken_by(function):
    rows = json.loads(_core.options_json())["options"]
    return OptionSet(function, [row for row in rows if row["python"][function]])


EXTRACT = _taken_by("extract")
EXTRACT_FILE = _taken_by("extract_file")
SCORE = OptionSet("score", json.loads(_core.score_options_json()))
