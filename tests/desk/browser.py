"""Helpers that tests of pages in a real browser share: Debian's Chromium, which draws without a graphics card."""

import io
import json

from PIL import Image, ImageChops, ImageStat
from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.support.ui import WebDriverWait

SOFTWARE = ("--use-angle=swiftshader", "--enable-unsafe-swiftshader")
WITHOUT_WEBGL = ("--disable-3d-apis",)


class Browser:
    """A window with one page in it. @param size of the page in pixels @param dark whether the system is @param language
    that it asks for"""

    def __init__(self, size=(1280, 800), dark=False, flags=SOFTWARE, language="en-GB"):
        options = Options()
        for flag in ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--hide-scrollbars",
                     "--force-device-scale-factor=1", f"--window-size={size[0]},{size[1]}", *flags):
            options.add_argument(flag)
        options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
        self.driver = webdriver.Chrome(service=Service("/usr/bin/chromedriver"), options=options)
        self.call("Emulation.setDeviceMetricsOverride",
                  width=size[0], height=size[1], deviceScaleFactor=1, mobile=False)
        agent = self.driver.execute_script("return navigator.userAgent")
        self.call("Emulation.setUserAgentOverride", userAgent=agent, acceptLanguage=language)
        self.call("Emulation.setEmulatedMedia",
                  features=[{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}])

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.driver.quit()

    def call(self, name, **arguments):
        return self.driver.execute_cdp_cmd(name, arguments)

    def run(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def open(self, path, patience=60):
        """Until the picture has all that is to be seen."""
        self.driver.get(path.resolve().as_uri())
        self.wait(patience)

    def wait(self, patience=60):
        WebDriverWait(self.driver, patience, 0.1).until(
            lambda driver: driver.execute_script("return document.documentElement.dataset.ready === 'yes'"))

    def text(self, name):
        return self.run("return document.getElementById(arguments[0]).innerText", name)

    def is_seen(self, name):
        return self.run("return !document.getElementById(arguments[0]).hidden", name)

    def press(self, name):
        self.run("document.getElementById(arguments[0]).click()", name)

    def slide(self, level):
        self.run("const slider = document.getElementById('level'); slider.value = arguments[0];"
                 "slider.dispatchEvent(new Event('input'))", level)

    def click(self, x, y):
        for kind in ("mousePressed", "mouseReleased"):
            self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)

    def picture(self):
        return Image.open(io.BytesIO(self.driver.get_screenshot_as_png())).convert("RGB")

    def complaints(self):
        return [entry["message"] for entry in self.driver.get_log("browser") if entry["level"] != "INFO"]

    def requests(self):
        """Addresses that were asked for."""
        found = []
        for entry in self.driver.get_log("performance"):
            message = json.loads(entry["message"])["message"]
            if message["method"] == "Network.requestWillBeSent":
                found.append(message["params"]["request"]["url"])
        return found


def difference(one, other):
    """Mean distance of the pixels of two pictures, 0 to 255; of other sizes the second is brought to the first's."""
    stat = ImageStat.Stat(ImageChops.difference(one, other.resize(one.size)))
    return sum(stat.mean) / len(stat.mean)
