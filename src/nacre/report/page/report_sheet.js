// Zoomed crops and the contact sheet.

function caption(source) {
    if (!source.row) return el("span", {class: "caption"}, "reference");
    return el(
        "span", {class: "caption"}, markerIcon(source.row.name), "\u00a0", source.row.name,
        source.row.setting && [" ", el("small", {}, breakable(source.row.setting))]);
}

// For every picture a card with a tile a crop; one crop alone is shown larger.
function cropsSection() {
    const crops = report.crops ?? [], all = sources();
    if (!crops.length || !all.length || !canUnpack) return null;
    const reference = all[0].row ? null : all[0].picture;
    const cards = all.map(
        source =>
            el("div", {class: "card", "data-row": source.row?.id}, caption(source),
               el("div", {class: "tiles"}, crops.map((crop, i) => cropTile(source, crop, i, reference)))));
    const grid = el("div", {id: "crops", class: "cards", "data-crops": crops.length}, cards);
    const only = value => {
        for (const figure of grid.querySelectorAll("figure"))
            figure.hidden = value !== "all" && figure.dataset.crop !== value;
        grid.dataset.crops = value === "all" ? crops.length : 1;
    };
    const pick = crops.length > 1 &&
        choice("crop", "Crops to show", [["all", "All"], ...crops.map((crop, i) => [String(i), crop.title])],
               "all", only);
    return section(
        "crops", "Crops", el("div", {class: "controls"}, pick, exposureControl("exposure-crops")),
        reference !== null &&
            el("p", {class: "hint"}, "Press and hold a crop to see the reference in its place."),
        grid);
}

function cropTile(source, crop, i, reference) {
    const title = `${crop.title}, ${source.title}`;
    const canvas = tile(source.picture, title, crop);
    const button =
        el("button", {
            type: "button",
            class: "tile",
            "aria-label": reference === null ? title : `${title}: hold to see the reference`
        },
           canvas);
    const figure = el("figure", {"data-crop": i}, button, el("figcaption", {}, crop.title));
    if (reference !== null && source.picture !== reference) {
        const show = key => () => {
            figure.classList.toggle("held", key === reference);
            retile(canvas, key);
        };
        button.addEventListener("pointerdown", show(reference));
        for (const end of ["pointerup", "pointerleave", "pointercancel", "blur", "keyup"])
            button.addEventListener(end, show(source.picture));
        button.addEventListener("keydown", event => {
            if (event.key === " " || event.key === "Enter") {
                event.preventDefault();
                show(reference)();
            }
        });
        button.addEventListener("contextmenu", event => event.preventDefault());
    }
    return figure;
}

function sheetSection() {
    const all = sources();
    if (all.length < 2 || !canUnpack) return null;
    const measure = columns.find(column => !column.text && column.better !== "none");
    const cards = all.map(
        source =>
            el("button", {
                type: "button",
                class: "thumb",
                "data-row": source.row?.id,
                "data-source": source.id,
                "aria-label": `Show ${source.title} as picture A`,
                onclick: () => {
                    select(source.id);
                    const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
                    document.getElementById("section-pictures").scrollIntoView({
                        behavior: calm ? "auto" : "smooth"
                    });
                },
            },
               tile(source.picture, source.title), caption(source),
               source.row && measure &&
                   el("small", {class: "caption"},
                      describe(source.row, measure.key).replace(/ \(repeats.*/, ""))));
    const mark = () => {
        for (const card of cards) {
            card.setAttribute("aria-pressed", card.dataset.source === state.a.id);
        }
    };
    state.on("select", mark);
    mark();
    return section(
        "sheet", "All pictures",
        el("p", {class: "hint"}, measure ? `With the ${measure.title}. ` : "",
           el("span", {class: "screen"}, "Choose one to see it as picture A.")),
        el("div", {id: "sheet"}, cards));
}
