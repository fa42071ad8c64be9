#include <algorithm>
#include <cctype>
#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/arguments/capture_arguments.h"
#include "app/arguments/destinations.h"
#include "app/arguments/model_arguments.h"
#include "app/commands/commands.h"
#include "app/report/acquisition_summary.h"
#include "app/report/contact_sheet.h"
#include "app/report/progress_line.h"
#include "engine/files/error.h"
#include "evaluation/held_out/held_out.h"

namespace nacre {

namespace {

struct Box {
    int x0, y0, x1, y1; // x1 and y1 outside
};

// Where the picture is not 0, with a small margin.
Box boxOf(const Image& picture)
{
    constexpr int kMargin = 4;
    Box box{picture.width, picture.height, 0, 0};
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            if (picture.rgb(x, y) != glm::vec3(0)) {
                box = {std::min(box.x0, x), std::min(box.y0, y), std::max(box.x1, x + 1), std::max(box.y1, y + 1)};
            }
        }
    }
    return {std::max(0, box.x0 - kMargin), std::max(0, box.y0 - kMargin), std::min(picture.width, box.x1 + kMargin),
            std::min(picture.height, box.y1 + kMargin)};
}

Image cut(const Image& picture, const Box& box)
{
    Image part(std::max(1, box.x1 - box.x0), std::max(1, box.y1 - box.y0), 3);
    for (int y = box.y0; y < box.y1; ++y) {
        for (int x = box.x0; x < box.x1; ++x) {
            part.setRgb(x - box.x0, y - box.y0, picture.rgb(x, y));
        }
    }
    return part;
}

Image differenceOf(const Image& a, const Image& b)
{
    Image difference(a.width, a.height, 3);
    for (size_t i = 0; i < a.values.size(); ++i) {
        difference.values[i] = std::abs(a.values[i] - b.values[i]);
    }
    return difference;
}

// A power of two that leaves 99 % of what differs below white.
int amplification(const Image& difference)
{
    std::vector<float> values;
    std::copy_if(difference.values.begin(), difference.values.end(), std::back_inserter(values),
                 [](float v) { return v > 0; });
    const float high = peakOf(values);
    int factor = 1;
    while (factor < 64 && 2.0f * static_cast<float>(factor) * high <= 1) {
        factor *= 2;
    }
    return factor;
}

std::string rowOf(const std::string& name, const std::vector<PredictionScore>& scores, double PredictionScore::*value)
{
    std::string row = fmt::format("\n{:<42}", name); // beside the four columns of photographs
    for (const PredictionScore& score : scores) {
        row += fmt::format("{:>8.2f}", score.*value);
    }
    return row;
}

// What the user is told: a table of the photographs held out, errors of the normals where their truth is known, bytes
// and seconds.
std::string describe(const HeldOutEvaluation& evaluation, const std::optional<AngularError>& normals)
{
    std::string text =
        fmt::format("{} photographs given, {} held out; PSNR of radiance, dB; error relative to the "
                    "photograph; structural similarity as displayed\n\n{:<18}{:>8}{:>8}{:>8}",
                    evaluation.given, evaluation.photographs.size(), "photograph", "median", "95 %", "ssim");
    for (const PredictionScore& score : evaluation.scores) {
        text += fmt::format("{:>8}", score.method);
    }
    for (size_t j = 0; j < evaluation.photographs.size(); ++j) {
        const PhotographMeasures& m = evaluation.measures[j];
        text += fmt::format("\n{:<18}{:>7.1f}%{:>7.1f}%{:>8.4f}", m.photograph, 100 * m.medianRelativeError,
                            100 * m.percentile95RelativeError, m.structuralSimilarity);
        for (const PredictionScore& score : evaluation.scores) {
            text += fmt::format("{:>8.2f}", score.photographs[j]);
        }
    }
    text += rowOf("all, colour", evaluation.scores, &PredictionScore::psnr) +
            rowOf("all, grey", evaluation.scores, &PredictionScore::greyPsnr) +
            rowOf("grey, own peaks", evaluation.scores, &PredictionScore::ownPeakPsnr);
    text += fmt::format("\n\nworst        {}\n", evaluation.photographs[evaluation.worst]);
    if (normals) {
        text += fmt::format("normals      mean {:.2f}, median {:.2f}, 95th percentile {:.2f} degrees ({} pixels, {} "
                            "without a normal)\n",
                            normals->mean, normals->median, normals->percentile95, normals->pixels, normals->missing);
    }
    return text + describeWarnings(evaluation.acquisition.estimate) +
           fmt::format("model        {} bytes\n", evaluation.modelBytes) + describe(evaluation.acquisition.shadows) +
           describe(evaluation.acquisition.residual) + describe(evaluation.acquisition.estimate.times);
}

