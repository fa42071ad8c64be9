#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "acquisition/capture/capture_maps.h"
#include "app/arguments/capture_arguments.h"
#include "app/arguments/destinations.h"
#include "app/commands/commands.h"
#include "engine/files/error.h"
#include "engine/files/image.h"
#include "engine/files/measures.h"

namespace nacre {

namespace {

constexpr int kCodeTolerance = 4; // of 255

struct CompareArguments {
    std::filesystem::path picture;
    std::filesystem::path reference;
    std::filesystem::path mask;
    std::filesystem::path json;
    std::string transfer;
    bool force = false;
    double peak = 0;
    double atLeast = 0;
    int codeTolerance = kCodeTolerance;
    double ssimAtLeast = -1;
};

struct Comparison {
    double peak = 0;                 // radiance that counts as 1
    double psnr = 0;                 // dB of radiance
    double structuralSimilarity = 0; // of 8-bit codes, as the difference below
    CodeDifference codes;
};

// A choice is for what the file does not declare: a render that is compared with a photograph says that it is linear.
Image loadForComparison(const std::filesystem::path& file, const std::string& transfer)
{
    const ImageHeader header = readImageHeader(file);
    const bool isChosen = !transfer.empty() && !header.curveIsDeclared && header.pixelType.starts_with("uint");
    return loadPhotograph(file, isChosen ? curveFromName(transfer) : header.curve);
}

bool holdsCodes(const std::filesystem::path& file)
{
    return readImageHeader(file).pixelType.starts_with("uint");
}

// What the eye compares. Two files of integers are taken as they are; else radiance up to `peak` is shown as sRGB.
Image codesOf(const Image& radiance, const std::filesystem::path& file, bool asStored, double peak)
{
    return asStored ? loadImage(file)
                    : displayedImage(radiance, {.exposureStops = static_cast<float>(-std::log2(peak))});
}

Comparison compare(const CompareArguments& arguments)
{
    const Image picture = loadForComparison(arguments.picture, arguments.transfer);
    const Image reference = loadForComparison(arguments.reference, arguments.transfer);
    if (picture.width != reference.width || picture.height != reference.height) {
        throw Error(
            arguments.picture, fmt::format("is {}x{}", picture.width, picture.height),
            fmt::format("{}x{}, the size of {}", reference.width, reference.height, arguments.reference.string()));
    }
    const std::vector<uint8_t> mask = arguments.mask.empty()
                                          ? std::vector<uint8_t>(reference.pixelCount(), 1)
                                          : loadMask(arguments.mask, reference.width, reference.height).inside;
    Comparison found;
    found.peak = arguments.peak > 0 ? arguments.peak : peakOf(reference, mask);
    if (std::none_of(reference.values.begin(), reference.values.end(), [](float v) { return v > 0; })) {
        throw Error(arguments.reference, "is black", "a picture with light in it");
    }
    found.psnr = radiancePsnr(picture, reference, mask, found.peak);
    const bool asStored = holdsCodes(arguments.picture) && holdsCodes(arguments.reference);
    const Image codes = codesOf(picture, arguments.picture, asStored, found.peak);
    const Image referenceCodes = codesOf(reference, arguments.reference, asStored, found.peak);
    found.structuralSimilarity = structuralSimilarity(codes, referenceCodes, mask);
    found.codes = codeDifference(codes, referenceCodes, mask, arguments.codeTolerance);
    return found;
}

void writeJson(const CompareArguments& arguments, const Comparison& found)
{
    const nlohmann::json json = {{"radiancePsnr", found.psnr},
                                 {"peak", found.peak},
                                 {"structuralSimilarity", found.structuralSimilarity},
                                 {"largestCodeDifference", found.codes.largest},
                                 {"codeTolerance", arguments.codeTolerance},
                                 {"shareBeyondTolerance", found.codes.share()}};
    writeSummary(arguments.json, json);
}

Error checkFailed(const CompareArguments& arguments, const std::string& figure, const std::string& expected)
{
    return Error(arguments.picture, figure, expected, Error::kCheckFailed);
}

void runCompare(const CompareArguments& arguments)
{
    if (arguments.codeTolerance < 0) {
        throw Error("", fmt::format("--code-tolerance {} is not possible", arguments.codeTolerance), "0 to 255",
                    Error::kUsage);
    }
    if (!arguments.transfer.empty()) {
        curveFromName(arguments.transfer);
    }
    requireSummary(arguments.json, arguments.force);
    const Comparison found = compare(arguments);
    fmt::print("PSNR {:.2f} dB of radiance, peak {:.4g}\n", found.psnr, found.peak);
    fmt::print("SSIM {:.5f}; codes differ by {} of 255 at most, {:.3f} % of the pixels by more than {}\n",
               found.structuralSimilarity, found.codes.largest, 100 * found.codes.share(), arguments.codeTolerance);
    writeJson(arguments, found);
    if (found.psnr < arguments.atLeast) {
        throw checkFailed(arguments, fmt::format("PSNR {:.2f} dB", found.psnr),
                          fmt::format("at least {:.2f} dB", arguments.atLeast));
    }
    if (found.structuralSimilarity < arguments.ssimAtLeast) {
        throw checkFailed(arguments, fmt::format("SSIM {:.5f}", found.structuralSimilarity),
                          fmt::format("at least {:.5f}", arguments.ssimAtLeast));
    }
}

} // namespace

void addCompareCommand(CLI::App& app)
{
    auto arguments = std::make_shared<CompareArguments>();
    CLI::App* command = app.add_subcommand(
        "compare", "How far a picture is from a reference: PSNR of radiance, SSIM and codes of what the eye sees");
    command->add_option("PICTURE", arguments->picture, "Picture to judge, of linear radiance: .exr of nacre render")
        ->required();
    command->add_option("REFERENCE", arguments->reference, "Picture to compare with")->required();
    command->add_option("--mask", arguments->mask, "Picture that is white where to compare");
    command
        ->add_option("--transfer", arguments->transfer,
                     "Transfer curve of pictures of integers that declare none (default: sRGB for JPEG, else linear)")
        ->option_text("linear|srgb");
    command->add_option("--peak", arguments->peak,
                        "Radiance that counts as 1 (default: 99th percentile of the reference)");
    command->add_option("--at-least", arguments->atLeast, "Least PSNR in dB, below which the exit code is 1");
    command->add_option("--code-tolerance", arguments->codeTolerance,
                        "Largest difference, in codes of 255, of pixels that are not counted [4]");
    command->add_option("--ssim-at-least", arguments->ssimAtLeast,
                        "Least structural similarity, below which the exit code is 1");
    command->add_option("--json", arguments->json, "File for the figures as JSON")->option_text("OUT.json");
    command->add_flag("--force", arguments->force, "Replacement of an existing output");
    command->footer("Example:\n  nacre compare render.exr horse.4.tga --mask horse.mask.tga --at-least 20");
    command->callback([arguments] { runCompare(*arguments); });
}

} // namespace nacre
