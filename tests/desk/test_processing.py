"""The provider of the Processing toolbox: installed from its zip, run through qgis_process and in QGIS."""

import configparser
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import unittest
import zipfile

import desk_case
from desk_case import TOOL, DeskCase

ZIP = os.environ.get("D2B_QGIS_ZIP", str(desk_case.SOURCE / "build/tools/qgis/dem2buildings_qgis.zip"))
os.environ["DEM2BUILDINGS"] = TOOL

sys.path.append("/usr/share/qgis/python/plugins")
from processing.core.Processing import Processing
from qgis.core import (QgsApplication, QgsCoordinateTransformContext, QgsFeature, QgsFeatureRequest, QgsGeometry,
                       QgsProcessingContext, QgsProcessingException, QgsProcessingFeedback,
                       QgsProcessingParameterDefinition, QgsProcessingUtils, QgsProject, QgsRasterLayer, QgsRectangle,
                       QgsVectorFileWriter, QgsVectorLayer)

ALGORITHM = "dem2buildings:extractbuildings"


def plugin_metadata(path):
    metadata = configparser.ConfigParser()
    metadata.read(path)
    return metadata["general"]


class Feedback(QgsProcessingFeedback):
    """Remembers its messages, and cancels at a share of the progress."""

    def __init__(self, cancel_at=None):
        super().__init__(False)
        self.seen, self.lines, self.cancel_at = [], [], cancel_at
        self.progressChanged.connect(self.note)

    def note(self, percent):
        self.seen.append(percent)
        if self.cancel_at is not None and percent >= self.cancel_at:
            self.cancel()

    def pushInfo(self, text):
        self.lines.append(text)

    def pushCommandInfo(self, text):
        self.lines.append(text)

    def pushWarning(self, text):
        self.lines.append(text)


