#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "acquisition/capture/capture.h"
#include "app/commands.h"
#include "engine/scene/error.h"
#include "engine/scene/image.h"
#include "engine/scene/measures.h"
#include "engine/scene/whole_file.h"

namespace nacre {

namespace {

struct CompareArguments {
    std::filesystem::path picture;
    std::filesystem::path reference;
    std::filesystem::path mask;
    std::filesystem::path json;
    double peak = 0;
    double atLeast = 0;
};

Image loadForComparison(const std::filesystem::path& file)
{
    const ImageHeader header = readImageHeader(file);
    return loadPhotograph(file, header.curveIsDeclared ? header.declaredCurve : TransferCurve::linear);
}

// The brightest 1 % of the reference's mask values are clipped, as everywhere (docs/accuracy.md).
double peakOf(const Image& reference, std::span<const uint8_t> mask)
{
    std::vector<float> values;
    for (int y = 0; y < reference.height; ++y) {
        for (int x = 0; x < reference.width; ++x) {
            if (mask[static_cast<size_t>(y) * reference.width + x]) {
                const glm::vec3 v = reference.rgb(x, y);
                values.insert(values.end(), {v.x, v.y, v.z});
            }
        }
    }
    return values.empty() ? 0 : quantile(values, 0.99);
}

void runCompare(const CompareArguments& arguments)
{
    const Image picture = loadForComparison(arguments.picture);
    const Image reference = loadForComparison(arguments.reference);
    if (picture.width != reference.width || picture.height != reference.height) {
        throw Error(
            arguments.picture, fmt::format("is {}x{}", picture.width, picture.height),
            fmt::format("{}x{}, the size of {}", reference.width, reference.height, arguments.reference.string()));
    }
    const std::vector<uint8_t> mask = arguments.mask.empty()
                                          ? std::vector<uint8_t>(reference.pixelCount(), 1)
                                          : loadMask(arguments.mask, reference.width, reference.height);
    const double peak = arguments.peak > 0 ? arguments.peak : peakOf(reference, mask);
    if (!(peak > 0)) {
        throw Error(arguments.reference, "is black", "a picture with light in it");
    }
    const double psnr = radiancePsnr(picture, reference, mask, peak);
    fmt::print("PSNR {:.2f} dB of radiance, peak {:.4g}\n", psnr, peak);
    if (!arguments.json.empty()) {
        writeTextFile(arguments.json, nlohmann::json{{"radiancePsnr", psnr}, {"peak", peak}}.dump(2) + "\n");
    }
    if (psnr < arguments.atLeast) {
        throw Error(arguments.picture, fmt::format("PSNR {:.2f} dB", psnr),
                    fmt::format("at least {:.2f} dB", arguments.atLeast), Error::kCheckFailed);
    }
}

} // namespace

void addCompareCommand(CLI::App& app)
{
    auto arguments = std::make_shared<CompareArguments>();
    CLI::App* command = app.add_subcommand("compare", "How far a picture is from a reference: PSNR of radiance");
    command
        ->add_option("PICTURE", arguments->picture,
                     "Picture to judge, of linear radiance: render's .exr (its .png is exposed for the eye)")
        ->required();
    command->add_option("REFERENCE", arguments->reference, "Picture that is taken for true")->required();
    command->add_option("--mask", arguments->mask, "Picture that is white where to compare");
    command->add_option("--peak", arguments->peak,
                        "Radiance that counts as 1 (default: the reference's 99th percentile)");
    command->add_option("--at-least", arguments->atLeast, "Exit with 1 below this PSNR in dB");
    command->add_option("--json", arguments->json, "Write the figures to this file too");
    command->footer("Example:\n  nacre compare render.exr horse.4.tga --mask horse.mask.tga --at-least 20");
    command->callback([arguments] { runCompare(*arguments); });
}

} // namespace nacre
