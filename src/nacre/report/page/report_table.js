// The table of techniques: sortable, one row a setting, the best values marked.

const sorting = {
    key: null,
    descending: false
};

function tableSection() {
    if (!rows.length) return null;
    const nameHead = el(
        "th", {scope: "col", "data-key": "name", class: "name"}, el("button", {type: "button"}, kindOfRow()));
    const heads = shownColumns().map(column => {
        const head =
            el("th", {scope: "col", "data-key": column.key, class: column.text ? "text" : "number"},
               el("button", {type: "button"},
                  el("span", {}, column.title, column.unit && el("small", {}, ` ${column.unit}`))));
        if (column.help) explain(head.firstChild, () => [columnTitle(column), column.help]);
        return head;
    });
    const body = el("tbody");
    const table = el("table", {id: "table"}, el("thead", {}, el("tr", {}, nameHead, heads)), body);
    const best = bestOf();
    const lines = new Map(rows.map(row => [row.id, tableRow(row, best)]));

    const order = () => {
        body.replaceChildren(...sorted().map(row => lines.get(row.id)));
        for (const head of [nameHead, ...heads]) {
            const on = head.dataset.key === sorting.key;
            if (on)
                head.setAttribute("aria-sort", sorting.descending ? "descending" : "ascending");
            else
                head.removeAttribute("aria-sort");
        }
    };
    for (const head of [nameHead, ...heads]) {
        head.firstChild.addEventListener("click", () => {
            const {key} = head.dataset;
            if (sorting.key !== key)
                Object.assign(sorting, {key, descending: false});
            else if (!sorting.descending)
                sorting.descending = true;
            else
                Object.assign(sorting, {key: null, descending: false});  // the third time: the given order
            order();
        });
    }
    const mark = () => {
        for (const [id, line] of lines) {
            const chosen = state.a?.id === id;
            line.classList.toggle("chosen", chosen);
            line.querySelector("button.row")?.setAttribute("aria-pressed", chosen);
        }
    };
    state.on("reach", () => {
        const column = columnOf.get("reach");
        if (!column) return;
        const at = shownColumns().indexOf(column), marked = bestOf().get("reach");
        for (const row of rows.filter(row => row.status === "ok"))
            lines.get(row.id).children[at + 1].replaceWith(cell(row, column, marked?.has(row.id)));
        heads[at].querySelector("span").replaceChildren(column.title, el("small", {}, ` ${column.unit}`));
        order();
    });
    state.on("sort-reach", () => {
        Object.assign(sorting, {key: "reach", descending: false});
        order();
    });
    state.on("select", mark);
    order();
    mark();
    return section(
        "table", report.kind === "models" ? "Models" : "Techniques",
        el("p", {class: "sideways", "aria-hidden": "true"}, "The table scrolls sideways →"),
        el("div", {class: "scroll", tabindex: 0, role: "region", "aria-label": "Table, scrolls sideways"},
           table),
        tableNotes());
}

// Hidden ones are only for the diagram.
function shownColumns() { return columns.filter(column => !column.hidden); }

function kindOfRow() { return report.kind === "models" ? "Model" : "Technique"; }

function tableRow(row, best) {
    const name = [
        markerIcon(row.name),
        el("span", {class: "names"},
           el("span", {}, breakable(row.name), row.setting && [" ", el("small", {}, breakable(row.setting))]),
           row.title && row.title !== row.name && el("small", {class: "long"}, row.title),
           row.same_as !== undefined && el("small", {class: "same"}, "identical to ", breakable(row.same_as)),
           row.peer && el("small", {class: "tag"}, "another renderer"))
    ];
    const shows = canUnpack && row.picture !== undefined && report.pictures?.[row.picture];
    const head =
        el("th", {scope: "row", class: "name"},
           shows ?
               el("button",
                  {type: "button", class: "row", "aria-pressed": "false", title: "Show as picture A"}, name) :
               el("span", {class: "row"}, name));
    const line =
        el("tr", {
            "data-row": row.id,
            class:
                [row.peer && "peer", row.status !== "ok" && "absent", shows && "shows"].filter(Boolean).join(
                    " ")
        },
           head);
    if (row.status !== "ok") {
        line.append(
            el("td", {colspan: Math.max(1, shownColumns().length), class: "why"},
               el("span", {}, el("strong", {}, row.status === "missing" ? "Not run. " : "Failed. "),
                  row.why ?? "")));
    } else {
        line.append(...shownColumns().map(column => cell(row, column, best.get(column.key)?.has(row.id))));
    }
    if (shows) {
        line.addEventListener("click", () => {
            if (!String(getSelection())) select(row.id);
        });
    }
    line.addEventListener("pointerenter", () => highlight(row.id));
    line.addEventListener("pointerleave", () => highlight(null));
    return line;
}

