#pragma once
#include <filesystem>

#include <nlohmann/json_fwd.hpp>

#include "engine/scene/surface.h"

namespace nacre {

// A material's files within a surface's folder (docs/formats.md): its table and coverage, or the smaller model that it
// was reduced to beside its coverage alone. Answers what surface.json says of it.
nlohmann::json saveMaterial(const std::filesystem::path& folder, const Material& material, size_t index);

// Throws Error, or nlohmann's where the JSON lacks something.
Material loadMaterial(const std::filesystem::path& folder, const nlohmann::json& json);

} // namespace nacre
