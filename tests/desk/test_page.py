"""The page of -page in Chromium: its view, its answers, and that it speaks to nobody."""

import base64
import io
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import time
import unittest

import numpy as np
from osgeo import gdal, ogr
from PIL import Image
from scipy.spatial import cKDTree

from browser import WITHOUT_WEBGL, Browser, difference

gdal.UseExceptions()
SOURCE = pathlib.Path(__file__).resolve().parents[2]
TOOL = os.environ.get("D2B_TOOL", str(SOURCE / "build/tools/dem2buildings"))
TOWN = SOURCE / "sample_dems/town.tif"
PICTURES = SOURCE / "docs/pictures"
# Limit of a mean over all pixels: letters of another font and another way to draw lines are less.
SAME = 4


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="d2b_page_"))
        cls.town = cls.make(TOWN, "town.html", "-surface", str(cls.folder / "town.city.json"),
                            "-surface_of", "contours")

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    @classmethod
    def make(cls, dem, name, *options):
        page = cls.folder / name
        subprocess.run([TOOL, "-q", "-overwrite", *options, "-page", str(page), str(dem),
                        str(page.with_suffix(".gpkg"))], check=True)
        return page

    def looks_like(self, browser, name):
        """Is the picture in docs. With D2B_NEW_PICTURES it becomes that."""
        path = PICTURES / name
        picture = browser.picture()
        if os.environ.get("D2B_NEW_PICTURES"):
            picture.save(path, optimize=True)
        self.assertLess(difference(picture, Image.open(path).convert("RGB")), SAME, name)

    def quiet(self, browser):
        self.assertEqual(browser.complaints(), [])
        for address in browser.requests():
            self.assertTrue(address.startswith("file://"), address)

    def test_two_surveys_are_shown_in_turns(self):
        """Follows the page of docs about changes: houses below 90 m2 are gone."""
        results = []
        for name, options in (("old", []), ("new", ["-min_area", "90"])):
            results.append(self.folder / f"survey_{name}.gpkg")
            subprocess.run([TOOL, "-q", *options, str(TOWN), str(results[-1])], check=True)
        page = self.folder / "changes.html"
        summary = json.loads(subprocess.run([f"{TOOL}_compare", "-json", "-page", str(page), *map(str, results)],
                                            check=True, capture_output=True, text=True).stdout)
        with Browser() as browser:
            browser.open(page)
            self.assertEqual(browser.text("alternatives").split(), ["Old", "New"])
            self.assertTrue(browser.text("sum").startswith(f"{summary['new']['buildings']} buildings"))
            new = browser.picture()
            browser.run("document.querySelector('#alternatives button').click()")
            time.sleep(2)
            self.assertTrue(browser.text("sum").startswith(f"{summary['old']['buildings'] - 1} buildings"))
            self.assertGreater(difference(browser.picture(), new), 0.1)
            self.looks_like(browser, "page_changes.png")
            gone = browser.run("const {town} = window.dem2buildings;"
                               "return town.fields.get('change').values.filter((value) => value === 'gone').length")
            self.assertEqual(gone, summary["changes"]["gone"])
            # A chosen building stays chosen in the other survey, unless it is gone there.
            browser.run("window.dem2buildings.choose(window.dem2buildings.town.numbered(1))")
            browser.run("window.dem2buildings.turnTo('new')")
            self.assertIn("Building 1", browser.text("building"))
            browser.run("window.dem2buildings.turnTo('old');"
                        "const {town} = window.dem2buildings;"
                        "window.dem2buildings.choose(town.fields.get('change').values.indexOf('gone'));"
                        "window.dem2buildings.turnTo('new')")
            self.assertFalse(browser.is_seen("building"))
            self.quiet(browser)
        with Browser() as browser:
            browser.open(page)
            browser.run("window.location.hash = '#of=old'")
            time.sleep(1)
            self.assertTrue(browser.text("sum").startswith(f"{summary['old']['buildings'] - 1} buildings"))

    def test_is_drawn_light_and_dark(self):
        for name, dark in (("page_town.png", False), ("page_town_dark.png", True)):
            with self.subTest(name), Browser(dark=dark) as browser:
                browser.open(self.town)
                self.assertTrue(browser.is_seen("view"))
                self.assertEqual(browser.text("theme"), "Light" if dark else "Dark")
                self.looks_like(browser, name)
                self.quiet(browser)

    def test_is_drawn_on_a_telephone(self):
        with Browser(size=(390, 780)) as browser:
            browser.open(self.town)
            wide = browser.run("return document.documentElement.scrollWidth")
            self.assertLessEqual(wide, 390)
            self.looks_like(browser, "page_town_phone.png")
            self.quiet(browser)

    def test_all_is_seen_beside_the_panels(self):
        """Corners of the window, and the highest of each building, in both views and on both screens."""
        for size, left, top, bottom in ((1280, 800), 284, 0, 800), ((390, 780), 0, 120, 700):
            with self.subTest(size), Browser(size=size) as browser:
                browser.open(self.town)
                for view in ("to3d", "tomap"):
                    browser.press(view)
                    places = browser.run("""
                        const {scene, map, shown, town} = window.dem2buildings;
                        const base = (b) => [[0, 1], [2, 1], [2, 3], [0, 3]].map(([x, y]) => {
                          const box = town.boxOf(b);
                          return [box[x], box[y], box[4]];
                        });
                        const points = town.about.frame.corners.map(([x, y]) => [x, y, scene.relief.near(x, y)]);
                        for (let b = 0; b < town.buildings; ++b)
                          points.push(...base(b));
                        if (shown === map)
                          return points.map(([x, y]) => map.toPixels(x, y).map((part) => part / map.ratio));
                        scene.camera.updateMatrixWorld();
                        return points.map(([x, y, z]) => {
                          const at = scene.camera.position.clone().set(x, z, -y).project(scene.camera);
                          return [(1 + at.x) / 2 * innerWidth, (1 - at.y) / 2 * innerHeight];
                        });""")
                    self.assertGreater(min(x for x, _ in places), left, view)
                    self.assertLess(max(x for x, _ in places), size[0], view)
                    self.assertGreater(min(y for _, y in places), top, view)
                    self.assertLess(max(y for _, y in places), bottom, view)
                    wide = max(x for x, _ in places) - min(x for x, _ in places)
                    high = max(y for _, y in places) - min(y for _, y in places)
                    self.assertTrue(wide > 0.88 * (size[0] - left) or high > 0.88 * (bottom - top), view)

    def test_north_is_turned_up(self):
        with Browser() as browser:
            browser.open(self.town)
            around = lambda: browser.run("return window.dem2buildings.scene.controls.getAzimuthalAngle()")
            self.assertGreater(abs(around()), 0.1)
            browser.press("north")
            self.assertLess(abs(around()), 1e-6)

    def test_corners_are_those_of_the_surface(self):
        """Corners of the triangles in the page, and of the CityJSON; a solid has more where walls of others end."""
        city = json.loads((self.folder / "town.city.json").read_text())
        scale, translate = city["transform"]["scale"], city["transform"]["translate"]
        roofs = set()
        for item in city["CityObjects"].values():
            shell = item["geometry"][0]["boundaries"][0]
            kinds = item["geometry"][0]["semantics"]["values"][0]
            names = item["geometry"][0]["semantics"]["surfaces"]
            for face, kind in zip(shell, kinds):
                if names[kind]["type"] == "RoofSurface":
                    roofs.update(corner for ring in face for corner in ring)
        expected = {tuple(part * scale[i] + translate[i] for i, part in enumerate(city["vertices"][corner]))
                    for corner in roofs}
        with Browser() as browser:
            browser.open(self.town)
            drawn, origin = browser.run("""
                const {scene, town} = window.dem2buildings;
                const all = [];
                for (const {stack} of scene.chunks.all)
                  all.push(...stack.children[0].geometry.getAttribute('position').array);
                return [all, town.about.frame.origin];""")
        near = lambda x, y, z: (round(x, 2), round(y, 2), round(z, 2))
        corners = set()
        for i in range(0, len(drawn), 3):
            corners.add((drawn[i] + origin[0], origin[1] - drawn[i + 2], drawn[i + 1] + origin[2]))
        cells = {}
        for corner in corners:
            cells.setdefault(near(*corner), corner)

        def is_drawn(x, y, z):
            return any(near(x + i / 100, y + j / 100, z + k / 100) in cells
                       for i in (-1, 0, 1) for j in (-1, 0, 1) for k in (-1, 0, 1))
        missed = [corner for corner in expected if not is_drawn(*corner)]
        self.assertGreater(len(expected), 100)
        self.assertLess(len(missed), 0.02 * len(expected))

    def test_roofs_are_those_of_the_layer(self):
        """The page of -roofs begins with slanted roofs: corners, counts and elevations are those of the layer."""
        page = self.make(TOWN, "roofs.html", "-roofs")
        result = ogr.Open(str(page.with_suffix(".gpkg")))
        faces = [(feature.GetGeometryRef().Clone(), feature["kind"]) for feature in result.GetLayerByName("roofs")]
        pitched = [face for face, kind in faces if kind == "pitched"]
        self.assertGreater(len(pitched), 500)
        with Browser() as browser:
            browser.open(page)
            self.assertEqual(browser.text("leveltext"), "")  # the details are closed
            browser.run("document.getElementById('levels').open = true")
            self.assertEqual(browser.text("leveltext"), "slanted roofs")
            self.assertEqual(browser.text("contoursname"), "Faces of roofs")
            self.assertEqual(int(browser.text("contours").replace(",", "")), len(faces))
            drawn, origin, levels = browser.run("""
                const {scene, town} = window.dem2buildings;
                const all = [];
                for (const {roofs} of scene.chunks.all)
                  all.push(...roofs.children[0].geometry.getAttribute('position').array);
                return [all, town.about.frame.origin, town.levels];""")
            outline = lambda face: face.GetGeometryRef(0).GetGeometryRef(0).GetPoints()
            corners = [corner for face in pitched for corner in outline(face)]
            shown = np.array(drawn).reshape(-1, 3)[:, [0, 2, 1]] * [1, -1, 1] + origin
            apart, _ = cKDTree(shown).query(corners)
            # Corners that almost touch are one, and faces that would reach below the ground are level.
            self.assertLess(np.mean(apart > 0.01), 0.005)
            # Straight down onto the middles of faces.
            middles = [face.PointOnSurface() for face in pitched[::20]]
            found = browser.run("""
                const [points, origin] = arguments;
                const {scene, town} = window.dem2buildings;
                return points.map(([x, y]) => {
                  const [east, north, high] = [x - origin[0], y - origin[1], 1000];
                  const {building, along} = scene.hit({ray: {
                    origin: {x: east, y: high, z: -north}, direction: {x: 1e-9, y: -1, z: 1e-9}}});
                  return [high - along + origin[2], town.stack.id[building]];
                });""", [[middle.GetX(), middle.GetY()] for middle in middles], origin)
            for face, middle, (z, _) in zip(pitched[::20], middles, found):
                ring = np.array(outline(face))
                centre = np.mean(ring, axis=0)
                normal = np.linalg.svd(ring - centre)[2][2]
                expected = centre[2] - ((middle.GetX() - centre[0]) * normal[0] +
                                        (middle.GetY() - centre[1]) * normal[1]) / normal[2]
                self.assertAlmostEqual(z, expected, delta=0.02)
            browser.slide(levels)
            browser.wait()
            self.assertEqual(browser.text("leveltext"), f"1 to {levels} of {levels}")
            self.assertEqual(browser.text("contoursname"), "Contours")
            browser.slide(levels + 1)
            browser.run("document.getElementById('levels').open = false;"
                        "window.dem2buildings.scene.setPlace({eye: [-30, 130, 60], to: [60, 0, -110]})")
            time.sleep(2)
            browser.wait()
            self.looks_like(browser, "page_roofs.png")
            browser.press("tomap")
            self.quiet(browser)

    def test_a_click_answers(self):
        with Browser() as browser:
            browser.open(self.town)
            browser.press("tomap")
            browser.wait()
            # The middle of the largest footprint, in pixels of the map.
            x, y, number = browser.run("""
                const {map, town} = window.dem2buildings;
                let best = 0;
                const size = (b) => (town.boxOf(b)[2] - town.boxOf(b)[0]) * (town.boxOf(b)[3] - town.boxOf(b)[1]);
                for (let b = 0; b < town.buildings; ++b)
                  if (size(b) > size(best))
                    best = b;
                const box = town.boxOf(best);
                for (let i = 1; i < 10; ++i)
                  for (let j = 1; j < 10; ++j) {
                    const [x, y] = [box[0] + (box[2] - box[0]) * i / 10, box[1] + (box[3] - box[1]) * j / 10];
                    if (town.holds(town.tiersOf(best)[0], x, y))
                      return [...map.toPixels(x, y), town.stack.id[best]];
                  }""")
            browser.click(x, y)
            said = browser.text("building")
            self.assertIn(f"Building {number}", said)
            for field in ("Height (m)", "Floors", "Area", "Volume", "Confidence"):
                self.assertIn(field, said)
            values = self.record(number)
            self.assertIn(f"{values['num_floors']:.0f}", said)
            self.assertIn(f"{values['p90']:,.2f}".rstrip("0").rstrip("."), said)
            browser.press("to3d")
            browser.wait()
            browser.click(640, 400)  # something, or nothing: the building that a ray finds is compared
            said = browser.text("building") if browser.is_seen("building") else ""
            seen = browser.run("return window.dem2buildings.scene.pick(640, 400)")
            self.assertEqual(said.startswith("Building"), seen >= 0)
            self.quiet(browser)

    def record(self, number):
        text = subprocess.run(["ogrinfo", "-ro", "-q", str(self.folder / "town.gpkg"), "buildings", "-where",
                               f"id = {number}", "-geom=NO"], check=True, capture_output=True, text=True).stdout
        values = {}
        for line in text.splitlines():
            name, equals, value = line.strip().partition(" = ")
            if equals:
                values[name.split(" (")[0]] = float(value) if value.replace(".", "").isdigit() else value
        return values

    def test_the_slider_changes_what_is_seen_and_counted(self):
        with Browser() as browser:
            browser.open(self.town)
            whole = browser.picture()
            self.assertFalse(browser.run("return document.getElementById('levels').open"))
            browser.run("document.getElementById('levels').open = true")
            counts = [browser.text(name) for name in ("contours", "corners", "rmse")]
            browser.slide(1)
            browser.run("delete document.documentElement.dataset.ready")
            browser.run("window.dem2buildings.scene.ask()")
            browser.wait()
            low = [browser.text(name) for name in ("contours", "corners", "rmse")]
            number = lambda text: float(text.replace(",", "").split()[0])
            self.assertLess(number(low[0]), number(counts[0]))
            self.assertLess(number(low[1]), number(counts[1]))
            self.assertGreater(number(low[2]), number(counts[2]))
            self.assertGreater(difference(browser.picture(), whole), 0.05)
            self.quiet(browser)

    def again(self, browser):
        browser.run("delete document.documentElement.dataset.ready; window.dem2buildings.shown.ask()")
        browser.wait()

    def test_title_credit_and_date_are_shown(self):
        dem = self.folder / "dated.tif"
        gdal.Translate(str(dem), str(TOWN), metadataOptions=["TIFFTAG_DATETIME=2024:05:31 12:00:00"])
        page = self.make(dem, "titled.html", "-title", "Old town", "-credit", "City of Old Town, CC BY 4.0")
        with Browser() as browser:
            browser.open(page)
            self.assertEqual(browser.run("return document.title"), "Old town")
            said = browser.text("credit")
            self.assertIn("City of Old Town, CC BY 4.0", said)
            self.assertIn("2024", said)
            self.quiet(browser)
        with Browser() as browser:
            browser.open(self.town)
            self.assertFalse(browser.is_seen("credit"))

    def enter(self, browser, name, value, event="change"):
        browser.run("const field = document.getElementById(arguments[0]); field.value = arguments[1];"
                    "field.dispatchEvent(new Event(arguments[2]))", name, value, event)

    def test_a_building_is_found_by_its_number(self):
        with Browser() as browser:
            browser.open(self.town)
            browser.press("tofind")
            self.enter(browser, "findtext", "26")
            self.assertIn("Building 26", browser.text("building"))
            away = browser.run("""
                const {scene, town} = window.dem2buildings;
                const box = town.boxOf(town.stack.id.indexOf(26));
                const {x, z} = scene.controls.target;
                return Math.hypot(x - (box[0] + box[2]) / 2, -z - (box[1] + box[3]) / 2);""")
            self.assertLess(away, 0.01)
            self.enter(browser, "findtext", "99999")
            self.assertTrue(browser.is_seen("findnone"))
            self.quiet(browser)

    def test_buildings_are_filtered_by_height(self):
        counted = subprocess.run(
            ["ogrinfo", "-ro", "-q", str(self.folder / "town.gpkg"), "-sql",
             "SELECT count(*) AS n FROM buildings WHERE p90 BETWEEN 12 AND 30"],
            check=True, capture_output=True, text=True).stdout
        count = int(re.search(r"n \(Integer\S*\) = ([0-9]+)", counted)[1])
        with Browser() as browser:
            browser.open(self.town)
            whole = browser.picture()
            self.enter(browser, "lowest", "12")
            self.enter(browser, "highest", "30")
            self.again(browser)
            self.assertTrue(browser.text("sum").startswith(f"{count} of "))
            self.assertGreater(difference(browser.picture(), whole), 0.5)
            hidden = browser.run("""
                const {scene, town} = window.dem2buildings;
                const seen = scene.chunks.all.flatMap(({buildings}) => buildings);
                return seen.filter((b) => !(town.value('p90', b) >= 12 && town.value('p90', b) <= 30)).length;""")
            self.assertEqual(hidden, 0)
            for name in ("lowest", "highest"):
                self.enter(browser, name, "")
            self.again(browser)
            self.assertLess(difference(browser.picture(), whole), 0.05)
            self.quiet(browser)

    def test_the_sun_casts_shadows(self):
        """Shadow of a house 12 m high on level ground, with the length and direction that the sun's place gives."""
        page, house = self.with_courtyards("shadow")
        with Browser() as browser:
            browser.open(page)
            latitude, _ = browser.run("return window.dem2buildings.town.about.position")
            browser.press("tosun")
            self.enter(browser, "hour", "12", "input")
            # The sun is 90 degrees minus latitude plus 23.44 degrees above the south at noon of 21 June.
            height = np.radians(90 - latitude + 23.44)
            self.assertIn(f"{np.degrees(height):.0f}°", browser.text("sunheight"))
            length = 12 / np.tan(height)
            # Looks from above, a metre a pixel: north of the northern wall the ground is dark for this length.
            browser.run("""
                const {scene, town} = window.dem2buildings;
                const [west, south, east, north] = town.extent;
                scene.setPlace({eye: [(west + east) / 2, 3000, -(south + north) / 2 + 1], to: [(west + east) / 2, 0,
                    -(south + north) / 2]});""")
            self.again(browser)
            picture = browser.picture().convert("L")
            pixel = lambda row, col: picture.getpixel(tuple(round(part) for part in browser.run("""
                const {scene, town} = window.dem2buildings;
                const [west, , , north] = town.extent;
                scene.camera.updateMatrixWorld();
                const at = scene.camera.position.clone().set(west + arguments[1], scene.relief.near(0, 0),
                    -(north - arguments[0])).project(scene.camera);
                return [(1 + at.x) / 2 * innerWidth, (1 - at.y) / 2 * innerHeight];""", row, col)))
            sunny = pixel(20, 70)
            self.assertLess(pixel(40 - length / 2, 70), 0.75 * sunny)
            self.assertGreater(pixel(40 - length - 3, 70), 0.9 * sunny)
            self.assertGreater(pixel(126, 70), 0.9 * sunny)  # south of the house
            self.quiet(browser)

    def test_lengths_are_measured(self):
        with Browser() as browser:
            browser.open(self.town)
            browser.press("tomap")
            browser.press("tomeasure")
            browser.wait()
            metres = browser.run("""
                const {map} = window.dem2buildings;
                const [a, b] = [[700, 300], [900, 500]].map(([x, y]) => map.toMetres(x * map.ratio, y * map.ratio));
                return Math.hypot(a[0] - b[0], a[1] - b[1]);""")
            browser.click(700, 300)
            browser.click(900, 500)
            self.assertIn(f"{metres:,.1f} m".replace(".0 m", " m"), browser.text("measuretext"))
            browser.press("to3d")
            browser.press("tomeasure")
            browser.press("tomeasure")
            browser.click(700, 300)
            browser.click(900, 500)
            self.assertRegex(browser.text("measuretext"), r"[0-9,.]+ m on the map")
            self.quiet(browser)

    def test_a_link_leads_to_the_same_view(self):
        with Browser() as browser:
            browser.open(self.town)
            self.enter(browser, "findtext", "21")
            self.enter(browser, "lowest", "12")
            browser.press("tosun")
            self.enter(browser, "hour", "9", "input")
            self.again(browser)
            browser.press("link")
            address = browser.driver.current_url
            self.assertIn("id=21", address)
            state = """
                const {scene, town, chosen, sunCard} = window.dem2buildings;
                return [scene.camera.position.toArray().map(Math.round), town.stack.id[chosen], town.shown(),
                        sunCard.chosen()];"""
            before = browser.run(state)
            browser.driver.get("about:blank")
            browser.driver.get(address)
            browser.wait()
            self.assertEqual(browser.run(state), before)
            self.quiet(browser)

    def test_speaks_the_language_of_the_browser(self):
        with Browser() as browser:
            browser.open(self.town)
            keys = browser.run("return [...document.querySelectorAll('[data-text]')].filter((e) => !e.textContent).length")
            self.assertEqual(keys, 0)
        with Browser(language="de-DE") as browser:
            browser.open(self.town)
            self.assertEqual(browser.run("return document.documentElement.lang"), "de")
            self.assertEqual(browser.text("tofind"), "Suchen")
            self.assertIn("Gebäude", browser.text("sum"))
            self.assertEqual(browser.run("return [...document.querySelectorAll('[data-text]')].filter("
                                         "(e) => !e.textContent).length"), 0)
            self.quiet(browser)

    def test_both_languages_have_the_same_texts(self):
        table = (SOURCE / "lib/view/page/texts.js").read_text()
        keys = [sorted(re.findall(r"^  (\w+):", part, re.M)) for part in re.split(r"^const \w+ = \{", table, flags=re.M)[1:3]]
        self.assertGreater(len(keys[0]), 50)
        self.assertEqual(*keys)

    def test_keys_turn_and_zoom(self):
        with Browser() as browser:
            browser.open(self.town)
            where = lambda: browser.run("return window.dem2buildings.scene.camera.position.toArray()")
            places = [where()]
            for key in ("ArrowLeft", "ArrowUp", "+", "-"):
                browser.run("document.getElementById('view').dispatchEvent("
                            "new KeyboardEvent('keydown', {key: arguments[0]}))", key)
                self.assertNotEqual(where(), places[-1], key)
                places.append(where())
            self.quiet(browser)

    def test_without_webgl_there_is_the_map(self):
        with Browser(flags=WITHOUT_WEBGL) as browser:
            browser.open(self.town)
            self.assertIn("does not show 3D", browser.text("notice"))
            self.assertTrue(browser.is_seen("map"))
            self.assertFalse(browser.is_seen("view"))
            self.looks_like(browser, "page_town_map.png")
            self.quiet(browser)

    def test_prints_the_map(self):
        with Browser() as browser:
            browser.open(self.town)
            paper = browser.call("Page.printToPDF", landscape=False)
            self.assertGreater(len(paper["data"]), 20000)
            self.assertTrue(browser.is_seen("view"))  # afterwards as before
            self.quiet(browser)

    def with_courtyards(self, name, fall=0.0):
        """A house of 60 by 80 m with two courtyards, in the middle of 140 by 160 m. @param fall of the ground, m a row
        @return the page, and the cells of the house: rows from the north, columns from the west"""
        rows, cols = np.mgrid[0:160, 0:140]
        house = (rows >= 40) & (rows < 120) & (cols >= 40) & (cols < 100)
        for top, left in (50, 55), (85, 70):
            house &= ~((rows >= top) & (rows < top + 20) & (cols >= left) & (cols < left + 18))
        heights = 100 - fall * rows
        heights[house] = 112
        dem = self.folder / f"{name}.tif"
        raster = gdal.GetDriverByName("GTiff").Create(str(dem), 140, 160, 1, gdal.GDT_Float32)
        raster.SetGeoTransform((500000, 1, 0, 5800160, 0, -1))
        raster.SetProjection(gdal.Open(str(TOWN)).GetProjection())
        raster.WriteArray(heights)
        raster = None
        return self.make(dem, f"{name}.html"), house

    def shows_courtyards(self, browser, picture, house):
        """Roof where the house is, and ground in its courtyards as around it; walls are drawn on the borders."""
        places = browser.run("""
            const {map, town} = window.dem2buildings;
            const [west, south, east, north] = town.extent;
            const at = (row, col) => map.toPixels(west + col + 0.5, north - row - 0.5);
            const all = [];
            for (let row = 0; row < 160; ++row)
              for (let col = 0; col < 140; ++col)
                all.push(at(row, col));
            return all;""")
        roof = picture.getpixel(tuple(round(part) for part in places[45 * 140 + 45]))
        ground = picture.getpixel(tuple(round(part) for part in places[30 * 140 + 20]))
        self.assertGreater(max(abs(a - b) for a, b in zip(roof, ground)), 30)
        wrong = []
        for row in range(2, 158):
            for col in range(2, 138):
                around = house[row - 2:row + 3, col - 2:col + 3]
                if around.all() or not around.any():
                    seen = picture.getpixel(tuple(round(part) for part in places[row * 140 + col]))
                    like = [max(abs(a - b) for a, b in zip(seen, of)) for of in (roof, ground)]
                    if (like[0] < like[1]) != house[row, col]:
                        wrong.append((row, col))
        self.assertEqual(wrong, [])

    def test_a_courtyard_is_ground_on_the_map_and_on_paper(self):
        page, house = self.with_courtyards("courtyards")
        with Browser() as browser:
            browser.open(page)
            browser.press("tomap")
            browser.wait()
            # The scale bar and the arrow are drawn in the canvas as well, and lie outside of the house.
            canvas = "return document.getElementById('map').toDataURL('image/png').split(',')[1]"
            drawn = lambda: Image.open(io.BytesIO(base64.b64decode(browser.run(canvas)))).convert("RGB")
            browser.run("window.dem2buildings.map.draw()")
            self.shows_courtyards(browser, drawn(), house)
            browser.run("window.dispatchEvent(new Event('beforeprint'))")
            self.shows_courtyards(browser, drawn(), house)
            browser.run("window.dispatchEvent(new Event('afterprint'))")
            self.quiet(browser)

    def test_walls_of_a_courtyard_reach_the_ground(self):
        """Walls go on below the base of a house if the ground falls by 8 m along it, around its courtyards too."""
        page, _ = self.with_courtyards("slope", fall=0.1)
        with Browser() as browser:
            browser.open(page)
            corners, rings, base = browser.run("""
                const {scene, town} = window.dem2buildings;
                scene.chunks.update(scene.camera.position, Infinity, Infinity);
                const below = scene.chunks.all.flatMap(
                    ({foundation}) => [...foundation.children[0].geometry.getAttribute('position').array]);
                const rings = town.ringsOf(town.tiersOf(0)[0]).map(([from, to]) =>
                    Array.from({length: to - from}, (_, i) => [town.x[from + i], town.y[from + i]]));
                return [below, rings, town.base(0)];""")
            deep = {(round(corners[i], 1), round(-corners[i + 2], 1)) for i in range(0, len(corners), 3)
                    if corners[i + 1] < base - 0.01}
            self.assertEqual(len(rings), 3)
            for ring in rings:
                for x, y in ring:
                    self.assertIn((round(x, 1), round(y, 1)), deep)
            self.quiet(browser)

    def test_a_city_is_soon_there(self):
        """Sixteen towns: more than 5,000 buildings, on two cores without a graphics card."""
        town = gdal.Open(str(TOWN))
        cells = np.tile(town.ReadAsArray(), (4, 4))
        city = gdal.GetDriverByName("GTiff").Create(str(self.folder / "city.tif"), *cells.shape[::-1], 1,
                                                    gdal.GDT_Float32, ["COMPRESS=DEFLATE", "TILED=YES"])
        city.SetGeoTransform(town.GetGeoTransform())
        city.SetProjection(town.GetProjection())
        city.WriteArray(cells)
        city = None
        page = self.make(self.folder / "city.tif", "city.html")
        self.assertLess(page.stat().st_size, 25e6)
        seconds = []
        for _ in range(3):  # the machine may be busy
            with Browser() as browser:
                browser.open(page)
                self.assertGreater(browser.run("return window.dem2buildings.town.buildings"), 5000)
                seconds.append(browser.run(
                    "return performance.getEntriesByName('first-picture')[0].startTime") / 1000)
                self.quiet(browser)
        print(f"a city of {page.stat().st_size / 1e6:.1f} MB, first picture after {min(seconds):.1f} s")
        self.assertLess(min(seconds), 5)

    def test_names_are_text(self):
        for name in ("<script>document.title='run'<b>&amp;", "<title><script>"):
            place = self.folder / name
            dem = place.with_name(f"{place.name}.tif")
            shutil.copy(TOWN, dem)
            page = self.make(dem, f"{name}.html")
            with self.subTest(name), Browser() as browser:
                browser.open(page)
                self.assertEqual(browser.run("return document.title"), place.name)
                self.assertEqual(browser.run("return document.querySelector('h1').textContent"), place.name)
                browser.press("help")
                self.assertIn(dem.name, browser.text("source"))
                self.assertNotIn(str(self.folder), str(browser.run("return window.dem2buildings.town.about.metadata")))
                self.quiet(browser)


if __name__ == "__main__":
    unittest.main()
