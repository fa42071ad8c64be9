// Decodes what the page holds: the inverse of engine/page/packed_plane.h.
"use strict";

function bytesOfPart(number) {
    const letters = atob(document.getElementById(`part-${number}`).textContent);
    const bytes = new Uint8Array(letters.length);
    for (let i = 0; i < letters.length; ++i) {
        bytes[i] = letters.charCodeAt(i);
    }
    return bytes;
}

async function inflated(bytes) {
    const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
}

// Adds to each difference what its neighbours predict, in place.
function unfiltered(values, width) {
    for (let i = 0, column = 0; i < values.length; ++i, ++column) {
        column = column === width ? 0 : column;
        const left = column > 0 ? values[i - 1] : 0, above = i >= width ? values[i - width] : 0;
        const corner = column > 0 && i >= width ? values[i - width - 1] : 0;
        const least = Math.min(left, above), most = Math.max(left, above);
        values[i] += corner >= most ? least : corner <= least ? most : left + above - corner;
    }
    return values;
}

async function bytePlane(part, width) {
    return unfiltered(await inflated(bytesOfPart(part)), width);
}

async function wordPlane(part, width) {
    const bytes = await inflated(bytesOfPart(part)), count = bytes.length / 2;
    const values = new Uint16Array(count);
    for (let i = 0; i < count; ++i) {
        const small = (bytes[i] << 8) | bytes[count + i];
        values[i] = (small >> 1) ^ -(small & 1);
    }
    return unfiltered(values, width);
}

// Planes side by side: element i of plane k at `channels` i + k.
function interleaved(planes, channels, Numbers) {
    const values = new Numbers(planes[0].length * channels);
    planes.forEach((plane, k) => {
        for (let i = 0; i < plane.length; ++i) {
            values[channels * i + k] = plane[i];
        }
    });
    return values;
}

const kNoNormal = 65535;
const kNormalSteps = 8191; // of held_by_page.h

async function decodedNormals(shape) {
    const [mask, x, y] = await Promise.all([
        bytePlane(shape.mask, shape.width), ...shape.normals.map(part => wordPlane(part, shape.width))]);
    const codes = interleaved([x, y], 2, Uint16Array);
    for (let i = 0; i < mask.length; ++i) {
        if (!mask[i]) {
            codes[2 * i] = codes[2 * i + 1] = kNoNormal;
        }
    }
    return codes;
}

// RGBA: factors and label.
async function decodedFactors(shape) {
    const labels = await bytePlane(shape.labels, shape.width);
    const values = new Float32Array(4 * labels.length).fill(1);
    if (shape.albedo) {
        const { step, planes } = shape.albedo;
        (await Promise.all(planes.map(part => wordPlane(part, shape.width)))).forEach((plane, c) => {
            for (let i = 0; i < plane.length; ++i) {
                values[4 * i + c] = (step * plane[i]) ** 2;
            }
        });
    }
    for (let i = 0; i < labels.length; ++i) {
        values[4 * i + 3] = labels[i];
    }
    return values;
}

// Layers of four components, the last filled up.
async function decodedResidual(shape) {
    const planes = await Promise.all(shape.residual.planes.map(part => bytePlane(part, shape.width)));
    const layers = Math.ceil(planes.length / 4), pixels = shape.width * shape.height;
    const codes = new Uint8Array(4 * pixels * layers);
    for (let k = 0; k < layers; ++k) {
        codes.set(interleaved(planes.slice(4 * k, 4 * k + 4), 4, Uint8Array), 4 * pixels * k);
    }
    return codes;
}

// In widths of the object.
async function decodedHeights(shape) {
    const { low, step, plane } = shape.places;
    return Float32Array.from(await wordPlane(plane, shape.width), code => low + step * code);
}

// Of each component, one a node: [component * nodes + node][channel].
async function decodedWeights({ weights }) {
    const values = new Float32Array((await inflated(bytesOfPart(weights))).buffer);
    return Array.from({ length: values.length / 3 }, (_, i) => values.subarray(3 * i, 3 * i + 3));
}

async function decodedShape(shape) {
    const nothing = Promise.resolve(null);
    const [normals, factors, residual, heights] = await Promise.all([
        decodedNormals(shape), shape.labels === undefined ? nothing : decodedFactors(shape),
        shape.residual ? decodedResidual(shape) : nothing,
        shape.places?.plane === undefined ? nothing : decodedHeights(shape)]);
    if (residual) {
        shape.residual.weights = await decodedWeights(shape.residual);
    }
    return { ...shape, arrays: { normals, factors, residual, heights } }; // and horizons, later
}

// Half floats, RGBA: f and its expected error.
async function decodedMaterial(material) {
    const planes = await Promise.all(material.planes.map(part => wordPlane(part, material.size[0])));
    return { ...material, isJudged: planes.length > 3, halves: interleaved(planes, 4, Uint16Array) };
}

async function decodedPhotograph(photograph) {
    const picture = new Blob([bytesOfPart(photograph.part)], { type: "image/jpeg" });
    const options = { colorSpaceConversion: "none", premultiplyAlpha: "none" };
    return { ...photograph, picture, bitmap: await createImageBitmap(picture, options) };
}

// The visible half of a sphere that fills a square.
function sphereShape(side) {
    const normals = new Uint16Array(2 * side * side).fill(kNoNormal);
    for (let row = 0; row < side; ++row) {
        for (let column = 0; column < side; ++column) {
            const x = (2 * column + 1) / side - 1, y = 1 - (2 * row + 1) / side, z2 = 1 - x * x - y * y;
            if (z2 > 0) {
                const i = 2 * (row * side + column), packing = 1 / Math.sqrt(2 * (1 + Math.sqrt(z2)));
                normals[i] = Math.round(kNormalSteps * (1 + x * packing));
                normals[i + 1] = Math.round(kNormalSteps * (1 + y * packing));
            }
        }
    }
    return { name: "Sphere", x: 0, y: 0, width: side, height: side, arrays: { normals } };
}

// The page's description with all of its arrays; the sphere is the last shape.
async function decodedScene() {
    const scene = JSON.parse(document.getElementById("description").textContent);
    const all = (list, decode) => Promise.all(list.map(decode));
    const [shapes, materials, photographs] = await Promise.all([
        all(scene.shapes, decodedShape), all(scene.materials, decodedMaterial),
        all(scene.photographs, decodedPhotograph)]);
    shapes.push(sphereShape(scene.sphereSide));
    return { ...scene, shapes, materials, photographs };
}
