// Further diagrams: lines, polar, and pictures side by side.

function chartsSection() {
    const charts = (report.charts ?? [])
                       .map(chart => chart.kind === "image" ? imageChart(chart) : lineChart(chart))
                       .filter(Boolean);
    return charts.length ? section("charts", "Diagrams", el("div", {id: "charts"}, charts)) : null;
}

function chartFigure(chart, ...children) {
    return el(
        "figure", {class: `chart ${chart.kind}`, "data-chart": chart.id},
        el("figcaption", {}, el("h3", {}, chart.title), chart.text && el("p", {}, chart.text)), ...children);
}

function imageChart(chart) {
    const keys = (chart.pictures ?? []).filter(key => report.pictures?.[key]);
    if (!keys.length || !canUnpack) return null;
    const shown = keys.map(key => {
        const text = chart.captions?.[chart.pictures.indexOf(key)] ?? key;
        return el("figure", {}, tile(key, `${chart.title}: ${text}`), el("figcaption", {}, text));
    });
    return chartFigure(chart, exposureControl(`exposure-${chart.id}`), el("div", {class: "strip"}, shown));
}

function axisTitle(axis) { return axis?.unit ? `${axis.title}, ${axis.unit}` : axis?.title ?? ""; }

function lineChart(chart) {
    const series = (chart.series ?? []).filter(one => one.points?.length);
    if (!series.length) return null;
    const node = el("div", {class: "diagram"});
    const chosen = {name: null};  // a series that the reader keeps in front
    const mark = name => {
        const front = name ?? chosen.name;
        for (const line of node.querySelectorAll("[data-name]"))
            line.classList.toggle("dim", front !== null && line.dataset.name !== front);
    };
    const buttons = series.map((one, index) => {
        const button =
            el("button", {
                type: "button",
                "aria-pressed": "false",
                onclick: () => {
                    chosen.name = chosen.name === one.name ? null : one.name;
                    for (const other of buttons)
                        other.setAttribute("aria-pressed", chosen.name !== null && other === button);
                    mark(null);
                }
            },
               lineIcon(one, index), " ", one.name);
        button.addEventListener("pointerenter", () => mark(one.name));
        button.addEventListener("pointerleave", () => mark(null));
        return button;
    });
    const draw = chart.kind === "polar" ? drawPolar : drawLines;
    whenResized(node, width => {
        draw(chart, series, node, width, mark);
        mark(null);
    });
    return chartFigure(chart, node, el("ul", {class: "legend"}, buttons.map(button => el("li", {}, button))));
}

function lineStyle(one, index) {
    if (one.reference) return {colour: "var(--ink)", dash: "", width: 2.6, marker: null};
    return {...style(one.name, index), width: 1.6};
}

function lineIcon(one, index) {
    const {colour, dash, width, marker} = lineStyle(one, index);
    return svg(
        "svg", {class: "icon", viewBox: "0 -8 28 16", width: 28, height: 14, "aria-hidden": "true"},
        svg("line",
            {x1: 1, x2: 27, y1: 0, y2: 0, stroke: colour, "stroke-width": width, "stroke-dasharray": dash}),
        marker && svg("path", {d: marker(4), fill: colour, transform: "translate(14 0)"}));
}

// A line with a few markers, so that it is known without its colour. `places` in pixels.
function seriesLine(one, places, index, marked = () => true) {
    const {colour, dash, width, marker} = lineStyle(one, index);
    const group =
        svg("g", {class: "series", "data-name": one.name}, svg("path", {
                d: places.map(([px, py], i) => `${i ? "L" : "M"}${px.toFixed(1)} ${py.toFixed(1)}`).join(""),
                fill: "none",
                stroke: colour,
                "stroke-width": width,
                "stroke-dasharray": dash,
                "stroke-linejoin": "round"
            }));
    const every = Math.max(1, Math.ceil(places.length / 6));
    for (let i = (index * 2) % every; marker && i < places.length; i += every) {
        if (marked(places[i]))
            group.append(svg("path", {
                d: marker(3.6),
                fill: colour,
                transform: `translate(${places[i].map(v => v.toFixed(1)).join(" ")})`
            }));
    }
    return group;
}

// The pointer finds the nearest point of all series, which is named and ringed.
function readOut(chart, drawing, all, mark, words) {
    const ring = svg("circle", {class: "ring", r: 6, visibility: "hidden"});
    drawing.append(ring);
    const leave = () => {
        tip.hide();
        mark(null);
        ring.setAttribute("visibility", "hidden");
    };
    const find = event => {
        const box = drawing.getBoundingClientRect(), zoom = drawing.viewBox.baseVal.width / box.width;
        const px = (event.clientX - box.left) * zoom, py = (event.clientY - box.top) * zoom;
        let nearest = null, least = 40 ** 2;
        for (const {one, places} of all) {
            places.forEach(([qx, qy], i) => {
                const distance = (px - qx) ** 2 + (py - qy) ** 2;
                if (distance < least) [nearest, least] = [{one, i, qx, qy}, distance];
            });
        }
        if (!nearest) return leave();
        mark(nearest.one.name);
        ring.setAttribute("visibility", "visible");
        ring.setAttribute("transform", `translate(${nearest.qx} ${nearest.qy})`);
        tip.show([nearest.one.name, ...words(nearest.one.points[nearest.i])], event.clientX, event.clientY);
    };
    drawing.addEventListener("pointermove", find);
    drawing.addEventListener("click", find);
    drawing.addEventListener("pointerleave", leave);
}

