"""Names of files that are any bytes: "Geb\\xe4ude", as archives of another time unpack."""

import os
import pathlib
import shutil
import sqlite3
import unittest
import warnings
import xml.dom.minidom

import numpy

import dem2buildings
from python_case import PLACE, SAMPLES, PythonCase, block, write_grid

NAME = b"Geb\xe4ude"
READABLE = "Geb\ufffdude"
THESIS = SAMPLES / "thesis_50x36.tif"


class Names(PythonCase):
    def place(self, suffix):
        return os.path.join(os.fsencode(self.folder), NAME + suffix)

    def source(self):
        shutil.copy(THESIS, self.place(b".tif"))
        return self.place(b".tif")

    def write(self, suffix, array):
        return write_grid(self.place(suffix), array)

    def forms(self, path):
        """The types of names that os.fsencode() takes."""
        return path, os.fsdecode(path), pathlib.Path(os.fsdecode(path))

    def test_the_dem(self):
        plain = dem2buildings.extract(THESIS)
        for path in self.forms(self.source()):
            with self.subTest(path=path):
                found = dem2buildings.extract(path)
                self.assertEqual(found.buildings.wkb.tolist(), plain.buildings.wkb.tolist())
                self.assertTrue(found.metadata["D2B_SOURCE"].endswith(f"/{READABLE}.tif"))
                self.assertTrue(found.report["input"]["name"].endswith(f"/{READABLE}.tif"))

    def test_every_other_path(self):
        source = self.write(b".asc", block())
        self.write(b"_ground.asc", numpy.zeros((40, 50)))
        self.write(b"_mask.asc", numpy.ones((40, 50)))
        for i, path in enumerate(self.forms(self.place(b".gpkg"))):
            kind = (os.fsencode, os.fsdecode, lambda name: pathlib.Path(os.fsdecode(name)))[i]
            beside = {name: kind(self.place(b"_" + name.encode() + end))
                      for name, end in (("write_ground", b".tif"), ("surface", b".obj"), ("preview", b".png"))}
            report = dem2buildings.extract_file(source, path, ground=kind(self.place(b"_ground.asc")), overwrite=True,
                                                mask=kind(self.place(b"_mask.asc")), **beside)
            self.assertTrue(report["output"]["name"].endswith(f"/{READABLE}.gpkg"))
            for name in beside.values():
                self.assertTrue(os.path.exists(name))
            self.assertEqual(report["output"]["buildings"], 1)
            self.assertEqual(dem2buildings.score(path, path, dem=source)["iou"], 1)

    def test_what_is_written_is_text(self):
        dem2buildings.extract_file(self.source(), self.place(b".gpkg"), nln=os.fsdecode(NAME), layers="buildings",
                                   lco={"IDENTIFIER": os.fsdecode(NAME)}, surface=self.folder / "town.obj")
        (self.folder / "town.obj").read_text(encoding="utf-8")
        with sqlite3.connect(self.place(b".gpkg")) as database:
            self.assertIn((READABLE,), database.execute("SELECT identifier FROM gpkg_contents").fetchall())
            for table, column in (("gpkg_contents", "description"), ("gpkg_metadata", "metadata"),
                                  ("gpkg_contents", "table_name"), ("layer_styles", "f_table_name"),
                                  ("layer_styles", "styleQML")):
                texts = [text for text, in database.execute(f"SELECT {column} FROM {table}")]  # sqlite3 decodes them
                self.assertTrue(texts, table)
            for text, in database.execute("SELECT metadata FROM gpkg_metadata WHERE mime_type = 'text/xml'"):
                xml.dom.minidom.parseString(text)

    def test_messages(self):
        missing = self.place(b"_missing.tif")
        with self.assertRaisesRegex(dem2buildings.InputError, f"{READABLE}_missing.tif"):
            dem2buildings.extract(missing)
        with self.assertRaisesRegex(dem2buildings.InputError, f"{READABLE}_missing.tif"):
            dem2buildings.extract(block(), ground=missing, **PLACE)
        with self.assertRaisesRegex(dem2buildings.OptionError, READABLE):
            dem2buildings.extract(block(), preset=os.fsdecode(NAME), **PLACE)

    def test_a_null_character_ends_no_name(self):
        target = os.path.join(self.folder, "found.gpkg")
        for call in (lambda: dem2buildings.extract(f"{THESIS}\0.txt"),
                     lambda: dem2buildings.extract_file(f"{THESIS}\0.txt", target),
                     lambda: dem2buildings.extract_file(THESIS, f"{target}\0.gpkg"),
                     lambda: dem2buildings.extract_file(THESIS, target, nln="a\0b"),
                     lambda: dem2buildings.extract_file(THESIS, target, surface=f"{target}.obj\0.stl"),
                     lambda: dem2buildings.score(f"{target}\0.gpkg", target)):
            with self.assertRaisesRegex(ValueError, "null character"):
                call()
        self.assertFalse(os.path.exists(target))

    def test_warnings(self):
        flat = self.write(b"_flat.asc", numpy.zeros((20, 20)))
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            found = dem2buildings.extract(flat)
        self.assertEqual([str(warning.message) for warning in caught], found.report["warnings"])
        self.assertTrue(any(READABLE in text for text in found.report["warnings"]), found.report["warnings"])

    def test_values_of_a_field(self):
        """Parcels whose names are bytes of Latin-1 in a table that says nothing of it."""
        parcels = self.place(b"_parcels.csv")
        ring = "391000 5820000, 391050 5820000, 391050 5820040, 391000 5820040, 391000 5820000"
        with open(parcels, "wb") as file:
            file.write(b'name,WKT\n"' + NAME + b'","POLYGON ((' + ring.encode() + b'))"\n')
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            found = dem2buildings.extract(block(), split_by=parcels, split_field="name", **PLACE)
        self.assertEqual(found.buildings.columns["parcel"].tolist(), [READABLE])
        self.assertEqual(found.buildings[0]["properties"]["parcel"], READABLE)


if __name__ == "__main__":
    unittest.main()
