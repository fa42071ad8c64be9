#include "app/page/page_export.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/trigonometric.hpp>

#include "app/materials/transfer_sources.h"
#include "app/page/page_photographs.h"
#include "app/page/page_tables.h"
#include "engine/files/error.h"
#include "engine/files/measures.h"
#include "engine/files/text_files.h"
#include "engine/page/held_by_page.h"
#include "engine/page/page_shape.h"
#include "engine/scene/reference.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

constexpr int kMostSide = 2048; // pixels of a shape: 32-bit telephones hold the arrays of 4 megapixels
constexpr int kOntoSide = 384;  // pixels of the other shapes
constexpr int kMostPagePhotographs = 24;
constexpr int kJudgedSide = 192; // pixels of the pictures that tell what the page costs
constexpr size_t kJudgedLights = 6;
constexpr size_t kNoteBytes = 4096; // of what the page says of itself

// Every so many pixels alone, where there are more than a page should have.
Surface downscaled(Surface surface, const std::string& name, int mostSide, std::vector<std::string>& warnings)
{
    if (std::max(surface.normals.width, surface.normals.height) <= mostSide) {
        return surface;
    }
    const double share = double(mostSide) / std::max(surface.normals.width, surface.normals.height);
    const auto side = [&](int pixels) { return std::max(1, static_cast<int>(std::lround(share * pixels))); };
    const int width = side(surface.normals.width), height = side(surface.normals.height);
    warnings.push_back(fmt::format("{} has {}x{} pixels: the page has every {:.2f}th, {}x{}", name,
                                   surface.normals.width, surface.normals.height, 1 / share, width, height));
    return fittedSurface(surface, width, height);
}

// ---- what is left out where bytes are few

HorizonMap everySecondAzimuth(const HorizonMap& map)
{
    HorizonMap half(map.width, map.height, map.azimuths / 2);
    for (int azimuth = 0; azimuth < half.azimuths; ++azimuth) {
        std::copy_n(&map.codes[2 * azimuth * map.pixelCount()], map.pixelCount(),
                    &half.codes[azimuth * map.pixelCount()]);
    }
    return half;
}

// How much of radiance over irradiance one code of each component is, under the captured light that it matters most
// for.
std::vector<float> codeStrengths(const ResidualLayer& layer)
{
    std::vector<float> strengths(layer.components, 0.0f);
    const ResidualLights captured(layer);
    for (const glm::vec3& node : layer.nodes) {
        const ResidualLight light = captured.at(node);
        for (int k = 0; k < layer.components; ++k) {
            const glm::vec3 weight = glm::abs(light.weights[k]);
            const float strength = std::max({weight.x, weight.y, weight.z}) * (layer.high[k] - layer.low[k]) / 255;
            strengths[k] = std::max(strengths[k], strength);
        }
    }
    return strengths;
}

// The layer rounded to steps of so much radiance over irradiance, the same for all components: what is weaker goes,
// what is stronger stays (reverse water-filling: Cover, Thomas, Elements of Information Theory, 2006, 10.3.3).
ResidualLayer roundedLayer(const ResidualLayer& layer, float step)
{
    ResidualLayer rounded = layer;
    const std::vector<float> strengths = codeStrengths(layer);
    for (int k = 0; k < layer.components; ++k) {
        const float codes = std::max(1.0f, std::floor(step / std::max(strengths[k], 1e-12f)));
        const float zero = -255 * layer.low[k] / std::max(layer.high[k] - layer.low[k], 1e-12f);
        const size_t first = k / kComponentsPerTexel * layer.pixelCount();
        for (size_t pixel = 0; pixel < layer.pixelCount(); ++pixel) {
            uint8_t& code = rounded.codes[(first + pixel) * kComponentsPerTexel + k % kComponentsPerTexel];
            const float value = zero + codes * std::round((static_cast<float>(code) - zero) / codes);
            code = static_cast<uint8_t>(std::lround(std::clamp(value, 0.0f, 255.0f)));
        }
    }
    return rounded;
}

