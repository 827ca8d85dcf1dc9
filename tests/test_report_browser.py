"""The page in headless Chromium, from file://: short, quiet, by keyboard, on a phone, without network.

Debian's chromium and chromedriver; without them the tests are skipped, or fail where CI is set.
"""
import json
import os
import re
import shutil

import pytest
from selenium import webdriver
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import Select, WebDriverWait

from studies.kit.claim import paper_of
from studies.kit.csvfile import read
from studies.kit.store import RESULTS
from studies.report.page import text

pytestmark = pytest.mark.skipif(not (RESULTS/"claims.csv").exists(),
                                reason="no results yet: make study-rb writes them")
#: screens that the page may be long while all is folded
SCREENS = 15


@pytest.fixture(scope="module")
def page(tmp_path_factory) -> str:
    """The page of the committed results."""
    path = tmp_path_factory.mktemp("page")/"index.html"
    path.write_text(text(RESULTS))
    return path.as_uri()


@pytest.fixture(scope="module")
def chrome():
    """A browser that keeps its console and requests."""
    if not (shutil.which("chromium") and shutil.which("chromedriver")):
        (pytest.fail if os.environ.get("CI") else pytest.skip)("apt-get install chromium chromium-driver")
    options = webdriver.ChromeOptions()
    options.binary_location = shutil.which("chromium")
    for word in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                 "--disable-background-networking", "--no-first-run"):
        options.add_argument(word)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    service = webdriver.ChromeService(shutil.which("chromedriver"))
    with webdriver.Chrome(options=options, service=service) as started:
        yield started


def resize(chrome, width: int, height: int):
    """Narrow windows are those of a phone."""
    chrome.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
        "width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 500})
    return chrome


@pytest.fixture(scope="module")
def desk(chrome, page):
    """A wide window."""
    resize(chrome, 1366, 768).get(page)
    return chrome


@pytest.fixture
def sized(desk):
    """The same page in windows of other sizes."""
    def resized(width: int, height: int):
        return resize(desk, width, height)
    yield resized
    resize(desk, 1366, 768)


@pytest.fixture(scope="module")
def claims():
    return read(RESULTS/"claims.csv").fillna({"equation": ""})


def shown(chrome) -> set[str]:
    """Claims that are seen."""
    return set(chrome.execute_script("return [...document.querySelectorAll('.claims tbody tr')]"
                                     ".filter(row => row.checkVisibility()).map(row => row.id.slice(6))"))


def focused(chrome) -> str:
    return chrome.execute_script("const a = document.activeElement; return a.id || a.className || a.tagName")


def clear(chrome) -> None:
    chrome.find_element(By.CSS_SELECTOR, "#search button").click()
    WebDriverWait(chrome, 5).until(lambda _: not shown(chrome))


def typed(chrome, words: str) -> None:
    """Typed into the search box in place of what stood there."""
    box = chrome.find_element(By.ID, "phrase")
    box.clear()
    box.send_keys(words)


def test_no_errors_and_no_request_but_to_the_file_itself(desk, page):
    """The performance log has each request of the load."""
    desk.get("about:blank")
    desk.get_log("performance")
    desk.get_log("browser")
    desk.get(page)
    events = [json.loads(entry["message"])["message"] for entry in desk.get_log("performance")]
    asked = {event["params"]["request"]["url"][:40] for event in events
             if event["method"] == "Network.requestWillBeSent"}
    assert page[:40] in asked
    assert all(url.startswith(("file://", "data:")) for url in asked), asked
    assert desk.get_log("browser") == []


@pytest.mark.parametrize("size", [(1366, 768), (1920, 1080)])
def test_question_answer_choice_and_picture_are_on_one_screen(sized, size):
    chrome = sized(*size)
    for what in ("#question", ".answer li:last-child", ".lead", ".choice"):
        bottom = chrome.execute_script("return document.querySelector(arguments[0]).getBoundingClientRect()"
                                       ".bottom + scrollY", what)
        assert bottom <= size[1], what
    assert len(chrome.find_elements(By.CSS_SELECTOR, ".answer li")) == 5


#: what is wider than the window though no box of its own scrolls it
CUT = """return [...document.querySelectorAll(arguments[0])].filter(one =>
    one.getBoundingClientRect().right > innerWidth + 1 && !one.closest('.scroll, .strip, .cards')).length"""


@pytest.mark.parametrize("size", [(360, 740), (390, 844), (768, 1024), (1024, 768), (1366, 768),
                                  (1920, 1080)])
def test_the_page_is_short_while_folded_and_no_table_is_cut(sized, size):
    chrome = sized(*size)
    length, width = chrome.execute_script(
        "const all = document.documentElement; return [all.scrollHeight, all.scrollWidth]")
    assert length <= SCREENS*size[1] and width <= size[0]
    whole = "const one = document.querySelector('.choice .scroll'); return one.scrollWidth <= one.clientWidth"
    assert chrome.execute_script(whole), "the choice needs no scrolling"
    folds = chrome.execute_script("""const folds = [...document.querySelectorAll('details:not([open])')];
        folds.forEach(fold => { fold.open = true; }); window.opened = folds; return folds.length""")
    assert folds > 600
    assert chrome.execute_script("return document.documentElement.scrollWidth") <= size[0]
    assert chrome.execute_script(CUT, "table") == 0
    chrome.execute_script("opened.forEach(fold => { fold.open = false; })")


