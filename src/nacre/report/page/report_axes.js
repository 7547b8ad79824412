// Scales, axes, markers and series colours of all diagrams (SVG).

// Colours are custom properties of the style sheet, so that they follow the theme; seven colours and ten
// markers have no common divisor, so that seventy names differ, and neighbours differ in both.
const colours = 7;
const markers = [
    s => `M${- s} 0A${s} ${s} 0 1 1 ${s} 0A${s} ${s} 0 1 1 ${- s} 0Z`,  // circle
    s => `M${- s * .9} ${- s * .9}H${s * .9}V${s * .9}H${- s * .9}Z`,   // square
    s => `M0 ${- s * 1.2}L${s * 1.1} ${s * .8}H${- s * 1.1}Z`,          // triangle
    s => `M0 ${- s * 1.3}L${s * 1.2} 0L0 ${s * 1.3}L${- s * 1.2} 0Z`,   // diamond
    s => `M0 ${s * 1.2}L${s * 1.1} ${- s * .8}H${- s * 1.1}Z`,          // triangle, downwards
    s => polygon(5, s * 1.2, 0),                                        // pentagon
    s => `M${- s * .4} ${- s * 1.2}H${s * .4}V${- s * .4}H${s * 1.2}V${s * .4}H${s * .4}V${s * 1.2}H${
        - s * .4}V${s * .4}H${- s * 1.2}V${- s * .4}H${- s * .4}Z`,  // plus
    s => star(s * 1.45),                                             // star
    s => `M${- s * 1.2} 0L${s * .8} ${- s * 1.1}V${s * 1.1}Z`,       // triangle, leftwards
    s => `M${s * 1.2} 0L${- s * .8} ${- s * 1.1}V${s * 1.1}Z`,       // triangle, rightwards
];

function polygon(corners, size, turn) {
    const at = i =>
        [Math.sin(turn + i * 2 * Math.PI / corners) * size,
         -Math.cos(turn + i * 2 * Math.PI / corners) * size];
    return `M${Array.from({length: corners}, (_, i) => at(i).map(v => v.toFixed(2)).join(" ")).join("L")}Z`;
}

function star(size) {
    const at = i => {
        const radius = i % 2 ? size * .45 : size, angle = i * Math.PI / 5;
        return `${(Math.sin(angle) * radius).toFixed(2)} ${(-Math.cos(angle) * radius).toFixed(2)}`;
    };
    return `M${Array.from({length: 10}, (_, i) => at(i)).join("L")}Z`;
}

const styleOf = new Map();  // name of a technique -> place in the list: it looks the same everywhere
for (const {name} of rows)
    if (!styleOf.has(name)) styleOf.set(name, styleOf.size);

// How a name is drawn; `index` is for names that are no technique's.
function style(name, index = 0) {
    index = styleOf.get(name) ?? index;
    return {
        colour: `var(--series-${index % colours})`,
        marker: size => markers[index % markers.length](size),
        dash: ["", "7 3", "2 3", "9 3 2 3"][Math.floor(index / colours) % 4],
    };
}

function markerIcon(name, hollow = false) {
    const {colour, marker} = style(name);
    return svg(
        "svg", {class: "icon", viewBox: "-8 -8 16 16", width: 14, height: 14, "aria-hidden": "true"},
        svg("path", {d: marker(5), fill: hollow ? "none" : colour, stroke: colour, "stroke-width": 1.5}));
}

