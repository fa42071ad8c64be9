#include <algorithm>
#include <csignal>
#include <filesystem>
#include <map>
#include <memory>

#include <fmt/format.h>

#include "app/arguments/chart_arguments.h"
#include "app/arguments/destinations.h"
#include "app/commands/commands.h"
#include "app/report/chart_progress.h"
#include "engine/files/error.h"
#include "engine/files/whole_file.h"
#include "engine/materials/material_specification.h"
#include "evaluation/charts/chart_measurement.h"
#include "evaluation/charts/chart_report.h"
#include "evaluation/charts/chart_tables.h"
#include "evaluation/rendering/chart_rendering.h"

namespace nacre {

namespace {
namespace fs = std::filesystem;

constexpr const char* kReport = "report.html";
constexpr int kInterrupted = 130; // 128 + SIGINT, as shells count it

volatile std::sig_atomic_t interrupted = 0;

// The first Ctrl+C ends the work after the setting that is under way, the second one ends the program at once.
void stopOnInterrupt()
{
    interrupted = 0;
    struct sigaction action {};
    action.sa_handler = [](int) { interrupted = 1; };
    action.sa_flags = SA_RESETHAND;
    sigaction(SIGINT, &action, nullptr);
}

// Refuses now what it would refuse after the work.
void checkOutput(const ChartArguments& arguments)
{
    WholeOutput(arguments.output, arguments.force);
    if (fs::exists(arguments.output) && !fs::exists(arguments.output / kReport)) {
        throw Error(arguments.output, "exists and holds no " + std::string(kReport),
                    "a new name; --force replaces charts alone");
    }
}

// All are checked before the first is measured. Rows are told apart by their captures' names.
std::vector<Capture> loadCaptures(const ChartArguments& arguments)
{
    std::vector<Capture> captures;
    for (const fs::path& folder : arguments.captures) {
        Capture capture = loadCapture(folder, arguments.capture);
        requireChartable(capture);
        const std::string name = capture.name;
        const auto isTaken = [&](const Capture& other) { return other.name == capture.name; };
        for (int i = 2; std::any_of(captures.begin(), captures.end(), isTaken); ++i) {
            capture.name = fmt::format("{} ({})", name, i);
        }
        captures.push_back(std::move(capture));
    }
    return captures;
}

size_t settingsOf(const Capture& capture, const ChartChoices& choices)
{
    return countSettings(capture, choices) + (choices.rendering ? countSettings(choices.frames) : 0);
}

struct ChartResult {
    ChartRows rows;
    std::vector<std::string> failures; // what ended a capture before its time
};

void measureCapture(const Capture& capture, const AcquireOptions& options, const ChartChoices& choices,
                    const std::string& device, const std::function<void(const std::string&, size_t)>& show,
                    ChartRows& rows)
{
    const size_t before = countSettings(capture, choices);
    const auto isStopped = [] { return interrupted != 0; };
    const auto first = [&](const std::string& setting, size_t done, size_t) { show(setting, done); };
    const auto second = [&](const std::string& setting, size_t done, size_t) { show(setting, before + done); };
    if (choices.normals || choices.brdf) {
        measureSettings(capture, options, choices, {first, isStopped}, rows);
    }
    if (choices.rendering && !isStopped()) {
        measureRendering(capture, options, choices.frames, device, {second, isStopped}, rows.rendering);
    }
}

// What one capture's photographs or the device refuse costs no setting that was finished, and no other capture.
ChartResult measureAll(const std::vector<Capture>& captures, const AcquireOptions& options, const ChartChoices& choices,
                       const ChartArguments& arguments)
{
    size_t all = 0, before = 0;
    for (const Capture& capture : captures) {
        all += settingsOf(capture, choices);
    }
    ChartProgress progress(all, arguments.quiet);
    ChartResult result;
    for (const Capture& capture : captures) {
        const auto show = [&](const std::string& setting, size_t done) {
            progress.show(capture.name + ": " + setting, before + done);
        };
        try {
            measureCapture(capture, options, choices, arguments.device, show, result.rows);
        } catch (const Error& error) {
            result.failures.push_back(capture.name + ": " + error.what());
        }
        before += settingsOf(capture, choices);
    }
    progress.end();
    return result;
}

// Answers what kept charts from being drawn.
std::string writeResults(const ChartArguments& arguments, const ChartRows& rows, std::vector<std::string> remarks)
{
    WholeOutput output(arguments.output, arguments.force);
    std::error_code error;
    if (!fs::create_directory(output.temporary(), error)) {
        throw Error(arguments.output, "cannot be made: " + error.message(), "a writable place with room");
    }
    writeTextFile(output.temporary() / kNormalTable, csvOf(rows.normals));
    writeTextFile(output.temporary() / kBrdfTable, csvOf(rows.brdf));
    writeTextFile(output.temporary() / kRenderingTable, csvOf(rows.rendering));
    const std::string missing = drawPlots(output.temporary(), plotsOf(rows));
    if (!missing.empty()) {
        remarks.push_back(missing);
    }
    writeTextFile(output.temporary() / kReport, reportOf(rows, remarks, output.temporary()));
    output.commit();
    return missing;
}

std::vector<std::string> remarksOn(const ChartResult& result, size_t finished)
{
    std::vector<std::string> remarks{fmt::format("Every {}th photograph is held out and judges; \"lights\" counts the "
                                                 "photographs given. Seconds are wall clock, "
                                                 "in one run.",
                                                 kChartHeldOutEvery)};
    if (!result.rows.rendering.empty()) {
        remarks.push_back(
            "Frames are the object side by side in one picture of one size for all captures, the median of several "
            "on one Vulkan device; rounding to 8 bits alone leaves 58.9 dB. Each number of lights has its own front.");
    }
    if (interrupted) {
        remarks.push_back(fmt::format("Interrupted: {} settings were finished.", finished));
    }
    for (const std::string& failure : result.failures) {
        remarks.push_back("Ended before its time: " + failure);
    }
    return remarks;
}

void runChart(const ChartArguments& arguments)
{
    const ChartChoices choices = arguments.choices();
    AcquireOptions options;
    options.normals.fitsFolder = fitsFolderFrom(arguments.fits);
    options.setThreads(arguments.threads);
    checkOutput(arguments);
    const std::vector<Capture> captures = loadCaptures(arguments);
    stopOnInterrupt();
    const ChartResult result = measureAll(captures, options, choices, arguments);
    std::signal(SIGINT, SIG_DFL);
    const ChartRows& rows = result.rows;
    const size_t finished = rows.normals.size() + rows.brdf.size() + rows.rendering.size();
    const std::string missing = writeResults(arguments, rows, remarksOn(result, finished));
    if (interrupted) {
        throw Error(arguments.output, fmt::format("was interrupted, and has {} settings", finished),
                    "start again with --force for all of them", kInterrupted);
    }
    if (!result.failures.empty()) {
        throw Error(arguments.output,
                    fmt::format("has {} settings and not all; {}", finished, fmt::join(result.failures, "; ")),
                    "captures and a device that can be read to the end");
    }
    if (!arguments.quiet) {
        fmt::print("{} settings of {} captures\n{}{}wrote {}\n", finished, captures.size(), missing,
                   missing.empty() ? "" : "\n", (arguments.output / kReport).string());
    }
}

} // namespace

void addChartCommand(CLI::App& app)
{
    auto arguments = std::make_shared<ChartArguments>();
    CLI::App* command = app.add_subcommand(
        "chart", "What each choice costs and buys, on your captures: error against time and bytes, with Pareto fronts");
    arguments->addTo(*command);
    command->footer("Ctrl+C ends after the setting under way and writes what is finished.\n\n"
                    "Example:\n  nacre chart ballPNG bearPNG -o charts");
    command->callback([arguments] { runChart(*arguments); });
}

} // namespace nacre
