// Picture A against picture B: split, one or the other, signed error, FLIP.

const viewer = {
    mode: "split",
    split: .5,
    zoom: "fit",
    range: 25,
    block: 1,
    pictures: null,  // {a, b, counts}: what is on the canvas
    images: null,    // {a, b} at the exposure
    version: 0,
};

function viewerSection() {
    const all = sources();
    if (!all.length) return null;
    if (!canUnpack) {
        return section(
            "pictures", "Pictures",
            el("p", {class: "warnings"},
               "This browser cannot unpack the pictures (it has no DecompressionStream). Chrome 80, Firefox 113 and Safari 16.4 " +
                   "can. The numbers and diagrams on this page are complete."));
    }
    const rowed = all.filter(source => source.row);
    state.b = all[0];
    state.a = (all[0].row ? rowed[1] : rowed[0]) ?? all[0];

    const v = viewer;
    v.canvas = el("canvas", {id: "picture", role: "img"});
    v.handle =
        el("div", {
            id: "split",
            role: "slider",
            tabindex: 0,
            "aria-label": "Split between A (left) and B (right), percent",
            "aria-valuemin": 0,
            "aria-valuemax": 100
        },
           el("span", {"aria-hidden": "true"}, "‹›"));
    v.nameA = el("span", {class: "badge a"});
    v.nameB = el("span", {class: "badge b"});
    v.holder = el("div", {class: "holder"}, v.canvas, v.handle);
    v.stage = el("div", {id: "stage"}, v.holder);
    v.frame = el("div", {class: "frame"}, v.stage, v.nameA, v.nameB);
    v.legend = el("div", {id: "scale", hidden: true});
    v.readout = el("div", {id: "readout", class: "readout"});
    v.message = el("p", {class: "message", hidden: true});
    const options = all.map(source => [source.id, source.title]);
    v.menuA = menu("picture-a", "A", options, state.a.id, select);
    v.menuB = menu("picture-b", "B", options, state.b.id, id => setB(all.find(source => source.id === id)));
    const swap =
        el("button", {
            type: "button",
            class: "quiet",
            "aria-label": "Swap A and B",
            title: "Swap A and B",
            onclick: () => {
                const a = state.a;
                state.a = state.b;
                setB(a);
            }
        },
           "⇄");
    v.modes = choice(
        "mode", "What to show",
        [["split", "Split"], ["a", "A"], ["b", "B"], ["error", "Error"], ["flip", "FLIP"]], v.mode, setMode);
    const zooms =
        choice("zoom", "Zoom", [["fit", "Fit"], ["1", "1×"], ["2", "2×"], ["4", "4×"]], v.zoom, value => {
            v.zoom = value;
            zoomStage();
        });
    v.errorControls =
        el("div", {class: "controls", hidden: true},
           menu(
               "error-range", "Scale", [10, 25, 50, 100].map(n => [n, `±${n} %`]), v.range,
               value => {
                   v.range = Number(value);
                   drawView();
               }),
           menu(
               "error-block", "Averaged over", [[1, "1 pixel"], [8, "8 × 8 pixels"], [16, "16 × 16 pixels"]],
               v.block, value => {
                   v.block = Number(value);
                   drawView();
               }));
    const flip =
        el("button", {type: "button", id: "flip", "aria-keyshortcuts": "F", onclick: flipView}, "Flip A/B ",
           el("kbd", {}, "F"));

    watchPointer();
    addEventListener("keydown", event => {
        const space = event.key === " ",
              busy = event.target.closest?.("input, select, textarea, button, summary, a, [tabindex]");
        if (event.ctrlKey || event.metaKey || event.altKey) return;
        if ((event.key.toLowerCase() === "f" && !event.target.closest?.("textarea, select")) ||
            (space && viewInSight() && (!busy || busy === v.handle))) {
            event.preventDefault();
            flipView();
        }
    });
    state.on("select", showSources);
    state.on("exposure", () => {
        v.images = null;
        requestDraw();
    });
    whenResized(v.stage, layoutStage);
    addEventListener("resize", layoutStage);
    showSources();
    return section(
        "pictures", "Pictures",
        el("div", {id: "viewer"}, el("div", {class: "pick"}, v.menuA, swap, v.menuB),
           el("div", {class: "show"}, v.message, v.frame, v.legend),
           el("div", {class: "side"}, el("div", {class: "controls"}, v.modes, flip), v.errorControls,
              el("div", {class: "controls"}, el("span", {class: "name"}, "Zoom"), zooms),
              exposureControl("exposure"),
              el("p", {class: "hint"},
                 "Drag the line, or move it with the arrow keys. F or space flips between A and B. " +
                     "When zoomed, drag the picture to pan."),
              v.readout)));
}

