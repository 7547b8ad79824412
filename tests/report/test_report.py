#!/usr/bin/env python3
"""Opens a comparison report in a browser and uses it as a reader would.

    tests/report/test_report.py report/index.html [--screenshots FOLDER]

Needs Debian's python3-selenium, chromium and chromium-driver; exits 77 with one line where they are absent, 1 with a
list of what failed, 0 otherwise. Sections that the report does not have are not looked for. The ids that it relies on
are listed at the head of src/nacre/report/page/report.html.
"""
import argparse
import json
import pathlib
import shutil
import sys
import time

try:
    from selenium.webdriver.common.keys import Keys
except ImportError:
    print("skipped: python3-selenium is not installed")
    sys.exit(77)

sys.dont_write_bytecode = True  # the source tree stays as it is
from browser import MEAN, PIXELS, SIZES, SUM, Page, open_page, screenshot
from verdict import check_names, check_verdict


def check_whole(page):
    """Of every report: it is there, stays in the window, and loads nothing."""
    wide = page.js("return [document.documentElement.scrollWidth, document.documentElement.clientWidth]")
    page.check(wide[0] <= wide[1], f"the page scrolls sideways: {wide[0]} pixels in {wide[1]}")
    page.check(page.js("return document.querySelector('h1')?.textContent") == page.document["title"], "no title")
    loaded = page.js("""return [...document.querySelectorAll("[src], link[href], use[href], image[href]")]
        .map(n => n.getAttribute("src") ?? n.getAttribute("href")).filter(u => !u.startsWith("data:") && !u.startsWith("#"))
        .concat(performance.getEntriesByType("resource").map(e => e.name).filter(u => !u.startsWith("data:")))""")
    page.check(not loaded, f"the page loads {loaded}")
    if page.document.get("command"):
        page.check(page.document["command"] in page.js("return document.querySelector('header .command').textContent"),
                   "the command is not shown")
    for warning in page.document.get("warnings", []):
        page.check(warning in page.js("return document.querySelector('.warnings')?.textContent ?? ''"), f"no warning {warning!r}")


def check_table(page):
    columns = [c for c in page.document.get("columns", []) if not c.get("text")]
    lines = page.js("return [...document.querySelectorAll('#table tbody tr')].map(n => n.dataset.row)")
    page.check(lines == [row["id"] for row in page.rows], "the table's rows are not those of the document, in its order")
    for row in page.rows:
        if row["status"] != "ok":
            text = page.js("return [...document.querySelectorAll('#table tr')].find(n => n.dataset.row === arguments[0])?.textContent ?? ''",
                           row["id"])
            page.check(row.get("why", "") in text, f"the row of {row['id']} does not say why it failed")
    for column in columns[:3]:
        head = f"#table th[data-key={json.dumps(column['key'])}]"
        size = abs if column.get("better") == "zero" else (lambda v: v)
        values = {row["id"]: size(row["values"][column["key"]]) for row in page.rows
                  if row["status"] == "ok" and column["key"] in row.get("values", {})}
        for direction in ("ascending", "descending"):
            page.click(head + " button")
            page.check(page.js("return document.querySelector(arguments[0]).ariaSort", head) == direction,
                       f"aria-sort of {column['key']} is not {direction}")
            shown = [values.get(i) for i in page.js("return [...document.querySelectorAll('#table tbody tr')].map(n => n.dataset.row)")]
            known = [v for v in shown if v is not None]
            page.check(known == sorted(known, reverse=direction == "descending"), f"not sorted by {column['key']}, {direction}")
            page.check(shown[:len(known)] == known, f"rows without {column['key']} are not last, {direction}")
        page.click(head + " button")
    pictured = [row for row in page.rows if row.get("picture") in page.document.get("pictures", {})]
    if len(pictured) > 1:
        chosen = pictured[-1]["id"]
        page.js("[...document.querySelectorAll('#table tr')].find(n => n.dataset.row === arguments[0]).click()", chosen)
        page.settle()
        page.check(page.js("return document.querySelector('#picture-a').value") == chosen, "a click on a row does not select picture A")


