#pragma once
#include <filesystem>

#include <nlohmann/json_fwd.hpp>

#include "engine/surface/residual_layer.h"
#include "engine/surface/surface.h"

namespace nacre {

// residual_NN.png, one grey picture a component, and residual_weights.exr, a row a component and a column a term of its
// spline; answers what surface.json says of them.
nlohmann::json saveResidual(const std::filesystem::path& folder, const ResidualLayer& layer);
// Nodes are the surface's lights. Throws Error about missing, unfitting or infinite values.
ResidualLayer loadResidual(const std::filesystem::path& folder, const nlohmann::json& json, const Surface& surface);

} // namespace nacre
