#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/arguments/destinations.h"
#include "app/commands/commands.h"
#include "app/report/brdf_report.h"
#include "app/report/contact_sheet.h"
#include "engine/brdf/brdf_models.h"
#include "engine/files/error.h"
#include "engine/files/parallel_for.h"
#include "engine/files/stopwatch.h"
#include "engine/files/text_files.h"
#include "engine/materials/material_specification.h"
#include "engine/scene/ball.h"
#include "engine/scene/coverage.h"
#include "engine/surface/surface_material.h"

namespace nacre {

namespace {

// A material that can be used, or a file that should have been one.
struct LibraryEntry {
    std::string specification; // to type
    std::string kind{};        // for the user
    std::string problem{};     // why it cannot be used; empty where it can
    size_t bytes = 0;          // of the file; of the model in memory for a surface's material or a fit
    // Of the configurations above the horizon; empty for formulas, and where a table does not say.
    std::optional<double> measured{};
    BrdfModel model{};
};

namespace fs = std::filesystem;

using Entries = std::vector<LibraryEntry>;

std::optional<double> measuredShare(const BrdfModel& model)
{
    const BrdfTable* table = tableOf(model);
    return table && knowsCoverage(*table) ? std::optional(coveredShare(*table)) : std::nullopt;
}

void addSurface(Entries& entries, const std::string& folder)
{
    Surface surface = loadSurface(folder);
    for (size_t i = 0; i < surface.materials.size(); ++i) {
        Material& material = surface.materials[i];
        LibraryEntry entry{.specification = specificationOf(folder, surface, i)};
        entry.kind = material.compact ? "surface, " + describe(*material.compact) : "surface, table";
        entry.bytes = bytesOf(material);
        entry.model = std::make_shared<const BrdfTable>(std::move(material.table));
        entry.measured = measuredShare(entry.model);
        entries.push_back(std::move(entry));
    }
}

void addNamed(Entries& entries, const std::string& specification, const fs::path& fitsFolder)
{
    LibraryEntry entry{.specification = specification};
    if (auto found = loadSurfaceMaterial(specification)) {
        entry.kind = found->material.compact ? "surface, " + describe(*found->material.compact) : "surface, table";
        entry.bytes = bytesOf(found->material);
        entry.model = std::make_shared<const BrdfTable>(std::move(found->material.table));
    } else {
        entry.model = parseMaterial(specification, fitsFolder).model;
        entry.kind = kindOf(specification, entry.model);
        const fs::path file =
            fs::exists(specification) ? specification : specification.substr(specification.find(':') + 1);
        entry.bytes = fs::is_regular_file(file) ? fs::file_size(file) : sizeof(LambertGgx);
    }
    entry.measured = measuredShare(entry.model);
    entries.push_back(std::move(entry));
}

// What add() cannot use becomes an entry with its error.
template <typename Add> void tryAdd(Entries& entries, const std::string& specification, const Add& add)
{
    const size_t before = entries.size();
    try {
        add();
    } catch (const Error& error) {
        entries.resize(before);
        entries.push_back({.specification = specification, .kind = "unusable", .problem = error.what()});
    }
}

bool isSurfaceFolder(const fs::path& path)
{
    return fs::is_directory(path) && (lowerExtension(path) == ".nacre" || fs::exists(path / "surface.json"));
}

// An EXR that says nothing of a table is some other picture, no broken material.
bool isForeignPicture(const fs::path& file)
{
    try {
        return lowerExtension(file) == ".exr" && readImageAttribute(file, "nacre:brdfTable").empty();
    } catch (const Error&) {
        return false;
    }
}

void addFound(Entries& entries, const fs::path& path)
{
    constexpr std::array kExtensions{".binary", ".bsdf", ".exr", ".brdf"};
    const bool isFile = fs::is_regular_file(path) &&
                        std::find(kExtensions.begin(), kExtensions.end(), lowerExtension(path)) != kExtensions.end();
    if (isSurfaceFolder(path)) {
        tryAdd(entries, path.string(), [&] { addSurface(entries, path.string()); });
    } else if (isFile && !isForeignPicture(path)) {
        tryAdd(entries, path.string(), [&] { addNamed(entries, path.string(), {}); });
    }
}

std::vector<fs::path> sortedContent(const fs::path& folder)
{
    std::vector<fs::path> paths;
    for (const auto& item : fs::directory_iterator(folder)) {
        paths.push_back(item.path());
    }
    std::sort(paths.begin(), paths.end());
    return paths;
}

void addFolder(Entries& entries, const fs::path& folder)
{
    for (const fs::path& path : sortedContent(folder)) {
        addFound(entries, path);
        if (fs::is_directory(path) && !isSurfaceFolder(path)) {
            for (const fs::path& inner : sortedContent(path)) {
                addFound(entries, inner);
            }
        }
    }
}

template <typename Model> void addFits(Entries& entries, const std::vector<NamedBrdf>& fits, const char* family)
{
    for (const NamedBrdf& fit : fits) {
        entries.push_back({.specification = fmt::format("{}:{}", family, fit.name),
                           .kind = "published fit",
                           .bytes = sizeof(Model),
                           .model = fit.model});
    }
}

// What the places hold, in their order, by name within a folder: NAME.nacre (each of its materials), .binary, .bsdf and
// our .exr tables in a folder and in the folders in it; or one material that is named. What cannot be used is listed
// with its error.
std::vector<LibraryEntry> libraryOf(const std::vector<std::string>& places, const fs::path& fitsFolder)
{
    Entries entries;
    for (const std::string& place : places) {
        if (fs::is_directory(place) && !isSurfaceFolder(place)) {
            addFolder(entries, place);
        } else if (isSurfaceFolder(place)) {
            tryAdd(entries, place, [&] { addSurface(entries, place); });
        } else {
            tryAdd(entries, place, [&] { addNamed(entries, place, fitsFolder); });
        }
    }
    return entries;
}

// All published fits, ABC before SGD. Throws Error where the folder lacks them.
std::vector<LibraryEntry> fitEntries(const fs::path& fitsFolder)
{
    Entries entries;
    addFits<AbcModel>(entries, loadAbcFits(fitsFolder / "merl_abc_params.csv"), "merl-abc");
    addFits<SgdModel>(entries, loadSgdFits(fitsFolder / "merl_sgd_params.csv"), "merl-sgd");
    return entries;
}

// One line an entry, problems last.
void print(const std::vector<LibraryEntry>& entries)
{
    size_t widest = 0;
    for (const LibraryEntry& entry : entries) {
        widest = std::max(widest, entry.problem.empty() ? entry.specification.size() : 0);
    }
    fmt::print("{:<{}}  {:>10}  measured  kind\n", "material", widest, "bytes");
    for (const LibraryEntry& entry : entries) {
        if (entry.problem.empty()) {
            const std::string share = entry.measured ? fmt::format("{:.1f} %", 100 * *entry.measured) : "-";
            fmt::print("{:<{}}  {:>10}  {:>8}  {}\n", entry.specification, widest, entry.bytes, share, entry.kind);
        }
    }
    for (const LibraryEntry& entry : entries) {
        if (!entry.problem.empty()) {
            fmt::print("unusable     {}\n", entry.problem);
        }
    }
}

nlohmann::json jsonOf(const std::vector<LibraryEntry>& entries)
{
    nlohmann::json list = nlohmann::json::array();
    for (const LibraryEntry& entry : entries) {
        nlohmann::json item = {{"material", entry.specification}};
        if (entry.problem.empty()) {
            item["kind"] = entry.kind;
            item["bytes"] = entry.bytes;
            item["measured"] = entry.measured ? nlohmann::json(*entry.measured) : nlohmann::json();
        } else {
            item["error"] = entry.problem;
        }
        list.push_back(std::move(item));
    }
    return {{"materials", std::move(list)}};
}

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
        if (lowerExtension(arguments.output) != ".png") {
            throw Error(arguments.output, "is nothing that materials writes", ".png (a sheet of balls)", Error::kUsage);
        }
        requireFile(arguments.output, arguments.force);
    }
    requireSummary(arguments.json, arguments.force);
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
    writeSummary(arguments.json, jsonOf(entries));
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
    command->add_option("-o,--output", arguments->output, "Sheet of balls (.png)")->option_text("OUT.png");
    command->add_option("--json", arguments->json, "File for the list as JSON")->option_text("OUT.json");
    command->add_option("--threads", arguments->threads, "Threads (0: all)")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    command->add_flag("--force", arguments->force, "Replacement of existing outputs");
    command->add_flag("--quiet", arguments->quiet, "No messages");
    command->footer("Example:\n  nacre materials . -o balls.png");
    command->callback([arguments] { runMaterials(*arguments); });
}

} // namespace nacre
