#include <algorithm>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/arguments/destinations.h"
#include "app/arguments/interpolation_arguments.h"
#include "app/commands/commands.h"
#include "app/materials/library_packing.h"
#include "app/materials/material_library.h"
#include "app/report/acquisition_summary.h"
#include "app/report/contact_sheet.h"
#include "app/report/ladder_report.h"
#include "engine/files/error.h"
#include "engine/files/parallel_for.h"
#include "engine/files/stopwatch.h"
#include "engine/files/whole_file.h"
#include "engine/materials/material_specification.h"
#include "engine/scene/ball.h"

namespace nacre {

namespace {

constexpr int kBallSize = 160;  // pixels
constexpr int kCellWidth = 208; // of a caption
constexpr size_t kCaptionLetters = 27;
constexpr size_t kMostColumns = 10;

struct MaterialsArguments {
    std::vector<std::string> places;
    std::filesystem::path fits;
    std::filesystem::path output;
    std::filesystem::path json;
    LadderArguments ladder;
    int threads = 0;
    bool force = false;
    bool quiet = false;
};

void checkArguments(const MaterialsArguments& arguments)
{
    const std::string extension = arguments.output.extension().string();
    const bool isReduced = !arguments.ladder.tolerance.empty() || !arguments.ladder.budget.empty();
    if (arguments.places.empty() && arguments.fits.empty()) {
        throw Error("", "no place to look for materials is given", "DIR, a material, or --fits DIR", Error::kUsage);
    }
    if (!arguments.output.empty() && extension != ".png" && extension != ".nacre") {
        throw Error(arguments.output, "is nothing that materials writes",
                    ".png (a sheet of balls) or .nacre (a library)", Error::kUsage);
    }
    if (isReduced && extension != ".nacre") {
        throw Error("", "--tolerance and --budget-bytes make a library", "-o LIBRARY.nacre", Error::kUsage);
    }
    if (!arguments.output.empty()) {
        requireDestination(arguments.output, arguments.force);
    }
    requireSummaryDestination(arguments.json);
}

// The end of a name tells materials apart.
std::string captionOf(const std::string& specification)
{
    const size_t slash = specification.rfind('/');
    const std::string name = slash == std::string::npos ? specification : specification.substr(slash + 1);
    return name.size() <= kCaptionLetters ? name : ".." + name.substr(name.size() - kCaptionLetters + 2);
}

// Every ball by the same lights and the same rule of exposure.
Image sheetOf(const std::vector<LibraryEntry>& usable, int threads)
{
    std::vector<Image> balls(usable.size());
    parallelFor(usable.size(), 1, threads, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            const Image radiance = materialThumbnail(usable[i].model, kBallSize);
            balls[i] = displayedImage(radiance, {.exposureStops = automaticExposure(radiance)});
        }
    });
    const size_t columns = std::min(kMostColumns, usable.size());
    std::vector<std::vector<SheetCell>> rows((usable.size() + columns - 1) / columns);
    for (size_t i = 0; i < usable.size(); ++i) {
        rows[i / columns].push_back({std::move(balls[i]), captionOf(usable[i].specification)});
    }
    return contactSheet(rows, kCellWidth, kBallSize);
}

std::vector<LibraryEntry> entriesOf(const MaterialsArguments& arguments)
{
    std::vector<LibraryEntry> entries = libraryOf(arguments.places, fitsFolderFrom(arguments.fits));
    if (!arguments.fits.empty() && (arguments.places.empty() || arguments.output.extension() != ".nacre")) {
        std::vector<LibraryEntry> fits = fitEntries(arguments.fits);
        std::move(fits.begin(), fits.end(), std::back_inserter(entries));
    }
    return entries;
}

void listMaterials(const MaterialsArguments& arguments)
{
    const std::vector<LibraryEntry> entries = entriesOf(arguments);
    std::vector<LibraryEntry> usable;
    std::copy_if(entries.begin(), entries.end(), std::back_inserter(usable),
                 [](const LibraryEntry& entry) { return entry.problem.empty(); });
    if (usable.empty()) {
        throw Error("", entries.empty() ? arguments.places.front() + ": holds no material" : entries.front().problem,
                    fmt::format("NAME.nacre, .binary, .bsdf or our .exr tables ({} unusable)", entries.size()));
    }
    if (!arguments.quiet) {
        print(entries);
        fmt::print("in all       {} usable, {} not\n", usable.size(), entries.size() - usable.size());
    }
    if (!arguments.output.empty()) {
        saveImage(arguments.output, sheetOf(usable, arguments.threads), PixelType::uint8);
        if (!arguments.quiet) {
            fmt::print("wrote        {}\n", arguments.output.string());
        }
    }
    if (!arguments.json.empty()) {
        writeTextFile(arguments.json, jsonOf(entries).dump(2) + "\n");
    }
}