def check_plot(page):
    plot = page.document["plot"]
    expected = {row["id"] for row in page.rows if row["status"] == "ok"
                and row["values"].get(plot["x"][0], 0) > 0 and row["values"].get(plot["y"][0], 0) > 0}
    shown = page.js("return [...document.querySelectorAll('#plot .point')].map(n => n.dataset.row)")
    page.check(set(shown) == expected, f"points differ from the rows: {expected ^ set(shown)}")
    page.check(page.find("#plot .front") is not None, "no Pareto front")
    names = {row["id"]: row["name"] for row in page.rows}
    for i, row in enumerate(shown):
        page.mouse("mouseMoved", 2, 2)
        page.js("document.querySelector('#tip').hidden = true")
        page.js("document.querySelectorAll('#plot .point')[arguments[0]].setAttribute('data-tested', '')", i)
        x, y = page.middle("#plot .point[data-tested]")
        page.js("document.querySelectorAll('#plot .point')[arguments[0]].removeAttribute('data-tested')", i)
        page.settle()
        page.mouse("mouseMoved", x, y)
        page.settle()
        text = page.js("const t = document.querySelector('#tip'); return t.hidden ? '' : t.textContent")
        # Points may lie upon each other: then the upper one answers.
        top = page.js("return document.elementFromPoint(arguments[0], arguments[1])?.closest('.point')?.dataset.row", x, y)
        page.check(top is not None and names[top] in text, f"the point of {row} has no tooltip with its name: {text!r}")
        if top == row:
            lit = page.js("return [...document.querySelectorAll('#table tr.lit')].map(n => n.dataset.row)")
            page.check(lit == [row], f"the point of {row} marks the rows {lit}")
    page.mouse("mouseMoved", 2, 2)
    if page.touch:
        page.js("document.querySelector('#tip').hidden = true")
        page.tap(*page.middle("#plot .point"))
        page.check(page.js("return !document.querySelector('#tip').hidden"), "a tap on a point shows no tooltip")
    page.js("document.querySelector('#plot .point').focus()")
    before = page.js("return document.activeElement.dataset.row")
    if len(shown) > 1:
        page.press(Keys.ARROW_RIGHT)
        after = page.js("return document.activeElement.dataset.row")
        page.check(after in expected and after != before, "an arrow key does not go to another point")
    if len(plot["y"]) > 1:
        first = page.js("return document.querySelector('#plot svg').innerHTML")
        page.choose("#plot-y", plot["y"][1])
        page.check(page.js("return document.querySelector('#plot svg').innerHTML") != first, "another error does not change the plot")
        page.choose("#plot-y", plot["y"][0])