// A scale maps values to pixels: {at, ticks: [{value, text, major}], log, low, high}.
// Options: ticks wanted; fromZero: start at 0 if that is near; tight: end where the values end; degrees.
function scale(values, pixels, log, {wanted = 6, fromZero = false, tight = false, degrees = false} = {}) {
    const finite = values.filter(v => Number.isFinite(v) && (!log || v > 0));
    let low = Math.min(...finite), high = Math.max(...finite);
    if (!finite.length) [low, high] = log ? [1, 10] : [0, 1];
    const [from, to] = pixels;
    if (log) {
        let a = Math.log10(low), b = Math.log10(high);
        const room = Math.max((b - a) * .06, .08);
        a -= room;
        b += room;
        return {
            log,
            low: 10 ** a,
            high: 10 ** b,
            ticks: logTicks(a, b),
            at: v => from + (Math.log10(v) - a) / (b - a) * (to - from)
        };
    }
    if (fromZero && low > 0 && low < .5 * high) low = 0;
    if (low === high) [low, high] = [low - (Math.abs(low) || 1) * .5, high + (Math.abs(high) || 1) * .5];
    const step = niceStep((high - low) / wanted, degrees);
    if (!tight) [low, high] = [Math.floor(low / step + 1e-9) * step, Math.ceil(high / step - 1e-9) * step];
    const digits = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
    const ticks = [];
    for (let i = Math.ceil(low / step - 1e-6); i * step <= high + step * 1e-6; ++i) {
        const value = i * step;
        ticks.push({value, major: true, text: number(Math.abs(value) < step * 1e-6 ? 0 : value, digits)});
    }
    return {log, low, high, ticks, at: v => from + (v - low) / (high - low) * (to - from)};
}

function niceStep(rough, degrees) {
    if (degrees && rough > 4) return [5, 10, 15, 30, 45, 90, 180].find(step => step >= rough * .8) ?? 360;
    const size = 10 ** Math.floor(Math.log10(rough));
    return [1, 2, 5, 10].find(m => m * size >= rough * .999) * size;
}

function logTicks(a, b) {
    const ticks = [];
    const decades = b - a;
    const every = Math.ceil(decades / 7);  // decades between labels
    for (let k = Math.floor(a); k <= Math.ceil(b); ++k) {
        for (const m of [1, 2, 3, 4, 5, 6, 7, 8, 9]) {
            const value = m * 10 ** k;
            if (Math.log10(value) < a || Math.log10(value) > b) continue;
            if (m > 1 && every > 1) continue;
            const major = m === 1;
            const shown = decades < .7 ||
                (decades < 1.3     ? [1, 2, 3, 5, 7].includes(m) :
                     decades < 2.6 ? [1, 2, 5].includes(m) :
                                     major && k % every === 0);
            ticks.push({value, major, text: shown ? decade(value) : ""});
        }
    }
    return ticks;
}

function decade(value) {
    if (value >= .00099 && value < 99999)
        return String(Number(value.toPrecision(1))).replace(/\B(?=(\d{3})+$)/g, "\u202f");
    const power = Math.round(Math.log10(value));
    const raised = [...String(power)].map(c => c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(c)]).join("");
    return `10${raised}`;
}

// Grid, ticks and titles of a diagram of two axes. `box` is {left, top, right, bottom} in pixels.
function axes(x, y, box, titleX, titleY) {
    const group = svg("g", {class: "axes"});
    for (const tick of x.ticks) {
        const at = x.at(tick.value);
        group.append(
            svg("line",
                {class: tick.major ? "grid major" : "grid", x1: at, x2: at, y1: box.top, y2: box.bottom}));
        if (tick.text)
            group.append(svg("text", {x: at, y: box.bottom + 16, "text-anchor": "middle"}, tick.text));
    }
    for (const tick of y.ticks) {
        const at = y.at(tick.value);
        group.append(
            svg("line",
                {class: tick.major ? "grid major" : "grid", x1: box.left, x2: box.right, y1: at, y2: at}));
        if (tick.text)
            group.append(svg("text", {x: box.left - 7, y: at + 4, "text-anchor": "end"}, tick.text));
    }
    group.append(
        svg("path", {class: "frame", d: `M${box.left} ${box.top}V${box.bottom}H${box.right}`}),
        svg("text", {class: "title", x: box.right, y: box.bottom + 35, "text-anchor": "end"}, titleX),
        svg("text", {class: "title", x: 2, y: 12}, titleY));
    return group;
}

// Calls draw(width) now and whenever the node's width changes.
function whenResized(node, draw) {
    let width = 0;
    new ResizeObserver(() => {
        const now = Math.round(node.clientWidth);
        if (now > 0 && now !== width) draw(width = now);
    }).observe(node);
}
