#include <algorithm>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/arguments/destinations.h"
#include "app/commands/commands.h"
#include "app/materials/material_library.h"
#include "app/report/contact_sheet.h"
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
    int threads = 0;
    bool force = false;
    bool quiet = false;
};

void checkArguments(const MaterialsArguments& arguments)
{
    if (arguments.places.empty() && arguments.fits.empty()) {
        throw Error("", "no place to look for materials is given", "DIR, a material, or --fits DIR", Error::kUsage);
    }
    if (!arguments.output.empty()) {
        if (arguments.output.extension() != ".png") {
            throw Error(arguments.output, "is nothing that materials writes", ".png (a sheet of balls)", Error::kUsage);
        }
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
    if (!arguments.fits.empty()) {
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

void runMaterials(const MaterialsArguments& arguments)
{
    checkArguments(arguments);
    listMaterials(arguments);
}

} // namespace

void addMaterialsCommand(CLI::App& app)
{
    auto arguments = std::make_shared<MaterialsArguments>();
    CLI::App* command = app.add_subcommand("materials", "What materials there are, as a list and as balls");
    command->add_option("PLACE", arguments->places,
                        "Folders to look in (and one level below), or materials by name: NAME.nacre[#MATERIAL], "
                        ".binary, .bsdf, .exr, merl-abc:NAME, ...");
    command->add_option("--fits", arguments->fits,
                        "Folder of merl_abc_params.csv and merl_sgd_params.csv, to list the published fits as well");
    command->add_option("-o,--output", arguments->output, "Sheet of balls (.png)");
    command->add_option("--json", arguments->json, "File for the list as JSON");
    command->add_option("--threads", arguments->threads, "Threads (0: all)")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    command->add_flag("--force", arguments->force, "Replacement of existing outputs");
    command->add_flag("--quiet", arguments->quiet, "No messages");
    command->footer("Example:\n  nacre materials . -o balls.png");
    command->callback([arguments] { runMaterials(*arguments); });
}

} // namespace nacre