// What of an object a page leaves out where its bytes are few.
struct Savings {
    int azimuths = 0; // of the horizons, that are kept
    float step = 0;   // of the residual layer (roundedLayer); 0: as stored, infinite: no layer

    Surface of(const Surface& own) const
    {
        Surface object = own;
        while (object.horizon.azimuths > azimuths) {
            object.horizon = azimuths == 0 ? HorizonMap() : everySecondAzimuth(object.horizon);
        }
        if (step > 0 && !own.residual.empty()) {
            object.residual = std::isinf(step) ? ResidualLayer() : roundedLayer(own.residual, step);
        }
        return object;
    }
};

std::vector<Light> judgedLights(const Surface& surface)
{
    std::vector<Light> lights;
    const size_t count = std::min(kJudgedLights, surface.lights.size());
    for (size_t i = 0; i < count; ++i) {
        lights.push_back(surface.lights[i * surface.lights.size() / count].light);
    }
    return lights.empty() ? std::vector<Light>{{glm::normalize(glm::vec3(-0.4f, 0.5f, 0.8f))}} : lights;
}

// Of the surface under its captured lights.
float peakOverIrradiance(const Surface& surface)
{
    Scene scene{fittedSurface(surface, kJudgedSide, kJudgedSide), {}};
    float largest = 0;
    for (const Light& light : judgedLights(surface)) {
        scene.lights = {light};
        const Frame frame = renderReference(scene);
        const glm::vec3& e = light.irradiance;
        largest = std::max(largest, std::exp2(-automaticExposure(frame)) / std::max({e.x, e.y, e.z, 1e-12f}));
    }
    return largest;
}

// dB of the page's pictures against the surface's own, both from the front under captured lights.
double decibelsOf(const Surface& page, const Surface& own)
{
    Scene shown{fittedSurface(page, kJudgedSide, kJudgedSide), {}},
        truth{fittedSurface(own, kJudgedSide, kJudgedSide), {}};
    std::vector<uint8_t> mask;
    for (size_t i = 0; i < truth.surface.labels.size(); ++i) {
        mask.push_back(isShaded(truth.surface, i) ? 1 : 0);
    }
    double squares = 0;
    const std::vector<Light> lights = judgedLights(own);
    for (const Light& light : lights) {
        shown.lights = truth.lights = {light};
        const Frame frame = renderReference(truth);
        squares += std::pow(10, -0.1 * radiancePsnr(renderReference(shown), frame, mask, peakOf(frame, mask)));
    }
    return -10 * std::log10(std::max(squares / static_cast<double>(lights.size()), 1e-12));
}

std::string textOf(double decibels)
{
    return decibels >= 99 ? "exactly" : fmt::format("to {:.1f} dB", decibels);
}

size_t bytesOf(const std::vector<PageParts::Share>& shares, const std::string& kind)
{
    const auto found =
        std::find_if(shares.begin(), shares.end(), [&](const auto& share) { return share.kind == kind; });
    return found == shares.end() ? 0 : found->bytes;
}

constexpr const char* kLayer = "residual layer";
constexpr const char* kShadows = "cast shadows";

// Savings of one of the two alone, with the bytes that are left of it.
struct SizedSavings {
    Savings savings;
    size_t bytes = 0;
};

std::vector<SizedSavings> sized(const Surface& own, const std::vector<Savings>& savings, const char* kind)
{
    std::vector<SizedSavings> all;
    for (const Savings& saving : savings) {
        PageParts parts;
        describeShape("", saving.of(own), {true, false}, parts);
        all.push_back({saving, bytesOf(parts.shares(), kind)});
    }
    return all;
}

