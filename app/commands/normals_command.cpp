#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/arguments/capture_arguments.h"
#include "app/arguments/destinations.h"
#include "app/commands/commands.h"
#include "app/report/acquisition_summary.h"
#include "app/report/debug_pictures.h"
#include "app/report/plain_verdict.h"
#include "app/report/progress_line.h"
#include "engine/files/error.h"
#include "engine/files/text_files.h"
#include "evaluation/held_out/held_out_measures.h"

namespace nacre {

namespace {

struct NormalsArguments {
    CaptureArguments common;
    std::filesystem::path output;
    std::filesystem::path truth;
};

// Refuses now what it would refuse after the work.
void checkOutputs(const NormalsArguments& arguments)
{
    const std::string extension = lowerExtension(arguments.output);
    if (extension != ".exr" && extension != ".png") {
        throw Error(arguments.output, "is no normal map that normals writes", ".exr (float) or .png (16-bit)",
                    Error::kUsage);
    }
    requireFile(arguments.output, arguments.common.force);
    requireSummary(arguments.common.json, arguments.common.force);
    requirePictureFolder(arguments.common.debugFolder, arguments.common.force);
}

void runNormals(NormalsArguments& arguments)
{
    const CaptureArguments& common = arguments.common;
    AcquireOptions options = common.stageOptions();
    options.estimateDistance = true;
    checkOutputs(arguments);
    const Capture capture = arguments.common.load();
    const NormalEstimate result = estimateCaptureNormals(capture, options, progressLine(common.quiet));
    endProgressLine(common.quiet);
    saveNormalMap(arguments.output, result.normals);
    const Capture given = selectPhotographs(capture, result.given);
    nlohmann::json summary = summaryOf(given, result);
    if (!common.quiet) {
        fmt::print("{}\n\n{}{}{}{}{}", plainVerdict(result), describe(capture), describeGiven(capture, result),
                   describe(given, result.rig), describeNormals(given, result), describe(result.times));
    }
    if (!common.compareRig.empty() && !common.quiet) {
        fmt::print("{}", describeDisagreement(capture, result.given, result.rig, common.compareRig));
    }
    const std::filesystem::path truth = arguments.truth.empty() ? capture.truthNormals : arguments.truth;
    if (!truth.empty()) {
        const AngularError error = errorAgainstTruth(capture, result.normals, truth);
        summary["meanErrorDegrees"] = error.mean;
        summary["medianErrorDegrees"] = error.median;
        summary["percentile95ErrorDegrees"] = error.percentile95;
        if (!common.quiet) {
            fmt::print("error        mean {:.2f}, median {:.2f}, 95th percentile {:.2f} degrees against {} ({} pixels, "
                       "{} without a normal)\n",
                       error.mean, error.median, error.percentile95, truth.string(), error.pixels, error.missing);
        }
    }
    writeSummary(common.json, summary);
    if (!common.debugFolder.empty()) {
        makeDebugFolder(common.debugFolder);
        saveNormalPictures(common.debugFolder, result.normals);
        saveVerdictPictures(common.debugFolder, given, result);
    }
}

} // namespace

void addNormalsCommand(CLI::App& app)
{
    auto arguments = std::make_shared<NormalsArguments>();
    CLI::App* command = app.add_subcommand("normals", "The first half of acquire: photographs to a normal map");
    arguments->common.addTo(*command);
    command->add_option("-o,--output", arguments->output, "Normal map to write, .exr or .png")
        ->option_text("OUT.exr|OUT.png")
        ->required();
    command->add_option(
        "--truth", arguments->truth,
        "True normals to compare with (.mat, .png, .exr); sphere: those of the ball that fills the mask");
    command->footer("Example:\n  nacre normals ballPNG --normals threshold -o ball.exr");
    command->callback([arguments] { runNormals(*arguments); });
}

} // namespace nacre
