"""Nothing is fetched that the caller did not name, whatever a file refers to."""

import http.server
import json
import threading
import unittest

import dem2buildings
from python_case import PLACE, PythonCase, block, write_grid


class Fetches(PythonCase):
    def setUp(self):
        super().setUp()
        self.asked = asked = []

        class Handler(http.server.BaseHTTPRequestHandler):
            def do_GET(self):
                asked.append(self.path)
                self.send_error(404)

            do_HEAD = do_GET

            def log_message(self, *arguments):
                pass

        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
        thread = threading.Thread(target=server.serve_forever, daemon=True)
        thread.start()
        self.addCleanup(thread.join)
        self.addCleanup(server.server_close)
        self.addCleanup(server.shutdown)
        self.url = f"http://127.0.0.1:{server.server_port}"

    def link(self):
        """Polygons around PLACE, in longitudes and latitudes, whose CRS is said to lie on the server."""
        ring = [[13, 52], [14, 52], [14, 53], [13, 53], [13, 52]]
        path = self.folder / "link.geojson"
        path.write_text(json.dumps({
            "type": "FeatureCollection",
            "crs": {"type": "link", "properties": {"href": self.url + "/secret", "type": "proj4"}},
            "features": [{"type": "Feature", "properties": {"kind": "building"},
                          "geometry": {"type": "Polygon", "coordinates": [ring]}}]}))
        return path

    def test_polygons_beside_an_array(self):
        for option in ("cutline", "mask", "split_by", "footprints", "exclude", "corrections"):
            with self.subTest(option=option), self.assertWarnsRegex(UserWarning, "refers to .*/secret, which is not fetched"):
                dem2buildings.extract(block(), **{option: self.link()}, **PLACE)
        self.assertEqual(self.asked, [])

    def test_what_is_compared(self):
        found = dem2buildings.extract(block(), **PLACE)
        with self.assertWarnsRegex(UserWarning, "which is not fetched"):
            dem2buildings.score(found, self.link())
        self.assertEqual(self.asked, [])

    def test_what_is_named(self):
        with self.assertRaises(dem2buildings.InputError):
            dem2buildings.extract(f"/vsicurl/{self.url}/dem.tif")
        self.assertTrue(self.asked)

    def test_a_gate_stays_in_its_run(self):
        dem2buildings.extract(write_grid(self.folder / "dem.asc", block()))
        with self.assertRaises(dem2buildings.InputError):
            dem2buildings.extract(f"{self.url}/dem.tif")
        self.assertTrue(self.asked)


if __name__ == "__main__":
    unittest.main()
