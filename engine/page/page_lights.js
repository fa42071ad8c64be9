// Lights: where a drag takes them, their colours, and what a residual layer knows of them (the twin of
// engine/surface/residual_layer.cpp, light_plane.cpp and light_covariance.h). Directions are [x, y, z], unit, x right,
// y up, z towards the camera.
"use strict";

const kMostPolar = 1.48353; // radians: the visible side has to see a light that is dragged

const dot = (a, b) => a.reduce((sum, value, i) => sum + value * b[i], 0);
const scaled = (a, factor) => a.map(value => factor * value);
const unit = a => scaled(a, 1 / Math.hypot(...a));

// The light ball's disc is x right, y up, its rim at radius 1.
function lightFromBallDisc([x, y]) {
    const radius = Math.hypot(x, y), inside = Math.min(1, Math.sin(kMostPolar) / radius);
    const u = x * inside, v = y * inside;
    return [u, v, Math.sqrt(1 - u * u - v * v)];
}

function ballDiscFromLight([x, y, z]) {
    const radius = Math.hypot(x, y);
    return z < 0 && radius > 0 ? [x / radius, y / radius] : [x, y];
}

function draggedLight(direction, [right, up]) {
    const [x, y] = ballDiscFromLight(direction);
    return lightFromBallDisc([x + right, y + up]);
}

// Of an irradiance over the white one's, its largest channel: strength; what remains, as #rrggbb: the colour.
function strengthOf({ irradiance }, white) {
    return Math.max(...irradiance.map((value, c) => value / white[c]));
}

function colourOf(light, white) {
    const strength = strengthOf(light, white) || 1;
    const code = value => Math.round(255 * (value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055));
    const codes = light.irradiance.map((value, c) => code(Math.min(1, value / white[c] / strength)));
    return "#" + codes.map(value => value.toString(16).padStart(2, "0")).join("");
}

function irradianceOf(hex, strength, white) {
    const linear = code => code <= 0.04045 ? code / 12.92 : ((code + 0.055) / 1.055) ** 2.4;
    const colour = [1, 3, 5].map(at => linear(parseInt(hex.slice(at, at + 2), 16) / 255));
    const most = Math.max(...colour, 1e-6);
    return colour.map((value, c) => strength * white[c] * value / most);
}

function lightPlanePoint([x, y, z]) {
    const radius = Math.hypot(x, y);
    return z >= 0 ? [x, y] : radius > 0 ? scaled([x, y], (2 - radius) / radius) : [2, 0];
}

// How far a point lies outside of a convex polygon, counter-clockwise; 0 inside.
function distanceFromHull(hull, [x, y]) {
    let isInside = hull.length >= 3, least = Infinity;
    hull.forEach(([fromX, fromY], i) => {
        const [toX, toY] = hull[(i + 1) % hull.length];
        const edge = [toX - fromX, toY - fromY], away = [x - fromX, y - fromY], length2 = dot(edge, edge);
        const along = length2 > 0 ? Math.min(Math.max(dot(edge, away) / length2, 0), 1) : 0;
        isInside = isInside && edge[0] * away[1] - edge[1] * away[0] >= 0;
        least = Math.min(least, Math.hypot(away[0] - along * edge[0], away[1] - along * edge[1]));
    });
    return isInside ? 0 : least;
}

// 1 within two of the captured lights' spacings, 0 from four on.
function presenceAt(distance, spacing) {
    const away = distance / Math.min(Math.max(spacing, 0.02), 0.25);
    const t = Math.min(Math.max((4 - away) / 2, 0), 1);
    return t * t * (3 - 2 * t);
}

function lightCovariance(a, b) {
    const chord = a.map((value, i) => value - b[i]), square = dot(chord, chord);
    return 0.5 * Math.exp(-0.5 * Math.sqrt(square)) + 0.5 * Math.exp(-square) + dot(a, b);
}

// What the layer adds under the lights, and what it leaves of each for the BRDF.
function residualFrame(layer, lights) {
    const offset = [0, 0, 0], gains = new Float32Array(4 * 64), trusts = [];
    for (const { direction, irradiance } of lights) {
        const presence = presenceAt(distanceFromHull(layer.hull, lightPlanePoint(direction)), layer.spacing);
        const covariances = layer.nodes.map(node => presence * lightCovariance(direction, node));
        trusts.push(1 - presence * (1 - layer.trust));
        layer.low.forEach((low, k) => {
            for (let c = 0; c < 3; ++c) {
                const weight = covariances.reduce(
                    (sum, covariance, i) => sum + covariance * layer.weights[k * layer.nodes.length + i][c], 0);
                offset[c] += irradiance[c] * weight * low;
                gains[4 * k + c] += irradiance[c] * weight * (layer.high[k] - low);
            }
        });
    }
    return { offset, gains, trusts };
}
