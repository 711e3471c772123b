"""extract_file(): writes the files of the program by a call."""

import pathlib
import resource
import unittest
import warnings

import dem2buildings
from python_case import SAMPLES, PythonCase, layer_of

TOWN = SAMPLES / "town.tif"
PART = {"te": (391100, 5820100, 391400, 5820300)}
PART_OPTIONS = ("-te", "391100", "5820100", "391400", "5820300")


class ExtractFile(PythonCase):
    def target(self, name="own.gpkg"):
        return self.folder / name

    def assert_same_file(self, one, other, layers=("buildings", "contours")):
        for layer in layers:
            self.assertEqual(layer_of(one, layer), layer_of(other, layer), layer)

    def test_the_same_as_the_program(self):
        written = self.program(TOWN, "-3d", "-nln", "town", "-split_height", "3")
        report = dem2buildings.extract_file(TOWN, self.target(), with_z=True, nln="town", split_height=3)
        self.assert_same_file(self.target(), written, ("town", "town_contours"))
        self.assertEqual(report["output"]["name"], str(self.target()))
        self.assertGreater(report["output"]["buildings"], 100)

    def test_what_is_written_beside(self):
        beside = {f"write_{name}": self.target(f"{name}.tif") for name in ("ground", "height", "canopy")}
        dem2buildings.extract_file(TOWN, self.target(), **PART, **beside, preview=self.target("look.png"))
        program = {f"-write_{name}": str(self.folder / f"{name}_program.tif") for name in ("ground", "height", "canopy")}
        options = [text for pair in program.items() for text in pair]
        self.program(TOWN, *PART_OPTIONS, *options, "-preview", str(self.folder / "look_program.png"))
        for name in ("ground.tif", "height.tif", "canopy.tif", "look.png"):
            stem, extension = name.split(".")
            self.assertEqual((self.folder / name).read_bytes(), (self.folder / f"{stem}_program.{extension}").read_bytes(), name)

    def test_surfaces_in_several_formats(self):
        names = ("town.city.json", "town.obj", "town.stl", "town.glb")
        dem2buildings.extract_file(TOWN, self.target(), **PART, surface=[self.target(name) for name in names],
                                   surface_of="contours")
        program = [str(self.folder / f"program_{name}") for name in names]
        self.program(TOWN, *PART_OPTIONS, "-surface_of", "contours", *(text for name in program for text in ("-surface", name)))
        for name, same in zip(names, program):
            # An OBJ names its materials after itself.
            expected = pathlib.Path(same).read_bytes().replace(b"mtllib program_", b"mtllib ")
            self.assertEqual(self.target(name).read_bytes(), expected, name)

    def test_a_terrain_and_a_mask(self):
        ground = self.target("ground.tif")
        dem2buildings.extract_file(TOWN, self.target("first.gpkg"), **PART, write_ground=ground)
        written = self.program(TOWN, *PART_OPTIONS, "-ground", str(ground), "-mask", str(self.target("first.gpkg")),
                               "-mask_layer", "buildings")
        options = {"ground": ground, "mask": self.target("first.gpkg"), "mask_layer": "buildings"}
        dem2buildings.extract_file(TOWN, self.target(), **PART, **options)
        self.assert_same_file(self.target(), written)
        found = dem2buildings.extract(TOWN, **PART, **options)
        self.assert_same_features(found, written)

    def test_one_layer_a_file(self):
        with self.assertWarnsRegex(UserWarning, "use layers= contours"):
            dem2buildings.extract_file(TOWN, self.target("own.geojson"), **PART)
        self.assertTrue(self.target("own.geojson").exists())

    def test_an_existing_file(self):
        dem2buildings.extract_file(TOWN, self.target(), **PART)
        with self.assertRaisesRegex(dem2buildings.OptionError, "give overwrite= to replace .* append= to add"):
            dem2buildings.extract_file(TOWN, self.target(), **PART)
        dem2buildings.extract_file(TOWN, self.target(), **PART, overwrite=True)
        report = dem2buildings.extract_file(TOWN, self.target(), **PART, append=True)
        self.assertEqual(len(layer_of(self.target(), "buildings")[0]), 2 * report["output"]["buildings"])

    def test_refusals(self):
        with self.assertRaisesRegex(dem2buildings.OptionError, "is the source"):
            dem2buildings.extract_file(TOWN, TOWN)
        with self.assertRaisesRegex(dem2buildings.OptionError, "destination is empty"):
            dem2buildings.extract_file(TOWN, "")
        with self.assertRaisesRegex(dem2buildings.OptionError, "extension"):
            dem2buildings.extract_file(TOWN, self.target("own.xyz"))
        with self.assertRaisesRegex(dem2buildings.InputError, "nowhere.tif"):
            dem2buildings.extract_file("nowhere.tif", self.target())
        with self.assertRaises(dem2buildings.OutputError) as caught:
            dem2buildings.extract_file(TOWN, self.folder / "no" / "such" / "folder.gpkg", **PART)
        self.assertIsInstance(caught.exception, OSError)
        with self.assertRaisesRegex(TypeError, "no argument 'transform'"):
            dem2buildings.extract_file(TOWN, self.target(), transform=(0, 1, 0, 0, 0, -1))
        with self.assertRaisesRegex(TypeError, "PathLike"):
            dem2buildings.extract_file(TOWN, None)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_what_is_stopped_leaves_nothing(self):
        with self.assertRaises(dem2buildings.Cancelled):
            dem2buildings.extract_file(TOWN, self.target(), progress=lambda share: False)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_a_file_that_does_not_fit_leaves_nothing(self):
        usual = resource.getrlimit(resource.RLIMIT_FSIZE)
        beside = {"write_ground": self.folder / "ground.tif", "surface": self.folder / "city.glb", **PART}
        for limit in (1_000, 20_000, 60_000):
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit, usual[1]))
            try:
                with self.assertRaisesRegex(dem2buildings.OutputError, "Cannot write"):
                    dem2buildings.extract_file(TOWN, self.target(), **beside)
            finally:
                resource.setrlimit(resource.RLIMIT_FSIZE, usual)
            self.assertEqual(list(self.folder.iterdir()), [])
        dem2buildings.extract_file(TOWN, self.target(), **beside)
        self.assertEqual(len(list(self.folder.iterdir())), 3)

    def test_a_warning_as_an_error_leaves_nothing(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            with self.assertRaises(UserWarning):
                dem2buildings.extract_file(SAMPLES / "thesis_11x7.tif", self.target(), zrange=(0, 45), preset="thesis")
        self.assertEqual(list(self.folder.iterdir()), [])


if __name__ == "__main__":
    unittest.main()
