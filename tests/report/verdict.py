"""Checks of a report's verdict and of the names in its table, for test_report.py."""


def check_verdict(page):
    """The sentences stand on top, and the times follow the error that the reader chooses."""
    shown = page.js("return [...document.querySelectorAll('#verdict .sentence')].map(n => n.textContent)")
    page.check(shown == page.document["verdict"]["sentences"], f"the verdict reads {shown}")
    top = page.js("return document.querySelector('#verdict').compareDocumentPosition(document.querySelector('#table')) & 4")
    page.check(top, "the verdict does not stand above the table")
    if page.find("#reach-error") is None:
        return

    def reach(law, error):
        floor = law["floor"] + 2 * law["sigma"]
        if floor >= error:
            return None
        return law["before"] + max(law["frame"] * law["noise"] ** 2 / (error ** 2 - floor ** 2), law["least_frame"])

    first = page.js("return document.querySelector('#reach-error').value")
    for error in (50, 5, 1):
        page.choose("#reach-error", str(error))
        times = {row["id"]: reach(row["law"], error) for row in page.rows if "law" in row and "same_as" not in row}
        expected = sorted((i for i in times if times[i] is not None), key=times.get)
        listed = page.js("return [...document.querySelectorAll('#reach li')].map(n => n.dataset.reachRow)")
        page.check(listed == expected, f"techniques that reach {error} % are {listed} instead of {expected}")
        head = page.js("return document.querySelector('#table th[data-key=reach]').textContent")
        page.check(f"{error}\u00a0%" in head, f"the table's column does not follow the chosen error: {head!r}")
    page.choose("#reach-error", first)
    # The given order: a third click on the head that sorts.
    page.click("#table th[data-key=reach] button")
    page.click("#table th[data-key=reach] button")


def check_names(page):
    """No word of a name is broken, and the last column can be brought beside the name."""
    broken = page.js("""const bad = [];
        for (const n of document.querySelectorAll("#table .names > :first-child, #reach .names")) {
            const walk = document.createTreeWalker(n, NodeFilter.SHOW_TEXT);
            for (let t; t = walk.nextNode();)
                for (const m of t.data.matchAll(/[A-Za-z]+/g)) {
                    const r = document.createRange();
                    r.setStart(t, m.index); r.setEnd(t, m.index + m[0].length);
                    if (r.getClientRects().length > 1) bad.push(m[0]);
                }
        } return bad""")
    page.check(not broken, f"broken in the middle: {broken}")
    reached = page.js("""const s = document.querySelector("#section-table .scroll"), h = s.querySelector("th.name");
        s.scrollLeft = s.scrollWidth;
        const last = [...s.querySelectorAll("thead th")].at(-1).getBoundingClientRect(), name = h.getBoundingClientRect();
        const box = s.getBoundingClientRect(), fits = last.right <= box.right + 1 && name.left >= box.left - 1
            && name.width < box.width / 2; s.scrollLeft = 0; return fits""")
    page.check(reached, "the last column cannot be reached beside the names")
    for row in page.rows:
        if "same_as" in row:
            page.check(f"identical to {row['same_as']}" in page.js(
                "return [...document.querySelectorAll('#table tr')].find(n => n.dataset.row === arguments[0]).textContent", row["id"]),
                f"{row['id']} does not say that it is identical to another")
