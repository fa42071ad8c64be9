// Reads a .ktx2 with ktx-parse and holds it to what docs/formats.md says of it. The BRDF is lambert:0.6,0.5,0.4.
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { pathToFileURL } from "node:url";

const [modules, file] = process.argv.slice(2);
const require = createRequire(pathToFileURL(`${modules}/`));
const { read, VK_FORMAT_R16G16B16A16_SFLOAT, KHR_DF_MODEL_RGBSDA, KHR_DF_TRANSFER_LINEAR, KHR_DF_PRIMARIES_BT709 } =
  await import(pathToFileURL(require.resolve("ktx-parse")));

const halfToNumber = (bits) => {
  const sign = bits & 0x8000 ? -1 : 1, exponent = (bits >> 10) & 31, fraction = bits & 1023;
  return sign * (exponent ? 2 ** (exponent - 15) * (1 + fraction / 1024) : 2 ** -14 * (fraction / 1024));
};

const texture = read(new Uint8Array(readFileSync(file)));
assert.equal(texture.vkFormat, VK_FORMAT_R16G16B16A16_SFLOAT);
assert.equal(texture.typeSize, 2);
assert.deepEqual([texture.pixelWidth, texture.pixelHeight, texture.pixelDepth], [90, 90, 90]);
assert.deepEqual([texture.layerCount, texture.faceCount, texture.levels.length], [0, 1, 1]);
assert.equal(texture.supercompressionScheme, 0);

const [descriptor] = texture.dataFormatDescriptor;
assert.equal(descriptor.colorModel, KHR_DF_MODEL_RGBSDA);
assert.equal(descriptor.colorPrimaries, KHR_DF_PRIMARIES_BT709);
assert.equal(descriptor.transferFunction, KHR_DF_TRANSFER_LINEAR);
assert.deepEqual([...descriptor.texelBlockDimension], [0, 0, 0, 0]);
assert.equal(descriptor.bytesPlane[0], 8);
assert.deepEqual(descriptor.samples.map((s) => s.bitOffset), [0, 16, 32, 48]);
assert.deepEqual(descriptor.samples.map((s) => s.bitLength), [15, 15, 15, 15]);
// Float and signed (bits 7 and 6), red, green, blue, alpha.
assert.deepEqual(descriptor.samples.map((s) => s.channelType), [0xc0, 0xc1, 0xc2, 0xcf]);

const text = (value) => (typeof value === "string" ? value : new TextDecoder().decode(value)).replace(/\0$/, "");
assert.deepEqual(Object.keys(texture.keyValue), ["KTXwriter", "nacre:brdfTable"]);
assert.match(text(texture.keyValue["nacre:brdfTable"]), /^1 90 90 90 half-difference 1\.570796/);

const level = texture.levels[0].levelData;
assert.equal(level.byteLength, 90 * 90 * 90 * 8);
const view = new DataView(level.buffer, level.byteOffset, level.byteLength);
for (const texel of [0, 1, 90, 8100, 50 + 90 * 20 + 8100 * 45]) {
  [0.6, 0.5, 0.4].forEach((albedo, channel) => {
    const value = halfToNumber(view.getUint16(8 * texel + 2 * channel, true));
    assert.ok(Math.abs(value - albedo / Math.PI) < 2e-4, `texel ${texel}: ${value}`);
  });
}
assert.equal(halfToNumber(view.getUint16(6, true)), 1); // covered
assert.equal(halfToNumber(view.getUint16(8 * (89 + 90 * 60) + 6, true)), 0); // below the horizon
console.log(`${file}: read by ktx-parse as it should be`);
