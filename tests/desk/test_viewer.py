"""A .glb of -surface in a viewer of the web: three.js reads it with its loader of glTF, in Chromium, and shows the
buildings of the layer."""

import base64
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from osgeo import ogr

from browser import Browser

ogr.UseExceptions()
SOURCE = pathlib.Path(__file__).resolve().parents[2]
TOOL = os.environ.get("D2B_TOOL", str(SOURCE / "build/tools/dem2buildings"))
TOWN = SOURCE / "sample_dems/town.tif"
THREE = "/usr/share/javascript/three"
VIEWER = f"""
import * as THREE from '{THREE}/build/three.module.js';
import {{GLTFLoader}} from '{THREE}/examples/jsm/loaders/GLTFLoader.js';
const bytes = Uint8Array.from(atob(document.getElementById('model').textContent), (letter) => letter.charCodeAt(0));
new GLTFLoader().parse(bytes.buffer, '', (model) => {{
  const box = new THREE.Box3().setFromObject(model.scene);
  const [size, middle] = [box.getSize(new THREE.Vector3()), box.getCenter(new THREE.Vector3())];
  const scene = new THREE.Scene();
  scene.background = new THREE.Color(0xffffff);
  scene.add(model.scene, new THREE.HemisphereLight(0xffffff, 0x404040));
  const camera = new THREE.PerspectiveCamera(45, innerWidth / innerHeight, 1, 10000);
  camera.position.copy(middle).add(new THREE.Vector3(0, size.x, size.z));
  camera.lookAt(middle);
  const renderer = new THREE.WebGLRenderer({{preserveDrawingBuffer: true}});
  renderer.setSize(innerWidth, innerHeight);
  document.body.appendChild(renderer.domElement);
  renderer.render(scene, camera);
  const [node] = model.scene.children;
  const buildings = node.userData.buildings.map(({{name, attributes}}) => ({{name, attributes, box: new THREE.Box3()}}));
  const {{position, _feature_id_0: places}} = node.children[0].geometry.attributes;
  for (let i = 0; i < places.count; ++i)
    buildings[places.getX(i)].box.expandByPoint(new THREE.Vector3().fromBufferAttribute(position, i));
  window.shown = {{
    buildings: buildings.map(({{name, attributes, box}}) =>
        ({{name, fields: attributes, low: box.min.toArray(), high: box.max.toArray()}})),
    asset: model.asset, drawn: renderer.info.render.triangles, calls: renderer.info.render.calls}};
  document.documentElement.dataset.ready = 'yes';
}}, (error) => console.error(error.message));
"""


class Viewer(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="d2b_viewer_"))
        subprocess.run([TOOL, "-q", "-te", "391300", "5820300", "391500", "5820500", "-surface",
                        str(cls.folder / "town.glb"), str(TOWN), str(cls.folder / "town.gpkg")], check=True)
        (cls.folder / "viewer.js").write_text(VIEWER)
        subprocess.run(["esbuild", str(cls.folder / "viewer.js"), "--bundle", "--log-level=warning",
                        f"--outfile={cls.folder / 'bundle.js'}"], check=True)
        model = base64.b64encode((cls.folder / "town.glb").read_bytes()).decode()
        cls.page = cls.folder / "viewer.html"
        cls.page.write_text(f"<!doctype html><meta charset='utf-8'><body style='margin: 0'><script id='model' type='text/plain'>"
                            f"{model}</script><script src='bundle.js'></script>")
        layers = ogr.Open(str(cls.folder / "town.gpkg"))
        cls.layer = {feature["id"]: (feature["volume_m3"] / feature["area_m2"], feature["p90"], feature.geometry().GetEnvelope())
                     for feature in layers.GetLayerByName("buildings")}

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def test_shows_the_buildings(self):
        with Browser() as browser:
            browser.open(self.page)
            shown = browser.run("return window.shown")
            self.assertEqual(browser.complaints(), [])
            picture = browser.picture()
        east, north, _ = shown["asset"]["extras"]["origin"]
        self.assertEqual({building["fields"]["id"] for building in shown["buildings"]}, set(self.layer))
        self.assertGreater(len(self.layer), 5)
        for building in shown["buildings"]:
            number = building["fields"]["id"]
            mean, p90, (west, right, south, top) = self.layer[number]
            self.assertEqual(building["name"], f"building_{number}")
            self.assertEqual(building["fields"]["p90"], p90)
            # x to the east, y up, z to the south.
            self.assertGreaterEqual(building["high"][1] - building["low"][1], 0.999 * mean - 0.01)
            for found, expected in ((building["low"][0] + east, west), (building["high"][0] + east, right),
                                    (north - building["high"][2], south), (north - building["low"][2], top)):
                self.assertAlmostEqual(found, expected, delta=0.05)
        self.assertGreater(shown["drawn"], 12 * len(self.layer))
        self.assertEqual(shown["calls"], 3)  # roofs, walls, grounds
        # Roofs and walls have colours of their own.
        colours = sorted(picture.getcolors(picture.width * picture.height), reverse=True)
        self.assertGreater(sum(count for count, colour in colours if colour != (255, 255, 255)), 0.1 * picture.width * picture.height)
        self.assertGreaterEqual(len(colours), 3)


if __name__ == "__main__":
    unittest.main()
