#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include "app/arguments/destinations.h"
#include "app/commands/commands.h"
#include "engine/files/error.h"
#include "engine/files/stopwatch.h"
#include "engine/files/whole_file.h"
#include "engine/materials/material_specification.h"
#include "engine/scene/picture_size.h"
#include "evaluation/charts/chart_measurement.h"
#include "evaluation/charts/chart_report.h"
#include "evaluation/charts/chart_tables.h"
#include "evaluation/rendering/chart_rendering.h"

namespace nacre {

namespace {
namespace fs = std::filesystem;

constexpr const char* kReport = "report.html";
constexpr int kInterrupted = 130; // 128 + SIGINT, as shells count it

// Which captures `chart` looks at, and what it tries.
struct ChartArguments {
    std::vector<fs::path> captures;
    CaptureOptions capture;
    fs::path output, fits;
    std::vector<std::string> parts{"normals", "brdf", "rendering"};
    std::vector<std::string> methods, lights, neighbours, frameLights;
    std::string frameSize = fmt::format("{}x{}", RenderingChoices{}.width, RenderingChoices{}.height);
    std::string device;
    int threads = 0;
    bool quiet = false, force = false;

    void addTo(CLI::App& command);
    ChartChoices choices() const; // throws usage Errors
};

size_t numberFrom(const char* option, const std::string& text, size_t least, size_t most)
{
    const bool digits = !text.empty() && text.size() < 7 && text.find_first_not_of("0123456789") == std::string::npos;
    const size_t value = digits ? std::stoul(text) : 0;
    if (value < least || value > most) {
        throw Error("", fmt::format("{} {} is not understood", option, text), fmt::format("{} to {}", least, most),
                    Error::kUsage);
    }
    return value;
}

void setFrames(const ChartArguments& arguments, RenderingChoices& frames)
{
    constexpr size_t kMostLights = 100000;
    const PictureSize size = sizeFromArgument("--frame-size", arguments.frameSize);
    frames.width = size.width;
    frames.height = size.height;
    if (!arguments.frameLights.empty()) {
        frames.lights.clear();
    }
    for (const std::string& count : arguments.frameLights) {
        frames.lights.push_back(numberFrom("--frame-lights", count, 1, kMostLights));
    }
}

ChartChoices ChartArguments::choices() const
{
    ChartChoices chosen;
    const std::map<std::string, bool*> wanted{
        {"normals", &chosen.normals}, {"brdf", &chosen.brdf}, {"rendering", &chosen.rendering}};
    for (const auto& [name, part] : wanted) {
        *part = false;
    }
    for (const std::string& part : parts) {
        if (!wanted.contains(part)) {
            throw Error("", "--parts " + part + " is not known", "normals, brdf, rendering", Error::kUsage);
        }
        *wanted.at(part) = true;
    }
    if (!methods.empty()) {
        chosen.methods.clear();
    }
    for (const std::string& name : methods) {
        chosen.methods.push_back(normalMethodFromName(name));
    }
    if (!lights.empty()) {
        chosen.lightsGiven.clear();
    }
    for (const std::string& count : lights) {
        chosen.lightsGiven.push_back(
            count == "all" || count == "0" ? 0 : numberFrom("--lights-given", count, kFewestLightsGiven, 100000));
    }
    if (!neighbours.empty()) {
        chosen.neighbours.clear();
    }
    for (const std::string& k : neighbours) {
        chosen.neighbours.push_back(static_cast<int>(numberFrom("--k", k, 1, kMostNeighbours)));
    }
    setFrames(*this, chosen.frames);
    return chosen;
}

void ChartArguments::addTo(CLI::App& command)
{
    command.add_option("CAPTURE", captures, "Folders of photographs")->required();
    command
        .add_option(
            "-o,--output", output,
            "Folder to write: report.html, normals.csv, brdf.csv, rendering.csv, charts as .svg (by gnuplot, where "
            "installed) and the scripts .gp that draw them")
        ->option_text("OUT")
        ->required();
    command.add_option("--mirror-sphere", capture.mirrorSphere,
                       "Folder of a mirror sphere's photographs, for all captures");
    command.add_option("--diffuse-sphere", capture.diffuseSphere,
                       "Folder of a diffuse sphere's photographs, for all captures");
    command.add_option("--rig", capture.rig, "Lights from a file, for all captures");
    command.add_option("--parts", parts, "Charts: normals, brdf, rendering (default: all)")->delimiter(',');
    command.add_option("--methods", methods, "NAME[,NAME] of " + normalMethodNames() + " (default: all)")
        ->delimiter(',');
    command
        .add_option("--lights-given", lights,
                    fmt::format("COUNT[,COUNT] of photographs given, 0 for all (default: {})",
                                fmt::join(ChartChoices{}.lightsGiven, ",")))
        ->delimiter(',');
    command
        .add_option("--k", neighbours,
                    fmt::format("Neighbours tried, N[,N] (default: {})", fmt::join(ChartChoices{}.neighbours, ",")))
        ->delimiter(',');
    command
        .add_option("--frame-lights", frameLights,
                    fmt::format("Lights of the frames, N[,N] (default: {})", fmt::join(RenderingChoices{}.lights, ",")))
        ->delimiter(',');
    command.add_option("--frame-size", frameSize, "Size of the frames in pixels, WxH")->capture_default_str();
    command.add_option("--fits", fits, "Folder of published fits for exemplars (default: $NACRE_FITS_DIR)");
    command.add_option("--device", device, "Vulkan device that draws: number or part of its name, see nacre info");
    command.add_option("--threads", threads, "Number of threads (default: all)")->check(CLI::NonNegativeNumber);
    command.add_flag("--quiet", quiet, "No progress and no summary");
    command.add_flag("--force", force, "Replacement of existing outputs");
}

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
    requireWholeFolder(arguments.output, arguments.force, kReport);
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

// On stderr: what is tried and what is left, its time by the mean of the settings that are done. One line that
// overwrites itself on a terminal, lines elsewhere.
class ChartProgress {
public:
    ChartProgress(size_t all, bool quiet) : all_(all), quiet_(quiet) {}

    void show(const std::string& what, size_t done) const;
    void end() const; // clears the line, if there is one

private:
    Stopwatch watch_;
    size_t all_;
    bool quiet_;
};

void ChartProgress::show(const std::string& what, size_t done) const
{
    if (quiet_) {
        return;
    }
    const double elapsed = watch_.seconds();
    const size_t left = all_ - std::min(all_, done);
    const std::string time =
        done == 0 ? ""
                  : fmt::format(", about {:.0f} s", elapsed * static_cast<double>(left) / static_cast<double>(done));
    const bool terminal = isatty(STDERR_FILENO);
    fmt::print(stderr, "{}{}; {} of {} settings left{}{}", terminal ? "\r\x1b[K" : "", what, left, all_, time,
               terminal ? "" : "\n");
    std::fflush(stderr);
}

void ChartProgress::end() const
{
    if (!quiet_ && isatty(STDERR_FILENO)) {
        fmt::print(stderr, "\r\x1b[K");
    }
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
