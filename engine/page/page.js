// The page: what the reader does changes the state, and each change draws one frame.
"use strict";

const element = id => document.getElementById(id);
const kBallSide = 160;     // pixels of the light ball's picture
const kBallScreenSide = 264; // and of the canvas that it is drawn on, with marks
const kPatience = 300; // milliseconds until a picture is shown that has no shadows yet
const kLightRadius = 0.5; // of the ball that a drag on the picture turns, in the stage's shorter side

class Page {
    constructor(scene, gl) {
        this.scene = scene;
        this.canvas = gl.canvas;
        this.painter = new Painter(gl, scene);
        this.sphere = sphereShape(kBallSide);
        this.state = stateOf(location.hash, scene);
        this.frame = { x: 0, y: 0, scale: 1 };
        this.isWaiting = false;
        this.ball = element("ball").getContext("2d");
        this.buildControls();
        this.watch();
        this.changed();
    }

    get shape() {
        return this.scene.shapes[this.state.shape];
    }

    get light() {
        return this.state.lights[this.state.chosen];
    }

    // ---- drawing

    // Changes of the state are drawn together, at the screen's next frame.
    changed() {
        if (!this.isWaiting) {
            this.isWaiting = true;
            requestAnimationFrame(() => {
                this.isWaiting = false;
                this.draw();
                this.showState();
            });
        }
    }

    view(changes) {
        const { state } = this;
        return {
            shape: this.shape, material: state.material, lights: state.lights, show: kShow[state.show],
            layer: state.layer, gain: 2 ** (stopsOf(state, this.scene) + state.stops), ...changes,
        };
    }

    draw() {
        if (this.painter.gl.isContextLost()) {
            return;
        }
        this.placeFrame();
        const picture = this.painter.picture("picture", this.shape);
        this.painter.paint(picture, this.view({}));
        this.painter.paintScreen(picture, this.drawCompared(), this.frame, this.state.line * this.canvas.width);
        this.drawBall();
    }

    // What stands right of the line.
    drawCompared() {
        const { compare, photograph } = this.state;
        if (!compare) {
            return null;
        }
        const picture = this.painter.picture("compared", this.shape);
        if (compare === "photograph") {
            const shown = this.scene.photographs[photograph];
            this.painter.paintPhotograph(picture, shown, this.view({}).gain * 2 ** -shown.stops);
        } else if (compare === "normals") {
            this.painter.paint(picture, this.view({ show: kShow.normals }));
        } else if (compare === "bare") {
            this.painter.paint(picture, this.view({ layer: false }));
        } else {
            this.painter.paint(picture, this.view({ material: Number(compare.split(":")[1]) }));
        }
        return picture;
    }

    // The material on a sphere, with the lights' places on it.
    drawBall() {
        const picture = this.painter.picture("ball", this.sphere), { width } = picture;
        const material = this.state.material ?? 0;
        this.painter.paint(picture, this.view({ shape: this.sphere, material, show: kShow.picture }));
        const { ball } = this, side = ball.canvas.width;
        const drawn = new OffscreenCanvas(width, width);
        drawn.getContext("2d").putImageData(new ImageData(this.painter.codesOf(picture), width, width), 0, 0);
        ball.imageSmoothingQuality = "high";
        ball.drawImage(drawn, 0, 0, side, side);
        const mark = (direction, radius, fill, edge) => {
            const [x, y] = ballDiscFromLight(direction);
            ball.beginPath();
            ball.arc(side * (0.5 + 0.5 * x), side * (0.5 - 0.5 * y), radius * side, 0, 2 * Math.PI);
            ball.fillStyle = fill;
            ball.fill();
            ball.lineWidth = side / 132;
            ball.strokeStyle = edge;
            ball.stroke();
        };
        this.scene.lights.forEach(light => mark(light.direction, 0.008, "#fff8", "#0000"));
        this.state.lights.forEach((light, i) =>
            mark(light.direction, 0.042, colourOf(light, this.scene.white), i === this.state.chosen ? "#fff" : "#000c"));
    }

    // Where the picture lies on the canvas.
    placeFrame() {
        const { canvas, shape, state } = this, ratio = window.devicePixelRatio || 1;
        const width = Math.max(1, Math.round(canvas.clientWidth * ratio)),
            height = Math.max(1, Math.round(canvas.clientHeight * ratio));
        if (canvas.width !== width || canvas.height !== height) {
            canvas.width = width;
            canvas.height = height;
        }
        const fitted = Math.min(width / shape.width, height / shape.height);
        const scale = state.zoom || fitted, [u, v] = state.zoom ? state.middle : [0.5, 0.5];
        this.frame = {
            scale, fitted,
            x: Math.round(width / 2 - u * scale * shape.width),
            y: Math.round(height / 2 - v * scale * shape.height),
        };
    }

