#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/capture_arguments.h"
#include "app/commands.h"
#include "app/interpolation_arguments.h"
#include "app/progress_line.h"
#include "engine/scene/error.h"
#include "engine/scene/whole_file.h"
#include "evaluation/held_out.h"

namespace nacre {

namespace {

struct EvaluateArguments {
    CaptureArguments common;
    InterpolationArguments interpolation;
    std::string holdOut = "every:7";
    bool baselines = false;
};

size_t holdOutEvery(const std::string& text)
{
    const std::string prefix = "every:";
    size_t every = 0;
    if (text.rfind(prefix, 0) == 0 && text.find_first_not_of("0123456789", prefix.size()) == std::string::npos &&
        text.size() > prefix.size() && text.size() < prefix.size() + 5) {
        every = std::stoul(text.substr(prefix.size()));
    }
    if (every < 2) {
        throw Error("", "--hold-out " + text + " is not understood", "every:N, N from 2", Error::kUsage);
    }
    return every;
}

std::string describe(const HeldOutEvaluation& evaluation)
{
    std::string text = fmt::format("{} photographs given, {} held out; PSNR of radiance, dB\n\n{:<18}",
                                   evaluation.given, evaluation.photographs.size(), "photograph");
    for (const PredictionScore& score : evaluation.scores) {
        text += fmt::format("{:>8}", score.method);
    }
    for (size_t j = 0; j < evaluation.photographs.size(); ++j) {
        text += fmt::format("\n{:<18}", evaluation.photographs[j]);
        for (const PredictionScore& score : evaluation.scores) {
            text += fmt::format("{:>8.2f}", score.photographs[j]);
        }
    }
    text += fmt::format("\n{:<18}", "all, colour");
    for (const PredictionScore& score : evaluation.scores) {
        text += fmt::format("{:>8.2f}", score.psnr);
    }
    text += fmt::format("\n{:<18}", "all, grey");
    for (const PredictionScore& score : evaluation.scores) {
        text += fmt::format("{:>8.2f}", score.greyPsnr);
    }
    text += fmt::format("\n{:<18}", "grey, own peaks");
    for (const PredictionScore& score : evaluation.scores) {
        text += fmt::format("{:>8.2f}", score.ownPeakPsnr);
    }
    return text + "\n";
}

nlohmann::ordered_json documentOf(const HeldOutEvaluation& evaluation)
{
    nlohmann::ordered_json document{{"photographsGiven", evaluation.given},
                                    {"photographsHeldOut", evaluation.photographs},
                                    {"acquisitionSeconds", evaluation.seconds}};
    for (const PredictionScore& score : evaluation.scores) {
        document["methods"].push_back({{"method", score.method},
                                       {"psnrColour", score.psnr},
                                       {"psnrGrey", score.greyPsnr},
                                       {"psnrGreyOwnPeaks", score.ownPeakPsnr},
                                       {"psnrOfPhotographs", score.photographs}});
    }
    return document;
}

void runEvaluate(EvaluateArguments& arguments)
{
    CaptureArguments& common = arguments.common;
    AcquireOptions options = common.stageOptions();
    options.interpolation = arguments.interpolation.options(options.interpolation.threads);
    options.lights.heldOutEvery = holdOutEvery(arguments.holdOut);
    if (!common.json.empty()) {
        WholeOutput(common.json, common.force);
    }
    const Capture capture = common.load();
    std::vector<RelightingBaseline> baselines;
    if (arguments.baselines) {
        baselines.assign(std::begin(kRelightingBaselines), std::end(kRelightingBaselines));
    }
    const HeldOutEvaluation evaluation = evaluateHeldOut(capture, options, baselines, progressLine(common.quiet));
    endProgressLine(common.quiet);
    if (!common.quiet) {
        fmt::print("{}", describe(evaluation));
    }
    if (!common.json.empty()) {
        writeTextFile(common.json, documentOf(evaluation).dump(2) + "\n");
    }
}

} // namespace

void addEvaluateCommand(CLI::App& app)
{
    auto arguments = std::make_shared<EvaluateArguments>();
    CLI::App* command = app.add_subcommand("evaluate", "How well a capture predicts photographs that are held out");
    arguments->common.addTo(*command);
    arguments->interpolation.addTo(*command);
    command
        ->add_option("--hold-out", arguments->holdOut, "every:N keeps back the first photograph and every N-th after")
        ->capture_default_str();
    command->add_flag(
        "--baselines", arguments->baselines,
        "Compare with per-pixel relighting: PTM, HSH, RBF, thin-plate splines, each at its best smoothing");
    command->footer("Example:\n  nacre evaluate ballPNG --lights-given 36 --baselines");
    command->callback([arguments] { runEvaluate(*arguments); });
}

} // namespace nacre
