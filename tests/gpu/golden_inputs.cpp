#include "tests/gpu/golden_inputs.h"

#include <array>
#include <cmath>
#include <functional>

#include <glm/geometric.hpp>

#include "assets/head/statue_head.h"
#include "assets/synth/bumpy_solid.h"
#include "engine/brdf/brdf_tabulation.h"
#include "engine/files/image.h"
#include "engine/files/whole_file.h"
#include "engine/surface/surface.h"
#include "tests/support/residual_surface.h"
#include "tests/support/temp_folder.h"

namespace nacre::test {
namespace fs = std::filesystem;

namespace {

const LambertGgx kCopper{.diffuse = {0.35f, 0.16f, 0.08f}, .specular = glm::vec3(0.05f), .alpha = 0.22f};
const LambertGgx kJade{.diffuse = {0.12f, 0.25f, 0.16f}, .specular = glm::vec3(0.06f), .alpha = 0.15f};
const LambertGgx kLinen{.diffuse = {0.12f, 0.2f, 0.38f}, .specular = glm::vec3(0.09f), .alpha = 0.3f};
const LambertGgx kViolet{.diffuse = {0.18f, 0.1f, 0.22f}, .specular = glm::vec3(0.07f), .alpha = 0.1f};

constexpr int kSide = 160; // of the solid's pictures, pixels

// Smooth, different in every channel and everywhere, of mean 1 or so.
glm::vec3 albedoFactor(int x, int y)
{
    const float u = 0.11f * static_cast<float>(x), v = 0.09f * static_cast<float>(y);
    return {1 + 0.5f * std::sin(u), 1 + 0.5f * std::sin(v + 1), 1 + 0.5f * std::sin(u + v + 2)};
}

// A table so coarse that half a texel shows, of a material whose hue turns with phiD: the models hardly know phiD, and
// a picture of them would not show where it is measured from.
Material satin(const LambertGgx& model)
{
    Material material{"satin", tabulatedBrdf(model, {20, 10, 8}), {}};
    BrdfTable& table = material.table;
    for (size_t i = 0; i < table.values.size(); ++i) {
        const auto texel = static_cast<int>(i);
        const glm::ivec3 at(texel % table.size.x, texel / table.size.x % table.size.y,
                            texel / (table.size.x * table.size.y));
        const HalfDifference c = halfDifferenceFromUnit(glm::vec3(at) / glm::vec3(table.size - 1), table.domain);
        // phiD is undefined where either angle is 0: the hue's turn fades out there.
        const float turn = std::sin(c.thetaH) * std::sin(c.thetaD) * std::cos(2 * c.phiD);
        table.values[i] += model.diffuse / kPi * turn * glm::vec3(1.2f, 0.2f, -1.2f);
        table.values[i] = glm::max(table.values[i], glm::vec3(0));
    }
    return material;
}

std::vector<Material> patchMaterials()
{
    return {satin({.diffuse = {0.55f, 0.5f, 0.42f}, .specular = glm::vec3(0.04f), .alpha = 0.35f}),
            satin({.diffuse = {0.05f, 0.1f, 0.25f}, .specular = glm::vec3(0.06f), .alpha = 0.15f}),
            satin({.diffuse = {0.4f, 0.07f, 0.04f}, .specular = glm::vec3(0.05f), .alpha = 0.22f})};
}

// One material, to be put onto other normals.
void writeSatin(const fs::path& folder, const LambertGgx& model)
{
    saveSurface(folder, transferredSurface(sphereNormalMap(8), satin(model)), false);
}

void writePatches(const fs::path& folder)
{
    const SolidView view = viewOf(bumpySolid(), kSide, kSide, 0);
    Surface surface;
    surface.normals = view.normals;
    surface.materials = patchMaterials();
    surface.labels.assign(view.mask.size(), Surface::kNoMaterial);
    surface.albedo = Image(kSide, kSide, 3);
    for (const uint32_t pixel : view.seen) {
        const glm::dvec3 direction = glm::normalize(view.surfacePoint(pixel));
        surface.labels[pixel] = static_cast<uint8_t>(patchMaterial(direction, surface.materials.size()));
        const int x = static_cast<int>(pixel) % kSide, y = static_cast<int>(pixel) / kSide;
        surface.albedo.setRgb(x, y, albedoFactor(x, y));
    }
    saveSurface(folder, surface, false);
}

// Six smooth patterns, each under lights of its own, nearly as strong as the BRDF, half of which is trusted.
ResidualLayer smoothResidual(const Surface& surface)
{
    constexpr int kComponents = 6;
    ResidualLayer layer;
    layer.width = layer.height = kSide;
    layer.components = kComponents;
    layer.trust = 0.5f;
    layer.low.assign(kComponents, -0.12f);
    layer.high.assign(kComponents, 0.14f);
    for (const CapturedLight& light : surface.lights) {
        layer.nodes.push_back(light.light.direction);
    }
    for (size_t i = 0; i < kComponents * layer.nodes.size(); ++i) {
        const float x = 1.7f * static_cast<float>(i);
        layer.weights.push_back(0.07f * glm::vec3(std::sin(x), std::sin(x + 1), std::sin(x + 2)));
    }
    layer.codes.resize(layer.layers() * layer.pixelCount() * kComponentsPerTexel);
    for (size_t i = 0; i < layer.codes.size(); ++i) {
        const size_t texel = i / kComponentsPerTexel, pixel = texel % layer.pixelCount();
        const auto k = static_cast<float>(texel / layer.pixelCount() * kComponentsPerTexel + i % kComponentsPerTexel);
        const auto x = static_cast<float>(pixel % kSide), y = static_cast<float>(pixel / kSide);
        const float wave = std::sin((0.05f + 0.01f * k) * (std::cos(k) * x + std::sin(k) * y) + k);
        layer.codes[i] = static_cast<uint8_t>(127.5f + 127 * wave);
    }
    return layer;
}

void writeShaded(const fs::path& folder)
{
    const NormalMap normals = viewOf(bumpySolid(), kSide, kSide, 0).normals;
    Surface surface = transferredSurface(normals, satin(kCopper));
    surface.albedo = Image(kSide, kSide, 3);
    for (int y = 0; y < kSide; ++y) {
        for (int x = 0; x < kSide; ++x) {
            surface.albedo.setRgb(x, y, albedoFactor(x, y));
        }
    }
    surface.lights = capturedRing(9);
    surface.residual = smoothResidual(surface);
    saveSurface(folder, surface, false);
}

// Yarns over and under in turn, their twist, a little drape; wovenCloth is another matter, whose looks may change.
NormalMap plainWeave(int width, int height)
{
    constexpr int kSpacing = 16; // pixels a yarn
    NormalMap map(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            // From -1 to 1 over the cell, to the right and up.
            const float u = (2.0f * (x % kSpacing) + 1) / kSpacing - 1, v = 1 - (2.0f * (y % kSpacing) + 1) / kSpacing;
            const bool warpOnTop = (x / kSpacing + y / kSpacing) % 2 == 0;
            const float across = warpOnTop ? u : v, along = warpOnTop ? v : u;
            const float round = 0.9f * across / std::sqrt(1.1f - across * across), crimp = 0.25f * along;
            const float twist = 0.12f * std::sin(9 * (across + (warpOnTop ? 0.5f : -0.5f) * along));
            const float drape = 0.35f * std::sin(0.04f * static_cast<float>(x) + 0.03f * static_cast<float>(y));
            const glm::vec2 slope(round + twist, crimp);
            map.normals[map.index(x, y)] =
                glm::normalize(glm::vec3(warpOnTop ? slope : glm::vec2(slope.y, slope.x), 1) + glm::vec3(drape, 0, 0));
            map.confidence[map.index(x, y)] = 1;
        }
    }
    return map;
}

// A dim blue sky, a warm soft box at the upper left in front, a cool narrow one at the right.
void writeStudio(const fs::path& file)
{
    constexpr int kHeight = 64, kWidth = 2 * kHeight;
    const auto box = [](float x, float y, float centreX, float centreY, float width, float height) {
        const float u = (x - centreX) / width, v = (y - centreY) / height;
        return std::exp(-u * u * u * u - v * v * v * v);
    };
    Image radiance(kWidth, kHeight, 3);
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            const float column = (x + 0.5f) / kWidth, row = (y + 0.5f) / kHeight; // +x lies at a quarter, -x at three
            const glm::vec3 sky = (1 - row) * glm::vec3(0.05f, 0.08f, 0.14f);
            const glm::vec3 warm = box(column, row, 0.6f, 0.3f, 0.06f, 0.09f) * glm::vec3(9, 7, 4.5f);
            const glm::vec3 cool = box(column, row, 0.29f, 0.45f, 0.02f, 0.2f) * glm::vec3(2, 3.5f, 6);
            radiance.setRgb(x, y, sky + warm + cool);
        }
    }
    saveImage(file, radiance, PixelType::float32);
}

