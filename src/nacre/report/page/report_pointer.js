// The viewer's pointer and keys: moving the split, panning, reading a pixel.

function moveSplit(to) {
    viewer.split = Math.max(0, Math.min(1, to));
    requestDraw();
}

function watchPointer() {
    const {holder, handle, stage, canvas} = viewer;
    let drag = null;
    holder.addEventListener("pointerdown", event => {
        if (event.button !== 0) return;
        readPixel(event);
        const onHandle = handle.contains(event.target), overflow = stage.dataset.overflow === "true";
        if (overflow && !onHandle) {
            if (event.pointerType !== "mouse") return;  // the browser pans by touch
            drag = {pan: true, x: event.clientX + stage.scrollLeft, y: event.clientY + stage.scrollTop};
        } else if (canvas.dataset.mode === "split") {
            drag = {pan: false};
            if (!onHandle) moveSplit(place(event));
        } else {
            return;
        }
        holder.setPointerCapture(event.pointerId);
        holder.classList.add("dragged");
        if (onHandle) handle.focus({preventScroll: true});
        event.preventDefault();
    });
    holder.addEventListener("pointermove", event => {
        readPixel(event);
        if (drag?.pan)
            stage.scrollTo(drag.x - event.clientX, drag.y - event.clientY);
        else if (drag)
            moveSplit(place(event));
    });
    const end = () => {
        drag = null;
        holder.classList.remove("dragged");
    };
    holder.addEventListener("pointerup", end);
    holder.addEventListener("pointercancel", end);
    holder.addEventListener("lostpointercapture", end);
    handle.addEventListener("keydown", event => {
        const step = event.shiftKey ? .1 : .01;
        const to = {
            ArrowLeft: viewer.split - step,
            ArrowDown: viewer.split - step,
            ArrowRight: viewer.split + step,
            ArrowUp: viewer.split + step,
            PageDown: viewer.split - .1,
            PageUp: viewer.split + .1,
            Home: 0,
            End: 1
        }[event.key];
        if (to === undefined) return;
        event.preventDefault();
        moveSplit(to);
    });
}

function place(event) {
    const box = viewer.canvas.getBoundingClientRect();
    return (event.clientX - box.left) / box.width;
}

function readPixel(event) {
    const {canvas, pictures} = viewer;
    if (!pictures) return;
    const box = canvas.getBoundingClientRect();
    const x = Math.floor((event.clientX - box.left) / box.width * canvas.width);
    const y = Math.floor((event.clientY - box.top) / box.height * canvas.height);
    if (x < 0 || y < 0 || x >= canvas.width || y >= canvas.height) return;
    viewer.at = [x, y];
    showPixel(x, y);
}

function showPixel(x, y) {
    const {a, b} = viewer.pictures;
    const inside = picture => x < picture.width && y < picture.height;
    const lines = [];
    const values = picture => rgbAt(picture, x, y);
    const line = (name, source, picture) =>
        el("tr", {}, el("th", {scope: "row"}, name),
           inside(picture) ? values(picture).map(v => el("td", {}, significant(v))) :
                             el("td", {colspan: 3}, "outside"));
    lines.push(line("A", state.a, a), line("B", state.b, b));
    if (inside(a) && inside(b)) {
        const mean = v => (v[0] + v[1] + v[2]) / 3;
        const percent = error => `${error > 0 ? "+" : ""}${number(error * 100, 1)} %`;
        lines.push(
            el("tr", {}, el("th", {scope: "row"}, "error"),
               values(a).map((v, i) => el("td", {}, percent(relative(v, values(b)[i]))))),
            el("tr", {}, el("th", {scope: "row"}, "mean"),
               el("td", {colspan: 3}, percent(relative(mean(values(a)), mean(values(b)))))));
    }
    viewer.readout.replaceChildren(
        el("table", {}, el("caption", {}, `Pixel ${x}, ${y}`),
           el("thead", {}, el("tr", {}, el("td"), ["R", "G", "B"].map(c => el("th", {scope: "col"}, c)))),
           el("tbody", {}, lines)));
}