std::vector<std::string> specificationsOf(const MaterialsArguments& arguments)
{
    std::vector<std::string> specifications;
    for (const LibraryEntry& entry : entriesOf(arguments)) {
        if (!entry.problem.empty()) {
            throw Error("", entry.problem, "materials that can be used: all of them are packed");
        }
        specifications.push_back(entry.specification);
    }
    if (specifications.empty()) {
        throw Error("", arguments.places.front() + ": holds no material",
                    "NAME.nacre, .binary, .bsdf or our .exr tables");
    }
    return specifications;
}

const SharedStep& takenStep(const SharedLadder& shared)
{
    return shared.taken ? shared.steps[*shared.taken] : shared.apart;
}

void print(const PackedLibrary& library)
{
    for (size_t i = 0; i < library.ladders.size(); ++i) {
        if (const std::string ladder = describe(library.ladders[i]); !ladder.empty()) {
            fmt::print("{}\n{}", library.surface.materials[i].name, ladder);
        }
    }
    fmt::print("{}full tables  {} bytes\n", describe(library.shared), library.fullBytes);
}

nlohmann::json summaryOf(const PackedLibrary& library, double seconds)
{
    const SharedLadder& shared = library.shared;
    const auto jsonOf = [](const SharedStep& step) {
        return nlohmann::json{
            {"description", step.description}, {"bytes", step.bytes}, {"worstDecibels", step.leastPsnr}};
    };
    nlohmann::json json = {
        {"materials", library.surface.materials.size()}, {"fullBytes", library.fullBytes}, {"seconds", seconds}};
    if (shared.apart.bytes > 0) {
        json["apart"] = jsonOf(shared.apart);
        json["taken"] = jsonOf(takenStep(shared));
    }
    return json;
}

void packMaterials(const MaterialsArguments& arguments)
{
    const Stopwatch watch;
    const PackedLibrary library = packedLibrary(specificationsOf(arguments), fitsFolderFrom(arguments.fits),
                                                arguments.ladder.options(arguments.threads));
    const double seconds = watch.seconds();
    saveSurface(arguments.output, library.surface, arguments.force);
    if (!arguments.quiet) {
        print(library);
        fmt::print("packed       {} materials in {:.1f} seconds\nwrote        {}\n", library.surface.materials.size(),
                   seconds, arguments.output.string());
    }
    if (!arguments.json.empty()) {
        writeTextFile(arguments.json, summaryOf(library, seconds).dump(2) + "\n");
    }
}

void runMaterials(const MaterialsArguments& arguments)
{
    checkArguments(arguments);
    arguments.output.extension() == ".nacre" ? packMaterials(arguments) : listMaterials(arguments);
}

} // namespace

void addMaterialsCommand(CLI::App& app)
{
    auto arguments = std::make_shared<MaterialsArguments>();
    CLI::App* command = app.add_subcommand("materials", "What materials there are, as a list and as balls; a library");
    command->add_option("PLACE", arguments->places,
                        "Folders to look in (and one level below), or materials by name: NAME.nacre[#MATERIAL], "
                        ".binary, .bsdf, .exr, merl-abc:NAME, ...");
    command->add_option("--fits", arguments->fits,
                        "List the published fits too: folder of merl_abc_params.csv and merl_sgd_params.csv");
    command->add_option("-o,--output", arguments->output,
                        "Sheet of balls (.png), or all of them packed into LIBRARY.nacre, one ball each");
    arguments->ladder.addTo(*command);
    command->add_option("--json", arguments->json, "Write the list, or the packing's figures, to this file");
    command->add_option("--threads", arguments->threads, "Threads (0: all)")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    command->add_flag("--force", arguments->force, "Replace an output that exists");
    command->add_flag("--quiet", arguments->quiet, "Print nothing");
    command->footer("Example:\n  nacre materials . -o balls.png\n"
                    "  nacre materials horse.nacre paper_white_rgb.bsdf --tolerance 45dB -o library.nacre\n"
                    "  nacre transfer --materials library.nacre#horse --onto make:cloth --rig key -o out");
    command->callback([arguments] { runMaterials(*arguments); });
}

} // namespace nacre