function cell(row, column, isBest) {
    const value = row.values?.[column.key];
    if (value === undefined || value === null)
        return el(
            "td", {class: column.text ? "text" : "number"},
            el("span", {class: "none", "aria-label": "not known"}, "–"));
    if (column.text)
        return el("td", {class: String(value).length > 40 ? "text long-text" : "text"}, breakable(value));
    const error = row.errors?.[column.key], range = row.ranges?.[column.key];
    const node =
        el("td", {class: `number${isBest ? " best" : ""}`},
           el("span", {class: "value"}, number(value, column.digits)),
           error !== undefined && el("small", {class: "error"}, ` ±\u202f${number(error, column.digits)}`));
    if (isBest) node.firstChild.append(el("span", {class: "visually-hidden"}, " (best)"));
    if (range) {
        node.classList.add("ranged");
        node.title = `repeats: ${number(range[0], column.digits)} to ${number(range[1], column.digits)}${
            column.unit ? ` ${column.unit}` : ""}`;
    }
    return node;
}

// For each column the rows whose value is the best, or within two standard errors of it, or reads the same.
function bestOf() {
    const best = new Map();
    for (const column of columns) {
        if (column.text || !["low", "zero"].includes(column.better)) continue;
        const size = row =>
            column.better === "zero" ? Math.abs(row.values[column.key]) : row.values[column.key];
        const known = rows.filter(row => row.status === "ok" && Number.isFinite(row.values?.[column.key]));
        if (known.length < 2) continue;
        const first = known.reduce((a, b) => size(b) < size(a) ? b : a);
        const error = row => row.errors?.[column.key] ?? 0;
        const good = known.filter(
            row => size(row) - size(first) <= 2 * Math.hypot(error(row), error(first)) ||
                number(size(row), column.digits) === number(size(first), column.digits));
        if (good.length <= Math.max(1, known.length / 3))
            best.set(column.key, new Set(good.map(row => row.id)));
    }
    return best;
}

// Rows without a value stay last whatever the direction.
function sorted() {
    const {key, descending} = sorting;
    if (key === null) return rows;
    const zero = columnOf.get(key)?.better === "zero";
    const value = row => {
        if (key === "name") return label(row);
        const found = row.status === "ok" ? row.values?.[key] ?? null : null;
        return zero && found !== null ? Math.abs(found) : found;
    };
    return [...rows].sort((a, b) => {
        const x = value(a), y = value(b);
        if (x === null || y === null) return (x === null) - (y === null);
        const order = typeof x === "string" || typeof y === "string" ?
            String(x).localeCompare(String(y), "en", {numeric: true}) :
            x - y;
        return descending ? -order : order;
    });
}

function tableNotes() {
    const helped = shownColumns().filter(column => column.help);
    const marks = [];  // text, whether it helps on paper too
    if (bestOf().size)
        marks.push([
            "Bold: the best of a column, and what cannot be told from it (within two standard errors).", true
        ]);
    if (rows.some(row => row.errors && Object.keys(row.errors).length))
        marks.push(["±: one standard error.", true]);
    if (rows.some(row => row.ranges && Object.keys(row.ranges).length))
        marks.push(["Dotted: point at a value to see the range of its repeats.", false]);
    if (canUnpack && sources().length > 1) marks.push(["Choose a row to see it as picture A below.", false]);
    return [
        marks.length > 0 &&
            el("p", {class: "hint"},
               marks.map(([text, paper]) => el("span", {class: paper ? null : "screen"}, `${text} `))),
        helped.length > 0 &&
            el("details", {class: "help"}, el("summary", {}, "What the columns mean"),
               pairs(helped.map(column => [columnTitle(column), column.help])))
    ];
}
