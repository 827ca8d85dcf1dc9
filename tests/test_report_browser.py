"""The page in a browser, from file://: quick, quiet, by keyboard, on a phone, without network."""
import json
from contextlib import contextmanager

import pytest
from browser import start
from report_tables import committed
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import Select, WebDriverWait

from studies.kit.csvfile import read
from studies.kit.store import RESULTS
from studies.report.page import address, render

pytestmark = pytest.mark.skipif(not (RESULTS/"claims.csv").exists(),
                                reason="no results yet: make study-rb writes them")


@pytest.fixture(scope="module")
def page(tmp_path_factory) -> str:
    """The page of the committed results; figures as they are, which is quicker than to pack them."""
    text = render(RESULTS, committed(), lambda path: address("image/png", path.read_bytes()))
    path = tmp_path_factory.mktemp("page")/"index.html"
    path.write_text(text)
    return path.as_uri()


@pytest.fixture(scope="module")
def desk(page):
    """A wide window; motion is not wanted, so that nothing changes by itself."""
    chrome = start(1280, 900, "--force-prefers-reduced-motion")
    chrome.get(page)
    yield chrome
    chrome.quit()


@contextmanager
def closing(chrome):
    """Ends with the test."""
    try:
        yield chrome
    finally:
        chrome.quit()


@pytest.fixture(scope="module")
def claims():
    return read(RESULTS/"claims.csv")


def shown(chrome) -> int:
    return chrome.execute_script("return [...document.querySelectorAll('.claims tbody tr')]"
                                 ".filter(r => r.offsetParent).length")


def focused(chrome) -> str:
    return chrome.execute_script("const a = document.activeElement; return a.id || a.className || a.tagName")


def clear(chrome) -> None:
    chrome.execute_script("document.querySelector('#filters').reset()")
    assert chrome.execute_async_script("setTimeout(() => arguments[0]("
                                       "document.querySelector('#count').textContent), 20)")


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


@pytest.fixture
def sized(desk):
    """The same page in windows of other sizes."""
    def resize(width: int, height: int):
        desk.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                             {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False})
        return desk
    yield resize
    resize(1280, 900)


# 625: what browsers leave of a laptop's 768
@pytest.mark.parametrize("size", [(1366, 625), (1920, 940)])
def test_the_question_its_answer_and_the_findings_are_on_one_screen(sized, size):
    chrome = sized(*size)
    bottom, lead = chrome.execute_script("return ['.findings', '.lead'].map("
                                         "one => document.querySelector(one).getBoundingClientRect()"
                                         ".bottom + scrollY)")
    assert bottom < size[1] and lead < size[1]
    assert chrome.execute_script("return document.documentElement.scrollWidth <= innerWidth")
    assert len(chrome.find_elements(By.CSS_SELECTOR, ".findings li")) >= 5


def test_filters_leave_the_rows_that_the_table_has(desk, claims):
    """Each filter alone, then two together."""
    for column in ("verdict", "study", "whose"):
        box = Select(desk.find_element(By.CSS_SELECTOR, f"#by-{column}"))
        for value in sorted(set(claims[column])):
            box.select_by_index([option.get_property("value") for option in box.options].index(value))
            assert shown(desk) == (claims[column] == value).sum(), value
        box.select_by_index(0)
    Select(desk.find_element(By.ID, "by-paper")).select_by_visible_text("KHP95")
    Select(desk.find_element(By.ID, "by-verdict")).select_by_value("fails")
    wanted = (claims["source"].str.startswith("KHP95") & claims["verdict"].eq("fails")).sum()
    assert shown(desk) == wanted > 0
    assert desk.find_element(By.ID, "count").text == f"{wanted} of {len(claims)} claims"
    clear(desk)
    assert shown(desk) == len(claims)


def test_by_keyboard_alone_from_the_first_link_to_filtered_claims(desk, page, claims):
    """Skip link first; the filter is reached by Tab, takes typing, and what is left is announced."""
    desk.get("about:blank")
    desk.get(page)
    ActionChains(desk).send_keys(Keys.TAB).perform()
    assert focused(desk) == "skip"
    assert desk.execute_script("return document.activeElement.getBoundingClientRect().left") >= 0, "seen"
    for _ in range(120):
        if focused(desk) == "by-text":
            break
        ActionChains(desk).send_keys(Keys.TAB).perform()
    assert focused(desk) == "by-text"
    style = "getComputedStyle(document.activeElement)"
    assert desk.execute_script(f"return [{style}.outlineStyle, {style}.outlineWidth]") == ["solid", "3px"]
    ActionChains(desk).send_keys("brillouin").perform()
    count = desk.find_element(By.ID, "count")
    left = shown(desk)
    text = claims[["id", "statement", "source", "printed", "reason", "study"]].agg(" ".join,
                                                                                   axis=1).str.lower()
    assert left == text.str.contains("brillouin").sum() > 0
    assert count.text.startswith(f"{left} of ") and count.get_attribute("aria-live") == "polite"
    clear(desk)


