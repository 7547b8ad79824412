// What the numbers say, in sentences, and how long each technique takes to an error that the reader chooses.

// As nacre::time_to_reach: seconds, or "unsure" or "never".
function timeToReach(law, error) {
    if (law.floor - 2 * law.sigma >= error) return "never";
    const floor = law.floor + 2 * law.sigma;
    if (!(floor < error)) return "unsure";
    return law.before + Math.max(law.frame * law.noise ** 2 / (error ** 2 - floor ** 2), law.least_frame);
}

function timeInWords(seconds) {
    const round = value => String(Number(value.toPrecision(2)));
    if (seconds >= 5400) return `${round(seconds / 3600)}\u00a0h`;
    if (seconds >= 90) return `${round(seconds / 60)}\u00a0min`;
    return seconds < 0.001 ? "under 1\u00a0ms" : `${round(seconds)}\u00a0s`;
}

function verdictBox() {
    const verdict = report.verdict;
    if (!verdict?.sentences?.length) return null;
    const lawful = rows.filter(row => row.law && row.same_as === undefined);
    return el(
        "section", {id: "verdict", class: "verdict", "aria-label": "What the numbers say"},
        verdict.sentences.map(text => el("p", {class: "sentence"}, breakable(text))),
        lawful.length > 0 && verdict.error > 0 ? reachControl(lawful, verdict.error) : null,
        verdict.text && el("details", {class: "help"}, el("summary", {}, "How this is known"),
                           el("p", {class: "hint"}, verdict.text)));
}

// The list of techniques by the time to the chosen error; the table's column follows it.
function reachControl(lawful, first) {
    const list = el("ol", {id: "reach"}), rest = el("p", {class: "hint", id: "reach-rest"});
    const show = error => {
        const times = lawful.map(row => [row, timeToReach(row.law, error)]);
        const reached = times.filter(([, t]) => typeof t === "number").sort((a, b) => a[1] - b[1]);
        list.replaceChildren(...reached.map(
            ([row, t]) =>
                el("li", {"data-reach-row": row.id},
                   el("span", {class: "names"}, markerIcon(row.name), "\u00a0", breakable(label(row))),
                   el("strong", {}, timeInWords(t)))));
        const names = what => times.filter(([, t]) => t === what).map(([row]) => label(row)).join("; ");
        rest.replaceChildren(
            reached.length ? "" : "None is certain to reach it. ",
            names("unsure") && el("span", {}, "Left open by noise: ", breakable(names("unsure")), ". "),
            names("never") && el("span", {}, "Never: ", breakable(names("never")), "."));
        const column = columnOf.get("reach");
        if (!column) return;
        column.title = `time to ${Number(error.toPrecision(3))}\u00a0%`;
        for (const row of rows.filter(row => row.law)) {
            const t = timeToReach(row.law, error);
            if (typeof t === "number")
                row.values.reach = t;
            else
                delete row.values.reach;
        }
        state.announce("reach");
    };
    const input = el("input", {
        id: "reach-error",
        type: "number",
        min: 0.1,
        max: 100,
        step: "any",
        value: first,
        inputmode: "decimal",
        oninput: event => {
            const error = Number(event.target.value);
            if (error > 0 && error <= 1000) {
                show(error);
                state.announce("sort-reach");
            }
        }
    });
    show(first);
    return el(
        "div", {class: "reach"}, el("label", {for: "reach-error"}, "Time to an error of ", input, " %"), list,
        rest);
}
