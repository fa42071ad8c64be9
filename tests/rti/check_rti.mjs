// Shows a .ptm and a folder of info.json and planes under a light by their formats' descriptions alone, and compares
// them with a picture: node check_rti.mjs PICTURE.ppm MASK.ppm X Y FILE.ptm WEB_FOLDER LEAST_DB. Planes are .ppm here,
// decoded from .jpg by the caller. Nothing of Nacre's own is used.
import { readFileSync } from "node:fs";

const [, , pictureFile, maskFile, xText, yText, ptmFile, webFolder, leastText] = process.argv;
const x = Number(xText), y = Number(yText), z = Math.sqrt(1 - x * x - y * y);

// The next `count` words and where the byte after the white space that ends them is.
function words(bytes, count) {
    const found = [];
    let at = 0;
    while (found.length < count) {
        let word = "";
        while (bytes[at] <= 32) ++at;
        while (bytes[at] > 32) word += String.fromCharCode(bytes[at++]);
        found.push(word);
    }
    return [found, at + 1];
}

function readPpm(file) {
    const bytes = readFileSync(file);
    const [[magic, width, height, full], start] = words(bytes, 4);
    if (magic !== "P6" || full !== "255") throw new Error(`${file} is no 8-bit .ppm`);
    return { width: Number(width), height: Number(height), codes: bytes.subarray(start) };
}

// Malzbender and Gelb 2001: a0 x^2 + a1 y^2 + a2 xy + a3 x + a4 y + a5, of (byte - bias) scale; the bottom row is first.
function showPtm(file) {
    const bytes = readFileSync(file);
    const [header, start] = words(bytes, 16);
    const width = Number(header[2]), height = Number(header[3]);
    const scale = header.slice(4, 10).map(Number), bias = header.slice(10, 16).map(Number);
    const weights = [x * x, y * y, x * y, x, y, 1], pixels = width * height;
    const value = (pixel) => weights.reduce((sum, w, k) => sum + w * (bytes[start + 6 * pixel + k] - bias[k]) * scale[k], 0);
    const codes = new Float64Array(3 * pixels);
    for (let row = 0; row < height; ++row) {
        for (let column = 0; column < width; ++column) {
            const pixel = (height - 1 - row) * width + column;
            for (let c = 0; c < 3; ++c) {
                codes[3 * (row * width + column) + c] = header[1] === "PTM_FORMAT_RGB"
                    ? value(c * pixels + pixel)
                    : value(pixel) * bytes[start + 6 * pixels + 3 * pixel + c] / 255;
            }
        }
    }
    return { width, height, codes };
}

// The weights that OpenLIME gives its planes under a light.
function webWeights(type) {
    if (type === "ptm") return [1, x, y, x * x, x * y, y * y];
    const phi = Math.atan2(y, x), t = Math.cos(Math.min(Math.acos(z), Math.PI / 2 - 0.15)), r = Math.sqrt(t - t * t);
    const a = Math.sqrt(6 / Math.PI), b = Math.sqrt(30 / Math.PI), half = Math.sqrt(1 / (2 * Math.PI));
    return [half, a * r * Math.cos(phi), Math.sqrt(3) * half * (2 * t - 1), a * r * Math.sin(phi),
        b * Math.cos(2 * phi) * (t * t - t), b * r * (2 * t - 1) * Math.cos(phi), Math.sqrt(5) * half * (1 - 6 * t + 6 * t * t),
        b * r * (2 * t - 1) * Math.sin(phi), b * Math.sin(2 * phi) * (t * t - t)];
}

function showWeb(folder) {
    const info = JSON.parse(readFileSync(`${folder}/info.json`));
    const { scale, bias } = info.materials[0];
    if (info.colorspace !== "rgb" || info.format !== "jpg") throw new Error("another kind of info.json");
    const codes = new Float64Array(3 * info.width * info.height);
    webWeights(info.type).forEach((weight, k) => {
        const plane = readPpm(`${folder}/plane_${k}.ppm`);
        if (plane.width !== info.width || plane.height !== info.height) throw new Error(`plane ${k} has another size`);
        plane.codes.forEach((code, i) => {
            codes[i] += 255 * weight * (code / 255 - bias[3 * k + i % 3]) * scale[3 * k + i % 3];
        });
    });
    return { width: info.width, height: info.height, codes };
}

const truth = readPpm(pictureFile), mask = readPpm(maskFile);
let failed = false;
for (const [name, shown] of [[ptmFile, showPtm(ptmFile)], [webFolder, showWeb(webFolder)]]) {
    if (shown.width !== truth.width || shown.height !== truth.height) throw new Error(`${name} has another size`);
    let squares = 0, count = 0;
    truth.codes.forEach((code, i) => {
        if (mask.codes[i]) {
            squares += (Math.round(Math.min(255, Math.max(0, shown.codes[i]))) - code) ** 2;
            ++count;
        }
    });
    const decibels = 10 * Math.log10(255 * 255 * count / squares);
    console.log(`${name}: ${decibels.toFixed(2)} dB`);
    failed ||= !(decibels >= Number(leastText));
}
process.exit(failed ? 1 : 0);