class Toolbox(DeskCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.plugins = cls.folder / "profile/python/plugins"
        with zipfile.ZipFile(ZIP) as packed:
            packed.extractall(cls.plugins)
        sys.path.insert(0, str(cls.plugins))
        Processing.initialize()
        import dem2buildings
        cls.plugin = dem2buildings.classFactory(None)
        cls.plugin.initProcessing()

    @classmethod
    def tearDownClass(cls):
        cls.plugin.unload()
        super().tearDownClass()

    def algorithm(self):
        algorithm = QgsApplication.processingRegistry().createAlgorithmById(ALGORITHM)
        self.assertIsNotNone(algorithm)
        return algorithm

    def run_it(self, feedback=None, **given):
        context = QgsProcessingContext()
        context.setProject(QgsProject.instance())
        given.setdefault("INPUT", str(self.folder / "hotel_70x85.tif"))
        given.setdefault("OUTPUT", str(self.folder / "out.gpkg"))
        results, well = self.algorithm().run(given, context, feedback or Feedback(), {}, False)
        return results, well, context

    def log_of(self, **given):
        feedback = Feedback()
        results, well, _ = self.run_it(feedback, **given)
        self.assertTrue(well)
        return results, "\n".join(feedback.lines)

    def test_every_option_of_the_program_has_its_parameter(self):
        table = json.loads(subprocess.run([TOOL, "-options_json"], check=True, capture_output=True).stdout)["options"]
        algorithm = self.algorithm()
        shown = {one.name(): one for one in algorithm.parameterDefinitions()}
        from dem2buildings.parameters import LEFT_OUT
        wanted = {option["name"] for option in table if not option["hidden"]} - LEFT_OUT
        surfaces = {"surface_cityjson", "surface_obj", "surface_stl", "surface_glb"}
        self.assertEqual(set(shown), wanted - {"surface"} | surfaces | {"INPUT", "OUTPUT", "LOAD", "ground_model"})
        self.assertGreater(len(wanted), 30)
        lod = shown["lod"]
        self.assertEqual((lod.defaultValue(), lod.minimum(), lod.maximum()), (4, 1, 10000))
        files = lambda name: shown[name].metadata()["widget_wrapper"]["files"]
        self.assertEqual(files("preview"), "PNG (*.png);;SVG (*.svg);;PDF (*.pdf)")
        self.assertEqual(files("page"), "HTML (*.html)")
        self.assertEqual(files("surface_cityjson"), "CITY.JSON (*.city.json)")
        self.assertEqual(shown["surface_glb"].description(), "Output: Surface of the buildings (.glb)")
        self.assertEqual(shown["preset"].options(), ["Find buildings", "All above thresholds (thesis)"])
        self.assertTrue(shown["zrange"].flags() & QgsProcessingParameterDefinition.FlagAdvanced)

    def test_eight_parameters_are_seen_at_first(self):
        algorithm = self.algorithm()  # owns the definitions
        shown = [one for one in algorithm.parameterDefinitions()
                 if not one.flags() & QgsProcessingParameterDefinition.FlagAdvanced]
        self.assertEqual([one.name() for one in shown],
                         ["INPUT", "te", "ground_model", "min_building_height", "min_area", "min_confidence", "split_height",
                          "OUTPUT"])
        self.assertEqual([one.description() for one in shown][2:4],
                         ["Terrain model (DTM), if there is one", "Minimum height of a building [m]"])

    def test_the_window_shows_no_more(self):
        """Processing shows outputs whatever their flags say; files have a widget that asks for a name to write."""
        from processing.gui.ParametersPanel import ParametersPanel
        from qgis.gui import QgsFileWidget, QgsMessageBar
        from qgis.PyQt.QtWidgets import QComboBox, QDialog, QLineEdit

        class Window(QDialog):
            def messageBar(self):
                return bar
        bar = QgsMessageBar()
        window, algorithm = Window(), self.algorithm()
        panel = ParametersPanel(window, algorithm)
        window.show()
        self.assertEqual(len(algorithm.destinationParameterDefinitions()), 1)
        page = panel.wrappers["page"]
        self.assertEqual(page.widget.storageMode(), QgsFileWidget.SaveFile)
        page.setValue("/tmp/town.html")
        self.assertEqual(page.value(), "/tmp/town.html")
        # Values that the program decides are called "automatic", not "Not set".
        for name in ("preview_scale", "snodata", "i", "min_gap", "min_wall", "regularize_tolerance"):
            with self.subTest(name):
                number = panel.wrappers[name]
                line = number.widget.findChild(QLineEdit)
                self.assertEqual((number.value(), line.text()), (None, "automatic"))
                number.setValue(2.5)
                self.assertEqual(number.value(), 2.5)
                number.setValue(None)
                self.assertEqual((number.value(), line.text() or line.placeholderText()), (None, "automatic"))
        extent = panel.wrappers["te"]
        self.assertIn("whole raster", [line.text() for line in extent.widget.findChildren(QLineEdit)])
        extent.setValue("391150,391210,5820180,5820240 [EPSG:25833]")
        self.assertIn("391150", extent.value())
        extent.setValue(None)
        self.assertIsNone(extent.value())
        self.assertIn("whole raster", [line.text() for line in extent.widget.findChildren(QLineEdit)])
        for name in ("a_srs", "t_srs"):
            with self.subTest(name):
                crs = panel.wrappers[name]
                self.assertEqual(crs.widget.findChild(QComboBox).currentText(), "as the raster")
                crs.setValue("EPSG:25833")
                self.assertEqual(crs.value().authid(), "EPSG:25833")
        window.close()

    def test_a_model_may_give_each_number(self):
        from processing.modeler.ModelerParametersDialog import ModelerParametersDialog
        from qgis.core import QgsProcessingModelAlgorithm
        from qgis.gui import QgsProcessingModelerParameterWidget
        algorithm, model = self.algorithm(), QgsProcessingModelAlgorithm()
        dialog = ModelerParametersDialog(algorithm, model)
        for name in ("lod", "min_gap"):
            self.assertIsInstance(dialog.widget.widget.wrappers[name], QgsProcessingModelerParameterWidget)

    def test_advanced_parameters_come_in_groups(self):
        algorithm = self.algorithm()
        shown = [one for one in algorithm.parameterDefinitions() if one.name() not in ("INPUT", "OUTPUT", "LOAD")]
        names = [one.description() for one in shown]
        groups = [name.split(":")[0] if re.match("[A-Z][a-z]+: ", name) else "" for name in names]
        self.assertEqual(list(dict.fromkeys(groups)), ["", "Ground", "Trees", "Detail", "Output"])
        for name in ("Trees: Vegetation index (NDVI)", "Detail: Number of levels in a building", "Output: Title",
                     "Open options of the raster's format: NAME=VALUE", "Unit of the elevations: m, ft, us-ft or metres",
                     "Range of valid elevations: lowest and highest [vertical unit of the input]",
                     "Levels at these elevations: numbers with blanks between them [vertical unit of the input]",
                     "Origin of the surface: x, y and z [m]"):
            self.assertIn(name, names)

    def test_defaults_are_shown(self):
        """Neither "[Not selected]" nor "Not set" where the program has a value."""
        algorithm = self.algorithm()
        optional = QgsProcessingParameterDefinition.FlagOptional
        defaults = {"ground": 0, "layers": 2, "regularize": 0, "trace": 1, "levels": 1, "min_area": 30, "detail": 0.5,
                    "min_confidence": 0.5, "split_height": 0, "surface_roof": 0, "fields": 0, "surface_of": 0, "preview_paper": 0}
        for name, default in defaults.items():
            with self.subTest(name):
                parameter = algorithm.parameterDefinition(name)
                self.assertEqual(parameter.defaultValue(), default)
                self.assertFalse(parameter.flags() & optional)
        self.assertEqual(algorithm.parameterDefinition("surface_roof").options()[:2], ["Mean height", "Median height"])

    def test_layers_come_into_a_group_of_the_file(self):
        from processing.gui.Postprocessing import handleAlgorithmResults
        for name in ("one", "two"):
            _, well, context = self.run_it(OUTPUT=str(self.folder / f"{name}.gpkg"))
            self.assertTrue(well)
            handleAlgorithmResults(self.algorithm(), context, Feedback())
        root = QgsProject.instance().layerTreeRoot()
        for name in ("one", "two"):
            self.assertEqual({node.name() for node in root.findGroup(name).findLayers()}, {"buildings", "contours"})
        self.assertEqual([node for node in root.children() if node.nodeType() == 1], [])
        QgsProject.instance().clear()

    def test_a_model_may_use_the_layers_without_showing_them(self):
        results, well, context = self.run_it(LOAD=False)
        self.assertTrue(well)
        self.assertEqual(context.layersToLoadOnCompletion(), {})
        self.assertTrue(QgsVectorLayer(results["BUILDINGS"], "buildings", "ogr").isValid())

    def test_the_help_speaks_of_parameters_not_of_options(self):
        algorithm = self.algorithm()
        texts = [algorithm.shortHelpString(), *(one.help() for one in algorithm.parameterDefinitions())]
        for text in texts:
            self.assertNotRegex(text, r"(?<![\w-])--?[a-z][a-z0-9_]+")
        self.assertIn('instead of those of "Number of levels in a building"', " ".join(texts))

    def test_provider_and_algorithm_have_an_icon(self):
        algorithm = self.algorithm()
        for one in (algorithm, algorithm.provider()):
            self.assertTrue(pathlib.Path(one.svgIconPath()).exists())
            drawn = one.icon().pixmap(24, 24).toImage()
            self.assertGreater(len({drawn.pixel(x, y) for x in range(24) for y in range(24)}), 8)
        self.assertEqual(plugin_metadata(self.plugins / "dem2buildings/metadata.txt")["author"], "The dem2buildings authors")

    def test_defaults_are_left_to_the_program(self):
        algorithm = self.algorithm()
        given = {one.name(): one.defaultValue() for one in algorithm.parameterDefinitions()
                 if one.defaultValue() is not None}
        _, log = self.log_of(**given)
        self.assertIn(f"{TOOL} -overwrite -- ", log)

    def test_parameters_become_options(self):
        town = str(self.folder / "town.tif")
        _, log = self.log_of(INPUT=town, preset=0, min_height=2.5, lod=2, te="391100,391400,5820100,5820300 [EPSG:25833]",
                             ground_model=town, disjoint=True, fl=None, mask=town, t_srs="EPSG:4326",
                             write_ground=str(self.folder / "ground.tif"), layers=1)
        for words in ("-min_height 2.5", "-lod 2", "-te 391100.0 5820100.0 391400.0 5820300.0", f"-ground {town}",
                      "-disjoint", f"-mask {town}", "-t_srs EPSG:4326", "-layers contours",
                      f"-write_ground {self.folder / 'ground.tif'}"):
            self.assertIn(words, log)
        self.assertNotIn("-preset", log)
        self.assertNotIn("-fl", log)
        self.assertTrue((self.folder / "ground.tif").exists())
        picture = str(self.folder / "town.pdf")
        _, log = self.log_of(INPUT=town, preview=picture, preview_paper=0)
        self.assertNotIn("-preview_paper", log)
        _, log = self.log_of(INPUT=town, preview=picture, preview_paper=4, preview_scale=10000)
        self.assertIn("-preview_paper A3 -preview_scale 10000", log)
        _, log = self.log_of(preset=1, fl="15 60, 100")
        self.assertIn("-preset thesis", log)
        self.assertIn("-fl 15 60 100", log)

    def test_surfaces_have_a_file_a_format(self):
        files = {f"surface_{ending.replace('.', '')}": str(self.folder / f"town.{ending}")
                 for ending in ("city.json", "obj", "stl", "glb")}
        _, log = self.log_of(INPUT=str(self.folder / "town.tif"), surface_of=0, **files)
        for file in files.values():
            self.assertIn(f"-surface {file}", log)
            self.assertGreater(pathlib.Path(file).stat().st_size, 10000)

    def test_a_page_is_written(self):
        page = self.folder / "town.html"
        _, log = self.log_of(INPUT=str(self.folder / "town.tif"), page=str(page))
        self.assertIn(f"-page {page}", log)
        self.assertIn("A page of dem2buildings", page.read_text()[:100])

    def test_layers_are_loaded_in_their_style(self):
        results, well, context = self.run_it(INPUT=str(self.folder / "town.tif"))
        self.assertTrue(well)
        self.assertEqual(sorted(context.layersToLoadOnCompletion()), [results["BUILDINGS"], results["CONTOURS"]])
        for place, details in context.layersToLoadOnCompletion().items():
            layer = QgsProcessingUtils.mapLayerFromString(place, context)
            self.assertEqual(layer.renderer().type(), "singleSymbol")
            details.postProcessor().postProcessLayer(layer, context, Feedback())
            self.assertEqual(layer.renderer().type(), "RuleRenderer")
            self.assertGreater(layer.featureCount(), 300)

    def test_every_layer_of_the_run_is_loaded_and_no_other(self):
        target = str(self.folder / "layers.gpkg")
        results, _, _ = self.run_it(OUTPUT=target, roofs=True, write_doubtful=True, write_rejected=True)
        self.assertEqual(results, {"OUTPUT": target, **{name.upper(): f"{target}|layername={name}" for name in
                                                        ("buildings", "contours", "roofs", "doubtful", "rejected")}})
        results, _, _ = self.run_it(OUTPUT=target, layers=1, write_rejected=True)  # the others stay in the file
        self.assertEqual(results, {"OUTPUT": target, "CONTOURS": f"{target}|layername=contours",
                                   "REJECTED": f"{target}|layername=rejected"})
        results, _, _ = self.run_it(OUTPUT=target, layers=1, nln="bands")
        self.assertEqual(results, {"OUTPUT": target, "CONTOURS": f"{target}|layername=bands"})

    def areas(self):
        """A GeoPackage with two layers, of which the second covers the western half of the hotel."""
        target = self.folder / "areas.gpkg"
        if not target.exists():
            dem = QgsRasterLayer(str(self.folder / "hotel_70x85.tif"), "dem")
            box = dem.extent()
            for name, right in (("all", box.xMaximum()), ("west", box.center().x())):
                layer = QgsVectorLayer("Polygon?field=kind:string", name, "memory")
                layer.setCrs(dem.crs())
                feature = QgsFeature(layer.fields())
                feature.setAttribute("kind", "building")
                feature.setGeometry(QgsGeometry.fromRect(QgsRectangle(box.xMinimum(), box.yMinimum(), right,
                                                                      box.yMaximum())))
                layer.dataProvider().addFeatures([feature])
                options = QgsVectorFileWriter.SaveVectorOptions()
                options.layerName = name
                if target.exists():
                    options.actionOnExistingFile = QgsVectorFileWriter.CreateOrOverwriteLayer
                QgsVectorFileWriter.writeAsVectorFormatV3(layer, str(target), QgsCoordinateTransformContext(), options)
        return target

    def test_the_layer_that_was_chosen_is_the_one_that_is_named(self):
        for option, layer in (("cutline", "cutline_layer"), ("mask", "mask_layer"), ("split_by", "split_layer"),
                              ("footprints", "footprints_layer"), ("exclude", "exclude_layer"),
                              ("corrections", "corrections_layer")):
            for place in ("layername=west", "layerid=1"):
                _, log = self.log_of(**{option: f"{self.areas()}|{place}"})
                self.assertIn(f"-{option} {self.areas()} -{layer} west", log)
                self.assertNotIn("Warning", log)

    def test_a_layer_in_memory_is_written_to_a_file_first(self):
        layer = QgsVectorLayer(f"{self.areas()}|layername=west", "west", "ogr")
        layer.selectAll()
        copy = layer.materialize(QgsFeatureRequest())
        QgsProject.instance().addMapLayer(copy)
        _, log = self.log_of(mask=copy.id())
        self.assertRegex(log, r"-mask \S+\.gpkg")
        QgsProject.instance().removeMapLayer(copy.id())

    def test_a_file_of_one_layer_is_loaded_too(self):
        target = str(self.folder / "one.geojson")
        results, well, _ = self.run_it(OUTPUT=target)
        self.assertTrue(well)
        self.assertEqual(results, {"OUTPUT": target, "BUILDINGS": target})

    def test_progress_goes_from_nothing_to_all(self):
        feedback = Feedback()
        self.run_it(feedback, INPUT=str(self.folder / "town.tif"))
        self.assertEqual(feedback.seen, sorted(feedback.seen))
        self.assertEqual(feedback.seen[-1], 100)
        self.assertGreater(len(feedback.seen), 3)
        self.assertTrue(any("buildings and" in line for line in feedback.lines))
        from dem2buildings.program import percent_of
        self.assertEqual([percent_of(text) for text in ("", "0.", "0...10..", "0...10...20", "0...100 - done.\n3")],
                         [0, 2.5, 15, 20, 100])

    def test_a_cancelled_run_leaves_what_was_there(self):
        target = self.make("kept.gpkg", sample="hotel_70x85.tif")
        before = target.read_bytes()
        feedback = Feedback(cancel_at=5)
        # Ignores SIGINT, as in programs that a script starts in the background.
        self.addCleanup(signal.signal, signal.SIGINT, signal.signal(signal.SIGINT, signal.SIG_IGN))
        # Enough to do for the request to arrive in time, also where the machine has much else to do.
        large = str(self.folder / "large.vrt")
        subprocess.run(["gdal_translate", "-q", "-of", "VRT", "-outsize", "600%", "600%",
                        str(self.folder / "town.tif"), large], check=True)
        results, _, _ = self.run_it(feedback, INPUT=large, OUTPUT=str(target), threads=1)
        self.assertTrue(feedback.isCanceled())
        self.assertEqual(results, {})
        self.assertEqual(target.read_bytes(), before)
        self.assertEqual([one.name for one in self.folder.iterdir() if one.name.startswith(".")], [])

    def test_errors_are_those_of_the_program(self):
        context, feedback = QgsProcessingContext(), Feedback()
        given = {"INPUT": str(self.folder / "hotel_70x85.tif"), "OUTPUT": str(self.folder / "no/such/out.gpkg")}
        (self.folder / "no").write_text("a file in the way of the folder")
        algorithm = self.algorithm()
        with self.assertRaisesRegex(QgsProcessingException, "ERROR: .*out.gpkg"):
            algorithm.run(given, context, feedback, {}, False)
        given |= {"OUTPUT": str(self.folder / "out.gpkg"), "preset": 1, "min_building_height": 5}
        with self.assertRaisesRegex(QgsProcessingException,
                                    'ERROR: "Minimum height of a building" 5 has no effect with "Method" thesis; '):
            algorithm.run(given, context, feedback, {}, False)

    def test_warnings_are_shown(self):
        _, log = self.log_of(min_height=500)
        self.assertIn('Warning: No building was found: "Height above ground at which a building begins" 500 ', log)

    def test_without_the_program_the_dialog_says_so(self):
        os.environ["DEM2BUILDINGS"] = "/nowhere/dem2buildings"
        try:
            able, why = self.algorithm().canExecute()
            self.assertFalse(able)
            self.assertIn("/nowhere/dem2buildings", why)
        finally:
            os.environ["DEM2BUILDINGS"] = TOOL

    def test_through_qgis_process(self):
        home = self.folder / "home"
        plugins = home / ".local/share/QGIS/QGIS3/profiles/default/python/plugins"
        shutil.copytree(self.plugins, plugins)
        program = shutil.which("qgis_process.bin") or shutil.which("qgis_process")
        environment = dict(os.environ, HOME=str(home))
        subprocess.run([program, "plugins", "enable", "dem2buildings"], env=environment, check=True, capture_output=True)
        target = self.folder / "process.gpkg"
        done = subprocess.run([program, "--json", "run", ALGORITHM, "--", f"INPUT={self.folder / 'town.tif'}",
                               "lod=2", f"OUTPUT={target}"], env=environment, check=True, capture_output=True, text=True)
        self.assertIn("process.gpkg|layername=buildings", done.stdout)
        layer = self.layer(target, "buildings")
        self.assertGreater(layer.featureCount(), 300)
        self.assertEqual(layer.maximumValue(layer.fields().indexOf("n_levels")), 3)


if __name__ == "__main__":
    unittest.main()
