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
constexpr int kLargestRank = 64;

// One row of the picture for each `width` of values.
void saveRows(const fs::path& file, const std::vector<float>& values, int width, PixelType type = PixelType::float32)
{
    Image image(width, static_cast<int>(values.size() / width), 1);
    image.values = values;
    saveImage(file, image, type);
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

int rankOf(const fs::path& folder, const Json& json)
{
    const int rank = json.at("rank").get<int>();
    if (rank < 1 || rank > kLargestRank) {
        throw Error(folder / "surface.json", fmt::format("names a model of rank {}", rank),
                    fmt::format("1 to {}", kLargestRank));
    }
    return rank;
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

Json MaterialFolder::saveBasis(const BasisBrdf& model, size_t index)
{
    auto [saved, isNew] = savedBases_.try_emplace(model.basis.get(), fmt::format("basis_{}.exr", index));
    if (isNew) {
        saveRows(folder_ / saved->second, model.basis->components, model.basis->size.x, PixelType::half);
    }
    return {{"kind", "basis"},
            {"rank", model.basis->rank},
            {"components", saved->second},
            {"coefficients", model.coefficients}};
}

BasisBrdf MaterialFolder::loadBasis(const Json& json, const BrdfTable& covered)
{
    const std::string name = json.at("components").get<std::string>();
    const int rank = rankOf(folder_, json);
    std::shared_ptr<const BrdfBasis>& basis = loadedBases_[name];
    if (!basis) {
        const glm::ivec3& size = covered.size;
        basis = std::make_shared<BrdfBasis>(
            BrdfBasis{size, covered.domain, rank, loadRows(folder_ / name, size.x, size.y * size.z * rank)});
    }
    BasisBrdf model{basis, json.at("coefficients").get<std::vector<float>>()};
    if (basis->size != covered.size || basis->rank != rank || model.coefficients.size() != size_t{3} * rank) {
        throw Error(folder_ / "surface.json", "has a material that does not go with " + name,
                    fmt::format("{} coefficients and a table of {}x{}x{}", 3 * basis->rank, basis->size.x,
                                basis->size.y, basis->size.z));
    }
    return model;
}

Json MaterialFolder::saveModel(const CompactBrdf& model, size_t index)
{
    if (const auto* lobe = std::get_if<FittedLobe>(&model)) {
        return describeLobe(lobe->model);
    }
    if (const auto* small = std::get_if<SmallTable>(&model)) {
        return {{"kind", "table"}, {"format", nameOf(small->format)}};
    }
    return saveBasis(std::get<BasisBrdf>(model), index);
}

// `covered`: of the full size and domain.
CompactBrdf MaterialFolder::loadModel(const Json& json, const BrdfTable& covered)
{
    const std::string kind = json.at("kind").get<std::string>();
    if (kind == "lobe") {
        return FittedLobe{lobeOf(json)};
    }
    if (kind == "table") {
        return SmallTable{covered, texelFormatFromName(json.at("format").get<std::string>())};
    }
    if (kind == "basis") {
        return loadBasis(json, covered);
    }
    throw Error(folder_ / "surface.json", "names a model \"" + kind + "\"", "lobe, table or basis");
}

Json MaterialFolder::save(const Material& material, size_t index)
{
    const std::string table = fmt::format("material_{}.exr", index);
    Json json = {{"name", material.name}, {"table", table}};
    if (!material.coverage.distance.empty()) {
        json["coverage"] = fmt::format("material_{}_coverage.exr", index);
        saveCoverage(folder_ / json["coverage"].get<std::string>(), material.table.size, material.coverage);
    }
    if (!material.compact || std::holds_alternative<SmallTable>(*material.compact)) {
        saveBrdfTable(folder_ / table, material.table);
    } else {
        const glm::ivec3& s = material.table.size;
        saveBrdfTable(folder_ / table,
                      resampledTable(material.table, glm::min(s, kCoverageSize), material.table.domain));
        json["size"] = Json::array({s.x, s.y, s.z});
    }
    if (material.compact) {
        json["model"] = saveModel(*material.compact, index);
    }
    return json;
}

Material MaterialFolder::load(const Json& json)
{
    Material material;
    material.name = json.at("name").get<std::string>();
    material.table = loadBrdfTable(folder_ / json.at("table").get<std::string>());
    if (json.contains("model")) {
        if (json.contains("size")) {
            material.table = resampledTable(material.table, sizeOf(folder_, json.at("size")), material.table.domain);
        }
        material.compact = loadModel(json.at("model"), material.table);
        material.table = expandedTable(*material.compact, material.table);
    }
    if (json.contains("coverage")) {
        material.coverage = loadCoverage(folder_ / json.at("coverage").get<std::string>(), material.table.size);
    }
    return material;
}

} // namespace nacre
