#pragma once
#include <filesystem>

#include <nlohmann/json_fwd.hpp>

#include "engine/surface/surface.h"

namespace nacre {

// The files of material `index` within a surface's folder (docs/formats.md): a table and its coverage, or the smaller
// model that it was reduced to beside its coverage alone. Answers what surface.json says of the material.
nlohmann::json saveMaterialFiles(const std::filesystem::path& folder, const Material& material, size_t index);

// Throws Error, or nlohmann's where the JSON lacks something.
Material loadMaterialFiles(const std::filesystem::path& folder, const nlohmann::json& json);

} // namespace nacre
