// The suite: every technique on every case.

const summaries = {
    rms: ["RMS", list => Math.sqrt(list.reduce((sum, v) => sum + v * v, 0) / list.length)],
    median: [
        "median",
        list => {
            const order = [...list].sort((a, b) => a - b), half = order.length >> 1;
            return order.length % 2 ? order[half] : (order[half - 1] + order[half]) / 2;
        }
    ],
    worst: ["worst", list => list.reduce((worst, v) => Math.abs(v) > Math.abs(worst) ? v : worst, list[0])],
};

const matrixState = {
    measure: null,
    summary: "rms",
    filters: new Map(),
    sort: false,
    table: null,
    count: null
};

function matrixSection() {
    const matrix = report.matrix;
    if (!matrix?.cases?.length || !matrix.techniques?.length) return null;
    const measures = matrix.measures ?? [];
    if (!measures.length) return null;
    matrixState.measure = measures[0];
    matrixState.table = el("table", {id: "matrix"});
    matrixState.count = el("span", {class: "hint", "aria-live": "polite"});
    matrixState.legend = el("div", {class: "heat-legend"});
    const filters = (matrix.label_titles ?? []).map((title, i) => {
        const values =
            [...new Set(matrix.cases.map(one => one.labels?.[i]).filter(value => value !== undefined))];
        return values.length > 1 &&
            menu(null, title, [["", "all"], ...values.map(value => [value, value])], "", value => {
                   if (value === "")
                       matrixState.filters.delete(i);
                   else
                       matrixState.filters.set(i, value);
                   drawMatrix();
               }, {"data-label": title});
    });
    drawMatrix();
    return section(
        "matrix", "Cases",
        el("div", {class: "controls"},
           menu(
               "matrix-measure", "Measure", measures.map(measure => [measure.key, columnTitle(measure)]),
               measures[0].key,
               key => {
                   matrixState.measure = measures.find(measure => measure.key === key);
                   drawMatrix();
               }),
           menu(
               "matrix-summary", "Summary", Object.entries(summaries).map(([key, [title]]) => [key, title]),
               "rms",
               key => {
                   matrixState.summary = key;
                   drawMatrix();
               }),
           el("label", {class: "check"}, el("input", {
                  type: "checkbox",
                  id: "matrix-sort",
                  onchange: event => {
                      matrixState.sort = event.target.checked;
                      drawMatrix();
                  }
              }),
              " best first")),
        el("div", {class: "controls"}, filters, matrixState.count),
        el("div",
           {class: "scroll tall", tabindex: 0, role: "region", "aria-label": "Table of cases, scrolls"},
           matrixState.table),
        matrixState.legend);
}

