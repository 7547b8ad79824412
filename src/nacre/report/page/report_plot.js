// Error against time, both logarithmic: every setting a point, the settings of one technique that differ in a number joined.

const plotState = {
    x: null,
    y: null,
    node: null
};

function plotSection() {
    const plot = report.plot;
    const usable = keys => (keys ?? []).filter(key => columnOf.has(key) && !columnOf.get(key).text);
    const xs = usable(plot?.x), ys = usable(plot?.y);
    if (!xs.length || !ys.length) return null;
    [plotState.x] = xs;
    [plotState.y] = ys;
    const options = keys => keys.map(key => [key, columnTitle(columnOf.get(key))]);
    const change = axis => value => {
        plotState[axis] = value;
        drawPlot();
    };
    plotState.node = el("div", {id: "plot", class: "diagram"});
    plotState.legend = el("ul", {class: "legend"});
    plotState.note = el("p", {class: "hint"});
    whenResized(plotState.node, drawPlot);
    state.on("select", () => {
        for (const point of plotState.node.querySelectorAll(".point"))
            point.classList.toggle("chosen", point.dataset.row === state.a.id);
    });
    return section(
        "plot", "Error against time",
        el("div", {class: "controls"}, menu("plot-y", "Error", options(ys), plotState.y, change("y")),
           menu("plot-x", "Time", options(xs), plotState.x, change("x"))),
        el("div", {class: "with-legend"}, plotState.node, plotState.legend), plotState.note);
}

function drawPlot() {
    const {x: keyX, y: keyY, node} = plotState;
    const width = node.clientWidth;
    if (!width) return;
    const height = Math.round(Math.max(300, Math.min(540, width * .62)));
    const box = {left: 52, top: 26, right: width - 18, bottom: height - 44};
    const at = (row, key) => row.values?.[key];
    const known =
        rows.filter(row => row.status === "ok" && at(row, keyX) !== undefined && at(row, keyY) !== undefined);
    const points = known.filter(row => at(row, keyX) > 0 && at(row, keyY) > 0);
    const curves = keyX === "total" && keyY === "rms" ? points.filter(row => row.curve?.length > 1) : [];
    const x = scale(points.map(row => at(row, keyX)), [box.left, box.right], true);
    const y = scale(points.map(row => at(row, keyY)), [box.bottom, box.top], true);
    const place = row => [x.at(at(row, keyX)), y.at(at(row, keyY))];
    const front = paretoFront(points, keyX, keyY);

    const drawing = svg("svg", {
        viewBox: `0 0 ${width} ${height}`,
        role: "group",
        "aria-label":
            `${columnOf.get(keyY).title} against ${columnOf.get(keyX).title}, ${points.length} settings`
    });
    drawing.append(
        svg("defs", {},
            svg("clipPath", {id: "plot-area"},
                svg("rect",
                    {x: box.left, y: box.top, width: box.right - box.left, height: box.bottom - box.top}))),
        axes(x, y, box, `${columnTitle(columnOf.get(keyX))} →`, `↑ ${columnTitle(columnOf.get(keyY))}`));
    const area = svg("g", {"clip-path": "url(#plot-area)"});
    drawing.append(area);
    if (front.length) area.append(svg("path", {class: "front", d: stairs(front.map(place), box)}));
    for (const row of curves) {
        const d = row.curve.filter(([t, e]) => t > 0 && e > 0)
                      .map(([t, e], i) => `${i ? "L" : "M"}${x.at(t).toFixed(1)} ${y.at(e).toFixed(1)}`)
                      .join("");
        area.append(svg("path", {class: "curve", d, stroke: style(row.name).colour, "data-name": row.name}));
    }
    for (const [name, group] of byName(points)) {
        // Words, such as the names of profiles, are in no order that a line could follow.
        if (group.length < 2 || !group.every(row => /=[-.\d]+/.test(row.setting ?? ""))) continue;
        const sorted = [...group].sort((a, b) => at(a, keyX) - at(b, keyX));
        area.append(svg("path", {
            class: "join",
            stroke: style(name).colour,
            "data-name": name,
            d: sorted.map((row, i) => `${i ? "L" : "M"}${place(row).map(v => v.toFixed(1)).join(" ")}`)
                   .join("")
        }));
    }
    for (const row of points) area.append(...whiskers(row, keyX, keyY, x, y));
    const labels = placeLabels(points, place, box);
    drawing.append(...labels);
    const order = [...points].sort((a, b) => at(a, keyX) - at(b, keyX));
    const nodes = order.map(row => pointNode(row, place(row), front.includes(row), keyX, keyY));
    nodes.forEach((point, i) => {
        point.setAttribute("tabindex", i === 0 ? 0 : -1);  // one stop of the tab key; arrows go on
        point.addEventListener("keydown", event => {
            const step = {ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1}[event.key];
            const next = event.key === "Home" ? 0 :
                event.key === "End"           ? nodes.length - 1 :
                step                          ? Math.max(0, Math.min(nodes.length - 1, i + step)) :
                                                null;
            if (next === null) return;
            event.preventDefault();
            nodes[next].focus();
        });
    });
    drawing.append(svg("g", {class: "points"}, nodes));
    node.replaceChildren(drawing);
    drawPlotLegend(points, front);
    const lost = known.filter(row => !points.includes(row)).map(label),
          unknown = rows.filter(row => row.status === "ok" && !known.includes(row)).map(label);
    plotState.note.replaceChildren([
        "Filled points and the grey line are the Pareto front: no other setting is both faster and closer.",
        points.some(row => row.errors?.[keyY] || row.ranges?.[keyX]) &&
            "Whiskers: one standard error of the error, range of the repeated times.",
        curves.length && "Thin lines: how the error falls with time, bias² + variance / time.",
        lost.length && `Not shown, being 0: ${lost.join(", ")}.`,
        unknown.length && `Not shown, without a value: ${unknown.join(", ")}.`,
    ].filter(Boolean).join(" "));
}

