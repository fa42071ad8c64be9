// What the reader has chosen, and the same as text behind a # in the page's address, so that it can be sent on.
"use strict";

// The state that the page opens with. Materials are numbers of the scene's, null: the shape's own.
function openedState(scene) {
    return {
        shape: 0,
        material: scene.ownMaterials > 0 ? null : 0,
        lights: [{ direction: scene.firstLight, irradiance: scene.white, nearness: 0 }],
        chosen: 0, // of the lights
        stops: 0,  // beyond the exposure that suits shape and material
        show: "picture",
        layer: true,
        compare: "", // "", "photograph", "bare" (without residual layer), "normals" or "material:N"
        photograph: null, // of the scene's, whose light is the only one
        line: 0.5,
        zoom: 0, // screen pixels a pixel; 0: fitted into the stage
        middle: [0.5, 0.5], // of the picture, in the stage's middle
    };
}

const numberText = value => String(Number(value.toPrecision(9)));

function hashOf(state, scene) {
    const light = ({ direction, irradiance, nearness }) =>
        [...direction, ...irradiance, ...(nearness > 0 ? [1 / nearness] : [])].map(numberText).join(",");
    const words = {
        shape: state.shape,
        material: state.material ?? "own",
        ...(state.photograph === null && { light: state.lights.map(light).join(";") }),
        exposure: numberText(stopsOf(state, scene) + state.stops),
        show: state.show,
        layer: state.layer ? "on" : "off",
        ...(state.compare && { compare: state.compare, line: numberText(state.line) }),
        ...(state.photograph !== null && { photograph: state.photograph }),
        ...(state.zoom && { zoom: numberText(state.zoom), middle: state.middle.map(numberText).join(",") }),
    };
    return "#" + Object.entries(words).map(([name, value]) => `${name}=${value}`).join("&");
}

const numbersOf = text => (text ?? "").split(",").map(Number);
const areFinite = numbers => numbers.every(Number.isFinite);

// "x,y,z,r,g,b" and, of a near light, its distance in widths of the object.
function lightOf(text, scene) {
    const numbers = numbersOf(text), direction = numbers.slice(0, 3), irradiance = numbers.slice(3, 6);
    if (![3, 6, 7].includes(numbers.length) || !areFinite(numbers) || !(Math.hypot(...direction) > 0) ||
        irradiance.some(value => value < 0)) {
        return null;
    }
    const distance = numbers[6] ?? Infinity;
    return {
        direction: unit(direction),
        irradiance: irradiance.length ? irradiance : scene.white,
        nearness: distance >= 0.6 ? 1 / distance : 0,
    };
}

function lightOfPhotograph(number, scene) {
    const { direction, irradiance, nearness } = scene.lights[scene.photographs[number].light];
    return { direction, irradiance, nearness };
}

// What is not understood stays as the page opens.
function stateOf(hash, scene) {
    const state = openedState(scene), words = new URLSearchParams(hash.replace(/^#/, ""));
    const index = (name, count) => {
        const number = Number(words.get(name));
        return words.has(name) && Number.isInteger(number) && number >= 0 && number < count ? number : null;
    };
    state.shape = index("shape", scene.shapes.length) ?? 0;
    state.material = index("material", scene.materials.length) ?? (state.shape === 0 ? state.material : 0);
    const lights = (words.get("light") ?? "").split(";").map(text => lightOf(text, scene)).filter(Boolean);
    state.lights = lights.length ? lights.slice(0, kMostLights) : state.lights;
    const exposure = words.has("exposure") ? Number(words.get("exposure")) : NaN;
    state.stops = Number.isFinite(exposure) ? Math.min(Math.max(exposure - stopsOf(state, scene), -16), 16) : 0;
    state.show = Object.hasOwn(kShow, words.get("show")) ? words.get("show") : "picture";
    state.layer = words.get("layer") !== "off";
    state.photograph = index("photograph", scene.photographs.length);
    if (state.photograph !== null) {
        state.lights = [lightOfPhotograph(state.photograph, scene)];
    }
    state.compare = comparisonsOf(state, scene).some(choice => choice.name === words.get("compare"))
        ? words.get("compare") : "";
    const line = Number(words.get("line") ?? 0.5), zoom = Number(words.get("zoom")), middle = numbersOf(words.get("middle"));
    state.line = line >= 0 && line <= 1 ? line : 0.5;
    state.zoom = zoom > 0 && zoom <= 64 ? zoom : 0;
    state.middle = middle.length === 2 && areFinite(middle) ? middle : state.middle;
    return state;
}

const hasOwnMaterial = (state, scene) => state.shape === 0 && scene.ownMaterials > 0;
const hasLayer = (state, scene) => state.material === null && Boolean(scene.shapes[state.shape].residual);

// What can stand to the right of the line.
function comparisonsOf(state, scene) {
    const choices = [{ name: "", text: "nothing" }];
    if (state.photograph !== null && state.shape === 0) {
        choices.push({ name: "photograph", text: "photograph" });
    }
    if (hasLayer(state, scene)) {
        choices.push({ name: "bare", text: "without residual layer" });
    }
    choices.push({ name: "normals", text: "normals" });
    scene.materials.forEach((material, i) => {
        if (i !== state.material && !(state.material === null && scene.ownMaterials === 1 && i === 0 && !scene.shapes[0].albedo)) {
            choices.push({ name: `material:${i}`, text: material.name });
        }
    });
    return choices;
}

// Stops that suit a shape in a material, under the light that the page opens with.
function stopsOf(state, scene) {
    const row = scene.stops[state.shape], own = state.shape === 0 ? 1 : 0;
    return row[state.material === null ? 0 : state.material + own];
}

// What the reader cannot see of it.
function wordsOf(state, scene) {
    const shape = scene.shapes[state.shape], [x, y, z] = state.lights[state.chosen].direction;
    const polar = Math.round(180 / Math.PI * Math.acos(Math.min(1, Math.max(-1, z))));
    const clock = (Math.round(6 * Math.atan2(x, y) / Math.PI) + 12) % 12 || 12;
    let text = state.lights.length > 1 ? `Light ${state.chosen + 1} of ${state.lights.length}: ` : "Light: ";
    text += polar < 1 ? "from the camera" : `${polar}° from the camera, at ${clock} o'clock`;
    if (state.photograph !== null) {
        text += `, as in photograph ${scene.lights[scene.photographs[state.photograph].light].photograph}`;
    }
    text += state.show === "coverage" ? ". Stripes: where the material is expected to be off by more than 20 %" : "";
    text += shape.azimuths && !shape.arrays.horizons ? ". Cast shadows are still being found" : "";
    return `${text}.`;
}
