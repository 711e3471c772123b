"""The README, word for word: its first command, and the map that its result is in QGIS."""

import os
import pathlib
import re
import subprocess
import unittest

from desk_case import SAMPLES, SOURCE, TOOL, DeskCase

BLOCKS = (391317, 5820317, 391557, 5820497)
TOLERANCE = 0.03


class Readme(DeskCase):
    def test_its_first_command_makes_the_map_that_the_tutorial_shows(self):
        readme = (SOURCE / "README.md").read_text(encoding="utf-8")
        command = re.search(r"^```sh\n(.*?)\n```$", readme, flags=re.M | re.S).group(1)
        (self.folder / "sample_dems").symlink_to(SAMPLES)
        path = f"{pathlib.Path(TOOL).resolve().parent}:{os.environ['PATH']}"
        said = subprocess.run(["sh", "-euc", command], cwd=self.folder, env={**os.environ, "PATH": path}, check=True,
                              capture_output=True, text=True)
        self.assertEqual(said.stderr, "")
        self.assertIn("363 buildings", said.stdout)
        layer = self.layer(self.folder / "town.gpkg", "buildings")
        self.assertLess(self.difference(self.render(layer, BLOCKS), "buildings.png"), TOLERANCE)


if __name__ == "__main__":
    unittest.main()
