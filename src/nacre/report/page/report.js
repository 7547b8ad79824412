// The document, what is selected, and small helpers that every section uses.
const report = JSON.parse(document.getElementById("document").textContent);
const rows = report.rows ?? [];
const rowOf = new Map(rows.map(row => [row.id, row]));
const columns = report.columns ?? [];
const columnOf = new Map(columns.map(column => [column.key, column]));

// What the reader has chosen. Changes are announced as events of `state.bus`: "select" (A or B), "exposure",
// "theme".
const state = {
    a: null,  // a source: see sources()
    b: null,
    exposure: report.exposure?.start ?? 0,
    bus: new EventTarget(),
    announce(what) { this.bus.dispatchEvent(new Event(what)); },
    on(what, act) { this.bus.addEventListener(what, act); },
};

// An element: el("td", {class: "number", onclick: act, "data-row": id}, child, "text", [more]).
function el(name, attributes = {}, ...children) {
    return fill(document.createElement(name), attributes, children);
}

function svg(name, attributes = {}, ...children) {
    return fill(document.createElementNS("http://www.w3.org/2000/svg", name), attributes, children);
}

function fill(node, attributes, children) {
    for (const [key, value] of Object.entries(attributes)) {
        if (value === undefined || value === null || value === false) continue;
        if (key.startsWith("on"))
            node.addEventListener(key.slice(2), value);
        else
            node.setAttribute(key, value === true ? "" : value);
    }
    node.append(
        ...children.flat(3).filter(child => child !== undefined && child !== null && child !== false));
    return node;
}

// A section of the page, which the navigation lists.
function section(id, title, ...children) {
    return el(
        "section", {id: `section-${id}`, class: "section", "aria-labelledby": `title-${id}`},
        el("h2", {id: `title-${id}`}, title), ...children);
}

// Text that may be broken after _ = and commas, where long settings should.
function breakable(text) {
    return String(text).split(/([_=,])/).flatMap(
        (part, i, parts) => i % 2 ? [] : i + 1 < parts.length ? [part + parts[i + 1], el("wbr")] : [part]);
}

function label(row) { return row.setting ? `${row.name} ${row.setting}` : row.name; }

// Words of a number with a unit; digits as the column says, unless nothing would be left of the value.
function number(value, digits = 2) {
    if (value === undefined || value === null || !Number.isFinite(value)) return "–";
    let text = value.toFixed(digits);
    if (value !== 0 && Number(text) === 0) {
        text = Math.abs(value) < 1e-4 ? value.toExponential(0) : value.toPrecision(1);
    }
    if (Math.abs(value) >= 1e4) text = text.replace(/\B(?=(\d{3})+(?!\d)(?:\.|$))/g, "\u202f");
    return text.replace("-", "\u2212");
}

function withUnit(text, unit) { return unit ? `${text}${unit === "%" ? "\u00a0%" : `\u00a0${unit}`}` : text; }

// As many digits as help at any size: three significant ones.
function significant(value) {
    if (value === 0) return "0";
    const size = Math.floor(Math.log10(Math.abs(value)));
    if (size < -4 || size > 5) return value.toExponential(2).replace("-", "\u2212");
    return value.toFixed(Math.max(0, 2 - size)).replace("-", "\u2212");
}

// Value, standard error and range of a row in words, for tooltips.
function describe(row, key) {
    const column = columnOf.get(key);
    const value = row.values?.[key];
    if (value === undefined || value === null) return "–";
    if (column.text) return String(value);
    let text = number(value, column.digits);
    if (row.errors?.[key] !== undefined) text += ` ± ${number(row.errors[key], column.digits)}`;
    text = withUnit(text, column.unit);
    const range = row.ranges?.[key];
    if (range) text += ` (repeats ${number(range[0], column.digits)} to ${number(range[1], column.digits)})`;
    return text;
}

function columnTitle(column) { return column.unit ? `${column.title}, ${column.unit}` : column.title; }

// The one tooltip. Lines: strings, or [title, value] pairs. Stays inside the window.
const tip = {
    node: document.getElementById("tip"),
    show(lines, x, y) {
        const [head, ...rest] = lines;
        this.node.replaceChildren(
            ...(head ? [el("strong", {}, head)] : []),
            ...rest.map(
                line => Array.isArray(line) ?
                    el("div", {class: "pair"}, el("span", {}, line[0]), el("span", {}, line[1])) :
                    el("div", {}, line)));
        this.node.hidden = false;
        const {offsetWidth: width, offsetHeight: height} = this.node;
        const right = document.documentElement.clientWidth - width - 8;
        this.node.style.left = `${Math.max(8, Math.min(x + 14, right))}px`;
        this.node.style.top = `${y + 18 + height > innerHeight ? Math.max(8, y - height - 12) : y + 18}px`;
    },
    hide() { this.node.hidden = true; },
};

