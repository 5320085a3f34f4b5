#!/usr/bin/python3
"""report_page_test.py LKAO_BENCH FOLDER: the report's page in headless Chromium, by mouse and keyboard.

Makes a small report in FOLDER, which is emptied, and looks at it as a reader does. Screenshots stay in FOLDER.
"""

import pathlib
import shutil
import signal
import subprocess
import sys
import time

try:
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
except ImportError:
    webdriver = None

METHODS = "query,tables"


def command(bench, folder):
    return [bench, "report", "-o", str(folder), "--quick", "--scenes", "box", "--methods", METHODS, "--rounds", "1"]


def make_report(bench, folder):
    """Stopped midway by Ctrl-C, and gone on with: what was measured before is in the page."""
    first = subprocess.Popen(command(bench, folder), stdout=subprocess.PIPE, text=True)
    for line in first.stdout:
        if "RMSE" in line:
            break
    first.send_signal(signal.SIGINT)
    first.stdout.read()
    assert first.wait() == 130, f"Ctrl-C gave the exit code {first.returncode}"
    assert not (folder / "report.html").exists(), "a report that was stopped has a page"
    measured = {path: path.read_bytes() for path in (folder / "measured").glob("*.json")
                if not path.name.startswith("seconds_spent")}  # by all starts together
    assert measured, "nothing was kept"
    subprocess.run(command(bench, folder), check=True, stdout=subprocess.DEVNULL)
    for path, text in measured.items():
        assert path.read_bytes() == text, f"{path.name} was measured again"
    page = (folder / "report.html").read_bytes()
    again = subprocess.run(command(bench, folder), check=True, capture_output=True, text=True)
    assert "RMSE" not in again.stdout, "something was measured a third time"
    assert (folder / "report.html").read_bytes() == page, "the same measurements give another page"


def open_browser():
    options = webdriver.ChromeOptions()
    options.binary_location = shutil.which("chromium")
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--window-size=1200,1600", "--no-first-run"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)


class Page:
    def __init__(self, browser):
        self.browser = browser

    def find(self, selector):
        return self.browser.find_element(By.CSS_SELECTOR, selector)

    def find_all(self, selector):
        return self.browser.find_elements(By.CSS_SELECTOR, selector)

    def caption(self, wanted):
        """Pictures are decoded while the reader goes on."""
        deadline = time.time() + 10
        while time.time() < deadline:
            if wanted in self.find("#picture-caption").text:
                return
            time.sleep(0.05)
        raise AssertionError(f"'{wanted}' is not in the caption '{self.find('#picture-caption').text}'")

    def pixels(self):
        """The canvas as it is drawn: its size and its bytes."""
        return self.browser.execute_script(
            "const c = document.getElementById('picture');"
            "return [c.width, c.height, ...c.getContext('2d').getImageData(0, 0, c.width, c.height).data]")

    def press(self, keys):
        self.find("#viewer").send_keys(keys)


def check_plot(page):
    points = page.find_all("#plot .point")
    methods = page.find_all("#shown option")
    assert len(points) == len(methods) > 5, f"{len(points)} points of {len(methods)} methods"
    labels = [point.get_attribute("aria-label") for point in points]
    assert any("lkao render" in label and "RMSE" in label for label in labels), labels
    page.find("#legend button").click()
    assert 0 < len(page.find_all("#plot .point")) < len(points), "the legend hides nothing"
    page.find("#legend button").click()
    assert len(page.find_all("#plot .point")) == len(points)
    # A point is reached and chosen without a mouse.
    chosen = page.find_all("#plot .point")[-1]
    name = chosen.get_attribute("aria-label").split(":")[0]
    page.browser.execute_script("arguments[0].focus()", chosen)
    assert name in page.find("#plot-caption").text
    page.browser.switch_to.active_element.send_keys(Keys.ENTER)
    page.caption(name)


def check_viewer(page):
    page.press("1")
    page.caption("Visibility by")
    picture = page.pixels()
    assert picture[:2] == [160, 120] and len(set(picture[2:])) > 20, "the picture is blank"
    page.press("2")
    page.caption("rays a pixel")
    rays = page.pixels()
    assert rays != picture and len(rays) == len(picture)
    page.press(" ")
    page.caption("Visibility by")
    assert page.pixels() == picture, "space does not flip back"
    page.press("3")
    page.caption("Signed error")
    assert page.pixels() != picture
    before = page.find("#shown").get_attribute("value")
    page.press(Keys.ARROW_RIGHT)
    assert page.find("#shown").get_attribute("value") != before
    page.press(Keys.ARROW_LEFT)
    assert page.find("#shown").get_attribute("value") == before
    page.press("4")
    page.caption("ray")
    page.press("1")
    page.press("m")
    assert page.find("#magnify").is_selected()
    webdriver.ActionChains(page.browser).move_to_element(page.find("#picture")).perform()
    deadline = time.time() + 10
    while not page.find("#lens").is_displayed() and time.time() < deadline:
        time.sleep(0.05)
    assert page.find("#lens").is_displayed(), "no magnifier"