def check_viewer(page):
    document = page.document
    page.click("input[name=mode][value=split]")
    page.middle("#picture")
    if not page.wait("document.querySelector('#picture').dataset.mode === 'split'"):
        page.check(False, "the viewer draws no picture")
        return
    now = lambda: page.js("return Number(document.querySelector('#split').getAttribute('aria-valuenow'))")
    page.js("document.querySelector('#split').focus()")
    before, value = page.js(SUM, "#picture"), now()
    for _ in range(20):
        page.press(Keys.ARROW_RIGHT)
    page.check(now() == value + 20, f"20 presses of an arrow key move the slider from {value} to {now()}")
    page.check(page.js(SUM, "#picture") != before, "the picture stays the same when the slider moves by keys")
    page.press(Keys.HOME)
    only_b = page.js(SUM, "#picture")
    page.press(Keys.END)
    only_a = page.js(SUM, "#picture")
    page.check(only_a != only_b, "A and B look the same")
    for mode, expected in (("a", only_a), ("b", only_b)):
        page.click(f"input[name=mode][value={mode}]")
        page.check(page.js(SUM, "#picture") == expected, f"the view {mode} is not what the slider shows at its end")
    page.click("input[name=mode][value=split]")
    x, y = page.middle("#picture")
    left, width = page.js("const b = document.querySelector('#picture').getBoundingClientRect(); return [b.left, b.width]")
    x0 = page.middle("#split")[0]
    page.drag(x0, y, left + 0.25 * width, y)
    page.check(abs(now() - 25) <= 1, f"dragging the slider to 25 % gives {now()}")
    page.check(page.js(SUM, "#picture") not in (only_a, only_b), "the picture at 25 % is all A or all B")
    page.js("document.activeElement.blur()")
    page.press("f")
    first = page.js(SUM, "#picture")
    page.press(" ")
    second = page.js(SUM, "#picture")
    page.click("#flip")
    page.check([first, second, page.js(SUM, "#picture")] == [only_a, only_b, only_a], "F, space and the button do not flip between A and B")

    page.click("input[name=mode][value=a]")
    page.mouse("mouseMoved", *page.middle("#picture"))
    page.settle()
    page.check("Pixel" in page.js("return document.querySelector('#readout').textContent"), "the pixel under the pointer is not read")
    # One stop makes what is neither black nor clipped brighter; reset brings back the same picture.
    dark, before = page.js(MEAN, 0, 1), page.js(SUM, "#picture")
    stops = float(page.js("return document.querySelector('#exposure').value"))
    page.choose("#exposure", str(stops + 1))
    page.check(page.js(MEAN, 0, 1) > dark + 1, "one more stop does not make the picture brighter")
    page.click("#exposure-reset")
    page.check(page.js(SUM, "#picture") == before, "resetting the exposure does not bring the picture back")

    page.click("input[name=mode][value=error]")
    legend = "const n = document.querySelector('#scale'); return n.hidden ? '' : n.textContent"
    page.check("+25 %" in page.js(legend) and "25 %" in page.js(legend), f"the error map has no legend: {page.js(legend)!r}")
    pixels = page.js(SUM, "#picture")
    page.check(pixels not in (only_a, only_b), "the error map is a picture")
    page.choose("#error-range", "100")
    page.check("+100 %" in page.js(legend), "the legend does not follow the range")
    page.check(page.js(SUM, "#picture") != pixels, "the error map does not follow the range")
    pixels = page.js(SUM, "#picture")
    page.choose("#error-block", "8")
    page.check(page.js(SUM, "#picture") != pixels, "means of blocks change nothing")
    check_error_map(page)
    page.choose("#error-block", "1")
    page.choose("#error-range", "25")
    chosen = page.js("return document.querySelector('#picture-a').value")
    row = next((row for row in page.rows if row["id"] == chosen), None)
    if row and row.get("flip") in document.get("maps", {}):
        page.click("input[name=mode][value=flip]")
        page.wait("document.querySelector('#picture').dataset.mode === 'flip'")
        page.check("0.5" in page.js(legend), "the FLIP map has no legend")
    page.click("input[name=mode][value=a]")
    for zoom, factor in (("1", 1), ("4", 4)):
        page.click(f"input[name=zoom][value='{zoom}']")
        sizes = page.js("const c = document.querySelector('#picture'); return [c.clientWidth, c.width]")
        page.check(abs(sizes[0] - factor * sizes[1]) <= 1, f"zoom {zoom} shows {sizes[1]} pixels on {sizes[0]}")
    wide = page.js("return [document.documentElement.scrollWidth, document.documentElement.clientWidth]")
    page.check(wide[0] <= wide[1], "the page scrolls sideways when the picture is zoomed")
    page.click("input[name=zoom][value=fit]")
    page.click("input[name=mode][value=split]")


def check_error_map(page):
    """A against itself has no error: the map is white wherever it has a colour."""
    b = page.js("return document.querySelector('#picture-b').value")
    page.choose("#picture-b", page.js("return document.querySelector('#picture-a').value"))
    time.sleep(0.1)
    others = page.js(PIXELS + """const d = pixels(document.querySelector("#picture"));
        let n = 0; for (let i = 0; i < d.length; i += 4) if (d[i + 3] && Math.min(d[i], d[i + 1], d[i + 2]) < 250) ++n; return n""")
    page.check(others == 0, f"the error of a picture against itself is not 0 at {others} pixels")
    page.choose("#picture-b", b)
    time.sleep(0.1)