    // ---- what the state says, in words and controls

    buildControls() {
        const { scene } = this;
        const option = (value, text) => Object.assign(document.createElement("option"), { value, textContent: text });
        scene.shapes.forEach((shape, i) => element("shape").append(option(i, shape.name || scene.title)));
        element("layerField").hidden = !scene.shapes[0].residual;
        element("distanceField").hidden = !scene.lights.some(light => light.nearness > 0);
        const shows = [["picture", "Picture"], ["normals", "Normals"], ["coverage", "Uncertain"]];
        if (scene.ownMaterials > 1) {
            shows.push(["labels", "Materials"]);
        }
        for (const [name, text] of shows) {
            element("shows").append(this.button(text, () => {
                this.state.show = name;
            }, { name, role: "radio" }));
        }
        scene.photographs.forEach((photograph, i) => {
            const name = scene.lights[photograph.light].photograph;
            const button = this.button("", () => this.choosePhotograph(i), { title: name });
            const image = new Image();
            image.src = URL.createObjectURL(photograph.picture);
            image.alt = `Light of photograph ${name}`;
            button.append(image);
            element("thumbnails").append(button);
        });
        element("photographs").hidden = scene.photographs.length === 0;
        scene.notes.forEach(([heading, text]) => {
            element("notes").append(Object.assign(document.createElement("dt"), { textContent: heading }),
                Object.assign(document.createElement("dd"), { textContent: text }));
        });
        element("ball").width = element("ball").height = kBallScreenSide;
    }

    // `act` changes the state.
    button(text, act, { name = "", role = "", title = "" }) {
        const button = Object.assign(document.createElement("button"), { textContent: text, name, title });
        if (role) {
            button.setAttribute("role", role);
        }
        button.addEventListener("click", () => {
            act();
            this.changed();
        });
        return button;
    }

    showState() {
        const { state, scene } = this;
        element("shape").value = state.shape;
        this.fill("material", this.materialChoices(), state.material ?? "own");
        this.fill("compare", comparisonsOf(state, scene), state.compare);
        element("exposure").value = state.stops;
        element("exposure").setAttribute("aria-valuetext", `${state.stops >= 0 ? "+" : ""}${state.stops.toFixed(2)} stops`);
        element("layer").checked = state.layer;
        element("layer").disabled = !hasLayer(state, scene);
        for (const button of element("shows").children) {
            button.setAttribute("aria-checked", button.name === state.show);
        }
        [...element("thumbnails").children].forEach((button, i) =>
            button.setAttribute("aria-pressed", i === state.photograph));
        this.showLights();
        this.showLine();
        element("status").textContent = wordsOf(state, scene);
        element("picture").setAttribute("aria-label", `${this.shape.name || scene.title}, ${state.show}`);
        clearTimeout(this.addressTimer);
        this.addressTimer = setTimeout(() => history.replaceState(null, "", hashOf(this.state, scene)), 500);
    }

    // A list of choices, made anew where they have changed.
    fill(id, choices, value) {
        const list = element(id), key = JSON.stringify(choices);
        if (list.dataset.key !== key) {
            list.dataset.key = key;
            list.replaceChildren(...choices.map(({ name, text }) =>
                Object.assign(document.createElement("option"), { value: name, textContent: text })));
        }
        list.value = value;
    }

    materialChoices() {
        const choices = this.scene.materials.map((material, i) => ({ name: String(i), text: material.name }));
        return hasOwnMaterial(this.state, this.scene)
            ? [{ name: "own", text: "as photographed" }, ...choices] : choices;
    }

    showLights() {
        const { state } = this, buttons = element("lights");
        buttons.replaceChildren(...state.lights.map((light, i) => {
            const button = this.button("", () => {
                state.chosen = i;
            }, { role: "radio", title: `Light ${i + 1}` });
            const colour = document.createElement("i");
            colour.style.background = colourOf(light, this.scene.white);
            button.append(colour);
            button.setAttribute("aria-label", `Light ${i + 1}`);
            button.setAttribute("aria-checked", i === state.chosen);
            return button;
        }));
        const more = this.button("+", () => this.addLight(), { title: "Add a light" });
        const fewer = this.button("−", () => this.removeLight(), { title: "Remove the chosen light" });
        more.setAttribute("aria-label", more.title);
        fewer.setAttribute("aria-label", fewer.title);
        more.disabled = state.lights.length >= kMostLights;
        fewer.disabled = state.lights.length < 2;
        buttons.append(more, fewer);
        element("colour").value = colourOf(this.light, this.scene.white);
        element("strength").value = Math.log2(Math.max(strengthOf(this.light, this.scene.white), 1e-6));
        element("nearness").value = this.light.nearness;
    }