def test_a_point_tells_its_values_to_pointer_and_keyboard(desk):
    plot = desk.find_element(By.CSS_SELECTOR, "#panel-0 .plot")
    points = [one for one in plot.find_elements(By.CSS_SELECTOR, ".point") if one.is_displayed()]
    tip = plot.find_element(By.CLASS_NAME, "tip")
    desk.execute_script("arguments[0].scrollIntoView({block: 'center', behavior: 'instant'})", plot)
    assert not tip.is_displayed()
    ActionChains(desk).move_to_element(points[1].find_element(By.CLASS_NAME, "mark")).perform()
    assert tip.is_displayed() and "CPU seconds" in tip.text and "error" in tip.text
    ActionChains(desk).move_to_element(desk.find_element(By.ID, "cost-title")).perform()
    assert not tip.is_displayed()
    desk.execute_script("document.querySelector('#panel-0 .point[tabindex=\"0\"]').focus()")
    first = tip.text
    ActionChains(desk).send_keys(Keys.ARROW_RIGHT).perform()
    assert tip.is_displayed() and tip.text != first
    assert tip.text.split("\n")[0] == first.split("\n")[0], "along the series"
    ActionChains(desk).send_keys(Keys.ARROW_DOWN).perform()
    assert tip.text.split("\n")[0] != first.split("\n")[0], "to the next series"


def test_every_committed_figure_is_there_with_its_commit_and_words(desk):
    figures = desk.execute_script("""return [...document.querySelectorAll('[data-figure]')].map(f =>
        [f.dataset.figure, f.querySelector('.commit').textContent, f.querySelector('img').alt,
         f.querySelector('img').naturalWidth])""")
    assert {name for name, *_ in figures} == {f"{path.parent.name}/{path.stem}"
                                              for path in RESULTS.glob("*/*.png")
                                              if path.parent.name not in ("raw", "quick")}
    for name, commit, alt, width in figures:
        assert len(commit) >= 7 and len(alt) > 10 and width > 100, name


def test_films_play_while_they_are_seen(page):
    with closing(start(1280, 900)) as chrome:
        chrome.get(page)
        film, *others = chrome.find_elements(By.TAG_NAME, "video")
        assert not any(one.get_attribute("src")
                       for one in (film, *others)), "what is not looked at costs nothing"
        chrome.execute_script("arguments[0].scrollIntoView({block: 'center', behavior: 'instant'})", film)
        plays(chrome, film)
        chrome.execute_script("scrollTo({top: 0, behavior: 'instant'})")
        until(chrome, film, "film.paused")
        assert chrome.get_log("browser") == []


def plays(chrome, film) -> None:
    """It is decoded, and goes on."""
    until(chrome, film, "film.currentTime > 0.2 && film.videoWidth === 640 && !film.error")


def until(chrome, film, what: str) -> None:
    """Wait for what a film shall do."""
    script = f"const film = arguments[0]; return {what}"
    WebDriverWait(chrome, 5).until(lambda _: chrome.execute_script(script, film), what)


def test_the_page_can_be_read_without_scripts_and_on_a_phone(page):
    """All claims, figures and findings are in the file; nothing is wider than the screen, text stands out."""
    with closing(start(360, 740, "--force-prefers-reduced-motion")) as chrome:
        chrome.get(page)
        for scheme in ("light", "dark"):
            scheme = {"name": "prefers-color-scheme", "value": scheme}
            chrome.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": [scheme]})
            assert chrome.execute_script("return [document.documentElement.scrollWidth, innerWidth]") == [360,
                                                                                                          360]
            for colour, ground, least in chrome.execute_script(CONTRAST):
                assert contrast(colour, ground) >= least, (scheme, colour, ground)
        chrome.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": True})
        chrome.get(page)
        assert len(chrome.find_elements(By.CSS_SELECTOR,
                                        ".claims tbody tr")) == len(read(RESULTS/"claims.csv"))
        assert chrome.find_element(By.ID, "panel-0").is_displayed()


#: text and ground of what there are many of; WCAG AA: 4.5
CONTRAST = """
const of = (what, name) => getComputedStyle(document.querySelector(what))[name];
const page = of('body', 'backgroundColor'), marks = ['.holds', '.fails', '.undecidable'];
return [[of('body', 'color'), page, 7], ...['.findings p', 'nav a'].map(one => [of(one, 'color'), page, 4.5]),
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
