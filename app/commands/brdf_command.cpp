#include <algorithm>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/arguments/destinations.h"
#include "app/commands/commands.h"
#include "app/report/brdf_pictures.h"
#include "app/report/brdf_report.h"
#include "app/report/scattered_report.h"
#include "engine/files/error.h"
#include "engine/files/whole_file.h"
#include "engine/materials/ktx2_file.h"
#include "engine/materials/material_specification.h"
#include "engine/materials/merl_file.h"

namespace nacre {
namespace {

struct BrdfArguments {
    std::string source;
    std::string against;
    std::filesystem::path fits;
    std::filesystem::path pictures;
    std::vector<std::filesystem::path> exports;
    std::filesystem::path json;
    int threads = 0;
    bool force = false;
    bool quiet = false;
};

constexpr const char* kExample =
    "Example:\n"
    "  nacre brdf horse.nacre -o horse-brdf\n"
    "  nacre brdf alum-bronze.binary --against merl-abc:alum-bronze --fits FOLDER\n"
    "  nacre brdf paper_white_rgb.bsdf --export paper.binary --export paper.ktx2\n"
    "Materials: NAME.nacre[#MATERIAL]  FILE.binary (MERL)  FILE.bsdf (RGL, isotropic RGB)  FILE.exr (our table)\n"
    "  FILE.brdf (Cornell's scattered measurements)  lambert:R,G,B  ggx:diffuse=R,G,B;specular=R,G,B;alpha=A\n"
    "  merl-abc:NAME  merl-sgd:NAME";

// Refuses what cannot be written before any work is done.
void checkArguments(const BrdfArguments& arguments)
{
    for (const std::filesystem::path& file : arguments.exports) {
        const std::string extension = file.extension().string();
        if (extension != ".binary" && extension != ".ktx2" && extension != ".exr") {
            throw Error(file, "is no file that --export writes", ".binary (MERL), .ktx2 or .exr", Error::kUsage);
        }
        requireDestination(file, arguments.force);
    }
    requireSummaryDestination(arguments.json);
    requireFolderDestination(arguments.pictures);
    if (arguments.threads < 0) {
        throw Error("", fmt::format("--threads {} is not possible", arguments.threads), "1 or more, or 0 for all",
                    Error::kUsage);
    }
}

void exportTo(const std::filesystem::path& file, const BrdfSource& source, const BrdfArguments& arguments)
{
    std::string note;
    if (file.extension() == ".binary") {
        saveMerl(file, source.model, arguments.threads);
    } else if (file.extension() == ".exr") {
        saveBrdfTable(file, tableOfSource(source, arguments.threads));
    } else if (const size_t clamped = saveKtx2(file, tableOfSource(source, arguments.threads)); clamped > 0) {
        note = fmt::format(" ({} values beyond 16 bits clamped to 65504)", clamped);
    }
    if (!arguments.quiet) {
        fmt::print("wrote        {}{}\n", file.string(), note);
    }
}

void runScattered(const BrdfArguments& arguments)
{
    if (!arguments.against.empty() || !arguments.exports.empty() || !arguments.pictures.empty()) {
        throw Error(arguments.source, "holds scattered measurements, no BRDF between them",
                    "no --against, --export or -o with a .brdf", Error::kUsage);
    }
    const ScatteredReport report = examineScattered(arguments.source, arguments.threads);
    if (!arguments.quiet) {
        print(report);
    }
    if (!arguments.json.empty()) {
        writeTextFile(arguments.json, jsonOf(report).dump(2) + "\n");
    }
}

void runBrdf(const BrdfArguments& arguments)
{
    checkArguments(arguments);
    if (std::filesystem::path(arguments.source).extension() == ".brdf") {
        return runScattered(arguments);
    }
    const std::filesystem::path fits = fitsFolderFrom(arguments.fits);
    BrdfReport report{loadBrdfSource(arguments.source, fits), {}, {}, {}};
    const BrdfFunction f = functionOf(report.source.model);
    if (!arguments.against.empty()) {
        const BrdfSource other = loadBrdfSource(arguments.against, fits);
        report.against = other.name;
        report.comparison = compareBrdfs(f, functionOf(other.model));
        if (report.comparison->configurations == 0) {
            throw Error(arguments.against, "covers nothing that " + arguments.source + " covers",
                        "materials with a common domain");
        }
    }
    report.audit = auditBrdf(f, arguments.threads);
    if (!arguments.quiet) {
        print(report);
    }
    if (!arguments.pictures.empty()) {
        saveBrdfPictures(arguments.pictures, report.source, arguments.force, arguments.threads);
    }
    for (const std::filesystem::path& file : arguments.exports) {
        exportTo(file, report.source, arguments);
    }
    if (!arguments.json.empty()) {
        writeTextFile(arguments.json, jsonOf(report).dump(2) + "\n");
    }
}

} // namespace

void addBrdfCommand(CLI::App& app)
{
    auto arguments = std::make_shared<BrdfArguments>();
    CLI::App* command = app.add_subcommand("brdf", "What a measured material or a model holds: audit, pictures, files");
    command->add_option("MATERIAL", arguments->source, "File, surface or model, see below")->required();
    command->add_option("--against", arguments->against, "Compare to this material");
    command->add_option("--fits", arguments->fits,
                        "Folder of merl_abc_params.csv and merl_sgd_params.csv "
                        "[environment variable NACRE_FITS_DIR]");
    command->add_option("-o,--output", arguments->pictures, "Folder for slices.png and sphere.png");
    command
        ->add_option("--export", arguments->exports,
                     "Write .binary (MERL), .ktx2 (3D texture, 16-bit floats) or .exr (our table). Repeatable")
        ->allow_extra_args(false);
    command->add_option("--json", arguments->json, "Write the figures to this file too");
    command->add_option("--threads", arguments->threads, "Threads (0: all)")->capture_default_str();
    command->add_flag("--force", arguments->force, "Replace outputs that exist");
    command->add_flag("--quiet", arguments->quiet, "Print nothing");
    command->footer(kExample);
    command->callback([arguments] { runBrdf(*arguments); });
}

} // namespace nacre