    showLine() {
        const { state } = this, isCompared = Boolean(state.compare), line = element("line");
        line.hidden = element("left").hidden = element("right").hidden = !isCompared;
        line.style.left = `${100 * state.line}%`;
        line.setAttribute("aria-valuenow", Math.round(100 * state.line));
        if (isCompared) {
            element("left").textContent = "rendered";
            element("right").textContent = element("compare").selectedOptions[0]?.textContent ?? "";
        }
    }

    // To a state as an address has it; what is on the canvas shows it at once.
    go(hash) {
        this.state = stateOf(hash, this.scene);
        this.draw();
        this.showState();
    }

    // ---- lights

    setLight(changes) {
        Object.assign(this.light, changes);
        this.leavePhotograph();
        this.changed();
    }

    setColour(hex, strength) {
        this.setLight({ irradiance: irradianceOf(hex, strength, this.scene.white) });
    }

    addLight() {
        const { lights } = this.state;
        if (lights.length < kMostLights) {
            const [x, y, z] = this.light.direction;
            lights.push({ direction: unit([-x, y, z]), irradiance: scaled(this.scene.white, 0.5), nearness: 0 });
            this.state.chosen = lights.length - 1;
            this.leavePhotograph();
        }
    }

    removeLight() {
        const { state } = this;
        if (state.lights.length > 1) {
            state.lights.splice(state.chosen, 1);
            state.chosen = Math.min(state.chosen, state.lights.length - 1);
            this.leavePhotograph();
        }
    }

    choosePhotograph(i) {
        Object.assign(this.state, {
            shape: 0, material: null, lights: [lightOfPhotograph(i, this.scene)], chosen: 0, photograph: i,
            show: "picture", compare: "photograph",
        });
    }

    // The light is not the photograph's any more.
    leavePhotograph() {
        this.state.photograph = null;
        this.settle();
    }

    // A choice can take another's ground away.
    settle() {
        const { state, scene } = this;
        if (state.shape !== 0 && state.material === null) {
            state.material = 0;
        }
        if (!comparisonsOf(state, scene).some(({ name }) => name === state.compare)) {
            state.compare = "";
        }
    }

    choose(changes) {
        Object.assign(this.state, changes);
        this.settle();
        this.changed();
    }

    // ---- input

    watch() {
        const on = (id, kind, act) => element(id).addEventListener(kind, act);
        on("shape", "change", event => this.choose({ shape: Number(event.target.value), zoom: 0,
            material: event.target.value === "0" && this.scene.ownMaterials > 0 ? null : this.state.material ?? 0 }));
        on("material", "change", event =>
            this.choose({ material: event.target.value === "own" ? null : Number(event.target.value) }));
        on("compare", "change", event => this.choose({ compare: event.target.value }));
        on("exposure", "input", event => this.choose({ stops: Number(event.target.value) }));
        on("layer", "change", event => this.choose({ layer: event.target.checked }));
        on("colour", "input", event => this.setColour(event.target.value, strengthOf(this.light, this.scene.white)));
        on("strength", "input", event => this.setColour(element("colour").value, 2 ** Number(event.target.value)));
        on("nearness", "input", event => this.setLight({ nearness: Number(event.target.value) }));
        on("about", "click", () => element("help").showModal());
        on("fit", "click", () => this.choose({ zoom: 0 }));
        on("reset", "click", () => this.choose(openedState(this.scene)));
        on("save", "click", () => this.save());
        on("picture", "dblclick", () => this.choose({ zoom: 0 }));
        this.watchPointers();
        document.addEventListener("keydown", event => this.key(event));
        new ResizeObserver(() => this.changed()).observe(this.canvas);
        addEventListener("hashchange", () => this.go(location.hash));
        this.canvas.addEventListener("webglcontextlost", event => event.preventDefault());
        this.canvas.addEventListener("webglcontextrestored", () => {
            this.painter.restore();
            this.changed();
        });
    }

    watchPointers() {
        const ball = element("ball"), line = element("line");
        const point = event => {
            const { left, top, width } = ball.getBoundingClientRect();
            const disc = [2 * (event.clientX - left) / width - 1, 1 - 2 * (event.clientY - top) / width];
            this.setLight({ direction: lightFromBallDisc(disc) });
        };
        watchDrags(ball, point, point);
        watchDrags(line, () => {}, event => {
            const { left, width } = this.canvas.getBoundingClientRect();
            this.choose({ line: Math.min(Math.max((event.clientX - left) / width, 0), 1) });
        });
        watchPicture(this.canvas, {
            drag: (right, below) => this.drag(right, below),
            pan: (right, below) => this.pan(right, below),
            zoom: (factor, x, y) => this.zoom(factor, x, y),
        });
    }

    drag(right, below) {
        const { clientWidth, clientHeight } = this.canvas;
        const radius = kLightRadius * Math.min(clientWidth, clientHeight);
        this.setLight({ direction: draggedLight(this.light.direction, [right / radius, -below / radius]) });
    }