// From all directions to none.
std::vector<Savings> horizonSavings(const Surface& own)
{
    std::vector<Savings> savings;
    for (int azimuths = own.horizon.azimuths; azimuths >= 8; azimuths /= 2) {
        savings.push_back({azimuths, std::numeric_limits<float>::infinity()});
    }
    savings.push_back({0, std::numeric_limits<float>::infinity()});
    return savings;
}

// From the layer as stored to none.
std::vector<Savings> layerSavings(const Surface& own)
{
    constexpr float kFirstStep = 1.0f / 1024, kLastStep = 0.1f, kCoarser = 1.41421356f; // of the peak
    const float peak = peakOverIrradiance(own);
    std::vector<Savings> savings = {{0, 0}};
    for (float share = kFirstStep; share < kLastStep && !own.residual.empty(); share *= kCoarser) {
        savings.push_back({0, share * peak});
    }
    savings.push_back({0, std::numeric_limits<float>::infinity()});
    return savings;
}

// The savings that are enough for `bytes` of layer and shadows together and cost least; none where nothing is enough.
std::optional<Savings> bestSavings(const Surface& own, size_t bytes)
{
    const std::vector<SizedSavings> layers = sized(own, layerSavings(own), kLayer);
    std::optional<Savings> best;
    double most = 0;
    for (const SizedSavings& horizon : sized(own, horizonSavings(own), kShadows)) {
        const auto layer = std::find_if(layers.begin(), layers.end(), [&](const SizedSavings& sizedLayer) {
            return sizedLayer.bytes + horizon.bytes <= bytes;
        });
        if (layer == layers.end()) {
            continue;
        }
        const Savings both{horizon.savings.azimuths, layer->savings.step};
        const double decibels = decibelsOf(both.of(own), own);
        if (!best || decibels > most) {
            best = both;
            most = decibels;
        }
    }
    return best;
}

// The object with fewer details where all are too much for the budget (0: none is set).
void fitInto(PageContent& content, size_t budget)
{
    if (budget == 0) {
        return;
    }
    const PageText text = makePage(content);
    if (text.html.size() <= budget) {
        return;
    }
    const size_t rest = text.html.size() - bytesOf(text.shares, kLayer) - bytesOf(text.shares, kShadows);
    const std::optional<Savings> savings =
        rest < budget ? bestSavings(content.object, budget - rest) : std::optional<Savings>();
    if (!savings) {
        throw Error("", fmt::format("--budget-bytes {} is too little", budget),
                    fmt::format("{} or more; --size, fewer shapes or photographs make a page smaller", rest),
                    Error::kUsage);
    }
    content.object = savings->of(content.object);
}

std::string describeLeftOut(const Surface& page, const Surface& own)
{
    std::vector<std::string> left;
    if (page.residual.empty() && !own.residual.empty()) {
        left.push_back("the residual layer");
    } else if (page.residual.codes != own.residual.codes) {
        left.push_back("what is weak in the residual layer");
    }
    if (page.horizon.azimuths < own.horizon.azimuths) {
        left.push_back(page.horizon.empty()
                           ? "cast shadows"
                           : fmt::format("{} of {} directions of cast shadows",
                                         own.horizon.azimuths - page.horizon.azimuths, own.horizon.azimuths));
    }
    return fmt::format("{}", fmt::join(left, " and "));
}

// ---- what the page says of itself

std::string describeLights(const Surface& surface)
{
    float least = 90, most = 0;
    bool areNear = false;
    for (const CapturedLight& captured : surface.lights) {
        const float polar = glm::degrees(std::acos(std::clamp(captured.light.direction.z, -1.0f, 1.0f)));
        least = std::min(least, polar), most = std::max(most, polar);
        areNear = areNear || isNear(captured.light);
    }
    return fmt::format(
        "{} photographs from one place, each under one light, {:.0f} to {:.0f} degrees from the camera{}",
        surface.lights.size(), least, most, areNear ? "; the lights stood near the object" : "");
}