// A brass of our own in the published fits' form: no diffuse part, a lobe some 6 degrees wide.
void writeFits(const fs::path& file)
{
    writeText(file, "name,kD_r,kD_g,kD_b,A_r,A_g,A_b,B,C,ior\n"
                    "brass,0.02,0.012,0.004,60,40,14,300,1.2,1.6\n");
}

} // namespace

void writeGoldenInputs(const fs::path& state)
{
    const fs::path folder = state.parent_path();
    const std::string text = readTextFile(state);
    const std::pair<const char*, std::function<void()>> inputs[] = {
        {"sphere.exr", [&] { saveNormalMap(folder / "sphere.exr", viewOf(plainSphere(), 128, 128, 0).normals); }},
        {"solid.exr", [&] { saveNormalMap(folder / "solid.exr", viewOf(bumpySolid(), kSide, kSide, 0).normals); }},
        {"cloth.exr", [&] { saveNormalMap(folder / "cloth.exr", plainWeave(192, 128)); }},
        {"head.exr", [&] { saveNormalMap(folder / "head.exr", statueHead(176, 176).normals); }},
        {"patches.nacre", [&] { writePatches(folder / "patches.nacre"); }},
        {"shaded.nacre", [&] { writeShaded(folder / "shaded.nacre"); }},
        {"copper.nacre", [&] { writeSatin(folder / "copper.nacre", kCopper); }},
        {"linen.nacre", [&] { writeSatin(folder / "linen.nacre", kLinen); }},
        {"jade.nacre", [&] { writeSatin(folder / "jade.nacre", kJade); }},
        {"violet.nacre", [&] { writeSatin(folder / "violet.nacre", kViolet); }},
        {"studio.exr", [&] { writeStudio(folder / "studio.exr"); }},
        {"merl-abc:", [&] { writeFits(folder / "merl_abc_params.csv"); }}};
    for (const auto& [name, write] : inputs) {
        if (text.find(name) != std::string::npos) {
            write();
        }
    }
}

} // namespace nacre::test