function byName(list) {
    const groups = new Map();
    for (const row of list) groups.set(row.name, [...(groups.get(row.name) ?? []), row]);
    return groups;
}

// Rows that no other beats in both, from left to right.
function paretoFront(points, keyX, keyY) {
    const front = [];
    const order =
        [...points].sort((a, b) => a.values[keyX] - b.values[keyX] || a.values[keyY] - b.values[keyY]);
    for (const row of order) {
        if (!front.length || row.values[keyY] < front.at(-1).values[keyY]) front.push(row);
    }
    return front;
}

function stairs(places, box) {
    const [first] = places;
    let d = `M${first[0]} ${box.top}V${first[1]}`;
    for (const [px, py] of places.slice(1)) d += `H${px}V${py}`;
    return `${d}H${box.right}`;
}

function whiskers(row, keyX, keyY, x, y) {
    const lines = [], vx = row.values[keyX], vy = row.values[keyY], error = row.errors?.[keyY],
          range = row.ranges?.[keyX];
    const line = (x1, y1, x2, y2) =>
        lines.push(svg("line", {class: "whisker", x1, y1, x2, y2, stroke: style(row.name).colour}));
    if (error > 0) line(x.at(vx), y.at(Math.max(vy - error, y.low / 10)), x.at(vx), y.at(vy + error));
    if (range && range[0] > 0) line(x.at(range[0]), y.at(vy), x.at(range[1]), y.at(vy));
    return lines;
}

