#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <nlohmann/json.hpp>

#include "acquisition/exchange/rgl_file.h"
#include "app/arguments/destinations.h"
#include "app/commands/commands.h"
#include "app/report/brdf_report.h"
#include "app/report/contact_sheet.h"
#include "engine/brdf/brdf_comparison.h"
#include "engine/brdf/brdf_tabulation.h"
#include "engine/files/error.h"
#include "engine/files/measures.h"
#include "engine/files/parallel_for.h"
#include "engine/files/text_files.h"
#include "engine/files/whole_file.h"
#include "engine/materials/ktx2_file.h"
#include "engine/materials/material_specification.h"
#include "engine/materials/merl_file.h"
#include "engine/scene/ball.h"
#include "engine/scene/coverage.h"

namespace nacre {
namespace {

constexpr const char* kPictures[] = {"slices.png", "sphere.png"};
constexpr int kSliceSize = 270; // pixels: three a degree of thetaD
constexpr int kBrdfBallSize = 270;
constexpr float kBrighterStops = 3;
constexpr float kDecades = 4; // that a slice shows below its peak
constexpr float kHorizonGrey = 0.25f;
constexpr glm::vec3 kAxis(0, 0, 1);

// The rectangle of coordinates that a slice shows.
HalfDifference coordinatesOf(int x, int y, float phiD)
{
    HalfDifference c =
        halfDifferenceFromUnit({x / (kSliceSize - 1.0f), y / (kSliceSize - 1.0f), 0}, {kHalfDifference, kHalfPi});
    c.phiD = phiD;
    return c;
}

bool isBelowHorizon(const HalfDifference& c)
{
    const LightView d = directionsFromHalfDifference(c);
    return d.l.z <= 0 || d.v.z <= 0;
}

glm::vec3 logarithmic(const glm::vec3& f, float peak)
{
    glm::vec3 display;
    for (int c = 0; c < 3; ++c) {
        display[c] = f[c] > 0 ? std::clamp(1 + std::log10(f[c] / peak) / kDecades, 0.0f, 1.0f) : 0.0f;
    }
    return display;
}

Image slicePicture(const BrdfModel& model, float phiD, float peak, int threads)
{
    Image picture(kSliceSize, kSliceSize, 3);
    const BrdfTable* table = tableOf(model);
    parallelFor(kSliceSize, 8, threads, [&](size_t first, size_t last) {
        for (int y = static_cast<int>(first); y < static_cast<int>(last); ++y) {
            for (int x = 0; x < kSliceSize; ++x) {
                const HalfDifference c = coordinatesOf(x, y, phiD);
                const BrdfValue f = foldedValue(model, c);
                const LightView d = directionsFromHalfDifference(c);
                const bool hatched = (x + y) % 8 < 2;
                if (isBelowHorizon(c)) {
                    picture.setRgb(x, y, glm::vec3(kHorizonGrey));
                } else if (table && hatched && expectedError(*table, kAxis, d.l, d.v) > kUncertainError) {
                    picture.setRgb(x, y, {0.6f, 0.1f, 0.5f});
                } else {
                    picture.setRgb(x, y, logarithmic(f.value, peak));
                }
            }
        }
    });
    return picture;
}

// Of a few thousand configurations; the highlight's own peak, thetaH = 0, is among them.
float largestValue(const BrdfModel& model)
{
    float peak = 0;
    const auto include = [&](const BrdfValue& f) {
        if (f.confidence >= kCoveredConfidence) {
            peak = std::max({peak, f.value.x, f.value.y, f.value.z});
        }
    };
    for (int degrees = 0; degrees < 80; ++degrees) {
        include(foldedValue(model, {0, glm::radians(static_cast<float>(degrees)), 0}));
    }
    for (const LightView& d : comparisonConfigurations(5000)) {
        include(evaluateCovered(model, kAxis, d.l, d.v));
    }
    return peak > 0 ? peak : 1;
}

Image ballRadiance(const BrdfModel& model, float lightDegrees, int threads)
{
    const float angle = glm::radians(lightDegrees);
    const glm::vec3 upperLeft = glm::normalize(glm::vec3(-1, 0.6f, 0));
    const Light light{std::sin(angle) * upperLeft + std::cos(angle) * kAxis};
    return materialBall(model, {&light, 1}, kBrdfBallSize, threads);
}

Image slicesSheet(const BrdfModel& model, int threads)
{
    const float peak = largestValue(model);
    std::vector<SheetCell> row;
    for (int degrees : {0, 45, 90}) {
        row.push_back({slicePicture(model, glm::radians(static_cast<float>(degrees)), peak, threads),
                       fmt::format("phiD {}, {} decades to {:.4g}/sr", degrees, kDecades, peak)});
    }
    return contactSheet({row}, kSliceSize, kSliceSize);
}

// The ball of the light that is nearest to the view sets the exposure of the first row; the second shows what a
// highlight leaves dark.
Image ballsSheet(const BrdfModel& model, int threads)
{
    std::vector<std::vector<SheetCell>> rows(2);
    float stops = 0;
    for (int degrees : {20, 50, 80, 110}) {
        const Image radiance = ballRadiance(model, static_cast<float>(degrees), threads);
        stops = rows[0].empty() ? std::round(automaticExposure(radiance) * 10) / 10 + 0.0f : stops; // no -0.0
        for (int r = 0; r < 2; ++r) {
            const float shown = stops + kBrighterStops * static_cast<float>(r);
            rows[r].push_back({displayedImage(radiance, {.exposureStops = shown}),
                               fmt::format("light {} degrees, {:.1f} stops", degrees, shown)});
        }
    }
    return contactSheet(rows, kBrdfBallSize, kBrdfBallSize);
}

// slices.png: f over thetaH (right, 0 to 90 degrees, square root) and thetaD (down) for several phiD, on a logarithmic
// scale from 1e-4 of the peak; grey where light or view is below the horizon, hatched where f is uncertain
// (coverage.h). sphere.png: a ball of the material under lights at several angles from the view, all exposed alike, and
// the same three stops brighter. `folder` is made.
void saveBrdfPictures(const std::filesystem::path& folder, const BrdfSource& source, int threads)
{
    std::filesystem::create_directories(folder);
    saveImage(folder / kPictures[0], slicesSheet(source.model, threads), PixelType::uint8);
    saveImage(folder / kPictures[1], ballsSheet(source.model, threads), PixelType::uint8);
}

struct BrdfArguments {
    std::string source;
    std::string against;
    std::filesystem::path fits;
    std::filesystem::path pictures;
    std::vector<std::filesystem::path> exports;
    std::filesystem::path json;
    int threads = 0;
    bool force = false;
    bool quiet = false;
};

constexpr const char* kExample =
    "Example:\n"
    "  nacre brdf horse.nacre -o horse-brdf\n"
    "  nacre brdf alum-bronze.binary --against merl-abc:alum-bronze --fits FOLDER\n"
    "  nacre brdf paper_white_rgb.bsdf --export paper.binary --export paper.ktx2\n"
    "Materials: NAME.nacre[#MATERIAL]  FILE.binary (MERL)  FILE.bsdf (RGL, isotropic RGB)  FILE.exr (Nacre's table)\n"
    "  FILE.brdf (Cornell's scattered measurements)  lambert:R,G,B  ggx:diffuse=R,G,B;specular=R,G,B;alpha=A\n"
    "  merl-abc:NAME  merl-sgd:NAME";

// Refuses what cannot be written before any work is done.
void checkArguments(const BrdfArguments& arguments)
{
    for (const std::filesystem::path& file : arguments.exports) {
        const std::string extension = lowerExtension(file);
        if (extension != ".binary" && extension != ".ktx2" && extension != ".bsdf" && extension != ".exr") {
            throw Error(file, "is no file that --export writes", ".binary (MERL), .bsdf (RGL), .ktx2 or .exr",
                        Error::kUsage);
        }
        requireFile(file, arguments.force);
    }
    requireSummary(arguments.json, arguments.force);
    requirePictureFolder(arguments.pictures, arguments.force);
    if (arguments.threads < 0) {
        throw Error("", fmt::format("--threads {} is not possible", arguments.threads), "1 or more, or 0 for all",
                    Error::kUsage);
    }
}

void exportTo(const std::filesystem::path& file, const BrdfSource& source, const BrdfArguments& arguments)
{
    std::string note;
    if (lowerExtension(file) == ".binary") {
        saveMerl(file, source.model, arguments.threads);
    } else if (lowerExtension(file) == ".bsdf") {
        saveRgl(file, source.model, source.name, arguments.threads);
    } else if (lowerExtension(file) == ".exr") {
        saveBrdfTable(file, tableOfSource(source, arguments.threads));
    } else if (const size_t clamped = saveKtx2(file, tableOfSource(source, arguments.threads)); clamped > 0) {
        note = fmt::format(" ({} values beyond 16 bits clamped to 65504)", clamped);
    }
    if (!arguments.quiet) {
        fmt::print("wrote        {}{}\n", file.string(), note);
    }
}

void runScattered(const BrdfArguments& arguments)
{
    if (!arguments.against.empty() || !arguments.exports.empty() || !arguments.pictures.empty()) {
        throw Error(arguments.source, "holds scattered measurements, no BRDF between them",
                    "no --against, --export or -o with a .brdf", Error::kUsage);
    }
    const ScatteredReport report = examineScattered(arguments.source, arguments.threads);
    if (!arguments.quiet) {
        print(report);
    }
    writeSummary(arguments.json, jsonOf(report));
}

void runBrdf(const BrdfArguments& arguments)
{
    checkArguments(arguments);
    if (lowerExtension(arguments.source) == ".brdf") {
        return runScattered(arguments);
    }
    const std::filesystem::path fits = fitsFolderFrom(arguments.fits);
    BrdfReport report{loadBrdfSource(arguments.source, fits), {}, {}, {}};
    const BrdfFunction f = functionOf(report.source.model);
    if (!arguments.against.empty()) {
        const BrdfSource other = loadBrdfSource(arguments.against, fits);
        report.against = other.name;
        report.comparison = compareBrdfs(f, functionOf(other.model));
        if (report.comparison->configurations == 0) {
            throw Error(arguments.against, "covers nothing that " + arguments.source + " covers",
                        "materials with a common domain");
        }
    }
    report.audit = auditBrdf(f, arguments.threads);
    if (!arguments.quiet) {
        print(report);
    }
    if (!arguments.pictures.empty()) {
        saveBrdfPictures(arguments.pictures, report.source, arguments.threads);
    }
    for (const std::filesystem::path& file : arguments.exports) {
        exportTo(file, report.source, arguments);
    }
    writeSummary(arguments.json, jsonOf(report));
}

} // namespace

void addBrdfCommand(CLI::App& app)
{
    auto arguments = std::make_shared<BrdfArguments>();
    CLI::App* command = app.add_subcommand("brdf", "Audit, pictures, comparison and conversion of a material");
    command->add_option("MATERIAL", arguments->source, "File, surface or model; see below")->required();
    command->add_option("--against", arguments->against, "Material to compare with, like MATERIAL");
    command->add_option("--fits", arguments->fits,
                        "Folder of merl_abc_params.csv and merl_sgd_params.csv (default: $NACRE_FITS_DIR)");
    command->add_option("-o,--output", arguments->pictures, "Folder for slices.png and sphere.png")->option_text("OUT");
    command
        ->add_option(
            "--export", arguments->exports,
            "File to write: .binary (MERL), .bsdf (RGL, as Mitsuba's `measured` reads it), .ktx2 (3D texture, 16-bit "
            "floats) or .exr (Nacre's table). Repeatable")
        ->option_text("OUT.binary|OUT.bsdf|OUT.ktx2|OUT.exr")
        ->allow_extra_args(false);
    command->add_option("--json", arguments->json, "File for the figures as JSON")->option_text("OUT.json");
    command->add_option("--threads", arguments->threads, "Number of threads (default: all)");
    command->add_flag("--force", arguments->force, "Replacement of existing outputs");
    command->add_flag("--quiet", arguments->quiet, "No messages");
    command->footer(kExample);
    command->callback([arguments] { runBrdf(*arguments); });
}

} // namespace nacre
