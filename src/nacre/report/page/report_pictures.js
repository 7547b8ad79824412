// Unpacks pictures and maps when they are first needed, and turns them into what a screen shows.

const canUnpack = "DecompressionStream" in window;
const unpacked = new Map();  // "picture key" or "map key" -> promise of {width, height, planes}
const ready = new Map();     // the same, once it is there

async function unpack(packed, planes) {
    const text = atob(packed.data);
    const bytes = new Uint8Array(text.length);
    for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
    const all = new Uint8Array(await new Response(stream).arrayBuffer());
    const size = packed.width * packed.height;
    if (all.length !== planes * size) throw new Error(`${all.length} bytes instead of ${planes * size}`);
    return {
        width: packed.width,
        height: packed.height,
        planes: Array.from({length: planes}, (_, i) => all.subarray(i * size, (i + 1) * size)),
    };
}

function fetchOnce(key, packed, planes) {
    if (!unpacked.has(key)) {
        unpacked.set(key, unpack(packed, planes).then(result => {
            ready.set(key, result);
            return result;
        }));
    }
    return unpacked.get(key);
}

// Planes R, G, B (mantissas) and E; a value is mantissa * 2^(E - 136).
function picture(key) { return fetchOnce(`picture ${key}`, report.pictures[key], 4); }
function flipMap(key) { return fetchOnce(`map ${key}`, report.maps[key], 1); }
function mask() { return report.mask ? fetchOnce("mask", report.mask, 1) : Promise.resolve(null); }

// 2^(E - 136) for every E; E = 0 is black.
const exponents = Float64Array.from({length: 256}, (_, e) => e ? 2 ** (e - 136) : 0);

// sRGB (IEC 61966-2-1) of a linear value in [0, 1], at 65536 places: finer than 8 bits anywhere.
const encoded = Uint8Array.from({length: 65536}, (_, i) => {
    const v = i / 65535;
    return Math.round(255 * (v <= .0031308 ? 12.92 * v : 1.055 * v ** (1 / 2.4) - .055));
});

// A window of a picture as it looks at an exposure in stops.
function develop({width, planes: [r, g, b, e]}, exposure, {x, y, width: columns, height: lines}) {
    const image = new ImageData(columns, lines), out = image.data;
    const factor = exponents.map(s => s * 2 ** exposure * 65535);
    for (let line = 0, to = 0; line < lines; ++line) {
        for (let i = (y + line) * width + x, end = i + columns; i < end; ++i, to += 4) {
            const f = factor[e[i]];
            out[to] = encoded[Math.min(65535, r[i] * f) | 0];
            out[to + 1] = encoded[Math.min(65535, g[i] * f) | 0];
            out[to + 2] = encoded[Math.min(65535, b[i] * f) | 0];
            out[to + 3] = 255;
        }
    }
    return image;
}

function whole({width, height}) { return {x: 0, y: 0, width, height}; }

// The part of a crop that lies in the picture.
function clip(crop, {width, height}) {
    const x = Math.max(0, Math.min(crop.x, width - 1)), y = Math.max(0, Math.min(crop.y, height - 1));
    return {
        x,
        y,
        width: Math.max(1, Math.min(crop.width, width - x)),
        height: Math.max(1, Math.min(crop.height, height - y))
    };
}

function rgbAt({width, planes: [r, g, b, e]}, x, y) {
    const i = y * width + x, s = exponents[e[i]];
    return [r[i] * s, g[i] * s, b[i] * s];
}

const epsilon = .01;  // so that black pixels do not decide, as in the metrics
function relative(a, b) { return (a - b) / (Math.abs(b) + epsilon); }

// (A - B) / (|B| + epsilon) of the means over R, G and B, averaged first over blocks of pixels: noise
// averages out and bias stays. Not a number where the mask says that a pixel does not count.
function errorMap(a, b, counts, block) {
    const {width, height} = a;
    const out = new Float32Array(width * height).fill(NaN);
    const mean = ({planes: [r, g, bl, e]}, i) => (r[i] + g[i] + bl[i]) * exponents[e[i]] / 3;
    const keep = counts?.planes[0];
    for (let top = 0; top < height; top += block) {
        for (let left = 0; left < width; left += block) {
            const bottom = Math.min(height, top + block), right = Math.min(width, left + block);
            let sumA = 0, sumB = 0, n = 0;
            const each = act => {
                for (let y = top; y < bottom; ++y) {
                    for (let x = left; x < right; ++x) {
                        const i = y * width + x;
                        if (!keep || keep[i]) act(i);
                    }
                }
            };
            each(i => {
                sumA += mean(a, i);
                sumB += mean(b, i);
                ++n;
            });
            if (!n) continue;
            const error = relative(sumA / n, sumB / n);
            each(i => {
                out[i] = error;
            });
        }
    }
    return out;
}

// Colours along a list of [place, r, g, b], as a table of 256.
function colours256(stops) {
    return Array.from({length: 256}, (_, i) => {
        const at = i / 255;
        const k = Math.max(1, stops.findIndex(([place]) => place >= at));
        const [p0, ...c0] = stops[k - 1], [p1, ...c1] = stops[k];
        return c0.map((c, j) => Math.round(c + (c1[j] - c) * (at - p0) / (p1 - p0)));
    });
}
// Too dark is blue, too bright is red, right is white: told apart with any colour vision.
const diverging =
    colours256([[0, 6, 32, 92], [.22, 28, 96, 190], [.5, 255, 255, 255], [.78, 206, 52, 36], [1, 92, 6, 18]]);
