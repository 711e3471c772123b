#!/usr/bin/python3
"""The folder debian of a source package: its version is the project's, and each installed file is in one package or in none on
purpose.

    debian_source.py <source folder> <version>
"""

import pathlib
import re
import sys
import unittest

PATHS = {"LIBDIR": "lib/x86_64-linux-gnu", "MANDIR": "share/man", "PYTHONDIR": "lib/python3/dist-packages"}
# The list is that of `cmake --install` without documents, which have a test of their own.
DOCUMENTS = {f"usr/share/doc/dem2buildings/{name}" for name in ("CHANGELOG.md", "LICENSE", "README.md", "docs")}


def entries(path):
    """Paths of a list, without comments."""
    return [line for line in path.read_text().splitlines() if line and not line.startswith("#")]


def is_in(file, entry):
    """Whether an entry names a file, or the folder that it lies in; in folders a star matches one name."""
    pattern = "[^/]*".join(map(re.escape, entry.split("*")))
    return re.fullmatch(f"{pattern}(/.*)?", file) is not None


class Source(unittest.TestCase):
    def test_the_version_is_the_projects(self):
        first = (DEBIAN / "changelog").read_text().splitlines()[0]
        self.assertRegex(first, rf"^dem2buildings \({re.escape(VERSION)}-[0-9]+\) ")

    def test_each_installed_file_has_one_place(self):
        files = {"usr/" + re.sub(r"^[A-Z]+(?=/)", lambda name: PATHS[name[0]], line).replace(".LIBRARY", ".a")
                 for line in entries(INSTALLED)} | DOCUMENTS
        lists = {path.name: entries(path) for path in [*DEBIAN.glob("*.install"), DEBIAN / "not-installed"]}
        self.assertEqual(len(lists), 4)
        for file in sorted(files):
            found = [name for name, names in lists.items() if any(is_in(file, entry) for entry in names)]
            self.assertEqual(len(found), 1, f"{file} is in {found}")
        for name, names in lists.items():
            for entry in names:
                self.assertTrue(any(is_in(file, entry) for file in files), f"{name} has {entry}, which nothing installs")

    def test_each_package_has_its_list(self):
        packages = re.findall(r"^Package: (.+)$", (DEBIAN / "control").read_text(), re.MULTILINE)
        self.assertEqual(sorted(packages), sorted(path.stem for path in DEBIAN.glob("*.install")))

    def test_it_is_built_with_what_the_project_needs(self):
        """Needs the packages of tools/dev/setup.sh, except compilers and make, because each Debian package has them."""
        setup = (SOURCE / "tools/dev/setup.sh").read_text()
        words = {word for name in ("build", "mesh", "page", "python")
                 for word in re.search(rf'{name}_packages="([^"]+)"', setup)[1].split()}
        field = re.search(r"^Build-Depends:((?:.|\n )+)", (DEBIAN / "control").read_text(), re.MULTILINE)[1]
        self.assertEqual(words - {"g++", "make"} - {name.split()[0] for name in field.split(",")}, set())


if __name__ == "__main__":
    SOURCE, VERSION = pathlib.Path(sys.argv.pop(1)), sys.argv.pop(1)
    DEBIAN = SOURCE / "tools/packaging/debian"
    INSTALLED = SOURCE / "tests/install/installed_files.txt"
    unittest.main()