std::string describeLeftOutError(const Surface& surface)
{
    return surface.leftOutDecibels
               ? fmt::format("{:.1f} dB PSNR of photographs that the measurement did not see, mean over them",
                             *surface.leftOutDecibels)
               : "not known for this surface";
}

std::vector<PageNote> notesOf(const Surface& own, const Surface& page, const std::string& left, double decibels)
{
    std::vector<PageNote> notes;
    if (!own.lights.empty()) {
        notes.push_back({"Photographs", describeLights(own)});
    }
    notes.push_back({"Held-out error", describeLeftOutError(own)});
    notes.push_back({"Scale", own.scale == RadianceScale::absolute
                                  ? "absolute: reflectance in 1/sr"
                                  : "relative: reflectance up to one factor for the whole object"});
    notes.push_back({"Pixels", fmt::format("{} x {}", own.normals.width, own.normals.height)});
    if (!page.residual.empty()) {
        notes.push_back(
            {"Residual layer", fmt::format("{} pictures that are added for what the material does not explain "
                                           "(light from the object to itself, faults of normals), near "
                                           "the lights of the photographs (dots on the ball)",
                                           page.residual.components)});
    }
    if (!page.horizon.empty()) {
        notes.push_back(
            {"Cast shadows", fmt::format("by the object's height, from {} directions", page.horizon.azimuths)});
    }
    if (!left.empty()) {
        notes.push_back({"Left out for size", left});
    }
    notes.push_back({"This page", fmt::format("agrees with the full measurement {}", textOf(decibels))});
    notes.push_back({"Made by", "Nacre, image-based measurement of reflectance"});
    return notes;
}

std::string nameOf(const fs::path& folder)
{
    const fs::path path = folder.has_filename() ? folder : folder.parent_path();
    return path.stem().string();
}

TransferArguments transferArgumentsOf(const PageArguments& arguments)
{
    TransferArguments transfer;
    transfer.materials = arguments.materials;
    transfer.targets = arguments.onto;
    transfer.fits = arguments.fits;
    transfer.size = fmt::format("{0}x{0}", kOntoSide);
    transfer.enlarges = false;
    transfer.device = arguments.device;
    transfer.threads = arguments.threads;
    transfer.shadows = arguments.shadows;
    return transfer;
}

void addShapes(const PageArguments& arguments, std::vector<PageShape> shapes, SurfacePage& page, PageContent& content)
{
    for (TransferTarget& target : loadTransferTargets(transferArgumentsOf(arguments), page.warnings)) {
        shapes.push_back({target.name, std::move(target.surface)});
    }
    for (PageShape& shape : shapes) {
        const auto& confidence = shape.surface.normals.confidence;
        if (std::none_of(confidence.begin(), confidence.end(), [](float c) { return c > 0; })) {
            throw Error(shape.name, "has no normals", "a shape that is seen");
        }
        content.shapes.push_back(
            {shape.name, heldByPage(downscaled(std::move(shape.surface), shape.name, kOntoSide, page.warnings))});
    }
}

void addMaterials(const PageArguments& arguments, double tolerance, SurfacePage& page, PageContent& content)
{
    const auto held = [&](Material material) {
        PageTable table = tableForPage(std::move(material), tolerance, arguments.threads);
        page.lines.push_back(fmt::format("material     {}: {}", table.material.name, table.description));
        return std::move(table.material);
    };
    for (Material& material : content.object.materials) {
        material = held(std::move(material));
    }
    for (TransferRow& row : loadTransferRows(transferArgumentsOf(arguments))) {
        content.materials.push_back(held(std::move(row.materials.front())));
    }
}

void describeBytes(const PageText& text, std::vector<std::string>& lines)
{
    for (const PageParts::Share& share : text.shares) {
        lines.push_back(fmt::format("{:>9.1f} KiB {}", static_cast<double>(share.bytes) / 1024, share.kind));
    }
}

} // namespace

