"""Arguments are the options of the program's table: names, values, checks, words and types."""

import ast
import inspect
import json
import pathlib
import subprocess
import types
import unittest

import numpy

import dem2buildings
from dem2buildings import _options
from python_case import PLACE, TOOL, PythonCase, block


def find(**options):
    return dem2buildings.extract(block(), **{**PLACE, **options})


def table():
    done = subprocess.run([TOOL, "-options_json"], check=True, capture_output=True, text=True)
    return {row["name"]: row for row in json.loads(done.stdout)["options"]}


class Options(PythonCase):
    def test_both_functions_take_what_means_something_there(self):
        asked_for = {"q", "json", "help", "help_all", "version", "man", "options_md", "options_json", "bash_completion",
                     "p", "sweep"}
        of_files = {"f", "dsco", "lco", "nln", "overwrite", "append", "arcs", "write_ground", "write_height",
                    "write_canopy", "surface", "surface_of", "surface_roof", "surface_solids",
                    "surface_origin", "page", "preview", "preview_size", "preview_paper", "preview_scale",
                    "landscape", "title", "credit"}
        self.assertEqual({option.name for option in _options.EXTRACT_FILE}, set(table()) - asked_for)
        self.assertEqual({option.name for option in _options.EXTRACT}, set(table()) - asked_for - of_files)

    def test_every_argument_is_a_name_of_python(self):
        for options in (_options.EXTRACT, _options.EXTRACT_FILE):
            for option in options:
                self.assertTrue(option.argument.isidentifier(), option)
        arguments = {option.name: option.argument for option in _options.EXTRACT_FILE}
        self.assertEqual({name: argument for name, argument in arguments.items() if name != argument},
                         {"3d": "with_z", "if": "input_format", "a_srs": "crs", "snodata": "nodata"})

    def test_any_other_name_is_a_type_error(self):
        for name in ("lodd", "q", "json", "overwrite", "arcs", "3d", "a_srs", "snodata", "of"):
            with self.subTest(name=name), self.assertRaisesRegex(TypeError, f"no argument '{name}'"):
                find(**{name: 1})
        with self.assertRaisesRegex(TypeError, "did you mean 'min_height'"):
            find(min_heigth=3)

    def test_values_of_every_kind(self):
        options = {option.argument: option for option in _options.EXTRACT_FILE}

        def texts(name, value):
            return options[name].texts(value)

        self.assertEqual(texts("with_z", True), [[]])
        self.assertEqual(texts("with_z", False), [])
        self.assertEqual(texts("with_z", numpy.True_), [[]])
        self.assertEqual(texts("with_z", numpy.False_), [])
        self.assertEqual(texts("lod", 6), [["6"]])
        self.assertEqual(texts("lod", numpy.int64(6)), [["6"]])
        self.assertEqual(texts("min_height", 0.1), [["0.1"]])
        self.assertEqual(texts("min_height", numpy.float32(0.5)), [["0.5"]])
        self.assertEqual(texts("te", (1, 2.5, 3, 4)), [["1", "2.5", "3", "4"]])
        self.assertEqual(texts("fl", numpy.array([10, 20.5])), [["10.0", "20.5"]])
        self.assertEqual(texts("fl", 10), [["10"]])
        self.assertEqual(texts("mask", pathlib.Path("a/b.shp")), [["a/b.shp"]])
        self.assertEqual(texts("mask", b"a/b.shp"), [["a/b.shp"]])
        self.assertEqual(texts("crs", 25833), [["EPSG:25833"]])
        self.assertEqual(texts("t_srs", types.SimpleNamespace(to_wkt=lambda: "LOCAL_CS[]")), [["LOCAL_CS[]"]])
        self.assertEqual(texts("dsco", {"VERSION": 1.4, "A": "B"}), [["VERSION=1.4"], ["A=B"]])
        self.assertEqual(texts("lco", ["A=B", "C=D"]), [["A=B"], ["C=D"]])
        self.assertEqual(texts("lco", "A=B"), [["A=B"]])

    def test_values_of_no_kind(self):
        for options in ({"with_z": 1}, {"with_z": "yes"}, {"lod": True}, {"lod": [1, 2]}, {"lod": object()},
                        {"mask": ["a", "b"]}, {"crs": 1.5}, {"preset": b"thesis"}):
            with self.subTest(options=options), self.assertRaises(TypeError):
                find(**options)

    def test_the_table_checks_values(self):
        for options, words in (({"lod": 0}, "lod= must be a whole number from 1 to 10000, not '0'."),
                               ({"lod": 1.5}, "lod= must be a whole number from 1 to 10000, not '1.5'."),
                               ({"min_height": float("nan")}, "min_height= must be a number of at least 0, not 'nan'."),
                               ({"preset": "house"}, "preset= must be buildings or thesis, not 'house'."),
                               ({"te": (1, 2)}, "te= needs 4 values"),
                               ({"mask": ""}, "mask= needs a value"),
                               ({"i": 2, "fl": [3]}, "fl= cannot be used together with i=")):
            with self.subTest(options=options), self.assertRaises(dem2buildings.OptionError) as caught:
                find(**options)
            self.assertIn(words, str(caught.exception))
            self.assertIsInstance(caught.exception, ValueError)

    def test_messages_speak_of_arguments(self):
        words = _options.EXTRACT.in_python
        self.assertEqual(words("give it with -a_srs, or -3d and -te 1 -2 3 4."), "give it with crs=, or with_z= and te= 1 -2 3 4.")
        self.assertEqual(words("'a -te b' and \"-b\" stay, so does x-te and -tee"),
                         "'a -te b' and \"-b\" stay, so does x-te and -tee")

    def test_none_is_not_given(self):
        self.assertEqual(find(lod=None, te=None, with_z=None).contours.wkb.tolist(), find().contours.wkb.tolist())

    def test_help_is_that_of_the_table(self):
        rows = table()
        for function, options in ((dem2buildings.extract, _options.EXTRACT),
                                  (dem2buildings.extract_file, _options.EXTRACT_FILE)):
            words = " ".join(function.__doc__.split())
            parameters = inspect.signature(function).parameters
            for option in options:
                self.assertIn(option.argument, parameters)
                self.assertIn(" ".join(options.in_python(rows[option.name]["help"]).split()), words)
                self.assertIn(f"{option.argument}: ", function.__doc__)

    def test_the_stub_has_the_same_functions(self):
        package = pathlib.Path(dem2buildings.__file__).parent
        self.assertTrue((package / "py.typed").exists())
        stub = ast.parse((package / "__init__.pyi").read_text())
        functions = {node.name: node for node in stub.body if isinstance(node, ast.FunctionDef)}
        names = {node.name for node in stub.body if isinstance(node, (ast.FunctionDef, ast.ClassDef))}
        self.assertEqual(names - {"_HasWkt", "_HasGdalTerms", "_Frame"}, set(dem2buildings.__all__))
        for name, node in functions.items():
            parameters = inspect.signature(getattr(dem2buildings, name)).parameters.values()
            positional = [p.name for p in parameters if p.kind is p.POSITIONAL_OR_KEYWORD]
            keyword = [p.name for p in parameters if p.kind is p.KEYWORD_ONLY]
            self.assertEqual([argument.arg for argument in node.args.args], positional)
            self.assertEqual([argument.arg for argument in node.args.kwonlyargs], keyword)
            self.assertTrue(all(argument.annotation for argument in node.args.args + node.args.kwonlyargs))
        classes = {node.name: node for node in stub.body if isinstance(node, ast.ClassDef)}
        members = {item.name for item in classes["Layer"].body if isinstance(item, ast.FunctionDef)}
        self.assertEqual(members, {name for name in vars(dem2buildings.Layer)
                                   if name in members or not name.startswith(("__", "_pybind11"))})


if __name__ == "__main__":
    unittest.main()
