#include "app/materials/parameter_export.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "acquisition/exchange/lobe_fit.h"
#include "app/arguments/destinations.h"
#include "app/materials/agreement.h"
#include "engine/brdf/brdf_models.h"
#include "engine/exchange/gltf_file.h"
#include "engine/exchange/gltf_picture.h"
#include "engine/exchange/gltf_surface.h"
#include "engine/exchange/materialx_file.h"
#include "engine/files/error.h"
#include "engine/files/image.h"
#include "engine/files/measures.h"
#include "engine/files/text_files.h"
#include "engine/files/whole_file.h"
#include "engine/materials/material_specification.h"
#include "engine/scene/ball.h"
#include "engine/surface/height_from_normals.h"
#include "engine/surface/object_places.h"
#include "engine/surface/surface.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

constexpr double kMostAlbedo = 0.999; // quantile of a material's albedo factors; those above are cut

// A material with what it was fitted by.
struct Fitted {
    Material material; // divided by the radiance scale
    float mostAlbedo = 1;
    BrdfInterpolant interpolant{};
    std::unique_ptr<ModelJudge> judge{};
    std::optional<LobeFit> gltf{}, standardSurface{};
};

struct Source {
    Surface surface; // of a material: that material and no pixels
    bool isSurface = false;
    bool isRelative = false;
};

Source loadSource(const ParameterExport& asked)
{
    Source source;
    const bool isFolder = fs::is_directory(asked.source) || lowerExtension(asked.source) == ".nacre";
    if (isFolder) {
        source.surface = loadSurface(asked.source);
        source.isSurface = true;
        source.isRelative = source.surface.scale == RadianceScale::relative;
        if (source.surface.materials.empty()) {
            throw Error(asked.source, "is a target without a material", "a surface of nacre acquire, or a material");
        }
        return source;
    }
    const BrdfSource named = loadBrdfSource(asked.source, asked.fits);
    source.isRelative = named.relative;
    source.surface.materials.push_back(loadMaterial(asked.source, asked.fits, asked.threads));
    return source;
}

float mostAlbedoOf(const Surface& surface, size_t material)
{
    std::vector<float> factors;
    for (size_t pixel = 0; pixel < surface.labels.size() && !surface.albedo.values.empty(); ++pixel) {
        if (isShaded(surface, pixel) && surface.labels[pixel] == material) {
            const glm::vec3 a = albedoFactor(surface, pixel);
            factors.push_back(std::max({a.x, a.y, a.z}));
        }
    }
    return factors.empty() ? 1 : std::max(quantile(factors, kMostAlbedo), 1e-3f);
}

void judgeOf(const std::string& source, Fitted& fitted, int threads)
{
    const BrdfTable& table = fitted.material.table;
    fitted.interpolant = [&table](const glm::vec3& unit) {
        return InterpolatedValue{sampleTable(table, unit).value, 0};
    };
    fitted.judge = std::make_unique<ModelJudge>(fitted.interpolant, table, threads);
    const bool isFinite = std::all_of(table.values.begin(), table.values.end(), [](const glm::vec3& f) {
        return std::isfinite(f.x) && std::isfinite(f.y) && std::isfinite(f.z);
    });
    if (!isFinite || fitted.judge->isEmpty()) {
        throw Error(source,
                    fmt::format("material \"{}\" {}", fitted.material.name,
                                isFinite ? "is covered nowhere" : "holds values that are no numbers"),
                    "a measured table");
    }
}

void scaleTable(BrdfTable& table, float by)
{
    for (glm::vec3& f : table.values) {
        f *= by;
    }
}

// What a surface's radiance is divided by, so that the albedo of its brightest pixels fits into 1. Only where its scale
// is free, and never to make it brighter.
float radianceScaleOf(const Source& source, const std::vector<std::unique_ptr<Fitted>>& all)
{
    float scale = 1;
    for (const auto& fitted : all) {
        const glm::vec3 albedo = fitLambert(fitted->judge->fittedPart()).kD;
        scale = std::max(scale, fitted->mostAlbedo * std::max({albedo.x, albedo.y, albedo.z}));
    }
    return source.isRelative ? scale : 1;
}

std::vector<std::unique_ptr<Fitted>> materialsOf(const ParameterExport& asked, const Source& source, float& scale)
{
    std::vector<std::unique_ptr<Fitted>> all; // judges point to their tables
    for (size_t i = 0; i < source.surface.materials.size(); ++i) {
        auto fitted = std::make_unique<Fitted>(Fitted{source.surface.materials[i], mostAlbedoOf(source.surface, i)});
        judgeOf(asked.source, *fitted, asked.threads);
        all.push_back(std::move(fitted));
    }
    scale = radianceScaleOf(source, all);
    for (auto& fitted : all) {
        scaleTable(fitted->material.table, 1 / scale);
        judgeOf(asked.source, *fitted, asked.threads);
    }
    return all;
}

std::string text(const glm::vec3& v)
{
    return fmt::format("{:.3f},{:.3f},{:.3f}", v.x, v.y, v.z);
}