function drawMatrix() {
    const {techniques, cases, label_titles: titles = []} = report.matrix;
    const {measure, filters} = matrixState;
    const shown = cases.filter(one => [...filters].every(([i, value]) => one.labels?.[i] === value));
    const valueOf = (one, technique) => one.cells?.[technique.id]?.[measure.key];
    const isNoise = (one, technique) =>
        Math.abs(valueOf(one, technique)) < 2 * (one.cells?.[technique.id]?.errors?.[measure.key] ?? 0);
    const valuesOf = (list, technique) => list.map(one => isNoise(one, technique) ? 0 : valueOf(one, technique))
                                              .filter(Number.isFinite);
    const summary = summaries[matrixState.summary][1];
    const summarise = (list, technique) => {
        const values = valuesOf(list, technique);
        return {value: values.length ? summary(values) : null, known: values.length, of: list.length};
    };
    const totals = new Map(techniques.map(technique => [technique.id, summarise(shown, technique)]));
    const order = [...techniques];
    if (matrixState.sort) {
        // A technique that knows fewer cases is summarised over easier ones, perhaps: those that know all
        // come first.
        const rank = technique => totals.get(technique.id);
        order.sort(
            (a, b) => (rank(b).known === shown.length) - (rank(a).known === shown.length) ||
                Math.abs(rank(a).value ?? Infinity) - Math.abs(rank(b).value ?? Infinity));
    }
    const every = cases.flatMap(one => techniques.map(technique => Math.abs(valueOf(one, technique))))
                      .filter(v => v > 0);
    const least = Math.min(...every), most = Math.max(...every);
    const heat = value => {
        if (!Number.isFinite(value) || most <= least || !every.length) return null;
        const t = (Math.log(Math.max(Math.abs(value), least)) - Math.log(least)) /
            (Math.log(most) - Math.log(least));
        return `--heat:${Math.round(Math.min(1, Math.max(0, t)) * 100)}%`;
    };

    const head =
        el("tr", {}, el("th", {scope: "col", class: "case"}, titles.join(" · ") || "Case"),
           order.map(technique => {
               const row = rowOf.get(technique.id);
               return el(
                   "th", {scope: "col", title: technique.title ?? ""},
                   el("span", {class: "upright"},
                      row ? [row.name, row.setting && el("small", {}, ` ${row.setting}`)] : technique.id));
           }));
    const summaryCells = list => order.map(technique => {
        const {value, known, of} = list === shown ? totals.get(technique.id) : summarise(list, technique);
        return el(
            "td", {
                style: heat(value),
                title: `${known} of ${of} cases`,
                class: known && known < of ? "partial" : null
            },
            value === null ? "–" : number(value, measure.digits));
    });
    const name = summaries[matrixState.summary][0];
    const all =
        el("tr", {class: "summary", "data-summary": "all"},
           el("th", {scope: "row", class: "case"}, `${name} of ${shown.length} shown`), summaryCells(shown));
    const parts = titles.flatMap((title, i) => {
        const values = [...new Set(shown.map(one => one.labels?.[i]))];
        return values.length < 2 ?
            [] :
            values.map(
                value =>
                    el("tr", {class: "part"}, el("th", {scope: "row", class: "case"}, `${title}: ${value}`),
                       summaryCells(shown.filter(one => one.labels?.[i] === value))));
    });
    const lines = shown.map(
        one => el(
            "tr", {},
            el("th", {scope: "row", class: "case"},
               el("span", {class: "row"}, caseThumb(one), el("span", {}, one.labels?.join(" · ") ?? one.id))),
            order.map(technique => matrixCell(one, technique, valueOf(one, technique), heat))));
    for (const canvas of matrixState.table.querySelectorAll("canvas")) forget(canvas);
    matrixState.table.replaceChildren(
        el("thead", {}, head, all), parts.length ? el("tbody", {class: "parts"}, parts) : "",
        el("tbody", {}, lines));
    matrixState.count.textContent = `${shown.length} of ${cases.length} cases`;
    const stops = [0, .5, 1].map(
        t => withUnit(
            significant(Math.exp(Math.log(least) + t * (Math.log(most) - Math.log(least)))), measure.unit));
    const partial = order.some(technique => totals.get(technique.id).known < shown.length);
    matrixState.legend.replaceChildren(
        el("div", {class: "heat-bar"}),
        el("div", {class: "ticks"}, every.length ? stops.map(stop => el("span", {}, stop)) : ""),
        el("p", {class: "hint"},
           `${
               report.matrix.title && measure === report.matrix.measures[0] ?
                   `${report.matrix.title}. ` :
                   ""}Colours are logarithmic; grey: within two standard errors of nothing. – : no value; point at it for the reason.` +
               (partial ?
                    " In italics: summaries of only some of the cases; point at one to see of how many." :
                    "")));
}

function caseThumb(one) {
    return canUnpack && one.picture !== undefined && report.pictures?.[one.picture] ? tile(one.picture, "") :
                                                                                      null;
}

function matrixCell(one, technique, value, heat) {
    const marks = {"data-case": one.id, "data-technique": technique.id};
    if (Number.isFinite(value)) {
        const {digits, unit, key} = matrixState.measure;
        const error = one.cells[technique.id].errors?.[key];
        const noise = error > 0 && Math.abs(value) < 2 * error;  // may be nothing
        return el(
            "td", {
                ...marks,
                class: noise && "unsure",
                style: noise ? null : heat(value),
                title: `${technique.title ?? technique.id}\n${one.id}\n${withUnit(number(value, digits), unit)}${
                    error > 0 ? ` ± ${number(error, digits)}${noise ? ": may be noise" : ""}` : ""}`
            },
            number(value, digits));
    }
    const why = one.cells?.[technique.id]?.why;
    const node =
        el("td", {...marks, class: "none", "data-why": why},
           why ? el("span", {tabindex: 0, "aria-label": why}, "–") : "–");
    if (why) explain(node.firstChild, () => [technique.title ?? technique.id, why]);
    return node;
}
