"""Each rule of check_cityjson.py finds files that break it. `python3 test_check_cityjson.py`"""

import copy
import unittest

import check_cityjson

CUBE = {
    "type": "CityJSON", "version": "2.0",
    "transform": {"scale": [0.001, 0.001, 0.001], "translate": [0, 0, 0]},
    "metadata": {"referenceSystem": "https://www.opengis.net/def/crs/EPSG/0/25832"},
    "CityObjects": {"building_1": {
        "type": "Building", "attributes": {"id": 1, "doubt": None},
        "geometry": [{
            "type": "Solid", "lod": "1.2",
            "boundaries": [[[[4, 5, 6, 7]], [[0, 1, 5, 4]], [[1, 2, 6, 5]], [[2, 3, 7, 6]], [[3, 0, 4, 7]], [[3, 2, 1, 0]]]],
            "semantics": {"surfaces": [{"type": "RoofSurface"}, {"type": "WallSurface"}, {"type": "GroundSurface"}],
                          "values": [[0, 1, 1, 1, 1, 2]]}}]}},
    "vertices": [[0, 0, 0], [9, 0, 0], [9, 9, 0], [0, 9, 0], [0, 0, 9], [9, 0, 9], [9, 9, 9], [0, 9, 9]]}


class Rules(unittest.TestCase):
    def found(self, change):
        city = copy.deepcopy(CUBE)
        change(city, city["CityObjects"]["building_1"]["geometry"][0])
        return " ".join(check_cityjson.faults(city))

    def test_a_cube_is_valid(self):
        self.assertEqual(list(check_cityjson.faults(CUBE)), [])

    def test_a_city_without_buildings_is_valid(self):
        empty = dict(CUBE, CityObjects={}, vertices=[])
        self.assertEqual(list(check_cityjson.faults(empty)), [])

    def test_parts_and_their_building_name_each_other(self):
        part = dict(CUBE["CityObjects"]["building_1"], type="BuildingPart", parents=["whole_1"])
        whole = {"type": "Building", "children": ["building_1"]}
        objects = {"building_1": part, "whole_1": whole}
        self.assertEqual(list(check_cityjson.faults(dict(CUBE, CityObjects=objects))), [])
        for words, change in (
                ("building_1 is no child of whole_1", {"whole_1": dict(whole, children=["other"])}),
                ("building_1 is no part of whole_1", {"building_1": dict(part, parents=["whole_2"])}),
                ("CityObjects/whole_1", {"whole_1": {"type": "Building"}}),
                ("CityObjects/whole_1", {"whole_1": dict(part, type="Building", children=["building_1"])}),
                ("CityObjects/building_1", {"building_1": {key: part[key] for key in part if key != "parents"}})):
            with self.subTest(words):
                found = " ".join(check_cityjson.faults(dict(CUBE, CityObjects=dict(objects, **change))))
                self.assertIn(words, found)

    def test_what_is_broken_is_found(self):
        def faces(solid):
            return solid["boundaries"][0]
        for words, change in (
                ("version", lambda c, s: c.update(version="1.1")),
                ("is not of type 'integer'", lambda c, s: c["vertices"].append([0.5, 0, 0])),
                ("does not match", lambda c, s: c["metadata"].update(referenceSystem="EPSG:25832")),
                ("does not match", lambda c, s: s.update(lod="2")),
                ("not there", lambda c, s: faces(s)[0][0].__setitem__(0, 8)),
                ("not used", lambda c, s: c["vertices"].append([1, 1, 1])),
                ("there twice", lambda c, s: c["vertices"].append([0, 0, 0])),
                ("once each way", lambda c, s: (faces(s).pop(), s["semantics"]["values"][0].pop())),
                ("looks to", lambda c, s: faces(s)[0][0].reverse()),
                ("looks to", lambda c, s: s["semantics"]["values"][0].__setitem__(1, 0)),
                ("not every face", lambda c, s: s["semantics"]["values"][0].append(1)),
                ("not plane", lambda c, s: c["vertices"].__setitem__(6, [9, 9, 8])),
                ("corners within a millimetre as one", lambda c, s: c["transform"].update(scale=[0.0001, 0.001, 0.001])),
                ("corners within a millimetre as one", lambda c, s: c["transform"].update(scale=[0.001, 0.001, 0.0001])),
                ("encloses nothing", lambda c, s: [ring.reverse() for face in faces(s) for ring in face])):
            with self.subTest(words=words):
                self.assertIn(words, self.found(change))


if __name__ == "__main__":
    unittest.main()