    // In CSS pixels.
    pan(right, below) {
        const { frame, shape, state } = this, ratio = window.devicePixelRatio || 1;
        const [u, v] = state.zoom ? state.middle : [0.5, 0.5], within = value => Math.min(Math.max(value, 0), 1);
        this.choose({
            zoom: frame.scale,
            middle: [within(u - right * ratio / frame.scale / shape.width),
                within(v - below * ratio / frame.scale / shape.height)],
        });
        this.placeFrame();
    }

    // About a point of the window; what lies there stays there.
    zoom(factor, clientX, clientY) {
        const { canvas, shape, state } = this, ratio = window.devicePixelRatio || 1;
        const { left, top } = canvas.getBoundingClientRect(), { scale, fitted } = this.frame;
        const next = Math.min(Math.max(scale * factor, 0.5 * fitted), 32 * ratio);
        const [u, v] = state.zoom ? state.middle : [0.5, 0.5];
        const x = (clientX - left) * ratio - canvas.width / 2, y = (clientY - top) * ratio - canvas.height / 2;
        const moved = 1 / scale - 1 / next, within = value => Math.min(Math.max(value, 0), 1);
        this.choose({ zoom: next, middle: [within(u + x * moved / shape.width), within(v + y * moved / shape.height)] });
        this.placeFrame();
    }

    zoomAboutMiddle(factor) {
        const { left, top, width, height } = this.canvas.getBoundingClientRect();
        this.zoom(factor, left + width / 2, top + height / 2);
    }

    key(event) {
        const target = event.target;
        if (event.ctrlKey || event.metaKey || event.altKey || element("help").open || target.matches("select, input")) {
            return;
        }
        const act = this.actionOf(event.key, event.shiftKey, target);
        if (act) {
            event.preventDefault();
            act();
            this.changed();
        }
    }

    actionOf(key, shift, target) {
        const { state } = this, step = 0.05;
        const turn = (right, up) => () => this.setLight({ direction: draggedLight(this.light.direction, [right, up]) });
        if (target === element("line") && (key === "ArrowLeft" || key === "ArrowRight")) {
            const line = state.line + (key === "ArrowLeft" ? -0.02 : 0.02);
            return () => this.choose({ line: Math.min(Math.max(line, 0), 1) });
        }
        const show = name => () => this.choose({ show: state.show === name ? "picture" : name });
        const actions = {
            ArrowLeft: turn(-step, 0), ArrowRight: turn(step, 0), ArrowUp: turn(0, step), ArrowDown: turn(0, -step),
            "+": () => this.zoomAboutMiddle(1.25), "=": () => this.zoomAboutMiddle(1.25),
            "-": () => this.zoomAboutMiddle(0.8), 0: () => this.choose({ zoom: 0 }), f: () => this.choose({ zoom: 0 }),
            e: () => this.choose({ stops: state.stops + (shift ? -0.25 : 0.25) }),
            n: show("normals"), c: show("coverage"), p: () => this.choose({ show: "picture" }),
            d: () => this.choose({ layer: !state.layer }),
            l: () => (shift ? this.removeLight() : this.addLight()),
            r: () => this.choose(openedState(this.scene)), s: () => this.save(),
            "?": () => element("help").showModal(), h: () => element("help").showModal(),
        };
        return actions[key.length === 1 ? key.toLowerCase() : key];
    }

    // The picture at its own size, as codes, row 0 on top.
    codes() {
        this.draw();
        const picture = this.painter.picture("picture", this.shape);
        return new ImageData(this.painter.codesOf(picture), picture.width, picture.height);
    }

    async save() {
        const codes = this.codes(), drawn = new OffscreenCanvas(codes.width, codes.height);
        drawn.getContext("2d").putImageData(codes, 0, 0);
        const link = document.createElement("a");
        link.href = URL.createObjectURL(await drawn.convertToBlob());
        link.download = `${this.scene.title}.png`;
        link.click();
    }
}

async function open() {
    const notice = element("notice");
    const gl = element("picture").getContext("webgl2", { alpha: false, antialias: false });
    if (!gl || typeof DecompressionStream === "undefined") {
        notice.textContent = "This page draws with WebGL 2, which this browser does not offer or has switched off. " +
            "Present versions of Firefox, Chrome, Edge and Safari have it.";
        return null;
    }
    const scene = await decodedScene(), baked = bakeShapes(scene.shapes);
    await Promise.race([baked, new Promise(done => setTimeout(done, kPatience))]);
    element("panel").hidden = false;
    const page = new Page(scene, gl);
    notice.remove();
    await baked;
    page.changed();
    return page;
}

// For whoever scripts the page: a promise of the Page.
window.nacrePage = open().catch(error => {
    element("notice").textContent = `This page cannot be shown: ${error.message}`;
    throw error;
});