std::string describe(const LobeFit& fit)
{
    std::string words =
        fit.shape.isMetal()
            ? fmt::format("metallic {:.1f} {}", fit.shape.metallic, text(fit.colours.specular))
            : fmt::format("diffuse {}, specular {}", text(fit.colours.diffuse), text(fit.colours.specular));
    words += fmt::format(", roughness {:.3f}", fit.shape.roughness);
    if (fit.format == ExchangeFormat::gltf && fit.shape.specularWeight != 1 && !fit.shape.isMetal()) {
        words += fmt::format(", specular factor {:.2f}", fit.shape.specularWeight);
    }
    if (fit.format == ExchangeFormat::standardSurface && !fit.shape.isMetal()) {
        words += fmt::format(", IOR {:.2f}", fit.shape.ior);
    }
    if (fit.hasSheen()) {
        words += fmt::format(", sheen {} of roughness {:.3f}", text(fit.colours.sheen), fit.shape.sheenRoughness);
    }
    return words;
}

LobeFit fitAs(const ParameterExport& asked, const Fitted& fitted, ExchangeFormat format)
{
    const LobeFit fit = fitLobes(*fitted.judge, format, std::min(1 / fitted.mostAlbedo, 1.0f), asked.threads);
    const LobeFitScale scale = fitScale(*fitted.judge);
    const char* name = format == ExchangeFormat::gltf ? "glTF" : "standard_surface";
    if (isNothing(fit, scale)) {
        throw Error(asked.source,
                    fmt::format("no parameters of {} come near material \"{}\": {:.1f} dB, and {:.1f} dB for black",
                                name, fitted.material.name, fit.psnr, scale.black),
                    "a material with a diffuse part and a highlight; its table can be kept by nacre brdf --export");
    }
    if (isFar(fit, scale)) {
        fmt::print(stderr, "nacre: warning: {} holds material \"{}\" to {:.1f} dB alone{}\n", name,
                   fitted.material.name, fit.psnr,
                   std::isfinite(scale.expected)
                       ? fmt::format("; its table is expected to be right to {:.1f} dB", scale.expected)
                       : "");
    }
    if (!asked.quiet) {
        fmt::print("{}: {} {:.2f} dB on the covered part{}: {}\n", fitted.material.name, name, fit.psnr,
                   fit.psnr > fit.corePsnr ? fmt::format(" ({:.2f} without extensions and sheen)", fit.corePsnr) : "",
                   describe(fit));
    }
    return fit;
}

constexpr int kBallSide = 240;
const Light kBallLights[] = {{glm::normalize(glm::vec3(-0.45f, 0.5f, 0.75f)), glm::vec3(1)},
                             {glm::normalize(glm::vec3(0.8f, 0.2f, 0.45f)), glm::vec3(1)}};

void drawBall(Image& image, int left, int top, const LitAndSeen& f)
{
    const Image ball = materialBall(f, kBallLights, kBallSide);
    for (int y = 0; y < kBallSide; ++y) {
        for (int x = 0; x < kBallSide; ++x) {
            image.setRgb(left + x, top + y, ball.rgb(x, y));
        }
    }
}

// A row a material: measured, and each fit.
void saveBalls(const ParameterExport& asked, const std::vector<std::unique_ptr<Fitted>>& all)
{
    constexpr int kCaption = 28, kLetters = 14, kRow = kBallSide + kCaption;
    Image radiance(3 * kBallSide, kRow * static_cast<int>(all.size()), 3);
    std::vector<std::string> captions;
    for (size_t i = 0; i < all.size(); ++i) {
        const int top = kRow * static_cast<int>(i);
        const BrdfTable& table = all[i]->material.table;
        drawBall(radiance, 0, top, [&](const glm::vec3& n, const glm::vec3& l, const glm::vec3& v) {
            return evaluateTable(table, n, l, v).value;
        });
        captions.push_back(all[i]->material.name);
        int left = kBallSide;
        for (const auto& fit : {all[i]->gltf, all[i]->standardSurface}) {
            const std::unique_ptr<LobeModel> model = modelOf(fit->format, fit->shape, fit->hasSheen());
            drawBall(radiance, left, top, [&](const glm::vec3& n, const glm::vec3& l, const glm::vec3& v) {
                return model->evaluate(fit->colours, n, l, v);
            });
            captions.push_back(fmt::format("{} {:.1f} dB", left == kBallSide ? "glTF" : "MaterialX", fit->psnr));
            left += kBallSide;
        }
    }
    Image codes = displayedImage(radiance, {.exposureStops = automaticExposure(radiance)});
    for (size_t i = 0; i < captions.size(); ++i) {
        drawText(codes, static_cast<int>(i % 3) * kBallSide + 8, kRow * static_cast<int>(i / 3) + kBallSide + 18,
                 captions[i], kLetters);
    }
    saveImage(asked.balls, codes, PixelType::uint8);
}