// Lightness rises evenly, so that it reads in grey as well.
const rising = colours256([
    [0, 3, 3, 14], [.2, 50, 18, 95], [.4, 128, 37, 128], [.6, 212, 66, 100], [.8, 252, 145, 95],
    [1, 252, 250, 198]
]);

function paintValues(values, width, height, table, place) {
    const image = new ImageData(width, height), out = image.data;
    for (let i = 0, to = 0; i < values.length; ++i, to += 4) {
        const value = values[i];
        if (Number.isNaN(value)) continue;  // stays transparent
        const colour = table[Math.max(0, Math.min(255, Math.round(255 * place(value))))];
        out[to] = colour[0];
        out[to + 1] = colour[1];
        out[to + 2] = colour[2];
        out[to + 3] = 255;
    }
    return image;
}

// Small pictures all over the page: drawn when they come into view, and again when the exposure changes.
const tiles = new Map();  // canvas -> {key, crop, seen}
const watcher = new IntersectionObserver(entries => {
    for (const entry of entries) {
        const known = tiles.get(entry.target);
        if (!known) continue;
        known.seen = entry.isIntersecting;
        if (known.seen) drawTile(entry.target);
    }
}, {rootMargin: "300px"});

function tile(key, title, crop = null) {
    const packed = report.pictures[key];
    const {width, height} = crop ? clip(crop, packed) : packed;
    const canvas = el("canvas", {width, height, role: "img", "aria-label": title, "data-key": key});
    tiles.set(canvas, {key, crop, seen: false});
    watcher.observe(canvas);
    return canvas;
}

function forget(canvas) {
    tiles.delete(canvas);
    watcher.unobserve(canvas);
}

async function drawTile(canvas) {
    if (!tiles.has(canvas)) return;
    const {key, crop} = tiles.get(canvas);
    if (canvas.dataset.drawn === String(state.exposure) && canvas.dataset.key === key) return;
    try {
        const source = ready.get(`picture ${key}`) ?? await picture(key);
        if (tiles.get(canvas)?.key !== key) return;  // another was asked for meanwhile
        paintTile(canvas, source, crop, key);
    } catch (error) {
        canvas.dataset.damaged = error.message;
        canvas.title = `This picture is damaged: ${error.message}`;
    }
}

function paintTile(canvas, source, crop, key) {
    canvas.getContext("2d").putImageData(
        develop(source, state.exposure, crop ? clip(crop, source) : whole(source)), 0, 0);
    canvas.dataset.drawn = String(state.exposure);
    canvas.dataset.key = key;
}

// Shows another picture in the same place.
function retile(canvas, key) {
    tiles.get(canvas).key = key;
    drawTile(canvas);
}

let drawing = 0;
state.on("exposure", () => {
    cancelAnimationFrame(drawing);
    drawing = requestAnimationFrame(() => {
        for (const [canvas, {seen}] of tiles)
            if (seen) drawTile(canvas);
        whenIdle();
    });
});

// What is out of sight follows while the reader does nothing, so that paper shows all of it.
let idle = false;
function whenIdle() {
    if (idle || !canUnpack) return;
    idle = true;
    const later = window.requestIdleCallback ?? (act => setTimeout(act, 30));
    const step = async () => {
        const stale = [...tiles.keys()].find(
            canvas => canvas.dataset.drawn !== String(state.exposure) && !canvas.dataset.damaged);
        if (!stale) {
            idle = false;
            document.documentElement.dataset.drawn = "all";
            return;
        }
        await drawTile(stale);
        later(step);
    };
    later(step);
}
addEventListener("beforeprint", () => {
    for (const [canvas, {key, crop}] of tiles) {
        const source = ready.get(`picture ${key}`);
        if (source) paintTile(canvas, source, crop, key);
    }
});

function setExposure(stops) {
    state.exposure = Math.max(-6, Math.min(6, Math.round(stops * 10) / 10));
    state.announce("exposure");
}

// One of several sliders that move together. The first has the id "exposure".
function exposureControl(id) {
    const range =
        el("input",
           {id, type: "range", min: -6, max: 6, step: .1, oninput: () => setExposure(Number(range.value))});
    const output = el("output", {for: id
    });
    const reset =
        el("button", {
            type: "button",
            id: `${id}-reset`,
            class: "quiet",
            onclick: () => setExposure(report.exposure?.start ?? 0)
        },
           "Reset");
    const show = () => {
        range.value = state.exposure;
        const text = `${state.exposure > 0 ? "+" : ""}${number(state.exposure, 1)} stops`;
        output.textContent = text;
        range.setAttribute("aria-valuetext", text);
        reset.disabled = state.exposure === (report.exposure?.start ?? 0);
    };
    state.on("exposure", show);
    show();
    return el("div", {class: "exposure"}, el("label", {for: id
              }, "Exposure"), range, output, reset);
}
