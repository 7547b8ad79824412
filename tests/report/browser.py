"""A browser without a window, and a page in it: what test_report.py drives."""
import base64
import shutil
import time

from selenium import webdriver
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By

SIZES = {"laptop": (1280, 900), "phone": (390, 844)}
# Pixels are read from a copy: Chromium warns on the console when a canvas of the page itself is read often.
PIXELS = """function pixels(c, left = 0, right = c.width) {
    const copy = document.createElement("canvas");
    [copy.width, copy.height] = [c.width, c.height];
    const context = copy.getContext("2d", {willReadFrequently: true});
    context.drawImage(c, 0, 0);
    return context.getImageData(left, 0, right - left, c.height).data;
}
"""
# A number that changes with any pixel of a canvas, and with where it is.
SUM = PIXELS + """const d = pixels(document.querySelector(arguments[0]));
let h = 7; for (let i = 0; i < d.length; ++i) h = (h * 31 + d[i]) | 0; return h;"""
# Mean of R, G and B over the columns [from, to) of the picture, as parts of its width.
MEAN = PIXELS + """const c = document.querySelector("#picture"), l = Math.floor(arguments[0] * c.width),
r = Math.max(l + 1, Math.floor(arguments[1] * c.width));
const d = pixels(c, l, r);
let s = 0; for (let i = 0; i < d.length; ++i) if (i % 4 < 3) s += d[i]; return s / d.length * 4 / 3;"""


class Page:
    def __init__(self, driver, document, name, failures):
        self.driver, self.document, self.name, self.failures = driver, document, name, failures
        self.touch = name.startswith("phone")
        self.rows = document["rows"]

    def check(self, holds, what):
        if not holds:
            self.failures.append(f"{self.name}: {what}")

    def js(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def find(self, selector):
        found = self.driver.find_elements(By.CSS_SELECTOR, selector)
        return found[0] if found else None

    def wait(self, script, *arguments, seconds=5):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if self.js(f"return Boolean({script})", *arguments):
                return True
            time.sleep(0.05)
        return False

    def settle(self):
        """Two frames: what the page put off to the next one is done."""
        self.driver.execute_async_script("requestAnimationFrame(() => requestAnimationFrame(() => arguments[0]()))")
        time.sleep(0.05)

    def middle(self, selector):
        """Where the middle of an element is in the window, after bringing it into view."""
        return self.js("""const n = document.querySelector(arguments[0]);
            n.scrollIntoView({block: "center", inline: "center", behavior: "instant"});
            const b = n.getBoundingClientRect(); return [b.left + b.width / 2, b.top + b.height / 2]""", selector)

    def press(self, key):
        ActionChains(self.driver).send_keys(key).perform()
        self.settle()

    def mouse(self, kind, x, y, pressed=False):
        self.driver.execute_cdp_cmd("Input.dispatchMouseEvent", {
            "type": kind, "x": x, "y": y, "button": "left" if kind != "mouseMoved" or pressed else "none",
            "buttons": 1 if pressed else 0, "clickCount": 1 if kind != "mouseMoved" else 0})

    def drag(self, x0, y0, x1, y1):
        """With a finger on the phone, with the mouse elsewhere."""
        places = [(x0 + (x1 - x0) * i / 5, y0 + (y1 - y0) * i / 5) for i in range(6)]
        if self.touch:
            for kind, place in [("touchStart", places[0])] + [("touchMove", p) for p in places[1:]]:
                self.driver.execute_cdp_cmd("Input.dispatchTouchEvent",
                                            {"type": kind, "touchPoints": [{"x": place[0], "y": place[1]}]})
            self.driver.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
        else:
            self.mouse("mouseMoved", *places[0])
            self.mouse("mousePressed", *places[0], True)
            for place in places[1:]:
                self.mouse("mouseMoved", *place, True)
            self.mouse("mouseReleased", *places[-1])
        self.settle()

    def tap(self, x, y):
        self.driver.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": [{"x": x, "y": y}]})
        self.driver.execute_cdp_cmd("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
        time.sleep(0.4)  # a tap becomes a click only when no second one follows
        self.settle()

    def click(self, selector):
        self.js("""const n = document.querySelector(arguments[0]);
            n.scrollIntoView({block: "center", behavior: "instant"}); n.click()""", selector)
        self.settle()

    def choose(self, selector, value):
        self.js("""const n = document.querySelector(arguments[0]); n.value = arguments[1];
            n.dispatchEvent(new Event("input", {bubbles: true})); n.dispatchEvent(new Event("change", {bubbles: true}))""",
                selector, value)
        self.settle()
        time.sleep(0.05)


def open_page(path, size, dark):
    options = webdriver.ChromeOptions()
    options.binary_location = shutil.which("chromium")
    for flag in ("--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars"):
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    driver = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
    driver.set_window_size(*size)
    # A window is never narrower than some 500 pixels, and its frame takes some of the height: set what the page sees.
    driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                           {"width": size[0], "height": size[1], "deviceScaleFactor": 1, "mobile": size[0] < 500})
    driver.execute_cdp_cmd("Emulation.setEmulatedMedia",
                           {"features": [{"name": "prefers-color-scheme", "value": "dark" if dark else "light"}]})
    driver.execute_cdp_cmd("Emulation.setTouchEmulationEnabled", {"enabled": size[0] < 500})
    driver.get(path.resolve().as_uri())
    return driver


def screenshot(page, folder):
    """Of the whole page, in pieces no longer than what is pleasant to look at."""
    page.js("document.activeElement?.blur(); scrollTo(0, 0)")
    page.wait("document.documentElement.dataset.drawn === 'all'", seconds=10)
    width, height = page.js("return [document.documentElement.clientWidth, document.documentElement.scrollHeight]")
    step = 1600
    for i in range(min(-(-height // step), 12)):
        picture = page.driver.execute_cdp_cmd("Page.captureScreenshot", {"captureBeyondViewport": True, "format": "png", "clip": {
            "x": 0, "y": i * step, "width": width, "height": min(step, height - i * step), "scale": 1}})
        (folder / f"{page.name.replace(', ', '-')}-{i}.png").write_bytes(base64.b64decode(picture["data"]))