def check_tiles(page, selector, count):
    """Canvases get pictures when they come into view, and follow the exposure."""
    found = page.js(f"return document.querySelectorAll('{selector} canvas').length")
    page.check(found == count, f"{selector} has {found} pictures instead of {count}")
    if not found:
        return
    page.js("document.querySelector(arguments[0]).scrollIntoView({block: 'start', behavior: 'instant'})", selector)
    first = f"{selector} canvas"
    page.check(page.wait("document.querySelector(arguments[0]).dataset.drawn !== undefined", first), f"{selector} draws nothing")
    blank = page.js(PIXELS + """return [...document.querySelectorAll(arguments[0])].filter(c => c.dataset.drawn !== undefined)
        .filter(c => pixels(c).some((v, i) => i % 4 === 3 && v !== 255)).length""", first)
    page.check(blank == 0, f"{selector} has {blank} blank pictures")
    before = page.js(SUM, first)
    stops = page.js("return document.querySelector(arguments[0]).dataset.drawn", first)
    control = page.js("return document.querySelector('.exposure input')?.id")
    page.choose(f"#{control}", str(float(stops) + 2))
    page.check(page.wait("document.querySelector(arguments[0]).dataset.drawn !== arguments[1]", first, stops)
               and page.js(SUM, first) != before, f"{selector} does not follow the exposure")
    page.click(f"#{control}-reset")
    page.check(page.wait("document.documentElement.dataset.drawn === 'all'", seconds=30), "some pictures are never drawn")


def check_charts(page):
    for chart in page.document["charts"]:
        figure = f"#charts figure[data-chart={json.dumps(chart['id'])}]"
        page.check(page.find(figure) is not None, f"no diagram {chart['id']}")
        if chart["kind"] == "image" or page.find(figure) is None:
            continue
        names = page.js("return [...document.querySelectorAll(arguments[0] + ' .series')].map(n => n.dataset.name)", figure)
        page.check(set(names) == {s["name"] for s in chart["series"]}, f"diagram {chart['id']} has the series {names}")
        page.js("document.querySelector(arguments[0] + ' .series path').setAttribute('id', 'tested')", figure)
        x, y = page.js("""const p = document.querySelector("#tested"), s = p.ownerSVGElement;
            s.scrollIntoView({block: "center", behavior: "instant"});
            const q = p.getPointAtLength(p.getTotalLength() / 2).matrixTransform(p.getScreenCTM()); return [q.x, q.y]""")
        page.js("document.querySelector('#tested').removeAttribute('id')")
        page.settle()
        page.mouse("mouseMoved", 2, 2)
        page.mouse("mouseMoved", x, y)
        page.settle()
        text = page.js("const t = document.querySelector('#tip'); return t.hidden ? '' : t.textContent")
        page.check(any(name in text for name in names), f"diagram {chart['id']} does not read out a point: {text!r}")
        page.mouse("mouseMoved", 2, 2)


def check_matrix(page):
    matrix = page.document["matrix"]
    key, digits = matrix["measures"][0]["key"], matrix["measures"][0]["digits"]
    count = page.js("return document.querySelectorAll('#matrix td[data-case]').length")
    page.check(count == len(matrix["cases"]) * len(matrix["techniques"]), f"the matrix has {count} cells")
    reasons = sum(1 for case in matrix["cases"] for cell in case["cells"].values() if "why" in cell)
    page.check(page.js("return document.querySelectorAll('#matrix td[data-why]').length") == reasons, "cells without a value do not say why")

    def certain(cell):
        """Its value, 0 where that may be noise."""
        value = cell.get(key)
        return 0 if value is not None and abs(value) < 2 * cell.get("errors", {}).get(key, 0) else value

    def rms(cases):
        result = []
        for technique in matrix["techniques"]:
            values = [certain(case["cells"].get(technique["id"], {})) for case in cases]
            values = [v for v in values if v is not None]
            result.append((sum(v * v for v in values) / len(values)) ** 0.5 if values else None)
        return result

    def agrees(cases):
        shown = page.js("return [...document.querySelectorAll('#matrix [data-summary=all] td')].map(n => n.textContent)")
        return len(shown) == len(matrix["techniques"]) and all(
            text == "–" if value is None else abs(float(text) - value) <= 0.51 * 10 ** -digits for text, value in zip(shown, rms(cases)))

    page.check(agrees(matrix["cases"]), "the summary is not the RMS of all cases")
    for i, title in enumerate(matrix["label_titles"]):
        values = sorted({case["labels"][i] for case in matrix["cases"]})
        if len(values) < 2:
            continue
        selector = f"select[data-label={json.dumps(title)}]"
        page.choose(selector, values[0])
        some = [case for case in matrix["cases"] if case["labels"][i] == values[0]]
        cells = page.js("return document.querySelectorAll('#matrix td[data-case]').length")
        page.check(cells == len(some) * len(matrix["techniques"]), f"the filter {title} = {values[0]} leaves {cells} cells")
        page.check(agrees(some), f"the summary does not follow the filter {title}")
        page.choose(selector, "")


