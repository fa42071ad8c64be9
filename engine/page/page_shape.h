#pragma once
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "engine/page/page_parts.h"
#include "engine/surface/surface.h"

namespace nacre {

// The rectangle of a picture that a page stores: what has a normal, and a small margin.
struct PageCrop {
    int x = 0, y = 0, width = 0, height = 0; // pixels, from the top left
};
PageCrop cropOf(const NormalMap& normals);
Image cropped(const Image& picture, const PageCrop& crop); // of three channels

// Kinds of parts, as a page's shares name them.
inline constexpr const char* kResidualPart = "residual layer";

// Which arrays a shape has.
struct ShapeContent {
    bool materials = false; // its own: factors, labels and residual layer
    bool places = false;    // of its pixels, for near lights and cameras; there in any case where it casts shadows
};

// A shape's description for the page's script, its arrays added to the parts.
nlohmann::json describeShape(const std::string& name, const Surface& surface, const ShapeContent& content,
                             PageParts& parts);

// The same of a material.
nlohmann::json describeMaterial(const Material& material, PageParts& parts);

} // namespace nacre
