#include <memory>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/arguments/capture_arguments.h"
#include "app/arguments/destinations.h"
#include "app/arguments/interpolation_arguments.h"
#include "app/arguments/residual_arguments.h"
#include "app/commands/commands.h"
#include "app/report/evaluate_report.h"
#include "app/report/progress_line.h"
#include "engine/files/error.h"
#include "engine/files/whole_file.h"
#include "evaluation/held_out/held_out.h"

namespace nacre {

namespace {

constexpr const char* kWorst = "worst.png";

struct EvaluateArguments {
    CaptureArguments common;
    InterpolationArguments interpolation;
    LadderArguments ladder;
    ResidualArguments residual;
    std::filesystem::path truth;
    std::filesystem::path output;
    std::string holdOut = "every:7";
    bool baselines = false;
};

constexpr const char* kEach = "each";

size_t holdOutEvery(const std::string& text)
{
    const std::string prefix = "every:";
    size_t every = 0;
    if (text.rfind(prefix, 0) == 0 && text.find_first_not_of("0123456789", prefix.size()) == std::string::npos &&
        text.size() > prefix.size() && text.size() < prefix.size() + 5) {
        every = std::stoul(text.substr(prefix.size()));
    }
    if (every < 2) {
        throw Error("", "--hold-out " + text + " is not understood", "every:N, N from 2, or each", Error::kUsage);
    }
    return every;
}

// Refuses now what it would refuse after the work.
void checkOutputs(const EvaluateArguments& arguments)
{
    requireSummaryDestination(arguments.common.json);
    requireFolderDestination(arguments.output);
    if (std::filesystem::exists(arguments.output / kWorst)) {
        requireDestination(arguments.output / kWorst, arguments.common.force);
    }
}

std::optional<AngularError> normalError(const EvaluateArguments& arguments, const Capture& capture,
                                        const NormalMap& normals)
{
    const std::filesystem::path truth = arguments.truth.empty() ? capture.truthNormals : arguments.truth;
    return truth.empty() ? std::nullopt : std::optional(errorAgainstTruth(capture, normals, truth));
}

void writeSheet(const std::filesystem::path& folder, const HeldOutEvaluation& evaluation)
{
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) {
        throw Error(folder, "cannot be made: " + error.message(), "a writable place with room");
    }
    saveImage(folder / kWorst, worstSheet(evaluation), PixelType::uint8);
}

void runEvaluate(EvaluateArguments& arguments)
{
    CaptureArguments& common = arguments.common;
    AcquireOptions options = common.stageOptions();
    options.interpolation = arguments.interpolation.options(options.interpolation.threads);
    options.ladder = arguments.ladder.options(options.interpolation.threads);
    options.residual = arguments.residual.options(options.ladder);
    const bool each = arguments.holdOut == kEach;
    options.lights.heldOutEvery = each ? 0 : holdOutEvery(arguments.holdOut);
    checkOutputs(arguments);
    const Capture capture = common.load();
    options.lights.heldOutEvery = each ? capture.photographs.size() : options.lights.heldOutEvery;
    std::vector<RelightingBaseline> baselines;
    if (arguments.baselines) {
        baselines.assign(std::begin(kRelightingBaselines), std::end(kRelightingBaselines));
    }
    const HeldOutEvaluation evaluation = evaluateHeldOut(capture, options, baselines, progressLine(common.quiet),
                                                         each ? options.lights.heldOutEvery : 1);
    endProgressLine(common.quiet);
    const std::optional<AngularError> error = normalError(arguments, capture, evaluation.acquisition.surface.normals);
    if (!common.quiet) {
        fmt::print("{}", describe(evaluation, error));
    }
    if (!common.json.empty()) {
        writeTextFile(common.json, documentOf(evaluation, error).dump(2) + "\n");
    }
    if (!arguments.output.empty()) {
        writeSheet(arguments.output, evaluation);
    }
}

} // namespace

void addEvaluateCommand(CLI::App& app)
{
    auto arguments = std::make_shared<EvaluateArguments>();
    CLI::App* command = app.add_subcommand("evaluate", "The whole chain, judged by photographs that are held out");
    arguments->common.addTo(*command);
    arguments->interpolation.addTo(*command);
    arguments->ladder.addTo(*command);
    arguments->residual.addTo(*command);
    command
        ->add_option(
            "--hold-out", arguments->holdOut,
            "Photographs that are held out: every:N (the first and each N-th after) or each (one after the other)")
        ->capture_default_str();
    command->add_option("--truth", arguments->truth,
                        "True normals to compare with (.mat, .png, .exr), or sphere for those of the ball that fills "
                        "the mask (default: those of the capture)");
    command->add_option("-o,--output", arguments->output,
                        "Folder for worst.png: the photograph predicted worst, its prediction, their difference");
    command->add_flag(
        "--baselines", arguments->baselines,
        "Comparison with per-pixel relighting: PTM, HSH, RBF, thin-plate splines, each at its best smoothing");
    command->footer("Example:\n  nacre evaluate ballPNG --lights-given 36 --json ball.json -o ball");
    command->callback([arguments] { runEvaluate(*arguments); });
}

} // namespace nacre
