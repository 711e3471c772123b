"""score(): files and results, against the program."""

import json
import subprocess
import unittest

import dem2buildings
from python_case import PLACE, SAMPLES, SCORE_TOOL, PythonCase, block

TOWN = SAMPLES / "town.tif"
TRUTH = SAMPLES / "town_truth.gpkg"


def program(*arguments):
    done = subprocess.run([SCORE_TOOL, "-json", *map(str, arguments)], check=True, capture_output=True, text=True)
    return json.loads(done.stdout)


class Scores(PythonCase):
    def test_files_as_the_program(self):
        written = self.program(TOWN)
        self.assertEqual(dem2buildings.score(written, TRUTH, dem=TOWN, min_object=80, reference_layer="buildings"),
                         program("-dem", TOWN, "-min_object", 80, "-reference_layer", "buildings", written, TRUTH))

    def test_a_result_is_as_its_file(self):
        written = self.program(TOWN)
        found = dem2buildings.extract(TOWN)
        by_file = program("-reference_layer", "buildings", written, TRUTH)
        self.assertGreater(by_file["completeness"], 0.9)
        self.assertIsNotNone(by_file["height_error"])
        by_result = dem2buildings.score(found, TRUTH, reference_layer="buildings")
        by_file["found"]["dataset"] = by_result["found"]["dataset"]
        self.assertEqual(by_result, by_file)

    def test_results_on_both_sides(self):
        found = dem2buildings.extract(block(), **PLACE)
        score = dem2buildings.score(found, found)
        self.assertEqual((score["iou"], score["completeness"], score["overlap"]), (1, 1, 0))
        self.assertEqual(score["height_error"]["rms_m"], 0)
        self.assertEqual(score["height_field"], "height")
        self.assertEqual(score["crs"], "ETRS89 / UTM zone 33N")
        by_p50 = dem2buildings.score(found, found, height_field="p50")
        self.assertEqual(by_p50["height_field"], "p50")

    def test_a_result_carries_its_crs(self):
        found = dem2buildings.extract(block(), **PLACE)
        elsewhere = dem2buildings.extract(block(), **PLACE, t_srs="EPSG:4326")
        self.assertAlmostEqual(dem2buildings.score(elsewhere, found)["iou"], 1, places=5)

    def test_refusals(self):
        found = dem2buildings.extract(block(), **PLACE)
        contours = dem2buildings.extract(block(), **PLACE, layers="contours")
        for error, words, arguments, options in (
                (dem2buildings.InputError, "nowhere.gpkg", ("nowhere.gpkg", TRUTH), {}),
                (dem2buildings.OptionError, "^min_object= must be", (found, TRUTH), {"min_object": -1}),
                (dem2buildings.OptionError, "no heights in a column 'doubt'", (found, found), {"height_field": "doubt"}),
                (dem2buildings.OptionError, "cannot be chosen", (found, TRUTH), {"layer": "contours"}),
                (dem2buildings.InputError, "do not meet", (found, SAMPLES / "samples_truth.gpkg"), {}),
                (ValueError, "has no buildings", (contours, TRUTH), {}),
                (TypeError, "no argument 'json'", (found, TRUTH), {"json": True}),
                (TypeError, "PathLike", (3, TRUTH), {})):
            with self.subTest(words=words), self.assertRaisesRegex(error, words):
                dem2buildings.score(*arguments, **options)


if __name__ == "__main__":
    unittest.main()