function pointNode(row, [px, py], onFront, keyX, keyY) {
    const {colour, marker} = style(row.name);
    const chosen = state.a?.id === row.id;
    const lines = () =>
        [row.name, ...(row.setting ? [row.setting] : []),
         ...(row.title && row.title !== row.name ? [row.title] : []),
         [columnOf.get(keyX).title, describe(row, keyX)], [columnOf.get(keyY).title, describe(row, keyY)],
         ...(onFront ? ["on the Pareto front"] : []), ...(row.peer ? ["another renderer"] : [])];
    const node =
        svg("g", {
            class: `point${chosen ? " chosen" : ""}${onFront ? " on-front" : ""}`,
            "data-row": row.id,
            "data-name": row.name,
            transform: `translate(${px.toFixed(1)} ${py.toFixed(1)})`,
            role: "button",
            "aria-label": `${label(row)}: ${columnOf.get(keyX).title} ${describe(row, keyX)}, ${
                columnOf.get(keyY).title} ${describe(row, keyY)}${onFront ? ", on the Pareto front" : ""}`
        },
            svg("circle", {class: "target", r: 13}), svg("circle", {class: "halo", r: 11}), svg("path", {
                d: marker(5.5),
                class: "mark",
                style: `stroke:${colour};fill:${onFront ? colour : "var(--surface)"}`
            }));
    explain(node, lines);
    node.addEventListener("pointerenter", () => highlight(row.id));
    node.addEventListener("pointerleave", () => highlight(null));
    node.addEventListener("focus", () => highlight(row.id));
    node.addEventListener("blur", () => highlight(null));
    node.addEventListener("click", () => select(row.id));
    node.addEventListener("keydown", event => {
        if (event.key === "Enter" || event.key === " ") {
            event.preventDefault();
            event.stopPropagation();
            select(row.id);
        }
    });
    return node;
}

function drawPlotLegend(points, front) {
    plotState.legend.replaceChildren(...[...byName(points)].map(([name, group]) => {
        const item =
            el("li", {}, markerIcon(name, !group.some(row => front.includes(row))), " ", name,
               group.some(row => row.peer) && el("small", {}, " another renderer"));
        item.addEventListener("pointerenter", () => dim(name));
        item.addEventListener("pointerleave", () => dim(null));
        return item;
    }));
}

// Fades all that is not of this name.
function dim(name) {
    for (const node of plotState.node.querySelectorAll("[data-name]"))
        node.classList.toggle("dim", name !== null && node.dataset.name !== name);
}

// A name beside one point of each technique, where it hides nothing; the legend holds those that find no
// place.
function placeLabels(points, place, box) {
    if (box.right - box.left < 480) return [];
    const taken =
        points.map(row => place(row)).map(([px, py]) => ({l: px - 9, r: px + 9, t: py - 9, b: py + 9}));
    const labels = [];
    for (const [name, group] of byName(points)) {
        const width = name.length * 7 + 4, height = 14;
        const spots = group.flatMap(row => {
            const [px, py] = place(row);
            return [
                [px + 12, py + 4, "start"], [px - 12, py + 4, "end"], [px, py - 13, "middle"],
                [px, py + 22, "middle"], [px + 9, py - 9, "start"], [px - 9, py - 9, "end"],
                [px + 9, py + 18, "start"], [px - 9, py + 18, "end"]
            ];
        });
        const boxOf = ([lx, ly, anchor]) => {
            const l = anchor === "start" ? lx : anchor === "end" ? lx - width : lx - width / 2;
            return {l, r: l + width, t: ly - height + 3, b: ly + 3};
        };
        const free = spots.find(spot => {
            const b = boxOf(spot);
            return b.l >= box.left && b.r <= box.right && b.t >= box.top && b.b <= box.bottom &&
                taken.every(t => b.r < t.l || b.l > t.r || b.b < t.t || b.t > t.b);
        });
        if (!free) continue;
        taken.push(boxOf(free));
        labels.push(
            svg("text", {
                class: "direct",
                x: free[0],
                y: free[1],
                "text-anchor": free[2],
                fill: `color-mix(in oklab, ${style(name).colour} 65%, var(--ink))`,
                "data-name": name,
                "aria-hidden": "true"
            },
                name));
    }
    return labels;
}
