#include "engine/scene/material_file.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/scene/error.h"
#include "engine/scene/json_vector.h"

namespace nacre {
namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

// Coverage changes slowly: texels that are kept of it beside a model that is not a table.
constexpr glm::ivec3 kCoverageSize{24, 12, 8};
constexpr int kLargestRank = 64;

// One row of the picture for each `width` of values.
void saveRows(const fs::path& file, const std::vector<float>& values, int width)
{
    Image image(width, static_cast<int>(values.size() / width), 1);
    image.values = values;
    saveImage(file, image, PixelType::float32);
}

std::vector<float> loadRows(const fs::path& file, int width, int height)
{
    Image image = loadImage(file);
    if (image.width != width || image.height != height || image.channels != 1) {
        throw Error(file, fmt::format("is {}x{} with {} channels", image.width, image.height, image.channels),
                    fmt::format("{}x{} with 1", width, height));
    }
    return std::move(image.values);
}

Json describeLobe(const AbcModel& m)
{
    return {{"kind", "lobe"}, {"kD", jsonOf(m.kD)}, {"A", jsonOf(m.A)}, {"B", m.B}, {"C", m.C}, {"ior", m.ior}};
}

Json saveLowRank(const fs::path& folder, const LowRankTable& m, size_t index)
{
    const std::string profiles = fmt::format("material_{}_profiles.exr", index),
                      slices = fmt::format("material_{}_slices.exr", index);
    saveRows(folder / profiles, m.profiles, m.size.x);
    saveRows(folder / slices, m.slices, m.size.y);
    return {{"kind", "low-rank"}, {"rank", m.rank}, {"profiles", profiles}, {"slices", slices}};
}

// `covered`: of the full size and domain.
CompactBrdf modelOf(const fs::path& folder, const Json& json, const BrdfTable& covered)
{
    const std::string kind = json.at("kind").get<std::string>();
    if (kind == "lobe") {
        AbcModel m;
        m.kD = vec3Of(json.at("kD"));
        m.A = vec3Of(json.at("A"));
        m.B = json.at("B").get<float>();
        m.C = json.at("C").get<float>();
        m.ior = json.at("ior").get<float>();
        return FittedLobe{m};
    }
    if (kind == "table") {
        return SmallTable{covered, texelFormatFromName(json.at("format").get<std::string>())};
    }
    if (kind != "low-rank") {
        throw Error(folder / "surface.json", "names a model \"" + kind + "\"", "lobe, table or low-rank");
    }
    LowRankTable m{covered.size, covered.domain, json.at("rank").get<int>(), {}, {}};
    if (m.rank < 1 || m.rank > kLargestRank) {
        throw Error(folder / "surface.json", fmt::format("names a model of rank {}", m.rank),
                    fmt::format("1 to {}", kLargestRank));
    }
    m.profiles = loadRows(folder / json.at("profiles").get<std::string>(), m.size.x, 3 * m.rank);
    m.slices = loadRows(folder / json.at("slices").get<std::string>(), m.size.y, m.size.z * m.rank);
    return m;
}

glm::ivec3 sizeOf(const fs::path& folder, const Json& json)
{
    const glm::ivec3 size(json.at(0).get<int>(), json.at(1).get<int>(), json.at(2).get<int>());
    if (std::min({size.x, size.y, size.z}) < 1 || std::max({size.x, size.y, size.z}) > 512) {
        throw Error(folder / "surface.json", fmt::format("has a table of {}x{}x{}", size.x, size.y, size.z),
                    "1 to 512 texels a side");
    }
    return size;
}

} // namespace

Json saveMaterial(const fs::path& folder, const Material& material, size_t index)
{
    const std::string table = fmt::format("material_{}.exr", index);
    Json json = {{"name", material.name}, {"table", table}};
    if (!material.coverage.distance.empty()) {
        json["coverage"] = fmt::format("material_{}_coverage.exr", index);
        saveCoverage(folder / json["coverage"].get<std::string>(), material.table.size, material.coverage);
    }
    if (!material.compact || std::holds_alternative<SmallTable>(*material.compact)) {
        saveBrdfTable(folder / table, material.table);
    } else {
        saveBrdfTable(folder / table, resampledTable(material.table, glm::min(material.table.size, kCoverageSize)));
        const glm::ivec3& s = material.table.size;
        json["size"] = Json::array({s.x, s.y, s.z});
    }
    if (material.compact) {
        if (const auto* lobe = std::get_if<FittedLobe>(&*material.compact)) {
            json["model"] = describeLobe(lobe->model);
        } else if (const auto* small = std::get_if<SmallTable>(&*material.compact)) {
            json["model"] = {{"kind", "table"}, {"format", nameOf(small->format)}};
        } else {
            json["model"] = saveLowRank(folder, std::get<LowRankTable>(*material.compact), index);
        }
    }
    return json;
}

Material loadMaterial(const fs::path& folder, const Json& json)
{
    Material material;
    material.name = json.at("name").get<std::string>();
    material.table = loadBrdfTable(folder / json.at("table").get<std::string>());
    if (json.contains("model")) {
        if (json.contains("size")) {
            material.table = resampledTable(material.table, sizeOf(folder, json.at("size")));
        }
        material.compact = modelOf(folder, json.at("model"), material.table);
        material.table = expandedTable(*material.compact, material.table);
    }
    if (json.contains("coverage")) {
        material.coverage = loadCoverage(folder / json.at("coverage").get<std::string>(), material.table.size);
    }
    return material;
}

} // namespace nacre
