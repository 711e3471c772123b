"""Programs killed at random moments: checks the result in QGIS, with the file open in it and when it opens it again."""

import json
import os
import random
import shutil
import signal
import sqlite3
import subprocess
import sys
import time
import unittest

from desk_case import HERE, TOOL, DeskCase

# Edits a layer of the file, which QGIS does in WAL mode, and ends as a crash would: nothing is put in order.
OTHER_QGIS = """
import os, sqlite3, sys
from desk_case import QgsVectorLayer
path = sys.argv[1]
mine, shown = (QgsVectorLayer(f"{path}|layername={name}", name, "ogr") for name in ("mine", "buildings"))
mine.startEditing()
notes = lambda: [feature["note"] for feature in mine.getFeatures()]
mode = sqlite3.connect(path).execute("PRAGMA journal_mode").fetchone()[0]
print(mode, sum(1 for _ in shown.getFeatures()), *notes(), flush=True)
sys.stdin.readline()
print(*notes(), flush=True)
os._exit(0)
"""
TIMES = int(os.environ.get("D2B_KILLS", "10"))


class Killed(DeskCase):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.random = random.Random(7)

    def command(self, target, sample="town.tif"):
        return [TOOL, "-q", "-overwrite", str(self.folder / sample), str(target)]

    def whole_run(self, target):
        """@return seconds"""
        start = time.monotonic()
        subprocess.run(self.command(target), check=True)
        return time.monotonic() - start

    def killed_run(self, target, seconds):
        """Half of the moments are in the last third of a run, when files change. @return whether it was killed"""
        share = self.random.uniform(*self.random.choice([(0, 1.05), (0.6, 1.05)]))
        process = subprocess.Popen(self.command(target))
        time.sleep(share * seconds)
        process.send_signal(signal.SIGKILL)
        return process.wait() == -signal.SIGKILL

    def content(self, path):
        """Opens a file afresh in QGIS and reads it. @return the number of features in each layer"""
        return tuple(sum(1 for feature in self.layer(path, name).getFeatures() if not feature.geometry().isNull())
                     for name in ("buildings", "contours"))

    def until_enough(self):
        """Some more turns where the machine has become faster, and runs end before their kill."""
        self.kills = 0
        for i in range(5 * TIMES):
            if i >= TIMES and self.kills > TIMES / 4:
                break
            yield i
        self.assertGreater(self.kills, TIMES / 4)

    def expect_sound(self, path):
        with sqlite3.connect(path) as file:
            self.assertEqual(file.execute("PRAGMA integrity_check").fetchall(), [("ok",)])

    def test_a_new_file_is_there_whole_or_not_at_all(self):
        target = self.folder / "new.gpkg"
        seconds = self.whole_run(target)
        whole = self.content(target)
        for _ in self.until_enough():
            for old in self.folder.glob("new.gpkg*"):
                old.unlink()
            killed = self.killed_run(target, seconds)
            self.kills += killed
            if target.exists():
                self.assertEqual(self.content(target), whole)
                self.expect_sound(target)
            else:
                self.assertTrue(killed)

    def test_a_geopackage_that_is_open_holds_the_old_content_or_the_new(self):
        base = self.folder / "base.gpkg"
        mine = self.folder / "mine.geojson"
        mine.write_text(json.dumps({"type": "FeatureCollection", "features": [
            {"type": "Feature", "properties": {"note": "my own"},
             "geometry": {"type": "Point", "coordinates": [1, 2]}}]}))
        subprocess.run(["ogr2ogr", "-f", "GPKG", str(base), str(mine), "-nln", "mine"], check=True)
        subprocess.run(self.command(base, "hotel_70x85.tif"), check=True)
        old = self.content(base)
        target = self.folder / "0.gpkg"
        shutil.copy(base, target)
        seconds = self.whole_run(target)
        new = self.content(target)
        self.assertNotEqual(old, new)
        for i in self.until_enough():
            # Another name each time: QGIS keeps files open for a while after their layers are gone.
            target.unlink()
            target = self.folder / f"{i + 1}.gpkg"
            shutil.copy(base, target)
            with subprocess.Popen([sys.executable, "-c", OTHER_QGIS, str(target)], cwd=HERE, text=True,
                                  stdin=subprocess.PIPE, stdout=subprocess.PIPE) as other:
                self.assertEqual(other.stdout.readline(), f"wal {old[0]} my own\n")
                killed = self.killed_run(target, seconds)
                self.kills += killed
                self.assertEqual(other.communicate("go on\n")[0], "my own\n")
            found = self.content(target)
            self.assertIn(found, (old, new) if killed else (new,))
            self.expect_sound(target)
            self.assertEqual([feature["note"] for feature in self.layer(target, "mine").getFeatures()], ["my own"])


if __name__ == "__main__":
    unittest.main()
