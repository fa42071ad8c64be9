#include <algorithm>
#include <csignal>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "app/chart_progress.h"
#include "app/commands.h"
#include "engine/scene/error.h"
#include "engine/scene/material_specification.h"
#include "engine/scene/whole_file.h"
#include "evaluation/chart_measurement.h"
#include "evaluation/chart_report.h"

namespace nacre {

namespace {
namespace fs = std::filesystem;

constexpr const char* kReport = "report.html";
constexpr int kInterrupted = 130; // 128 + SIGINT, as shells count it

struct ChartArguments {
    std::vector<fs::path> captures;
    CaptureOptions capture;
    fs::path output;
    std::vector<std::string> parts{"normals", "brdf"};
    std::vector<std::string> methods, lights, neighbours;
    fs::path fits;
    int threads = 0;
    bool quiet = false, force = false;
};

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

ChartChoices choicesFrom(const ChartArguments& arguments)
{
    ChartChoices choices;
    choices.normals = choices.brdf = false;
    for (const std::string& part : arguments.parts) {
        if (part != "normals" && part != "brdf") {
            throw Error("", "--parts " + part + " is not known", "normals, brdf", Error::kUsage);
        }
        (part == "normals" ? choices.normals : choices.brdf) = true;
    }
    if (!arguments.methods.empty()) {
        choices.methods.clear();
    }
    for (const std::string& name : arguments.methods) {
        choices.methods.push_back(normalMethodFromName(name));
    }
    if (!arguments.lights.empty()) {
        choices.lightsGiven.clear();
    }
    for (const std::string& count : arguments.lights) {
        choices.lightsGiven.push_back(count == "all" ? 0 : numberFrom("--lights", count, kFewestLightsGiven, 100000));
    }
    if (!arguments.neighbours.empty()) {
        choices.neighbours.clear();
    }
    for (const std::string& k : arguments.neighbours) {
        choices.neighbours.push_back(static_cast<int>(numberFrom("--k", k, 1, kMostNeighbours)));
    }
    return choices;
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

ChartRows measureAll(const std::vector<Capture>& captures, const AcquireOptions& options, const ChartChoices& choices,
                     bool quiet)
{
    size_t all = 0, before = 0;
    for (const Capture& capture : captures) {
        all += countSettings(capture, choices);
    }
    ChartProgress progress(all, quiet);
    ChartRows rows;
    for (const Capture& capture : captures) {
        const auto show = [&](const std::string& setting, size_t done, size_t) {
            progress.show(capture.name + ": " + setting, before + done);
        };
        measureSettings(capture, options, choices, {show, [] { return interrupted != 0; }}, rows);
        before += countSettings(capture, choices);
    }
    progress.end();
    return rows;
}

void writeResults(const ChartArguments& arguments, const ChartRows& rows, const std::vector<std::string>& remarks)
{
    WholeOutput output(arguments.output, arguments.force);
    std::error_code error;
    if (!fs::create_directory(output.temporary(), error)) {
        throw Error(arguments.output, "cannot be made: " + error.message(), "a writable place with room");
    }
    writeTextFile(output.temporary() / "normals.csv", csvOf(rows.normals));
    writeTextFile(output.temporary() / "brdf.csv", csvOf(rows.brdf));
    for (const NamedChart& chart : chartsOf(rows)) {
        writeTextFile(output.temporary() / chart.file, svgOf(chart.chart));
    }
    writeTextFile(output.temporary() / kReport, reportOf(rows, remarks));
    output.commit();
}

void runChart(const ChartArguments& arguments)
{
    const ChartChoices choices = choicesFrom(arguments);
    AcquireOptions options;
    options.normals.fitsFolder = fitsFolderFrom(arguments.fits);
    options.setThreads(arguments.threads);
    checkOutput(arguments);
    const std::vector<Capture> captures = loadCaptures(arguments);
    size_t all = 0;
    for (const Capture& capture : captures) {
        all += countSettings(capture, choices);
    }
    stopOnInterrupt();
    const ChartRows rows = measureAll(captures, options, choices, arguments.quiet);
    std::signal(SIGINT, SIG_DFL);
    const size_t finished = rows.normals.size() + rows.brdf.size();
    std::vector<std::string> remarks{fmt::format("Every {}th photograph is held out and judges; \"lights\" counts the "
                                                 "photographs given. Seconds are wall clock, "
                                                 "in one run.",
                                                 kChartHeldOutEvery)};
    if (finished < all) {
        remarks.push_back(fmt::format("Interrupted: {} of {} settings were finished.", finished, all));
    }
    writeResults(arguments, rows, remarks);
    if (finished < all) {
        throw Error(arguments.output, fmt::format("was interrupted, and has {} of {} settings", finished, all),
                    "start again with --force for all of them", kInterrupted);
    }
    if (!arguments.quiet) {
        fmt::print("{} settings of {} captures\nwrote {}\n", finished, captures.size(),
                   (arguments.output / kReport).string());
    }
}

} // namespace

void addChartCommand(CLI::App& app)
{
    auto arguments = std::make_shared<ChartArguments>();
    CLI::App* command = app.add_subcommand(
        "chart", "What each choice costs and buys, on your captures: error against time and bytes, with Pareto fronts");
    command->add_option("CAPTURE", arguments->captures, "Folders of photographs")->required();
    command
        ->add_option("-o,--output", arguments->output,
                     "Folder to write: report.html, normals.csv, brdf.csv and each chart as .svg")
        ->required();
    command->add_option("--mirror-sphere", arguments->capture.mirrorSphere,
                        "Folder of a mirror sphere's photographs, for all captures");
    command->add_option("--diffuse-sphere", arguments->capture.diffuseSphere,
                        "Folder of a diffuse sphere's photographs, for all captures");
    command->add_option("--rig", arguments->capture.rig, "Lights from a file, for all captures");
    command->add_option("--parts", arguments->parts, "normals, brdf (default: both)")->delimiter(',');
    command->add_option("--methods", arguments->methods, "NAME[,NAME] of " + normalMethodNames() + " (default: all)")
        ->delimiter(',');
    command->add_option("--lights", arguments->lights, "COUNT[,COUNT] of photographs given (default: all,36,12,6)")
        ->delimiter(',');
    command->add_option("--k", arguments->neighbours, "Neighbours tried, N[,N] (default: 5,12,25,50,100)")
        ->delimiter(',');
    command->add_option("--fits", arguments->fits,
                        "Folder of published fits that exemplars use [environment variable NACRE_FITS_DIR]");
    command->add_option("--threads", arguments->threads, "Threads (default: all)")->check(CLI::NonNegativeNumber);
    command->add_flag("--quiet", arguments->quiet, "No progress, no summary");
    command->add_flag("--force", arguments->force, "Replace an output that exists");
    command->footer("Ctrl+C ends after the setting under way and writes what is finished.\n\n"
                    "Example:\n  nacre chart ballPNG bearPNG -o charts");
    command->callback([arguments] { runChart(*arguments); });
}

} // namespace nacre
