#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "acquisition/capture/capture.h"
#include "engine/surface/normal_map.h"

namespace nacre {

// The circle of a sphere's mask: a geometric least-squares fit to the mask's border that forgets outliers (Tukey's
// biweight). The picture's own frame is no border. Throws Error where the mask is no disc; `source` names it.
Circle fitCircle(std::span<const uint8_t> mask, int width, int height, const std::filesystem::path& source);

// The geometric least-squares fit to points of its outline from a start near it, outliers forgotten.
Circle refinedCircle(Circle start, const std::vector<glm::dvec2>& border);

// Normals of the sphere inside its outline, at the centres of a width x height picture's pixels; none outside.
NormalMap sphereNormals(const Circle& circle, int width, int height);

// Unit normal of the sphere at a point of the picture, camera frame; z = 0 on and beyond the outline.
glm::vec3 sphereNormal(const Circle& circle, double x, double y);

} // namespace nacre
