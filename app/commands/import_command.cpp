#include <filesystem>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "acquisition/chain/acquire.h"
#include "app/arguments/destinations.h"
#include "app/commands/commands.h"
#include "app/materials/predicted_photographs.h"
#include "app/materials/rti_fits.h"
#include "app/report/acquisition_summary.h"
#include "app/report/plain_verdict.h"
#include "app/report/progress_line.h"
#include "engine/files/error.h"
#include "engine/files/text_files.h"
#include "engine/files/whole_file.h"

namespace nacre {

namespace {

struct ImportArguments {
    std::filesystem::path source, output, mask;
    int lights = 36;
    int threads = 0;
    bool quiet = false;
    bool force = false;
};

void check(const ImportArguments& arguments)
{
    constexpr int kFewest = 12, kMost = 256;
    if (lowerExtension(arguments.output) != ".nacre") {
        throw Error(arguments.output, "is no name for a surface", "-o NAME.nacre", Error::kUsage);
    }
    if (arguments.lights < kFewest || arguments.lights > kMost) {
        throw Error("", fmt::format("--lights {} is out of range", arguments.lights),
                    fmt::format("{} to {}", kFewest, kMost), Error::kUsage);
    }
    if (arguments.threads < 0) {
        throw Error("", fmt::format("--threads {} is not possible", arguments.threads), "1 or more, or 0 for all",
                    Error::kUsage);
    }
    requireWholeFolder(arguments.output, arguments.force, kSurfaceDescription);
}

// dB of the surface's pictures under other lights against those of the file.
double agreementWith(const RtiPicture& picture, const Surface& surface, int threads)
{
    RtiFits fits(surface, {}, {.exposureStops = 0.0f, .threads = threads});
    return fits.psnrOf(picture);
}

void runImport(const ImportArguments& arguments)
{
    check(arguments);
    const RtiPicture picture = loadRelightable(arguments.source);
    const TemporaryFolder folder;
    writePredictedCapture(folder.path(), picture, predictedLights(arguments.lights), arguments.source,
                          arguments.threads);
    CaptureOptions given;
    given.mask = arguments.mask;
    Capture capture = loadCapture(folder.path(), given);
    const std::filesystem::path whole =
        arguments.source.has_filename() ? arguments.source : arguments.source.parent_path();
    capture.name = whole.stem().string();
    AcquireOptions options;
    options.setThreads(arguments.threads);
    options.bake.range = tableRangeFromName("front");
    // What smooth functions leave of shading and highlights is off everywhere, and no outlier that a robust method
    // could reject.
    options.normals.method = NormalMethod::leastSquares;
    options.removeSelfLight = options.correctIntensities = false;
    Acquisition result = acquire(capture, options, progressLine(arguments.quiet));
    // The fit bends shading as a transfer curve would.
    std::erase_if(result.estimate.report.findings, [](const Finding& finding) {
        return finding.code == FindingCode::transferCurveTaken || finding.code == FindingCode::transferCurveLeft;
    });
    endProgressLine(arguments.quiet);
    saveSurface(arguments.output, result.surface, arguments.force);
    if (arguments.quiet) {
        return;
    }
    fmt::print("{}\n\npredicted    {} photographs of {}x{} under lights to 60 degrees, by {} terms a pixel\n{}{}"
               "agreement    {:.1f} dB with the file's own pictures under 17 other lights, to the horizon\n"
               "not held     highlights and shadow borders sharper than those terms; what the file's lights did not "
               "reach\nwrote        {}\n",
               plainVerdict(result.estimate), arguments.lights, picture.width(), picture.height(), picture.terms.size(),
               describeNormals(capture, result.estimate), describeBrdf(result),
               agreementWith(picture, result.surface, arguments.threads), arguments.output.string());
}

} // namespace

void addImportCommand(CLI::App& app)
{
    auto arguments = std::make_shared<ImportArguments>();
    CLI::App* command =
        app.add_subcommand("import", "A PTM or RTI to a surface, from the photographs that it predicts");
    command->add_option("FILE", arguments->source, "FILE.ptm, FILE.rti (HSH), or a folder of relight with info.json")
        ->required();
    command->add_option("-o,--output", arguments->output, "Surface to write, NAME.nacre")
        ->option_text("OUT.nacre")
        ->required();
    command
        ->add_option("--mask", arguments->mask,
                     "Picture, white on the object (default: what is not black under all lights)")
        ->option_text("FILE");
    command->add_option("--lights", arguments->lights, "Number of photographs to predict")->capture_default_str();
    command->add_option("--threads", arguments->threads, "Number of threads (default: all)");
    command->add_flag("--quiet", arguments->quiet, "No summary");
    command->add_flag("--force", arguments->force, "Replacement of an existing output");
    command->footer("Example:\n  nacre import coin.ptm -o coin.nacre");
    command->callback([arguments] { runImport(*arguments); });
}

} // namespace nacre