nlohmann::ordered_json documentOf(const HeldOutEvaluation& evaluation, const std::optional<AngularError>& normals)
{
    nlohmann::ordered_json document{{"photographsGiven", evaluation.given},
                                    {"photographsHeldOut", evaluation.photographs},
                                    {"worstPhotograph", evaluation.photographs[evaluation.worst]},
                                    {"modelBytes", evaluation.modelBytes},
                                    {"findings", findingsOf(evaluation.acquisition.estimate)},
                                    {"shadows", documentOf(evaluation.acquisition.shadows)},
                                    {"residual", documentOf(evaluation.acquisition.residual)},
                                    {"acquisitionSeconds", evaluation.seconds}};
    for (const StageTime& time : evaluation.acquisition.estimate.times) {
        std::string stage = time.stage;
        stage[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(stage[0])));
        document["seconds" + stage] = time.seconds;
    }
    if (normals) {
        document["normalsMeanErrorDegrees"] = normals->mean;
        document["normalsMedianErrorDegrees"] = normals->median;
        document["normalsPercentile95ErrorDegrees"] = normals->percentile95;
    }
    for (const PhotographMeasures& m : evaluation.measures) {
        document["predictions"].push_back({{"photograph", m.photograph},
                                           {"psnrColour", m.psnr},
                                           {"medianRelativeError", m.medianRelativeError},
                                           {"percentile95RelativeError", m.percentile95RelativeError},
                                           {"structuralSimilarity", m.structuralSimilarity}});
    }
    for (const PredictionScore& score : evaluation.scores) {
        document["methods"].push_back({{"method", score.method},
                                       {"psnrColour", score.psnr},
                                       {"psnrGrey", score.greyPsnr},
                                       {"psnrGreyOwnPeaks", score.ownPeakPsnr},
                                       {"psnrOfPhotographs", score.photographs}});
    }
    return document;
}

// The photograph that is predicted worst, its prediction, and their difference, amplified as the caption says; cut to
// the object. All three under the one exposure that suits the capture.
Image worstSheet(const HeldOutEvaluation& evaluation)
{
    constexpr int kNarrowest = 240; // captions have to fit below
    const PhotographMeasures& measures = evaluation.measures[evaluation.worst];
    const float stops = exposureOfPeak(evaluation.peak);
    const Box box = boxOf(evaluation.worstPhotograph);
    const Image photograph = cut(displayedImage(evaluation.worstPhotograph, {.exposureStops = stops}), box);
    const Image prediction = cut(displayedImage(evaluation.worstPrediction, {.exposureStops = stops}), box);
    Image difference = differenceOf(photograph, prediction);
    const int factor = amplification(difference);
    for (float& value : difference.values) {
        value = std::min(1.0f, value * static_cast<float>(factor));
    }
    return contactSheet(
        {{{photograph, measures.photograph},
          {prediction, fmt::format("predicted, {:.1f} dB, SSIM {:.3f}", measures.psnr, measures.structuralSimilarity)},
          {difference, fmt::format("difference x {}", factor)}}},
        std::max(kNarrowest, photograph.width), photograph.height);
}

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
    requireSummary(arguments.common.json, arguments.common.force);
    requirePictureFolder(arguments.output, arguments.common.force);
    requirePictureFolder(arguments.common.debugFolder, arguments.common.force);
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
    options.castShadows = arguments.residual.castShadows();
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
    writeSummary(common.json, documentOf(evaluation, error));
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
    command
        ->add_option("-o,--output", arguments->output,
                     "Folder for worst.png: the photograph predicted worst, its prediction, their difference")
        ->option_text("OUT");
    command->add_flag(
        "--baselines", arguments->baselines,
        "Comparison with per-pixel relighting: PTM, HSH, RBF, thin-plate splines, each at its best smoothing");
    command->footer("Example:\n  nacre evaluate ballPNG --lights-given 36 --json ball.json -o ball");
    command->callback([arguments] { runEvaluate(*arguments); });
}

} // namespace nacre
