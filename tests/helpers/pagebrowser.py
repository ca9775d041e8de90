"""Chromium without a window, that opens a page from a file and tells what the page did."""

import json
import shutil
from contextlib import contextmanager

FLAGS = (
    *("--headless=new", "--no-sandbox", "--disable-quic", "--no-first-run"),
    *("--disable-background-networking", "--disable-component-update", "--disable-sync"),
    *("--disable-dev-shm-usage", "--hide-scrollbars", "--window-size=1440,900"),
    *("--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"),
)


@contextmanager
def chromium():
    """A driver, closed in the end."""
    from selenium import webdriver
    from selenium.webdriver.chrome.service import Service

    options = webdriver.ChromeOptions()
    options.binary_location = shutil.which("chromium")
    for flag in FLAGS:
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL", "performance": "ALL"})
    driver = webdriver.Chrome(options=options, service=Service(shutil.which("chromedriver")))
    driver.set_script_timeout(120)
    try:
        yield driver
    finally:
        driver.quit()


def opened(driver, path, drawn):
    """Open a page and wait until its picture shows `drawn`."""
    driver.get(path.resolve().as_uri())
    until_drawn(driver, drawn)


def until_drawn(driver, drawn):
    from selenium.webdriver.support.wait import WebDriverWait

    script = "return document.body.dataset.ready && document.getElementById('scene').dataset.drawn"
    WebDriverWait(driver, 120).until(lambda d: d.execute_script(script) == drawn)


def choose(driver, box, value):
    """Choose in one of the page's boxes, as a user does."""
    driver.execute_script(
        "const b = document.getElementById(arguments[0]); b.value = arguments[1];"
        "b.dispatchEvent(new Event('change'));",
        box,
        value,
    )


def picture(driver):
    """Bytes of the picture in 3-D as it is shown."""
    from selenium.webdriver.common.by import By

    return driver.find_element(By.ID, "scene").screenshot_as_png


def requests(driver):
    """Addresses that the page asked for."""
    sent = [json.loads(entry["message"])["message"] for entry in driver.get_log("performance")]
    return [
        m["params"]["request"]["url"] for m in sent if m["method"] == "Network.requestWillBeSent"
    ]


@contextmanager
def window(driver, width, height):
    """Draw a page of a case's movements in a window of this size, and again in the usual one."""
    size = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False}
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", size)
    try:
        driver.refresh()
        until_drawn(driver, "OPE move")
        yield
    finally:
        driver.execute_cdp_cmd("Emulation.clearDeviceMetricsOverride", {})
        driver.refresh()
        until_drawn(driver, "OPE move")
