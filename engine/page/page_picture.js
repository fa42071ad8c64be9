// Draws a shape in a material under lights into a picture of the shape's own size, by shade.frag, and pictures onto the
// screen. Everything that is on the device can be made anew from the decoded scene after the context was lost.
"use strict";

const kShow = { picture: 0, normals: 1, labels: 2, coverage: 3 }; // of false_colour.h
const kShowBall = 16; // of shade.frag
const kLookup = 0.5; // time of a ball's lookup, in a table's
const kMostLights = 8;

function compiled(gl, kind, source) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost()) {
        throw new Error(gl.getShaderInfoLog(shader));
    }
    return shader;
}

// A program and its uniforms by name.
function linked(gl, fragmentName) {
    const source = name => document.getElementById(name).textContent.trimStart();
    const program = gl.createProgram();
    gl.attachShader(program, compiled(gl, gl.VERTEX_SHADER, source("fullscreen.vert")));
    gl.attachShader(program, compiled(gl, gl.FRAGMENT_SHADER, source(fragmentName)));
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
        throw new Error(gl.getProgramInfoLog(program));
    }
    const places = new Map();
    const at = name => {
        if (!places.has(name)) {
            places.set(name, gl.getUniformLocation(program, name));
        }
        return places.get(name);
    };
    return { program, at };
}

class Painter {
    constructor(gl, scene) {
        this.gl = gl;
        this.scene = scene;
        this.restore();
    }

