#pragma once
#include <span>

#include "engine/surface/surface.h"

namespace nacre {

// Whether a picture of the surface from there has something of its residual layer.
bool hasResidualFrom(const Surface& surface, const glm::vec3& view);

// Throws Error (usage) where the layer is asked for by itself and the picture has nothing of it.
void requireResidual(const Surface& surface, const glm::vec3& view, ResidualUse use);

// A layer by itself is exposed as the picture that it is a part of.
inline ResidualUse residualOfExposure(ResidualUse use)
{
    return use == ResidualUse::alone ? ResidualUse::on : use;
}

// How many of the lights that are on lie so far from the captured ones that the layer fades out.
size_t lightsBeyondResidual(const ResidualLayer& layer, std::span<const Light> lights);

} // namespace nacre
