// Horizons of a shape's height, for cast shadows: the twin of engine/surface/horizon.cpp, which says why.
"use strict";

const kHorizonSteps = 223, kFlatHorizon = 32; // of horizon.h
const kLowestHorizon = -kFlatHorizon / kHorizonSteps, kHighestHorizon = 1 - 2 / kHorizonSteps;

const horizonCode = sine =>
    Math.floor(Math.min(Math.max(sine, kLowestHorizon), kHighestHorizon) * kHorizonSteps + kFlatHorizon + 0.5);

// A rectangle of a picture whose columns are counted from `first` of `whole`; NaN without data.
function heightField(width, height, first, whole, valueAt) {
    const values = new Float32Array(width * height), cliffs = new Uint8Array(width * height);
    for (let y = 0, i = 0; y < height; ++y) {
        for (let x = 0; x < width; ++x, ++i) {
            values[i] = valueAt(x, y);
        }
    }
    const step = i => Math.abs(values[i + width] - values[i]) || 0; // 0 where there is none
    for (let i = 0; i < width * (height - 1); ++i) {
        cliffs[i] = step(i) > 1 + 2 * Math.max(0, step(i - width), step(i + width)) ? 1 : 0;
    }
    return { width, height, first, whole, values, cliffs };
}

const isNothing = value => value !== value; // NaN; Number.isNaN takes longer in these loops

// Writes a code for each pixel with data: column x, row y to element x strideX + y strideY of the layer.
function sweep({ width, height, first, whole, values, cliffs }, isForward, drift, layer, strideX, strideY) {
    const stepLength = Math.hypot(1, drift);
    const column = new Int32Array(width), below = new Int32Array(width), share = new Float32Array(width);
    for (let i = 0; i < width; ++i) {
        const rows = Math.fround(drift * (i + (isForward ? first : whole - first - width)));
        column[i] = isForward ? i : width - 1 - i;
        below[i] = Math.floor(rows);
        share[i] = rows - below[i];
    }
    const hullStep = new Float64Array(width), hullHeight = new Float64Array(width);
    // From the light on, over the highest points so far: their upper hull.
    const sweepLine = (line, sines) => {
        let size = 0;
        for (let i = width - 1; i >= 0; --i) {
            const y = line + below[i], at = y * width + column[i];
            const upper = y >= 0 && y < height ? values[at] : NaN;
            const lower = y >= -1 && y < height - 1 ? values[at + width] : NaN;
            const part = share[i], isTorn = isNothing(upper) || isNothing(lower) || (y >= 0 && cliffs[at]);
            const z = isTorn ? (part < 0.5 ? upper : lower) : upper + part * (lower - upper);
            if (isNothing(z)) {
                sines[i] = NaN;
                continue;
            }
            while (size > 1 && (hullHeight[size - 1] - z) * (hullStep[size - 2] - i) <=
                (hullHeight[size - 2] - z) * (hullStep[size - 1] - i)) {
                --size;
            }
            if (size > 0) {
                const rise = hullHeight[size - 1] - z, run = (hullStep[size - 1] - i) * stepLength;
                sines[i] = rise / Math.sqrt(rise * rise + run * run);
            } else {
                sines[i] = kLowestHorizon;
            }
            hullStep[size] = i;
            hullHeight[size++] = z;
        }
    };
    const least = Math.min(below[0], below[width - 1]), most = Math.max(below[0], below[width - 1]);
    let before = new Float32Array(width), current = new Float32Array(width);
    for (let line = -most - 1; line <= height - least; ++line) {
        sweepLine(line, current);
        for (let i = 0; i < width; ++i) { // the pixels between the line before and this one
            const x = column[i], part = share[i], y = line - 1 + below[i] + (part === 0 ? 0 : 1), at = y * width + x;
            if (y >= 0 && y < height && !isNothing(values[at])) {
                const upper = before[i], lower = current[i];
                const isTorn = isNothing(upper) || isNothing(lower) || cliffs[at] || (y > 0 && cliffs[at - width]);
                const sine = part === 0 ? upper
                    : isTorn ? (part > 0.5 ? upper : lower) : upper + (1 - part) * (lower - upper);
                layer[x * strideX + y * strideY] = horizonCode(isNothing(sine) ? kLowestHorizon : sine);
            }
        }
        [before, current] = [current, before];
    }
}

// Bakes the horizons of a shape, a layer an azimuth; waits for pause() after each. `heights`: in widths of the object.
async function bakedHorizons({ x, y, width, height, whole, azimuths, places, arrays }, pause) {
    const { viewpoint } = places, { normals, heights } = arrays, pixels = width * height;
    const inPicture = i => normals[2 * i] === kNoNormal ? NaN
        : places.width * heights[i] / (1 - heights[i] * viewpoint[3] / viewpoint[2]); // pointInPicture of lens.h
    const field = heightField(width, height, x, whole[0], (u, v) => inPicture(v * width + u));
    const turned = heightField(height, width, y, whole[1], (v, u) => inPicture(v * width + u));
    const codes = new Uint8Array(pixels * azimuths);
    for (let azimuth = 0; azimuth < azimuths; ++azimuth) {
        const angle = 2 * Math.PI * azimuth / azimuths, right = Math.cos(angle), down = -Math.sin(angle);
        const layer = codes.subarray(pixels * azimuth, pixels * (azimuth + 1));
        if (Math.abs(right) >= Math.abs(down)) {
            sweep(field, right > 0, Math.fround(down / Math.abs(right)), layer, 1, width);
        } else {
            sweep(turned, down > 0, Math.fround(right / Math.abs(down)), layer, width, 1);
        }
        await pause();
    }
    return codes;
}

// Of all shapes that cast shadows. The page stays awake: a shape of many pixels takes seconds.
async function bakeShapes(shapes) {
    let last = performance.now();
    const pause = async () => {
        if (performance.now() - last > 40) {
            await new Promise(done => setTimeout(done));
            last = performance.now();
        }
    };
    for (const shape of shapes.filter(({ azimuths }) => azimuths)) {
        shape.arrays.horizons = await bakedHorizons(shape, pause);
    }
}