// What the .glb's own pictures are, beside what nacre render makes of the surface with its layer and without.
std::string describeLoss(Surface surface, const std::vector<SurfaceLobes>& lobes, float scale)
{
    if (surface.castsShadows) {
        surface.horizon = horizonMap(surface.normals, heightInPicture(surface));
    }
    Surface own = judgedSurface(surface);
    GltfScene scene = gltfSurface(own, own.height, lobes, "");
    scene.radianceScale = scale;
    const auto picture = [&](std::span<const Light> lights) { return gltfPicture(scene, own, lights); };
    std::string text = fmt::format("its pictures have {:.1f} dB", agreementDecibels(own, picture));
    if (!own.residual.empty()) {
        own.residual = {};
        text += fmt::format(", {:.1f} of the surface without its residual layer", agreementDecibels(own, picture));
    }
    return text;
}

void saveGltf(const ParameterExport& asked, const Source& source, const std::vector<std::unique_ptr<Fitted>>& all,
              float scale)
{
    const std::string name = fs::path(asked.source).stem().string();
    GltfScene scene;
    std::string loss;
    if (source.isSurface) {
        std::vector<SurfaceLobes> lobes;
        for (const auto& fitted : all) {
            lobes.push_back({fitted->gltf->shape, fitted->gltf->colours, fitted->mostAlbedo});
        }
        const GltfSurfaceOptions options{.width = asked.width};
        const int side = std::max(source.surface.normals.width, source.surface.normals.height);
        if (side > options.largestTexture && !asked.quiet) {
            fmt::print("textures are made smaller, {} pixels to {}\n", side, options.largestTexture);
        }
        Surface surface = source.surface;
        surface.height = exportedHeight(surface, asked.threads);
        scene = gltfSurface(surface, surface.height, lobes, name, options);
        if (!asked.quiet) {
            loss = "; " + describeLoss(std::move(surface), lobes, scale);
        }
    } else {
        scene.name = name;
        scene.mesh = sphereMesh(0.5f * asked.width);
        scene.material =
            gltfMaterialOf(all.front()->material.name, all.front()->gltf->shape, all.front()->gltf->colours);
    }
    scene.radianceScale = scale;
    saveGlb(asked.gltf, scene);
    if (!asked.quiet) {
        fmt::print("{}: {} triangles, {} textures, {:.2f} MB, {} m wide{}{}\n", asked.gltf.string(),
                   scene.mesh.indices.size() / 3, scene.images.size(),
                   static_cast<double>(fs::file_size(asked.gltf)) / 1e6, asked.width,
                   scale != 1 ? fmt::format("; radiance is to be multiplied by {:.4g}", scale) : "", loss);
    }
}

} // namespace

void ParameterExport::check() const
{
    const auto require = [&](const char* option, const fs::path& file, const char* extension) {
        if (!file.empty() && lowerExtension(file) != extension) {
            throw Error("", fmt::format("{} {} is no such file", option, file.string()),
                        fmt::format("NAME{}", extension), Error::kUsage);
        }
    };
    require("--gltf", gltf, ".glb");
    require("--materialx", materialX, ".mtlx");
    require("--balls", balls, ".png");
    constexpr float kLeastWidth = 1e-4f, kMostWidth = 1e4f;
    if (!(width >= kLeastWidth && width <= kMostWidth)) {
        throw Error("", fmt::format("--width {} is out of range", width),
                    fmt::format("{} to {} metres", kLeastWidth, kMostWidth), Error::kUsage);
    }
}

void exportParameters(const ParameterExport& asked)
{
    const Source source = loadSource(asked);
    const bool hasShaded = std::any_of(source.surface.normals.confidence.begin(),
                                       source.surface.normals.confidence.end(), [](float c) { return c > 0; });
    if (source.isSurface && !asked.gltf.empty() && !hasShaded) {
        throw Error(asked.source, "has no normals", "a surface with pixels");
    }
    float scale = 1;
    const std::vector<std::unique_ptr<Fitted>> all = materialsOf(asked, source, scale);
    const bool needsBoth = !asked.balls.empty();
    for (const auto& fitted : all) {
        if (needsBoth || !asked.gltf.empty()) {
            fitted->gltf = fitAs(asked, *fitted, ExchangeFormat::gltf);
        }
        if (needsBoth || !asked.materialX.empty()) {
            fitted->standardSurface = fitAs(asked, *fitted, ExchangeFormat::standardSurface);
        }
    }
    if (!asked.gltf.empty()) {
        saveGltf(asked, source, all, scale);
    }
    if (!asked.materialX.empty()) {
        std::vector<MaterialXMaterial> materials;
        for (const auto& fitted : all) {
            materials.push_back(
                {fitted->material.name, fitted->standardSurface->shape, fitted->standardSurface->colours});
        }
        writeTextFile(asked.materialX, materialXText(materials, scale));
    }
    if (!asked.balls.empty()) {
        saveBalls(asked, all);
    }
}

Image exportedHeight(const Surface& surface, int threads)
{
    return surface.height.values.empty() ? heightFromNormals(surface.normals, {.threads = threads}).height
                                         : surface.height;
}

} // namespace nacre
