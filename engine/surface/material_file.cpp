#include "engine/surface/material_file.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/files/error.h"
#include "engine/files/json_vector.h"

namespace nacre {
namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

// Coverage changes slowly: texels that are kept of it beside a model that is not a table.
constexpr glm::ivec3 kCoverageSize{24, 12, 8};

Json describeLobe(const AbcModel& m)
{
    return {{"kind", "lobe"}, {"kD", jsonOf(m.kD)}, {"A", jsonOf(m.A)}, {"B", m.B}, {"C", m.C}, {"ior", m.ior}};
}

AbcModel lobeOf(const Json& json)
{
    AbcModel m;
    m.kD = vec3Of(json.at("kD"));
    m.A = vec3Of(json.at("A"));
    m.B = json.at("B").get<float>();
    m.C = json.at("C").get<float>();
    m.ior = json.at("ior").get<float>();
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

Json describeModel(const CompactBrdf& model)
{
    if (const auto* lobe = std::get_if<FittedLobe>(&model)) {
        return describeLobe(lobe->model);
    }
    return {{"kind", "table"}, {"format", nameOf(std::get<SmallTable>(model).format)}};
}

// `covered`: of the full size and domain.
CompactBrdf modelOf(const fs::path& folder, const Json& json, const BrdfTable& covered)
{
    const std::string kind = json.at("kind").get<std::string>();
    if (kind == "lobe") {
        return FittedLobe{lobeOf(json)};
    }
    if (kind == "table") {
        return SmallTable{covered, texelFormatFromName(json.at("format").get<std::string>())};
    }
    throw Error(folder / "surface.json", "names a model \"" + kind + "\"", "lobe or table; acquire the surface again");
}

} // namespace

Json saveMaterialFiles(const fs::path& folder, const Material& material, size_t index)
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
        const glm::ivec3& s = material.table.size;
        saveBrdfTable(folder / table,
                      resampledTable(material.table, glm::min(s, kCoverageSize), material.table.domain));
        json["size"] = Json::array({s.x, s.y, s.z});
    }
    if (material.compact) {
        json["model"] = describeModel(*material.compact);
    }
    return json;
}

Material loadMaterialFiles(const fs::path& folder, const Json& json)
{
    Material material;
    material.name = json.at("name").get<std::string>();
    material.table = loadBrdfTable(folder / json.at("table").get<std::string>());
    if (json.contains("model")) {
        if (json.contains("size")) {
            material.table = resampledTable(material.table, sizeOf(folder, json.at("size")), material.table.domain);
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
