// Puts the page together: head, sections in their order, what the papers printed, details, navigation.

function headerSection() {
    const notes = (report.notes ?? [])
                      .map(
                          note =>
                              el("details", {class: "note"}, el("summary", {}, note.title),
                                 note.text.split(/\n\s*\n/).map(paragraph => el("p", {}, paragraph))));
    return el(
        "header", {class: "head"}, el("h1", {}, report.title),
        report.warnings?.length ? el("div", {class: "warnings", role: "note", "aria-label": "Warnings"},
                                     report.warnings.map(text => el("p", {}, text))) :
                                  null,
        verdictBox(),
        report.facts?.length ? pairs(report.facts, {id: "facts"}) : null,
        report.command ?
            el("div", {class: "made-by"}, el("span", {class: "name"}, "Made by"), command(report.command)) :
            null,
        notes);
}

function printedSection() {
    const printed = report.printed;
    if (!printed?.rows?.length) return null;
    return el(
        "section", {id: "section-printed", class: "section printed", "aria-labelledby": "title-printed"},
        el("h2", {id: "title-printed"}, printed.title),
        printed.text && el("p", {class: "hint"}, printed.text),
        el("div",
           {class: "scroll", tabindex: 0, role: "region", "aria-label": "Printed numbers, scrolls sideways"},
           el("table", {id: "printed"},
              el("thead", {}, el("tr", {}, printed.columns.map(text => el("th", {scope: "col"}, text)))),
              el("tbody", {},
                 printed.rows.map(
                     row =>
                         el("tr", {},
                            row.map((text, i) => el(i ? "td" : "th", {scope: i ? null : "row"}, text))))))));
}

function detailsSection() {
    const reference = report.reference;
    const known = rows.filter(row => row.about?.length || row.command || row.why);
    if (!known.length && !reference?.about?.length) return null;
    return section(
        "details", "Details",
        el("div", {id: "details"},
           reference?.about?.length ?
               el("details", {"data-row": ""}, el("summary", {}, "Reference: ", reference.title),
                  pairs(reference.about)) :
               null,
           known.map(
               row => el(
                   "details", {"data-row": row.id},
                   el("summary", {}, markerIcon(row.name), " ", row.name,
                      row.setting && el("small", {}, ` ${row.setting}`),
                      row.title && row.title !== row.name && el("small", {class: "long"}, ` ${row.title}`)),
                   row.why &&
                       el("p", {class: "why"},
                          `${row.status === "missing" ? "Not run" : "Failed"}: ${row.why}`),
                   row.about?.length ? pairs(row.about) : null, row.command && command(row.command)))));
}

function navigation(sections) {
    const links = sections.filter(Boolean).map(node => [node.id, node.querySelector("h2").textContent]);
    const theme = el("button", {type: "button", id: "theme", class: "quiet"});
    const show = () => {
        const dark = document.documentElement.dataset.theme === "dark";
        theme.textContent = dark ? "Light" : "Dark";
        theme.setAttribute("aria-label", dark ? "Change to light colours" : "Change to dark colours");
    };
    const set = (name, keep) => {
        document.documentElement.dataset.theme = name;
        if (keep) try {
                localStorage.setItem("nacre-theme", name);
            } catch { /* storage may be off */
            }
        show();
    };
    theme.addEventListener(
        "click", () => set(document.documentElement.dataset.theme === "dark" ? "light" : "dark", true));
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", event => {
        let kept = null;
        try {
            kept = localStorage.getItem("nacre-theme");
        } catch { /* storage may be off */
        }
        if (kept === null) set(event.matches ? "dark" : "light", false);
    });
    show();
    document.getElementById("nav").replaceChildren(
        el("div", {class: "links"}, links.map(([id, text]) => el("a", {href: `#${id}`}, text))), theme);
}

function build() {
    // The viewer first: it decides what A and B are, which the others show.
    const pictures = viewerSection();
    const sections = [
        tableSection(), plotSection(), pictures, cropsSection(), sheetSection(), matrixSection(),
        chartsSection(), printedSection(), detailsSection()
    ];
    document.getElementById("main").replaceChildren(headerSection(), ...sections.filter(Boolean));
    navigation(sections);
    if (state.a) state.announce("select");
    document.documentElement.dataset.ready = "";
    // After the first paint, so that the page is there at once.
    setTimeout(whenIdle, 300);
}

addEventListener("DOMContentLoaded", build);