    restore() {
        const { gl } = this;
        gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
        gl.pixelStorei(gl.UNPACK_COLORSPACE_CONVERSION_WEBGL, gl.NONE);
        this.shade = linked(gl, "shade.frag");
        this.photograph = linked(gl, "photograph.frag");
        this.screen = linked(gl, "screen.frag");
        this.framebuffer = gl.createFramebuffer();
        this.drawsFloats = ["EXT_color_buffer_float", "EXT_color_buffer_half_float"].some(name => gl.getExtension(name));
        this.onDevice = new Map();
        // In place of arrays that a shape does not have: samplers of every kind need a texture that is whole.
        this.nothing = { x: 0, y: 0, width: 1, height: 1, arrays: { normals: new Uint16Array(2) } };
        this.none = {
            flat: this.flat(gl.RGBA8, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)),
            layers: this.layers(gl.RGBA8, 1, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)),
        };
    }

    textureOf(kind, filter) {
        const { gl } = this, texture = gl.createTexture();
        gl.bindTexture(kind, texture);
        gl.texParameteri(kind, gl.TEXTURE_MIN_FILTER, filter);
        gl.texParameteri(kind, gl.TEXTURE_MAG_FILTER, filter);
        for (const side of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T, gl.TEXTURE_WRAP_R]) {
            gl.texParameteri(kind, side, gl.CLAMP_TO_EDGE);
        }
        return texture;
    }

    flat(inside, width, height, format, type, values) {
        const { gl } = this, texture = this.textureOf(gl.TEXTURE_2D, gl.NEAREST);
        gl.texImage2D(gl.TEXTURE_2D, 0, inside, width, height, 0, format, type, values);
        return texture;
    }

    layers(inside, width, height, count, format, type, values) {
        const { gl } = this, texture = this.textureOf(gl.TEXTURE_2D_ARRAY, gl.NEAREST);
        gl.texImage3D(gl.TEXTURE_2D_ARRAY, 0, inside, width, height, count, 0, format, type, values);
        return texture;
    }

    // Of a thing of the scene, made when it is first drawn.
    held(thing, make) {
        if (!this.onDevice.has(thing)) {
            this.onDevice.set(thing, make());
        }
        return this.onDevice.get(thing);
    }

    texturesOf(shape) {
        const { gl } = this, { width, height, arrays } = shape;
        return this.held(shape, () => ({
            normals: this.flat(gl.RG16UI, width, height, gl.RG_INTEGER, gl.UNSIGNED_SHORT, arrays.normals),
            factors: arrays.factors
                ? this.flat(gl.RGBA16F, width, height, gl.RGBA, gl.FLOAT, arrays.factors) : this.none.flat,
            heights: arrays.heights
                ? this.flat(gl.R32F, width, height, gl.RED, gl.FLOAT, arrays.heights) : this.none.flat,
            residual: arrays.residual
                ? this.layers(gl.RGBA8, width, height, Math.ceil(shape.residual.low.length / 4), gl.RGBA,
                    gl.UNSIGNED_BYTE, arrays.residual) : this.none.layers,
        }));
    }

    // Null until they are baked.
    horizonsOf({ width, height, azimuths, arrays }) {
        const { gl } = this;
        return arrays.horizons ? this.held(arrays.horizons, () =>
            this.layers(gl.R8, width, height, azimuths, gl.RED, gl.UNSIGNED_BYTE, arrays.horizons)) : null;
    }

    tableOf(material) {
        const { gl } = this, [x, y, z] = material.size;
        return this.held(material, () => {
            const texture = this.textureOf(gl.TEXTURE_3D, gl.LINEAR);
            gl.texImage3D(gl.TEXTURE_3D, 0, gl.RGBA16F, x, y, z, 0, gl.RGBA, gl.HALF_FLOAT, material.halves);
            return texture;
        });
    }

    // The picture of that name to draw into, of this size, row 0 on top: codes of the display.
    picture(name, { width, height }, format = this.gl.RGBA8) {
        const { gl } = this, known = this.onDevice.get(name);
        if (known && known.width === width && known.height === height) {
            return known;
        }
        if (known) {
            gl.deleteTexture(known.texture);
        }
        const made = { texture: this.textureOf(gl.TEXTURE_2D, gl.LINEAR), width, height };
        gl.texStorage2D(gl.TEXTURE_2D, 1 + Math.floor(Math.log2(Math.max(width, height))), format, width, height);
        this.onDevice.set(name, made);
        return made;
    }

    begin(picture, { program }) {
        const { gl } = this;
        gl.bindFramebuffer(gl.FRAMEBUFFER, this.framebuffer);
        gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, picture.texture, 0);
        gl.viewport(0, 0, picture.width, picture.height);
        gl.clearColor(0, 0, 0, 1);
        gl.clear(gl.COLOR_BUFFER_BIT);
        gl.useProgram(program);
    }

    bind(program, unit, kind, name, texture) {
        const { gl } = this;
        gl.activeTexture(gl.TEXTURE0 + unit);
        gl.bindTexture(kind, texture);
        gl.uniform1i(program.at(name), unit);
    }

    draw() {
        this.gl.drawArrays(this.gl.TRIANGLES, 0, 3);
    }

    finish() {
        const { gl } = this;
        gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    }

    // Whether the picture shows anything else than `content`, which it will from now on.
    static isNew(picture, content) {
        const known = picture.content;
        picture.content = JSON.stringify(content);
        picture.isReduced = picture.isReduced && picture.content === known;
        return picture.content !== known;
    }

    // `view`: shape, material (null: the shape's own), lights, show, layer, gain.
    paint(picture, view) {
        const hasHorizons = Boolean(view.shape.arrays.horizons);
        if (!Painter.isNew(picture, { ...view, shape: this.scene.shapes.indexOf(view.shape), hasHorizons })) {
            return; // zoomed, moved or wiped
        }
        const { gl, shade, scene } = this, { shape } = view, isOwn = view.material === null;
        const layer = isOwn && view.layer && shape.residual ? residualFrame(shape.residual, view.lights) : null;
        const lights = view.lights.map((light, i) =>
            ({ ...light, irradiance: scaled(light.irradiance, layer ? layer.trusts[i] : 1) }));
        const isByLabel = isOwn && view.show !== kShow.normals;
        const numbers = isByLabel ? Array.from({ length: scene.ownMaterials }, (_, i) => i) : [view.material ?? 0];
        const balls = this.takesBalls(view, numbers) ? numbers.map(number => this.drawnBall(number, lights)) : [];
        this.begin(picture, shade);
        this.bindShape(shape);
        gl.uniform1i(shade.at("show"), view.show);
        gl.uniform1i(shade.at("labels"), scene.ownMaterials);
        gl.uniform1f(shade.at("gain"), view.gain);
        this.setPlaces(shape, lights);
        this.setLights(lights);
        this.setLayer(shape, layer);
        numbers.forEach((number, i) => {
            this.setMaterial(scene.materials[number], isByLabel ? number : -1);
            this.setBall(balls[i]);
            this.draw();
        });
        this.finish();
    }

    // Whether balls of the materials of those numbers show the same in less time.
    takesBalls({ shape, show, lights }, numbers) {
        const sides = numbers.map(number => this.scene.materials[number].ballSide);
        const isFar = lights.every(light => light.nearness === 0) && !(shape.places?.viewpoint[3] > 0);
        return this.drawsFloats && show === kShow.picture && !shape.azimuths && isFar && !sides.includes(0) &&
            this.ballsPay(shape.width * shape.height, sides, lights.length);
    }

    ballsPay(pixels, sides, lights) {
        return dot(sides, sides) * lights + kLookup * pixels < pixels * lights;
    }

    // The mean of a material's f over the lights by the normal, as ball.h has it.
    drawnBall(number, lights) {
        const { gl, shade } = this, material = this.scene.materials[number], side = material.ballSide;
        const ball = this.picture(`ball ${number}`, { width: side, height: side }, gl.RGBA16F);
        if (Painter.isNew(ball, lights)) {
            this.begin(ball, shade);
            this.bindShape(this.nothing);
            this.setPlaces(this.nothing, lights);
            this.setLights(lights);
            this.setMaterial(material, -1);
            this.setBall(null);
            gl.uniform1i(shade.at("show"), kShowBall);
            gl.uniform1f(shade.at("ballSide"), side);
            this.draw();
            this.finish();
        }
        return ball;
    }

    bindShape(shape) {
        const { gl, shade } = this, textures = this.texturesOf(shape), horizons = this.horizonsOf(shape);
        this.bind(shade, 0, gl.TEXTURE_2D, "normals", textures.normals);
        this.bind(shade, 1, gl.TEXTURE_2D, "albedos", textures.factors);
        this.bind(shade, 3, gl.TEXTURE_2D_ARRAY, "horizons", horizons ?? this.none.layers);
        this.bind(shade, 4, gl.TEXTURE_2D, "heights", textures.heights);
        this.bind(shade, 5, gl.TEXTURE_2D_ARRAY, "residual", textures.residual);
        gl.uniform2i(shade.at("corner"), shape.x, shape.y);
        gl.uniform1i(shade.at("azimuths"), horizons ? shape.azimuths : 0);
    }

    setBall(ball) {
        const { gl, shade } = this;
        this.bind(shade, 6, gl.TEXTURE_2D, "ball", ball ? ball.texture : this.none.flat);
        gl.uniform1f(shade.at("ballSide"), ball ? ball.width : 0);
    }

    setMaterial(material, label) {
        const { gl, shade } = this;
        this.bind(shade, 2, gl.TEXTURE_3D, "table", this.tableOf(material));
        gl.uniform1i(shade.at("material"), label);
        gl.uniform4f(shade.at("tableShape"), ...material.size, material.thetaDMax);
        gl.uniform1i(shade.at("coordinates"), material.coordinates);
        gl.uniform1i(shade.at("isJudged"), material.isJudged ? 1 : 0);
    }

    // A shape without heights stands on the plane.
    setPlaces(shape, lights) {
        const { gl, shade } = this, isNear = lights.some(light => light.nearness > 0);
        const { middle, width } = shape.places ??
            { middle: [shape.x + shape.width / 2, shape.y + shape.height / 2], width: Math.max(shape.width, shape.height) };
        const viewpoint = shape.places?.viewpoint ?? [0, 0, 1, 0];
        gl.uniform4f(shade.at("placeFrame"), ...middle, width, isNear || viewpoint[3] > 0 ? 1 : 0);
        gl.uniform4f(shade.at("viewpoint"), ...viewpoint);
    }

    setLights(lights) {
        const { gl, shade } = this;
        const places = new Float32Array(4 * kMostLights), irradiances = new Float32Array(3 * kMostLights);
        lights.forEach((light, i) => {
            places.set([...light.direction, light.nearness], 4 * i);
            irradiances.set(light.irradiance, 3 * i);
        });
        gl.uniform1i(shade.at("lightCount"), lights.length);
        gl.uniform4fv(shade.at("lights"), places);
        gl.uniform3fv(shade.at("irradiances"), irradiances);
    }

    setLayer(shape, layer) {
        const { gl, shade } = this;
        gl.uniform1i(shade.at("residualFours"), layer ? Math.ceil(shape.residual.low.length / 4) : 0);
        if (layer) {
            gl.uniform3f(shade.at("residualOffset"), ...layer.offset);
            gl.uniform4fv(shade.at("residualGains"), layer.gains);
        }
    }

    // `gain`: of the photograph's linear values.
    paintPhotograph(picture, photograph, gain) {
        if (!Painter.isNew(picture, { light: photograph.light, gain })) {
            return;
        }
        const { gl } = this, texture = this.held(photograph, () => {
            const made = this.textureOf(gl.TEXTURE_2D, gl.NEAREST);
            gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, photograph.bitmap);
            return made;
        });
        this.begin(picture, this.photograph);
        this.bind(this.photograph, 0, gl.TEXTURE_2D, "photograph", texture);
        gl.uniform1f(this.photograph.at("gain"), gain);
        this.draw();
        this.finish();
    }

    // `frame`: x and y of the top left corner and the scale, in the canvas's pixels. `second`: right of the line, or null.
    paintScreen(first, second, frame, line) {
        const { gl, screen } = this, { canvas } = gl;
        gl.viewport(0, 0, canvas.width, canvas.height);
        gl.useProgram(screen.program);
        for (const [unit, name, picture] of [[0, "first", first], [1, "second", second ?? first]]) {
            this.bind(screen, unit, gl.TEXTURE_2D, name, picture.texture);
            if (frame.scale < 1 && !picture.isReduced) {
                gl.generateMipmap(gl.TEXTURE_2D);
                picture.isReduced = true;
            }
            // From so many screen pixels a pixel on, pixels are shown as they are.
            gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, frame.scale < 6 ? gl.LINEAR : gl.NEAREST);
            gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER,
                frame.scale < 1 ? gl.LINEAR_MIPMAP_LINEAR : gl.LINEAR);
        }
        gl.uniform1i(screen.at("isCompared"), second ? 1 : 0);
        gl.uniform2f(screen.at("origin"), frame.x, frame.y);
        gl.uniform1f(screen.at("scale"), frame.scale);
        gl.uniform1f(screen.at("screenHeight"), canvas.height);
        gl.uniform1f(screen.at("line"), line);
        this.draw();
    }

    // RGBA codes, row 0 on top.
    codesOf(picture) {
        const { gl } = this, codes = new Uint8ClampedArray(4 * picture.width * picture.height);
        gl.bindFramebuffer(gl.FRAMEBUFFER, this.framebuffer);
        gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, picture.texture, 0);
        gl.readPixels(0, 0, picture.width, picture.height, gl.RGBA, gl.UNSIGNED_BYTE, codes);
        gl.bindFramebuffer(gl.FRAMEBUFFER, null);
        return codes;
    }
}