def test_the_parts_stay_in_reach_on_a_phone(sized):
    chrome = sized(390, 844)
    chrome.execute_script("scrollTo(0, 3000)")
    top = chrome.execute_script("return document.querySelector('nav').getBoundingClientRect().top")
    assert 0 <= top < 20
    chrome.execute_script("scrollTo(0, 0)")


@pytest.mark.parametrize(("words", "place"), [
    ("Eq. 45", "RR98 Eq. 45"), ("eq 5", "RR98 Eq. 5"), ("KHP95 Eq. 2", "KHP95 Eq. 2"),
    ("RR98 Sec. III", "RR98 Sec. III"), ("Fig. 10", "KHP95 Fig. 10")])
def test_a_place_in_the_words_finds_exactly_its_claims(desk, claims, words, place):
    typed(desk, words)
    wanted = {one for one, places in zip(claims["id"], claims["equation"]) if place in places.split("; ")}
    assert shown(desk) == wanted and wanted
    assert desk.find_element(By.ID, "count").text == f"{len(wanted)} of {len(claims)} claims"
    clear(desk)


def test_filters_leave_the_claims_that_the_table_has(desk, claims):
    """Each alone, then together and with words; studies without any are not shown."""
    papers = claims["source"].map(paper_of)
    for name, column in (("by-verdict", claims["verdict"]), ("by-paper", papers)):
        box = Select(desk.find_element(By.ID, name))
        for value in sorted(set(column)):
            box.select_by_value(value)
            assert shown(desk) == {*claims["id"][column == value]}, value
        box.select_by_value("")
    Select(desk.find_element(By.ID, "by-place")).select_by_value("RR98 Eq. 45")
    Select(desk.find_element(By.ID, "by-verdict")).select_by_value("fails")
    typed(desk, "vortex")
    text = claims.astype(object).fillna("").astype(str).agg(" ".join, axis=1).str.lower()
    judges = claims["equation"].map(lambda cell: "RR98 Eq. 45" in cell.split("; "))
    wanted = claims[judges & claims["verdict"].eq("fails") & text.str.contains("vortex")]
    assert shown(desk) == {*wanted["id"]} and len(wanted)
    seen = desk.execute_script("return [...document.querySelectorAll('.study')].filter(one => "
                               "one.checkVisibility()).map(one => one.id.slice(6))")
    assert {*seen} == {*wanted["study"]}
    clear(desk)


def test_by_keyboard_alone_from_the_first_link_to_filtered_claims(desk, page, claims):
    """Skip link first; the search is reached by Tab, takes typing, and what is left is announced."""
    desk.get("about:blank")
    desk.get(page)
    ActionChains(desk).send_keys(Keys.TAB).perform()
    assert focused(desk) == "skip"
    assert desk.execute_script("return document.activeElement.getBoundingClientRect().left") >= 0, "seen"
    for _ in range(120):
        if focused(desk) == "phrase":
            break
        ActionChains(desk).send_keys(Keys.TAB).perform()
    assert focused(desk) == "phrase"
    style = "getComputedStyle(document.activeElement)"
    assert desk.execute_script(f"return [{style}.outlineStyle, {style}.outlineWidth]") == ["solid", "3px"]
    ActionChains(desk).send_keys("fluctuations").perform()
    count = desk.find_element(By.ID, "count")
    assert 0 < len(shown(desk)) < len(claims)
    assert re.match(f"{len(shown(desk))} of ", count.text) and count.get_attribute("aria-live") == "polite"
    clear(desk)


def test_a_link_unfolds_what_it_leads_to_even_out_of_a_search(desk):
    """A finding leads to its figure, the figure to its table, a name to its word."""
    desk.execute_script("scrollTo(0, 0)")
    desk.find_element(By.CSS_SELECTOR, ".answer li a").click()
    figure = desk.find_element(By.CSS_SELECTOR, "figure:target")
    assert figure.is_displayed() and figure.get_attribute("data-figure") == "rb/convergence"
    figure.find_element(By.CSS_SELECTOR, "summary").click()
    figure.find_element(By.CSS_SELECTOR, ".made a").click()
    assert desk.find_element(By.CSS_SELECTOR, "details:target table").is_displayed()
    typed(desk, "Eq. 45")
    desk.execute_script("location.hash = '#figure-noise-printed'")
    WebDriverWait(desk, 5).until(lambda _: desk.find_element(By.ID, "figure-noise-printed").is_displayed())
    desk.execute_script("location.hash = '#word-moving'")
    WebDriverWait(desk, 5).until(lambda _: desk.find_element(By.ID, "word-moving").is_displayed())


def test_films_can_be_played(desk):
    assert desk.execute_async_script("""const done = arguments[0], film = document.querySelector('video');
        film.addEventListener('timeupdate', () => done(film.videoWidth === 640 && !film.error), {once: true});
        film.play().catch(() => done(false))""")


def test_the_page_can_be_read_without_scripts_on_a_phone_and_on_paper(sized, page):
    """All claims are in the file, no form is printed."""
    chrome = sized(360, 740)
    chrome.get("about:blank")
    chrome.get(page)
    chrome.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
    assert not chrome.find_element(By.TAG_NAME, "nav").is_displayed()
    assert chrome.execute_script("return document.documentElement.scrollWidth") <= 360
    chrome.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": ""})
    chrome.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": True})
    chrome.get(page)
    rows = chrome.find_elements(By.CSS_SELECTOR, ".claims tbody tr")
    assert len(rows) == len(read(RESULTS/"claims.csv"))
    assert not chrome.find_element(By.ID, "search").is_displayed()