function viewInSight() {
    const box = viewer.stage.getBoundingClientRect();
    return box.bottom > 0 && box.top < innerHeight;
}

function setB(source) {
    state.b = source;
    state.announce("select");
}

function setMode(mode) {
    viewer.mode = mode;
    for (const input of viewer.modes.querySelectorAll("input")) input.checked = input.value === mode;
    drawView();
}

function flipView() {
    setMode(viewer.mode === "a" ? "b" : "a");
    say(`Showing ${viewer.mode === "a" ? state.a.title : state.b.title}`);
}

async function showSources() {
    const v = viewer, version = ++v.version;
    v.menuA.querySelector("select").value = state.a.id;
    v.menuB.querySelector("select").value = state.b.id;
    const flip = v.modes.querySelector("[value=flip]");
    flip.disabled = report.maps?.[state.a.flip] === undefined;
    if (flip.disabled && v.mode === "flip") setMode("split");
    try {
        const [a, b, counts] =
            await Promise.all([picture(state.a.picture), picture(state.b.picture), mask()]);
        if (version !== v.version) return;  // the reader chose another meanwhile
        const same = a.width === b.width && a.height === b.height;
        v.message.hidden = same;
        v.message.textContent =
            same ? "" : "A and B differ in size: only one of them can be shown at a time.";
        v.pictures =
            {a, b, same, counts: counts?.width === a.width && counts?.height === a.height ? counts : null};
        v.images = null;
        layoutStage();
        drawView();
    } catch (error) {
        v.message.hidden = false;
        v.message.textContent = `A picture is damaged: ${error.message}.`;
    }
}

let viewFrame = 0;
function requestDraw() {
    cancelAnimationFrame(viewFrame);
    viewFrame = requestAnimationFrame(drawView);
}

async function drawView() {
    const v = viewer;
    if (!v.pictures) return;
    const {a, b, same} = v.pictures;
    const mode = !same && (v.mode === "split" || v.mode === "error") ? "a" : v.mode;
    const shown = mode === "b" ? b : a;
    if (v.canvas.width !== shown.width || v.canvas.height !== shown.height) {
        v.canvas.width = shown.width;
        v.canvas.height = shown.height;
        layoutStage();
    }
    const context = v.canvas.getContext("2d");
    if (mode === "error") {
        v.map = errorMap(a, b, v.pictures.counts, v.block);
        context.putImageData(
            paintValues(v.map, a.width, a.height, diverging, value => .5 + value * 50 / v.range), 0, 0);
    } else if (mode === "flip") {
        const version = v.version, map = await flipMap(state.a.flip);
        if (version !== v.version || v.mode !== "flip") return;
        context.putImageData(
            paintValues(map.planes[0], map.width, map.height, rising, value => value / 255), 0, 0);
    } else {
        v.images ??= {a: develop(a, state.exposure, whole(a)), b: develop(b, state.exposure, whole(b))};
        const edge = mode === "a" ? a.width : mode === "b" ? 0 : Math.round(v.split * a.width);
        context.putImageData(mode === "a" ? v.images.a : v.images.b, 0, 0);
        if (edge > 0) context.putImageData(v.images.a, 0, 0, 0, 0, edge, a.height);
    }
    v.canvas.dataset.mode = mode;
    v.frame.dataset.mode = mode;
    decorate(mode);
}

