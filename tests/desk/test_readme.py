"""The README, word for word: its first command, and the map that its result is in QGIS. D2B_README_MAP names a result of
that command, which is then not run again."""

import os
import pathlib
import re
import subprocess
import unittest

from desk_case import SAMPLES, SOURCE, TOOL, DeskCase

BLOCKS = (391317, 5820317, 391557, 5820497)
TOLERANCE = 0.03


class Readme(DeskCase):
    def run_it(self, command):
        (self.folder / "sample_dems").symlink_to(SAMPLES)
        path = f"{pathlib.Path(TOOL).resolve().parent}:{os.environ['PATH']}"
        said = subprocess.run(["sh", "-euc", command], cwd=self.folder, env={**os.environ, "PATH": path}, check=True,
                              capture_output=True, text=True)
        self.assertEqual(said.stderr, "")
        self.assertIn("364 buildings", said.stdout)
        return self.folder / "town.gpkg"

    def test_its_first_command_makes_the_map_that_the_tutorial_shows(self):
        readme = (SOURCE / "README.md").read_text(encoding="utf-8")
        command = re.search(r"^```sh\n(.*?)\n```$", readme, flags=re.M | re.S).group(1)
        self.assertIn(f"    {command}\n", readme)  # among those that build the program first
        made = os.environ.get("D2B_README_MAP") or self.run_it(command)
        layer = self.layer(made, "buildings")
        self.assertLess(self.difference(self.render(layer, BLOCKS), "buildings.png"), TOLERANCE)


if __name__ == "__main__":
    unittest.main()
