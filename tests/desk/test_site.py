"""The site of the documentation in Chromium: its search, its colours, on a phone, and that it needs no network."""

import functools
import http.server
import pathlib
import threading
import unittest

from selenium.webdriver.support.ui import WebDriverWait

from browser import Browser

SITE = pathlib.Path(__file__).resolve().parents[2] / "build/site"
PHONE = 390

# Ratio of the luminances of a link, and of the text, to the background (WCAG 2).
CONTRASTS = """
    const luminance = (colour) => {
      const parts = colour.match(/[0-9.]+/g).slice(0, 3).map((part) => part / 255)
          .map((part) => part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4);
      return 0.2126 * parts[0] + 0.7152 * parts[1] + 0.0722 * parts[2];
    };
    const below = luminance(getComputedStyle(document.body).backgroundColor);
    return ["article p", "article a[href]:not(.headerlink)"].map((which) => {
      const here = luminance(getComputedStyle(document.querySelector(which)).color);
      return (Math.max(here, below) + 0.05) / (Math.min(here, below) + 0.05);
    });"""


class Quiet(http.server.SimpleHTTPRequestHandler):
    def log_message(self, *_):
        pass


@unittest.skipUnless((SITE / "index.html").exists(), f"there is no {SITE}; run mkdocs build")
class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=str(SITE)))
        cls.address = f"http://127.0.0.1:{cls.server.server_port}/"
        threading.Thread(target=cls.server.serve_forever, daemon=True).start()

    @classmethod
    def tearDownClass(cls):
        cls.server.shutdown()
        cls.server.server_close()

    def test_the_search_finds_a_page_without_a_network(self):
        with Browser() as browser:
            browser.driver.get(self.address + "index.html")
            # Asked until the index is there.
            search = """const field = document.querySelector('[data-md-component=search-query]');
                field.focus();
                field.value = 'parcels';
                field.dispatchEvent(new Event('keyup'));
                return [...document.querySelectorAll('.md-search-result__list a')].map((link) => link.pathname);"""
            found = WebDriverWait(browser.driver, 60, 0.5).until(lambda driver: driver.execute_script(search))
            self.assertIn("/tasks/houses.html", found)
            for address in browser.requests():
                self.assertTrue(address.startswith((self.address, "data:", "blob:")), address)

    def test_text_and_links_are_legible_in_light_and_dark(self):
        for dark in (False, True):
            with self.subTest(dark=dark), Browser(dark=dark) as browser:
                browser.driver.get(self.address + "tutorial.html")
                scheme = "slate" if dark else "default"
                WebDriverWait(browser.driver, 60, 0.5).until(
                    lambda driver: driver.execute_script("return document.body.dataset.mdColorScheme") == scheme and
                    min(driver.execute_script(CONTRASTS)) > 4.5)

    def test_no_page_is_wider_than_a_phone(self):
        with Browser(size=(PHONE, 780)) as browser:
            for page in sorted(SITE.rglob("*.html")):
                name = page.relative_to(SITE).as_posix()
                if not name.startswith("cpp/") and name != "404.html":
                    browser.driver.get(self.address + name)
                    self.assertLessEqual(browser.run("return document.documentElement.scrollWidth"), PHONE, name)


if __name__ == "__main__":
    unittest.main()