// Names, handle, legend and what a screen reader hears.
function decorate(mode) {
    const v = viewer;
    const percent = Math.round(v.split * 100);
    v.handle.hidden = mode !== "split";
    v.handle.style.left = `${v.split * 100}%`;
    v.handle.setAttribute("aria-valuenow", percent);
    v.handle.setAttribute("aria-valuetext", `${percent} % A, ${100 - percent} % B`);
    v.nameA.hidden = mode === "b";
    v.nameB.hidden = mode !== "b" && mode !== "split";
    v.nameA.textContent = mode === "error" ? `A \u2212 B: ${state.a.short} \u2212 ${state.b.short}` :
        mode === "flip" ? `FLIP of ${state.a.short} against the reference` :
                          `A  ${state.a.short}`;
    v.nameB.textContent = `B  ${state.b.short}`;
    v.errorControls.hidden = mode !== "error";
    v.legend.hidden = mode !== "error" && mode !== "flip";
    const what = {
        split: `left ${state.a.title}, right ${state.b.title}`,
        a: state.a.title,
        b: state.b.title,
        error: `relative error of ${state.a.title} against ${state.b.title}`,
        flip: `FLIP error of ${state.a.title}`
    };
    v.canvas.setAttribute("aria-label", what[mode]);
    if (mode === "error") {
        drawLegend(
            diverging,
            [-1, -.5, 0, .5,
             1].map(t => `${t > 0 ? "+" : ""}${number(t * v.range, v.range % 2 && t % 1 ? 1 : 0)} %`),
            "(A − B) / (|B| + 0.01) of the mean of R, G and B. Blue: A is darker than B; red: brighter. " +
                (v.pictures.counts ? "Pixels that do not count are left out. " : "") + summaryOfMap(v.map));
    } else if (mode === "flip") {
        drawLegend(
            rising, ["0", "0.25", "0.5", "0.75", "1"],
            "FLIP error of A against the reference, whatever B is: 0 looks the same.");
    }
    if (v.at)
        showPixel(...v.at);
    else
        v.readout.replaceChildren(
            el("p", {class: "hint"}, "Point at the picture, or tap it, to read a pixel."));
}

function summaryOfMap(map) {
    let sum = 0, squares = 0, n = 0;
    for (const error of map) {
        if (Number.isNaN(error)) continue;
        sum += error;
        squares += error * error;
        ++n;
    }
    if (!n) return "";
    const mean = 100 * sum / n;
    return `Of this map: mean ${mean > 0 ? "+" : ""}${number(mean, 1)} %, RMS ${
        number(100 * Math.sqrt(squares / n), 1)} %.`;
}

function drawLegend(table, ticks, text) {
    const bar = el("canvas", {width: 256, height: 1, "aria-hidden": "true"});
    bar.getContext("2d").putImageData(
        new ImageData(new Uint8ClampedArray(table.flatMap(c => [...c, 255])), 256, 1), 0, 0);
    viewer.legend.replaceChildren(
        bar, el("div", {class: "ticks"}, ticks.map(tick => el("span", {}, tick))),
        el("p", {class: "hint"}, text));
}

// Another zoom, about the middle of what is seen.
function zoomStage() {
    const {stage, holder} = viewer;
    const x =
        (stage.scrollLeft - holder.offsetLeft + stage.clientWidth / 2) / Math.max(1, holder.offsetWidth);
    const y = (stage.scrollTop + stage.clientHeight / 2) / Math.max(1, holder.offsetHeight);
    layoutStage();
    stage.scrollTo({
        left: x * holder.offsetWidth - stage.clientWidth / 2,
        top: y * holder.offsetHeight - stage.clientHeight / 2,
        behavior: "instant"
    });
}

// The size of the picture on the page. "Fit" is smooth, whole multiples are exact pixels.
function layoutStage() {
    const v = viewer;
    if (!v.stage.clientWidth || !v.canvas.width) return;
    const fit =
        Math.min(v.stage.clientWidth / v.canvas.width, Math.max(320, innerHeight * .72) / v.canvas.height);
    v.scaleNow = v.zoom === "fit" ? fit : Number(v.zoom);
    v.holder.style.width = `${v.canvas.width * v.scaleNow}px`;
    v.canvas.style.imageRendering = v.zoom === "fit" && fit < 3 ? "auto" : "pixelated";
    v.stage.dataset.overflow =
        v.holder.offsetWidth > v.stage.clientWidth + 1 || v.holder.offsetHeight > v.stage.clientHeight + 1;
}
