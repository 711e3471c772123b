#!/usr/bin/python3
"""Builds the site of the documentation in strict mode, and checks it as a reader without a network meets it.

    check_site.py <source folder> <build folder>

Every page of docs/ is in the site, in its search, and reached by links from the first page; links and anchors lead
somewhere; nothing is loaded from another host; there is a light and a dark palette, and a width for phones. Ends with
status 77 if a package that builds the site is missing.
"""

import importlib.util
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import urllib.parse
from html.parser import HTMLParser

SKIPPED = 77
LOADED = {"script": "src", "img": "src", "iframe": "src", "source": "src"}


def missing():
    """Names of packages that are missing to build the site."""
    names = []
    for module, package in (("mkdocs", "mkdocs"), ("mkdocstrings", "mkdocstrings"),
                            ("mkdocstrings_handlers", "mkdocstrings-python-handlers")):
        if importlib.util.find_spec(module) is None:
            names.append(package)
    if not names:
        from mkdocs.utils import get_theme_names  # pylint: disable=import-outside-toplevel

        names += [] if "material" in get_theme_names() else ["mkdocs-material"]
    return names + ([] if shutil.which("doxygen") else ["doxygen"])


class Page(HTMLParser):
    def __init__(self, path):
        super().__init__()
        self.links = []
        self.loads = []
        self.anchors = set()
        self.schemes = set()
        self.phone = False
        self.feed(path.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        if values.get("id"):
            self.anchors.add(values["id"])
        if tag == "a":
            self.anchors.add(values.get("name"))
            self.links.append(values.get("href") or "")
        elif tag == "link" and values.get("rel") != "canonical":
            self.loads.append(values.get("href") or "")
        elif tag in LOADED and values.get(LOADED[tag]):
            self.loads.append(values[LOADED[tag]])
        if values.get("data-md-color-scheme"):
            self.schemes.add(values["data-md-color-scheme"])
        self.phone |= tag == "meta" and values.get("name") == "viewport"


def is_elsewhere(address):
    return bool(re.match(r"[a-z][a-z0-9+.-]*:|//", address)) and not address.startswith("data:")


class Site:
    def __init__(self, folder):
        self.folder = folder
        self.pages = {path: Page(path) for path in sorted(folder.rglob("*.html")) if "cpp" not in path.relative_to(folder).parts}
        self.faults = []

    def fault(self, path, text):
        self.faults.append(f"{path.relative_to(self.folder)}: {text}")

    def target(self, path, link):
        """The file and the anchor that a link of a page leads to."""
        address, _, anchor = link.partition("#")
        place = path if not address else (path.parent / urllib.parse.unquote(address.split("?")[0])).resolve()
        return place, urllib.parse.unquote(anchor)

    def check_links(self):
        for path, page in self.pages.items():
            if path.name == "404.html":  # its addresses are those of a server
                continue
            for link in page.links + page.loads:
                if is_elsewhere(link) or link.startswith("data:"):
                    continue
                place, anchor = self.target(path, link)
                if not place.is_file():
                    self.fault(path, f"'{link}' leads nowhere")
                elif anchor and place in self.pages and anchor not in self.pages[place].anchors:
                    self.fault(path, f"'{link}' leads to a page without this anchor")

    def check_loads(self):
        for path, page in self.pages.items():
            for address in page.loads:
                if is_elsewhere(address):
                    self.fault(path, f"loads {address}")
            if not page.phone:
                self.fault(path, "has no width for phones")
        for path in self.folder.rglob("*.css"):
            for address in re.findall(r"(?:url\(|@import\s+)[\"']?([^\"')\s]+)", path.read_text(encoding="utf-8")):
                if is_elsewhere(address):
                    self.fault(path, f"loads {address}")
        if self.pages[self.folder / "index.html"].schemes < {"default", "slate"}:
            self.fault(self.folder / "index.html", "has no light and dark palette")

    def reached(self):
        """The pages to which links lead from the first one."""
        seen = set()
        to_see = [self.folder / "index.html"]
        while to_see:
            path = to_see.pop()
            if path in seen or path not in self.pages:
                continue
            seen.add(path)
            to_see += [self.target(path, link)[0] for link in self.pages[path].links if not is_elsewhere(link)]
        return seen

    def check_pages(self, docs):
        found = json.loads((self.folder / "search/search_index.json").read_text(encoding="utf-8"))["docs"]
        searched = {entry["location"].split("#")[0] for entry in found}
        reached = self.reached()
        for source in sorted(docs.rglob("*.md")):
            name = source.relative_to(docs).with_suffix(".html")
            path = self.folder / (name.with_name("index.html") if name.stem == "README" else name)
            if path not in self.pages:
                self.faults.append(f"{source} is not in the site")
            elif path not in reached:
                self.fault(path, "is not reached from the first page; name it in mkdocs.yml, or link to it")
            elif path.relative_to(self.folder).as_posix() not in searched and path.name != "index.html":
                self.fault(path, "is not found by the search")
        if not (self.folder / "cpp/index.html").is_file():
            self.faults.append("the interface of C++ is missing")


def main(source, build):
    names = missing()
    if names:
        print("Skipped, because these are missing: " + ", ".join(names))
        return SKIPPED
    folder = build / "site"
    environment = {**os.environ, "D2B_BUILD": str(build), "PYTHONDONTWRITEBYTECODE": "1", "NO_COLOR": "1"}
    done = subprocess.run([sys.executable, "-m", "mkdocs", "build", "--strict", "--site-dir", str(folder)], cwd=source,
                          env=environment, capture_output=True, text=True, check=False)
    if done.returncode:
        print(done.stdout + done.stderr)
        return 1
    site = Site(folder.resolve())
    site.check_links()
    site.check_loads()
    site.check_pages(source / "docs")
    print("\n".join(site.faults) or f"{len(site.pages)} pages are well")
    return 1 if site.faults else 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()))