void PageArguments::addTo(CLI::App& command)
{
    const char* group = "A page for a browser";
    command.add_option("--page", file, "One page for a browser to write")->option_text("OUT.html")->group(group);
    command
        .add_option("--onto", onto,
                    "More shapes of the page, as nacre transfer takes them: make:NAME, mesh, NAME.nacre, ...")
        ->allow_extra_args(false)
        ->group(group);
    command.add_option("--materials", materials, "More materials of the page, as nacre transfer takes them")
        ->allow_extra_args(false)
        ->group(group);
    command.add_option("--photographs", photographs, "Number of photographs to compare with, of --capture")
        ->group(group);
    command.add_option("--capture", capture, "Capture that the surface was measured from")->group(group);
    command
        .add_option("--tolerance", size.tolerance,
                    "Least PSNR of each material's table against its own: the smallest that has it is taken")
        ->capture_default_str()
        ->group(group);
    command
        .add_option(
            "--budget-bytes", size.budget,
            "Most bytes of the page, e.g. 1MiB: less of the residual layer and of cast shadows where it is over")
        ->group(group);
    command
        .add_option("--fits", fits, "Folder of merl_abc_params.csv and merl_sgd_params.csv (default: $NACRE_FITS_DIR)")
        ->group(group);
}

void PageArguments::check() const
{
    const auto require = [](bool isFine, const std::string& wrong, const char* expected) {
        if (!isFine) {
            throw Error("", wrong, expected, Error::kUsage);
        }
    };
    const bool hasMore =
        !onto.empty() || !materials.empty() || photographs != 0 || !capture.empty() || !size.budget.empty();
    require(!file.empty() || !hasMore, "there is no page that these options could belong to",
            "--page FILE.html with them");
    require(file.empty() || lowerExtension(file) == ".html" || lowerExtension(file) == ".htm",
            fmt::format("--page {} is no such file", file.string()), "NAME.html");
    require(photographs >= 0 && photographs <= kMostPagePhotographs,
            fmt::format("--photographs {} is out of range", photographs), "0 to 24");
    require((photographs > 0) == !capture.empty(), "photographs and their capture go together",
            "--photographs 6 --capture FOLDER, or neither");
    size.options(threads);
}

SurfacePage pageOfSurface(const PageArguments& arguments, const fs::path& folder, Surface surface,
                          std::vector<PageShape> shapes)
{
    if (surface.materials.empty()) {
        throw Error(folder, "is a target without a material", "a surface of nacre acquire to make a page of");
    }
    const LadderOptions size = arguments.size.options(arguments.threads);
    SurfacePage page;
    PageContent content;
    content.title = nameOf(folder);
    if (arguments.photographs > 0) {
        if (std::max(surface.normals.width, surface.normals.height) > kMostSide) {
            throw Error(folder, "is too large to stand beside its photographs", "--size, or no --photographs");
        }
        content.photographs = photographsForPage(arguments.capture, folder, surface, arguments.photographs);
    }
    const Surface own = downscaled(std::move(surface), content.title, kMostSide, page.warnings);
    content.object = own;
    addMaterials(arguments, size.toleranceDecibels, page, content);
    content.object = heldByPage(std::move(content.object));
    addShapes(arguments, std::move(shapes), page, content);
    // The notes, which tell what was left out, are written last.
    fitInto(content, size.budgetBytes == 0 ? 0 : std::max<size_t>(size.budgetBytes, kNoteBytes + 1) - kNoteBytes);
    const std::string left = describeLeftOut(content.object, own);
    const double decibels = decibelsOf(content.object, own);
    content.notes = notesOf(own, content.object, left, decibels);
    page.text = makePage(content);
    describeBytes(page.text, page.lines);
    page.lines.push_back(fmt::format("agrees with the full measurement {}{}{}", textOf(decibels),
                                     left.empty() ? "" : "; left out for size: ", left));
    return page;
}

} // namespace nacre
