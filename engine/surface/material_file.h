#pragma once
#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "engine/surface/surface.h"

namespace nacre {

// The files of materials within a surface's folder (docs/formats.md): a table and its coverage, or the smaller model
// that it was reduced to beside its coverage alone. A basis that materials share is one file and, once read, one value.
class MaterialFolder {
public:
    explicit MaterialFolder(std::filesystem::path folder) : folder_(std::move(folder)) {}

    // Answers what surface.json says of the material.
    nlohmann::json save(const Material& material, size_t index);
    // Throws Error, or nlohmann's where the JSON lacks something.
    Material load(const nlohmann::json& json);

private:
    nlohmann::json saveModel(const CompactBrdf& model, size_t index);
    CompactBrdf loadModel(const nlohmann::json& json, const BrdfTable& covered);
    nlohmann::json saveBasis(const BasisBrdf& model, size_t index);
    BasisBrdf loadBasis(const nlohmann::json& json, const BrdfTable& covered);

    std::filesystem::path folder_;
    std::map<const BrdfBasis*, std::string> savedBases_;
    std::map<std::string, std::shared_ptr<const BrdfBasis>> loadedBases_;
};

} // namespace nacre