function drawLines(chart, series, node, width, mark) {
    const height = Math.round(Math.max(230, Math.min(360, width * .62)));
    const box = {left: 52, top: 26, right: width - 12, bottom: height - 44};
    const logX = Boolean(chart.x?.log), logY = Boolean(chart.y?.log);
    const usable = ([px, py]) =>
        Number.isFinite(px) && Number.isFinite(py) && (!logX || px > 0) && (!logY || py > 0);
    const points = series.flatMap(one => one.points.filter(usable));
    const x = scale(
        points.map(p => p[0]), [box.left, box.right], logX,
        {tight: true, degrees: chart.x?.unit === "degrees"});
    const y = scale(points.map(p => p[1]), [box.bottom, box.top], logY, {wanted: 5, fromZero: true});
    const drawing =
        svg("svg", {
            viewBox: `0 0 ${width} ${height}`,
            role: "img",
            "aria-label": `${chart.title}: ${series.map(one => one.name).join(", ")}`
        },
            axes(x, y, box, axisTitle(chart.x), axisTitle(chart.y)));
    const all =
        series.map((one, index) => ({index, one: {...one, points: one.points.filter(usable)}}))
            .map(entry => ({...entry, places: entry.one.points.map(([px, py]) => [x.at(px), y.at(py)])}));
    // The reference lies over the others.
    [...all]
        .sort((a, b) => Boolean(a.one.reference) - Boolean(b.one.reference))
        .forEach(({one, places, index}) => drawing.append(seriesLine(one, places, index)));
    readOut(
        chart, drawing, all, mark,
        ([
            px, py
        ]) => [[axisTitle(chart.x) || "x", significant(px)], [axisTitle(chart.y) || "y", significant(py)]]);
    node.replaceChildren(drawing);
}

// Angles from the normal, which points up; negative ones are on the left.
function drawPolar(chart, series, node, width, mark) {
    const points = series.flatMap(one => one.points);
    const full = points.some(([angle]) => Math.abs(angle) > 90.01);
    const radius = Math.min(width / 2 - 34, full ? 190 : 280);
    const centre = [width / 2, radius + 34], height = full ? 2 * radius + 68 : radius + 64;
    const r = scale([0, ...points.map(p => p[1])], [0, radius], false, {wanted: 4});
    const polar = (angle, length) =>
        [centre[0] + Math.sin(angle * Math.PI / 180) * length,
         centre[1] - Math.cos(angle * Math.PI / 180) * length];
    const drawing = svg("svg", {
        viewBox: `0 0 ${width} ${height}`,
        role: "img",
        "aria-label": `${chart.title}: ${series.map(one => one.name).join(", ")}`
    });
    const grid = svg("g", {class: "axes"});
    const end = full ? 180 : 90;
    for (const tick of r.ticks) {
        const length = r.at(tick.value);
        if (length <= 0) continue;
        const [ax, ay] = polar(-90, length), [bx, by] = polar(90, length);
        grid.append(
            svg("path", {
                class: "grid major",
                d: `M${ax} ${ay}A${length} ${length} 0 0 1 ${bx} ${by}${
                    full ? `A${length} ${length} 0 0 1 ${ax} ${ay}` : ""}`
            }),
            svg("text", {x: bx, y: by + 15, "text-anchor": "middle"}, tick.text));
    }
    for (let angle = -end; angle <= end; angle += 30) {
        if (full && angle === -180) continue;
        const [px, py] = polar(angle, radius), [tx, ty] = polar(angle, radius + 14);
        grid.append(
            svg("line",
                {class: angle === 0 ? "grid normal" : "grid", x1: centre[0], y1: centre[1], x2: px, y2: py}),
            Math.abs(angle) !== 90 &&
                    svg("text", {x: tx, y: ty + 4, "text-anchor": "middle"},
                        `${number(Math.abs(angle), 0)}°`) ||
                "");
    }
    grid.append(
        svg("text",
            {class: "title", x: width / 2, y: centre[1] + (full ? radius + 30 : 27), "text-anchor": "middle"},
            axisTitle(chart.y)));
    drawing.append(grid);
    const clear = ([px, py]) =>
        Math.hypot(px - centre[0], py - centre[1]) > .2 * radius;  // markers would hide the middle
    const all =
        series.map((one, index) => ({
                       index,
                       one,
                       places: one.points.map(([angle, value]) => polar(angle, r.at(Math.max(0, value))))
                   }));
    [...all]
        .sort((a, b) => Boolean(a.one.reference) - Boolean(b.one.reference))
        .forEach(({one, places, index}) => drawing.append(seriesLine(one, places, index, clear)));
    readOut(
        chart, drawing, all, mark, ([angle, value]) => [[axisTitle(chart.x) || "angle", significant(angle)], [
                                       axisTitle(chart.y) || "value", significant(value)
                                   ]]);
    node.replaceChildren(drawing);
}
