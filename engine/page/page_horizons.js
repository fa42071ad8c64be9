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

const nearer = (a, b, share) => share < 0.5 ? a : b;
const between = (a, b, share) => Number.isNaN(a) || Number.isNaN(b) ? nearer(a, b, share) : a + share * (b - a);

// Calls write(x, y, sine) for all pixels with data.
function sweep({ width, height, first, whole, values, cliffs }, isForward, drift, write) {
    const column = i => isForward ? i : width - 1 - i, stepLength = Math.hypot(1, drift);
    const below = new Int32Array(width), share = new Float32Array(width);
    for (let i = 0; i < width; ++i) {
        const rows = Math.fround(drift * (i + (isForward ? first : whole - first - width)));
        below[i] = Math.floor(rows);
        share[i] = rows - below[i];
    }
    const hullStep = new Float64Array(width), hullHeight = new Float64Array(width);
    let size = 0;
    const passed = (step, z) => {
        while (size > 1 && (hullHeight[size - 1] - z) * (hullStep[size - 2] - step) <=
            (hullHeight[size - 2] - z) * (hullStep[size - 1] - step)) {
            --size;
        }
        let sine = kLowestHorizon;
        if (size > 0) {
            const rise = hullHeight[size - 1] - z, run = (hullStep[size - 1] - step) * stepLength;
            sine = rise / Math.sqrt(rise * rise + run * run);
        }
        hullStep[size] = step;
        hullHeight[size++] = z;
        return sine;
    };
    const sweepLine = (line, sines) => {
        size = 0;
        for (let i = width - 1; i >= 0; --i) {
            const y = line + below[i], at = y * width + column(i);
            const upper = y >= 0 && y < height ? values[at] : NaN;
            const lower = y >= -1 && y < height - 1 ? values[at + width] : NaN;
            const z = y >= 0 && cliffs[at] ? nearer(upper, lower, share[i]) : between(upper, lower, share[i]);
            sines[i] = Number.isNaN(z) ? NaN : passed(i, z);
        }
    };
    const least = Math.min(below[0], below[width - 1]), most = Math.max(below[0], below[width - 1]);
    let before = new Float32Array(width), current = new Float32Array(width);
    for (let line = -most - 1; line <= height - least; ++line) {
        sweepLine(line, current);
        for (let i = 0; i < width; ++i) { // the pixels between the line before and this one
            const x = column(i), y = line - 1 + below[i] + (share[i] === 0 ? 0 : 1), at = y * width + x;
            if (y >= 0 && y < height && !Number.isNaN(values[at])) {
                const isTorn = cliffs[at] || (y > 0 && cliffs[at - width]);
                const sine = share[i] === 0 ? before[i]
                    : (isTorn ? nearer : between)(before[i], current[i], 1 - share[i]);
                write(x, y, Number.isNaN(sine) ? kLowestHorizon : sine);
            }
        }
        [before, current] = [current, before];
    }
}

// A layer an azimuth. `heights`: in widths of the object.
function bakedHorizons({ x, y, width, height, whole, azimuths, places }, normals, heights) {
    const { viewpoint } = places, pixels = width * height;
    const inPicture = i => normals[2 * i] === kNoNormal ? NaN
        : places.width * heights[i] / (1 - heights[i] * viewpoint[3] / viewpoint[2]); // pointInPicture of lens.h
    const field = heightField(width, height, x, whole[0], (u, v) => inPicture(v * width + u));
    const turned = heightField(height, width, y, whole[1], (v, u) => inPicture(v * width + u));
    const codes = new Uint8Array(pixels * azimuths);
    for (let azimuth = 0; azimuth < azimuths; ++azimuth) {
        const angle = 2 * Math.PI * azimuth / azimuths, right = Math.cos(angle), down = -Math.sin(angle);
        const layer = codes.subarray(pixels * azimuth, pixels * (azimuth + 1));
        if (Math.abs(right) >= Math.abs(down)) {
            sweep(field, right > 0, Math.fround(down / Math.abs(right)), (u, v, sine) => {
                layer[v * width + u] = horizonCode(sine);
            });
        } else {
            sweep(turned, down > 0, Math.fround(right / Math.abs(down)), (v, u, sine) => {
                layer[v * width + u] = horizonCode(sine);
            });
        }
    }
    return codes;
}
