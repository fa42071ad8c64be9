#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/arguments/capture_arguments.h"
#include "app/arguments/destinations.h"
#include "app/arguments/model_arguments.h"
#include "app/commands/commands.h"
#include "app/report/acquire_report.h"
#include "app/report/acquisition_summary.h"
#include "app/report/debug_pictures.h"
#include "app/report/plain_verdict.h"
#include "app/report/progress_line.h"
#include "engine/files/error.h"
#include "engine/files/stopwatch.h"
#include "engine/files/text_files.h"

namespace nacre {

namespace {

struct AcquireArguments {
    CaptureArguments common;
    std::filesystem::path output;
    std::string segment;
    std::string coordinates = "auto";
    std::vector<int> tableSize;
    InterpolationArguments interpolation;
    LadderArguments ladder;
    ResidualArguments residual;
    std::filesystem::path report;
    std::string range; // empty: front where unseen parts are completed, else captured
};

AcquireOptions optionsOf(const AcquireArguments& arguments)
{
    AcquireOptions options = arguments.common.stageOptions();
    options.interpolation = arguments.interpolation.options(options.interpolation.threads);
    options.segment = segmentOptionsFrom(arguments.segment);
    options.ladder = arguments.ladder.options(options.interpolation.threads);
    options.residual = arguments.residual.options(options.ladder);
    options.castShadows = arguments.residual.castShadows();
    const char* known = options.interpolation.completed ? "front" : "captured";
    options.bake.range = tableRangeFromName(arguments.range.empty() ? known : arguments.range);
    options.bake.coordinates = coordinatesFromName(arguments.coordinates);
    if (!options.bake.coordinates && arguments.coordinates != "auto") {
        throw Error("", fmt::format("--coordinates {} are not known", arguments.coordinates),
                    "auto, half-difference, one-way or natural", Error::kUsage);
    }
    if (!arguments.tableSize.empty()) {
        const std::vector<int>& s = arguments.tableSize;
        constexpr int kLargest = 512;
        if (s.size() != 3 || *std::min_element(s.begin(), s.end()) < 2 ||
            *std::max_element(s.begin(), s.end()) > kLargest) {
            throw Error("", "--table-size is not understood", fmt::format("three numbers X,Y,Z from 2 to {}", kLargest),
                        Error::kUsage);
        }
        options.bake.size = {s[0], s[1], s[2]};
    }
    return options;
}

// Refuses now what it would refuse after the work.
void checkOutputs(const AcquireArguments& arguments)
{
    if (lowerExtension(arguments.output) != ".nacre") {
        throw Error(arguments.output, "is no name for a surface", "-o NAME.nacre", Error::kUsage);
    }
    const bool force = arguments.common.force;
    requireWholeFolder(arguments.output, force, kSurfaceDescription);
    requireSummary(arguments.common.json, force);
    requirePictureFolder(arguments.common.debugFolder, force);
    requirePictureFolder(arguments.report, force);
}

// The summary and the pictures that were asked for.
void writeExtras(const CaptureArguments& common, const Capture& given, const Acquisition& result)
{
    writeSummary(common.json, summaryOf(given, result));
    if (!common.debugFolder.empty()) {
        makeDebugFolder(common.debugFolder);
        saveNormalPictures(common.debugFolder, result.surface.normals);
        saveVerdictPictures(common.debugFolder, given, result.estimate);
        saveLabelPicture(common.debugFolder, result.segmentation, given.width, given.height);
        saveMaterialPictures(common.debugFolder, result.surface.materials);
    }
}

void runAcquire(AcquireArguments& arguments)
{
    const CaptureArguments& common = arguments.common;
    const AcquireOptions options = optionsOf(arguments);
    checkOutputs(arguments);
    const Capture capture = arguments.common.load();
    const Progress progress = progressLine(common.quiet);
    const Acquisition result = acquire(capture, options, progress);
    endProgressLine(common.quiet);
    saveSurface(arguments.output, result.surface, common.force);
    const Capture given = selectPhotographs(capture, result.estimate.given);
    if (!common.quiet) {
        fmt::print("{}\n\n{}{}{}{}{}{}wrote        {}\n", plainVerdict(result.estimate), describe(capture),
                   describeGiven(capture, result.estimate), describe(given, result.estimate.rig),
                   describeNormals(given, result.estimate), describeBrdf(result), describe(result.estimate.times),
                   arguments.output.string());
    }
    if (!common.compareRig.empty() && !common.quiet) {
        fmt::print("{}", describeDisagreement(capture, result.estimate.given, result.estimate.rig, common.compareRig));
    }
    writeExtras(common, given, result);
    if (!arguments.report.empty()) {
        const CaptureReview review = reviewCapture(capture, options, result, progress);
        endProgressLine(common.quiet);
        saveReport(arguments.report, reportOf({capture, result, review}));
    }
}

} // namespace

void addAcquireCommand(CLI::App& app)
{
    auto arguments = std::make_shared<AcquireArguments>();
    CLI::App* command =
        app.add_subcommand("acquire", "Photographs under a moving light to normals and a measured BRDF");
    arguments->common.addTo(*command);
    command->add_option("-o,--output", arguments->output, "Surface to write, NAME.nacre")
        ->option_text("OUT.nacre")
        ->required();
    command
        ->add_option("--segment", arguments->segment,
                     "Materials: picture with a value or colour for each, auto to find them, auto:N to find N "
                     "(default: labels of the capture, else one)")
        ->option_text("FILE|auto[:N]|none");
    arguments->interpolation.addTo(*command);
    command
        ->add_option("--range", arguments->range,
                     "Range of thetaD in the table: captured, front (45 degrees) or full (90); what was not captured "
                     "is extrapolated (default: front, captured with --unseen nearest)")
        ->group("BRDF");
    arguments->ladder.addTo(*command);
    arguments->residual.addTo(*command);
    command
        ->add_option("--coordinates", arguments->coordinates,
                     "Coordinates of the table: half-difference (f(l, v) and f(v, l) are one), one-way (they are "
                     "apart), natural, or "
                     "auto: half-difference, or one-way where that predicts held-out photographs better")
        ->capture_default_str()
        ->group("BRDF");
    command
        ->add_option("--table-size", arguments->tableSize,
                     "Size of the table in texels, X,Y,Z (default: from the captured range)")
        ->delimiter(',')
        ->group("BRDF");
    command
        ->add_option(
            "--report", arguments->report,
            "Folder for report.html, a page of pictures and figures; acquires once more with photographs held out")
        ->option_text("OUT");
    command->footer("Example:\n  nacre acquire horse --mirror-sphere chrome --diffuse-sphere gray -o horse.nacre");
    command->callback([arguments] { runAcquire(*arguments); });
}

} // namespace nacre
