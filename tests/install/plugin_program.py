#!/usr/bin/python3
"""How the plugin of QGIS finds the program and reads its output; QGIS itself is not needed.

    plugin_program.py <folder of the plugin>
"""

import os
import pathlib
import shutil
import sys
import tempfile
import types
import unittest


class Settings:
    def value(self, _name, default):
        return default


sys.modules["qgis"] = types.ModuleType("qgis")
sys.modules["qgis.core"] = types.ModuleType("qgis.core")
sys.modules["qgis.core"].QgsSettings = Settings


class Program(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        shutil.copy(pathlib.Path(FOLDER) / "program.py", self.folder.name)
        sys.path.insert(0, self.folder.name)
        sys.modules.pop("program", None)
        import program
        self.program = program
        os.environ["PATH"] = ""
        os.environ.pop("DEM2BUILDINGS", None)

    def tearDown(self):
        sys.path.remove(self.folder.name)
        self.folder.cleanup()

    def put(self, *parts):
        place = pathlib.Path(self.folder.name, *parts)
        place.parent.mkdir(exist_ok=True)
        place.write_bytes('#!/bin/sh\necho \'{"options": ["Häuser"]}\'\n'.encode())
        place.chmod(0o755)
        return str(place)

    def test_a_folder_in_the_plugin_comes_last(self):
        beside = self.put("bin", "dem2buildings")
        self.assertEqual(self.program.find(), beside)
        other = self.put("path", "dem2buildings")
        os.environ["PATH"] = os.path.dirname(other)
        self.assertEqual(self.program.find(), other)
        os.environ["DEM2BUILDINGS"] = "given"
        self.assertEqual(self.program.find(), "given")

    def test_output_is_utf8_in_any_locale(self):
        self.put("bin", "dem2buildings")
        self.assertEqual(self.program.options(), ["Häuser"])

    def test_says_where_to_get_it(self):
        for platform, words in (("win32", "OSGeo4W"), ("linux", "Debian package"), ("darwin", "from the sources")):
            # shutil.which() of another system is not here.
            with unittest.mock.patch.object(sys, "platform", platform), unittest.mock.patch("shutil.which"):
                shutil.which.return_value = None
                with self.assertRaisesRegex(self.program.NotFound, words):
                    self.program.find()


if __name__ == "__main__":
    import unittest.mock
    FOLDER = sys.argv.pop(1)
    unittest.main()
