"""Headless Chromium for the tests of the page: Debian's chromium and chromedriver, nothing is fetched."""
import os
import shutil

import pytest
from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service

NAMES = {"chromium": ("chromium", "chromium-browser", "google-chrome"), "chromium-driver": ("chromedriver",)}


def programs() -> tuple[str, str]:
    """Browser and driver; without them the tests are skipped, or fail where CI is set."""
    found = [next(filter(None, map(shutil.which, names)), None) for names in NAMES.values()]
    if None in found:
        missing = " and no ".join(name for name, path in zip(NAMES, found) if not path)
        say = f"no {missing}: apt-get install {' '.join(NAMES)}"
        (pytest.fail if os.environ.get("CI") else pytest.skip)(say)
    return found[0], found[1]


def start(width: int, height: int, *more: str) -> webdriver.Chrome:
    """A window of this size; its console and requests are kept."""
    browser, driver = programs()
    options = Options()
    options.binary_location = browser
    for word in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                 "--disable-background-networking",
                 "--no-first-run", f"--window-size={width},{height}", *more):
        options.add_argument(word)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    chrome = webdriver.Chrome(options=options, service=Service(driver))
    chrome.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                           {"width": width, "height": height, "deviceScaleFactor": 1,
                                                                 "mobile": width < 500})
    return chrome
