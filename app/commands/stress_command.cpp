#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "app/arguments/capture_arguments.h"
#include "app/arguments/destinations.h"
#include "app/commands/commands.h"
#include "app/report/progress_line.h"
#include "engine/files/error.h"
#include "engine/files/whole_file.h"
#include "engine/materials/material_specification.h"
#include "evaluation/stress/stress_page.h"
#include "evaluation/stress/stress_tables.h"

namespace nacre {

namespace {
namespace fs = std::filesystem;

constexpr const char* kSynthetic = "synthetic";

struct StressArguments {
    CalibrationArguments capture;
    fs::path output;
    std::vector<std::string> sweeps;
    std::vector<std::string> methods{"least-squares", "threshold", "two-step", "ransac",
                                     "consensus",     "exemplar",  "auto"};
    std::string material = "ggx:diffuse=0.4,0.3,0.2;specular=0.05;alpha=0.2";
    fs::path fits;
    int size = 40;
    uint64_t seed = SynthOptions{}.seed;
};

SynthOptions synthOptionsOf(const StressArguments& arguments)
{
    constexpr int kLargest = 1024;
    if (arguments.size < 16 || arguments.size > kLargest) {
        throw Error("", fmt::format("--side {} is out of range", arguments.size), fmt::format("16 to {}", kLargest),
                    Error::kUsage);
    }
    SynthOptions options;
    options.width = options.height = arguments.size;
    options.material = arguments.material;
    options.fitsFolder = fitsFolderFrom(arguments.fits);
    options.seed = arguments.seed;
    options.threads = arguments.capture.threads;
    return options;
}

StressSubject subjectOf(StressArguments& arguments)
{
    const CalibrationOptions calibration = arguments.capture.calibrationOptions();
    if (arguments.capture.folder == kSynthetic) {
        return syntheticSubject(synthOptionsOf(arguments));
    }
    return captureSubject(photographedCapture(arguments.capture.load(), calibration), arguments.seed);
}

// Refuses now what it would refuse after the work.
void checkOutput(const StressArguments& arguments)
{
    requireWholeFolder(arguments.output, arguments.capture.force, kStressTable);
}

// Answers what kept charts from being drawn.
std::string writeResults(const StressArguments& arguments, const std::vector<StressRow>& rows,
                         const std::string& tables)
{
    WholeOutput output(arguments.output, arguments.capture.force);
    std::error_code error;
    if (!fs::create_directory(output.temporary(), error)) {
        throw Error(arguments.output, "cannot be made: " + error.message(), "a writable place with room");
    }
    writeTextFile(output.temporary() / kStressTable, csvOf(rows));
    writeTextFile(output.temporary() / "stress.txt", tables);
    const std::string remark = drawPlots(output.temporary(), stressPlotsOf(rows));
    writeTextFile(output.temporary() / "stress.html", stressPageOf(rows, remark, output.temporary()));
    output.commit();
    return remark;
}

void runStress(StressArguments& arguments)
{
    const bool quiet = arguments.capture.quiet;
    std::vector<NormalMethod> methods;
    for (const std::string& name : arguments.methods) {
        methods.push_back(normalMethodFromName(name));
    }
    checkOutput(arguments);
    const StressSubject subject = subjectOf(arguments);
    const std::vector<Sweep> sweeps = normalSweeps(subject, arguments.sweeps);
    AcquireOptions options;
    options.normals.seed = arguments.seed;
    options.setThreads(arguments.capture.threads);
    const std::vector<StressRow> rows = runSweeps(subject, sweeps, methods, options, progressLine(quiet));
    endProgressLine(quiet);
    const std::string tables = tablesOf(rows) + "\n" + breakingPointsOf(rows) + "\n" + countTableOf(rows);
    const std::string remark = writeResults(arguments, rows, tables);
    if (!quiet) {
        const auto silent = countsOf(rows).silent;
        fmt::print("{}: {} pixels, {} lights, seed {}\n\n{}\n{} of {} runs fail silently\n{}{}wrote {}\n",
                   subject.clean.name, subject.clean.seen.pixels.size(), subject.clean.lights.size(), arguments.seed,
                   tables, silent, rows.size(), remark, remark.empty() ? "" : "\n", arguments.output.string());
    }
}

} // namespace

void addStressCommand(CLI::App& app)
{
    auto arguments = std::make_shared<StressArguments>();
    CLI::App* command =
        app.add_subcommand("stress", "Where the methods fail: errors as photographs and lights get worse");
    arguments->capture.addTo(*command);
    command->get_option("CAPTURE")->description("Folder of photographs with true normals, or `synthetic`");
    command
        ->add_option("-o,--output", arguments->output,
                     "Folder to write: stress.csv, stress.txt, stress.html, charts as .svg (by gnuplot, where "
                     "installed) and the scripts .gp that draw them")
        ->option_text("OUT")
        ->required();
    command
        ->add_option(
            "--sweep", arguments->sweeps,
            fmt::format("NAME[,NAME] of {} (default: all that are possible)", fmt::join(normalSweepNames(), ", ")))
        ->delimiter(',');
    command->add_option("--methods", arguments->methods, "NAME[,NAME] of " + normalMethodNames() + " (default: all)")
        ->delimiter(',');
    command->add_option("--material", arguments->material, "Material of the synthetic object, as in nacre synth")
        ->capture_default_str();
    command->add_option("--fits", arguments->fits,
                        "Folder of published fits, for --material [environment variable NACRE_FITS_DIR]");
    command->add_option("--side", arguments->size, "Side of the synthetic photographs in pixels")
        ->capture_default_str();
    command->add_option("--seed", arguments->seed, "Seed of everything random")->capture_default_str();
    command->footer("Example:\n  nacre stress synthetic -o stress --sweep lights,layout --methods consensus,auto");
    command->callback([arguments] { runStress(*arguments); });
}

} // namespace nacre