def check_details(page):
    count = page.js("return document.querySelectorAll('#details details').length")
    for i in range(min(count, 3)):
        page.js("document.querySelectorAll('#details details')[arguments[0]].querySelector('summary').click()", i)
        page.check(page.js("return document.querySelectorAll('#details details')[arguments[0]].open", i), f"details {i} do not open")
        page.js("document.querySelectorAll('#details details')[arguments[0]].open = false", i)


def check_theme(page, dark):
    theme = lambda: page.js("return document.documentElement.dataset.theme")
    background = lambda: page.js("return getComputedStyle(document.documentElement).backgroundColor")
    page.check(theme() == ("dark" if dark else "light"), "the page does not follow the system's colours")
    before = background()
    page.click("#theme")
    page.check(theme() == ("light" if dark else "dark") and background() != before, "the button does not change the colours")
    page.click("#theme")
    page.js("try { localStorage.clear() } catch {}")
    page.check(background() == before, "the button does not bring the colours back")


def check(page, dark):
    document = page.document
    pictures = document.get("pictures", {})
    pictured = [row for row in page.rows if row.get("picture") in pictures]
    sources = len(pictured) + (document.get("reference", {}).get("picture") in pictures)
    check_whole(page)
    check_theme(page, dark)
    check_table(page)
    check_names(page)
    if document.get("verdict"):
        check_verdict(page)
    if document.get("plot"):
        check_plot(page)
    # The small pictures first: the viewer's exposure would have them drawn in any case.
    if sources and document.get("crops"):
        check_tiles(page, "#crops", sources * len(document["crops"]))
    if sources > 1:
        check_tiles(page, "#sheet", sources)
        check_viewer(page)
    if document.get("charts"):
        check_charts(page)
    if document.get("matrix"):
        check_matrix(page)
    check_details(page)
    if document.get("printed"):
        lines = page.js("return document.querySelectorAll('#printed tbody tr').length")
        page.check(lines == len(document["printed"]["rows"]), f"the printed table has {lines} rows")
    check_whole(page)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("report", type=pathlib.Path, help="the report's index.html")
    parser.add_argument("--screenshots", type=pathlib.Path, help="a folder for pictures of the page")
    arguments = parser.parse_args()
    for program in ("chromium", "chromedriver"):
        if not shutil.which(program):
            print(f"skipped: {program} is not installed")
            return 77
    text = arguments.report.read_text(encoding="utf-8")
    start = text.index('<script type="application/json" id="document">') + len('<script type="application/json" id="document">')
    document = json.loads(text[start:text.index("</script>", start)])
    if arguments.screenshots:
        arguments.screenshots.mkdir(parents=True, exist_ok=True)
    failures = []
    for size in SIZES:
        for dark in (False, True):
            driver = open_page(arguments.report, SIZES[size], dark)
            try:
                page = Page(driver, document, f"{size}, {'dark' if dark else 'light'}", failures)
                ready = page.wait("document.documentElement.dataset.ready !== undefined", seconds=20)
                page.check(ready, "the page is never ready")
                if ready:
                    if arguments.screenshots:
                        screenshot(page, arguments.screenshots)
                    check(page, dark)
                for entry in driver.get_log("browser"):
                    page.check(False, f"console: {entry['level']} {entry['message']}")
            finally:
                driver.quit()
    for failure in failures:
        print(failure)
    print(f"{len(failures)} failures" if failures else "the report works")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
