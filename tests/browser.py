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


def start(width: int, height: int) -> webdriver.Chrome:
    """A window of this size; its console and requests are kept."""
    browser, driver = programs()
    options = Options()
    options.binary_location = browser
    for word in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                 "--disable-background-networking", "--no-first-run", f"--window-size={width},{height}"):
        options.add_argument(word)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    chrome = webdriver.Chrome(options=options, service=Service(driver))
    resize(chrome, width, height)
    return chrome


def resize(chrome: webdriver.Chrome, width: int, height: int) -> None:
    """Narrow windows are those of a phone."""
    chrome.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
        "width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 500})


#: text and ground of what there are many of; WCAG AA: 4.5
CONTRAST = """
const of = (what, name) => getComputedStyle(document.querySelector(what))[name];
const page = of('body', 'backgroundColor'), marks = ['.holds', '.fails', '.undecidable'];
return [[of('body', 'color'), page, 7], ...['.answer p', 'nav a'].map(one => [of(one, 'color'), page, 4.5]),
        [of('.made', 'color'), of('figure', 'backgroundColor'), 4.5],
        ...marks.map(one => [of(one, 'color'), of(one, 'backgroundColor'), 4.5])];
"""


def contrast(one: str, other: str) -> float:
    """Ratio of luminances of two CSS colours    [WCAG 2.2, 1.4.3]"""
    def luminance(colour: str) -> float:
        parts = [float(part)/255 for part in colour[colour.index("(") + 1:-1].split(",")[:3]]
        linear = [part/12.92 if part <= 0.04045 else ((part + 0.055)/1.055)**2.4 for part in parts]
        return 0.2126*linear[0] + 0.7152*linear[1] + 0.0722*linear[2]
    bright, dark = sorted((luminance(one), luminance(other)), reverse=True)
    return (bright + 0.05)/(dark + 0.05)
