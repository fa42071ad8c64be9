#include "app/materials/material_library.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/report/brdf_report.h"
#include "engine/files/error.h"
#include "engine/materials/material_specification.h"
#include "engine/scene/coverage.h"
#include "engine/surface/surface_material.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

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
    return fs::is_directory(path) && (path.extension() == ".nacre" || fs::exists(path / "surface.json"));
}

// An EXR that says nothing of a table is some other picture, no broken material.
bool isForeignPicture(const fs::path& file)
{
    try {
        return file.extension() == ".exr" && readImageAttribute(file, "nacre:brdfTable").empty();
    } catch (const Error&) {
        return false;
    }
}

void addFound(Entries& entries, const fs::path& path)
{
    constexpr std::array kExtensions{".binary", ".bsdf", ".exr", ".brdf"};
    const bool isFile = fs::is_regular_file(path) &&
                        std::find(kExtensions.begin(), kExtensions.end(), path.extension()) != kExtensions.end();
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

} // namespace

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

std::vector<LibraryEntry> fitEntries(const fs::path& fitsFolder)
{
    Entries entries;
    addFits<AbcModel>(entries, loadAbcFits(fitsFolder / "merl_abc_params.csv"), "merl-abc");
    addFits<SgdModel>(entries, loadSgdFits(fitsFolder / "merl_sgd_params.csv"), "merl-sgd");
    return entries;
}

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

} // namespace nacre