def check_pictures_are_whole(page):
    """What the magnifier reads: pictures have the errors that were measured."""
    page.browser.set_script_timeout(30)
    off = page.browser.execute_async_script("""
        const done = arguments[0];
        (async () => {
          const all = [];
          for (const subject of report.subjects) {
            const rays = await decode(subject, "rays");
            for (const result of subject.results) {
              const picture = await decode(subject, result.contestant);
              const squares = [...picture].map((value, i) => (value - rays[i]) ** 2)
                .filter((value) => !isNaN(value));
              const rmse = Math.sqrt(squares.reduce((a, b) => a + b) / squares.length);
              all.push([result.contestant, squares.length - subject.receivers, rmse - result.errors.rmse]);
            }
          }
          done(all);
        })();""")
    assert len(off) > 5
    for name, count, error in off:
        assert count == 0 and abs(error) < 1e-5, f"{name}: {count} pixels and {error} of RMSE off"


def check_front(page):
    facts = page.find("#front-text").text
    for part in ("the exact query is on the Pareto front with", "Nothing else is."):
        assert part in facts, facts
    assert facts in page.find("#fronts li").text
    assert not page.find("#left-out").is_displayed(), "something was left out"


def check_tables(page):
    def column(index):
        return [row.find_elements(By.CSS_SELECTOR, "th, td")[index].text for row in page.find_all("#figures tbody tr")]

    page.find('#figures th[data-key="rmse"] button').click()
    errors = [float(text) for text in column(5)]
    assert errors == sorted(errors) and len(errors) > 5, errors
    page.find('#figures th[data-key="rmse"] button').send_keys(Keys.ENTER)
    assert [float(text) for text in column(5)] == sorted(errors, reverse=True)
    assert page.find('#figures th[data-key="rmse"]').get_attribute("aria-sort") == "descending"
    assert page.find_all("#causes tbody tr"), "no causes"
    assert page.find_all("#heat tbody td a")
    colours = {cell.value_of_css_property("background-color") for cell in page.find_all("#heat tbody td")}
    assert len(colours) > 3, "the table of all scenes has no colours"


def check_address(page, address):
    target = page.find_all("#figures tbody a")[-1].get_attribute("href")
    page.browser.get("about:blank")
    page.browser.get(target)
    page.caption("Visibility by")
    assert page.browser.current_url == target
    assert page.find("#shown").get_attribute("value") == target.split("/")[-1]
    page.browser.get(address)


def check_styles(page, folder):
    paper = {}
    for scheme in ("light", "dark"):
        features = [{"name": "prefers-color-scheme", "value": scheme}]
        page.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": features})
        paper[scheme] = page.find("body").value_of_css_property("background-color")
        page.browser.save_screenshot(str(folder / f"{scheme}.png"))
    assert paper["light"] != paper["dark"], "dark mode is as light"
    page.browser.execute_cdp_cmd("Emulation.setEmulatedMedia", {"media": "print"})
    assert not page.find("nav").is_displayed(), "links are printed"
    for image in page.find_all("canvas[role=img]"):
        assert image.get_attribute("aria-label"), "a picture has no text"


def main():
    bench, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    shutil.rmtree(folder, ignore_errors=True)
    make_report(bench, folder)
    if webdriver is None or not shutil.which("chromium") or not shutil.which("chromedriver"):
        print("Skipped\nneeds chromium, chromium-driver and python3-selenium")
        return
    browser = open_browser()
    try:
        address = (folder / "report.html").resolve().as_uri()
        browser.get(address)
        page = Page(browser)
        check_plot(page)
        check_viewer(page)
        check_pictures_are_whole(page)
        check_front(page)
        check_tables(page)
        check_address(page, address)
        check_styles(page, folder)
        severe = [entry for entry in browser.get_log("browser") if entry["level"] == "SEVERE"]
        assert not severe, severe
    finally:
        browser.quit()
    print("the page is usable")


main()
