#!/usr/bin/env python3
"""Checks that run.py notices faults: programs that have them are run in the place of ours."""
import json
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import run_tool
from judge import judge

FINDS_NOTHING = 'echo "{}"; echo "Warning: No building was found." >&2; cp "$MADE" out.gpkg'
COLUMNS = {name: 1 for name in ("roof", "n_points", "n_cells", "area_m2", "perim_m", "ground", "height", "volume_m3")}
SQUARE = [[0, 0], [4, 0], [4, 4], [0, 4], [0, 0]]
BOW_TIE = [[0, 0], [4, 4], [4, 0], [0, 4], [0, 0]]


class Judge(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.make()

    def make(self, ring=None, **values):
        """The result that the program in our place copies: a building, or none."""
        features = [{"type": "Feature", "properties": {**COLUMNS, "status": "traced", **values},
                     "geometry": {"type": "Polygon", "coordinates": [ring]}}] if ring else []
        source = self.folder / "made.json"
        source.write_text(json.dumps({"type": "FeatureCollection", "features": features}))
        subprocess.run(["ogr2ogr", "-f", "GPKG", self.folder / "made.gpkg", source, "-nln", "buildings", "-overwrite",
                        "-lco", "FID=id"], check=True)
        if not features:
            subprocess.run(["ogrinfo", "-q", self.folder / "made.gpkg", "-sql",
                            "ALTER TABLE buildings ADD COLUMN height REAL"], check=True, capture_output=True)

    def judged(self, script):
        tool = self.folder / "tool"
        tool.write_text(f"#!/bin/sh\n{script}\n")
        tool.chmod(0o755)
        run = run_tool.run_tool(tool, "test", [], self.folder, {**os.environ, "MADE": str(self.folder / "made.gpkg")})
        return judge(run, "buildings")

    def expect_fault(self, script, part):
        _, faults = self.judged(script)
        self.assertTrue(any(part in fault for fault in faults), faults)

    def test_what_is_well(self):
        self.assertEqual(self.judged(FINDS_NOTHING), ("nothing found", []))
        self.assertEqual(self.judged('echo "ERROR: It is no raster." >&2; exit 1'), ("refused", []))
        self.make(SQUARE)
        self.assertEqual(self.judged('echo "{}"; cp "$MADE" out.gpkg'), ("found", []))

    def test_signals(self):
        self.assertEqual(self.judged("kill -SEGV $$"), ("signal", ["ended by signal 11"]))

    def test_what_hangs(self):
        before, run_tool.SECONDS = run_tool.SECONDS, 0.5
        self.assertEqual(self.judged("exec sleep 9"), ("signal", ["ended by signal 15"]))
        self.assertEqual(self.judged('trap "exit 143" TERM; sleep 3 >/dev/null 2>&1 & wait'),
                         ("stopped after a minute", []))
        self.assertEqual(self.judged('trap "" TERM; sleep 3'),
                         ("signal", ["ended by signal 9, heedless of SIGTERM"]))
        run_tool.SECONDS = before

    def test_memory_has_an_end(self):
        self.assertEqual(self.judged('test "$(ulimit -v)" -le 4194304 && kill -ABRT $$'),
                         ("signal", ["ended by signal 6"]))

    def test_messages(self):
        self.expect_fault("exit 1", "0 errors with status 1")
        self.expect_fault('echo "ERROR: It is no raster" >&2; exit 1', "no sentence")
        self.expect_fault('echo "terminate called" >&2; exit 1', "a line that is no message")
        self.expect_fault('echo "ERROR: One." >&2; echo "ERROR: Two." >&2; exit 1', "2 errors")
        self.expect_fault(f'{FINDS_NOTHING}; echo "Warning: No building was found." >&2', "comes twice")
        self.expect_fault('echo "{}"; cp "$MADE" out.gpkg', "not a word")
        self.expect_fault('echo "ERROR: What?" >&2; exit 9', "status 9")

    def test_what_is_left(self):
        self.expect_fault('echo "ERROR: It is no raster." >&2; mkdir .dem2buildings.1; exit 1', "left .dem2buildings.1")
        self.expect_fault(f"{FINDS_NOTHING}; touch out.gpkg-journal", "left out.gpkg-journal")

    def test_results(self):
        self.expect_fault('echo "{\\"mean\\": Infinity}"; cp "$MADE" out.gpkg', "stdout is not JSON")
        self.expect_fault('echo "{}"', "there is no result")
        self.make(BOW_TIE)
        self.expect_fault(FINDS_NOTHING, "1 polygons are not valid")
        self.make(SQUARE, height=1e999)
        self.expect_fault(FINDS_NOTHING, "height is")
        self.make(SQUARE, area_m2=0)
        self.expect_fault(FINDS_NOTHING, "has no area")
        said = '{\\"output\\": {\\"buildings\\": 2}}'
        self.expect_fault(f'echo "{said}"; cp "$MADE" out.gpkg', "the report says 2 buildings")
        self.make(SQUARE, volume_m3=None)
        self.expect_fault(FINDS_NOTHING, "volume_m3 is NULL")
        self.make(SQUARE, height=1100)
        self.expect_fault(FINDS_NOTHING, "a building of 1100 m")
        _, faults = self.judged(f'{FINDS_NOTHING}; echo "Warning: They may be feet; give -zunit." >&2')
        self.assertEqual(faults, [])


if __name__ == "__main__":
    unittest.main()