// Makes `node` answer pointer, focus and tap with `lines()`.
function explain(node, lines) {
    const atNode = () => {
        const box = node.getBoundingClientRect();
        tip.show(lines(), box.left + box.width / 2, box.top + box.height / 2);
    };
    node.addEventListener("pointermove", event => tip.show(lines(event), event.clientX, event.clientY));
    node.addEventListener("pointerleave", event => {
        if (event.pointerType === "mouse") tip.hide();
    });
    node.addEventListener("focus", () => {
        if (node.matches(":focus-visible")) atNode();
    });
    node.addEventListener("blur", () => tip.hide());
    node.addEventListener("click", event => {
        if (event.detail > 0) tip.show(lines(event), event.clientX, event.clientY);
    });
}

// A tap elsewhere, Escape or scrolling ends the tooltip.
document.addEventListener("pointerdown", () => tip.hide(), true);
document.addEventListener("keydown", event => {
    if (event.key === "Escape") tip.hide();
});
document.addEventListener("scroll", () => tip.hide(), {capture: true, passive: true});

function say(text) { document.getElementById("live").textContent = text; }

// Marks all that belongs to a row, wherever it is on the page.
function highlight(id) {
    for (const node of document.querySelectorAll(".lit")) node.classList.remove("lit");
    document.documentElement.classList.toggle("has-lit", id !== null);
    if (id === null) return;
    for (const node of document.querySelectorAll(`[data-row="${CSS.escape(id)}"]`)) node.classList.add("lit");
}

// What the viewer can show: the reference and every row that has a picture.
function sources() {
    const list = [];
    const known = key => key !== undefined && report.pictures?.[key] !== undefined;
    if (known(report.reference?.picture)) {
        list.push({
            id: "",
            title: `Reference: ${report.reference.title}`,
            short: "reference",
            picture: report.reference.picture
        });
    }
    for (const row of rows) {
        if (known(row.picture)) {
            list.push({
                id: row.id,
                title: label(row),
                short: label(row),
                picture: row.picture,
                flip: row.flip,
                row
            });
        }
    }
    return list;
}

function select(id) {
    const source = sources().find(entry => entry.id === id);
    if (!source) return;
    state.a = source;
    state.announce("select");
    say(`Picture A is ${source.title}`);
}

function copyButton(text) {
    const button = el("button", {type: "button", class: "copy", "aria-label": "Copy the command"}, "Copy");
    button.addEventListener("click", async () => {
        let done = false;
        try {
            await navigator.clipboard.writeText(text);
            done = true;
        } catch {  // older browsers, or no permission
            const area = el("textarea", {class: "visually-hidden"});
            area.value = text;
            document.body.append(area);
            area.select();
            done = document.execCommand("copy");
            area.remove();
            button.focus();
        }
        button.textContent = done ? "Copied" : "Not possible";
        setTimeout(() => {
            button.textContent = "Copy";
        }, 1500);
    });
    return button;
}

function command(text) {
    return el(
        "div", {class: "command"}, el("code", {tabindex: 0, "aria-label": "Command"}, text),
        copyButton(text));
}

function pairs(list, attributes = {}) {
    return el(
        "dl", {class: "pairs", ...attributes},
        list.map(([key, value]) => el("div", {}, el("dt", {}, key), el("dd", {}, value))));
}

// Several choices of which one holds, as a row of buttons.
function choice(name, title, options, chosen, act) {
    return el(
        "fieldset", {class: "choice"}, el("legend", {class: "visually-hidden"}, title),
        options.map(
            ([value, text]) =>
                el("label", {}, el("input", {
                       type: "radio",
                       name,
                       value,
                       checked: value === chosen,
                       onchange: () => act(value),
                   }),
                   el("span", {}, text))));
}

function menu(id, title, options, chosen, act, attributes = {}) {
    const list =
        el("select", {id, ...attributes, onchange: event => act(event.target.value)},
           options.map(([value, text]) => el("option", {value, selected: value === chosen}, text)));
    return el("label", {class: "menu"}, el("span", {}, title), list);
}
