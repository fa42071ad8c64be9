#pragma once
#include <span>

#include "acquisition/capture/observations.h"
#include "acquisition/normals/normals.h"
#include "engine/scene/brdf_table.h"
#include "engine/scene/image.h"

namespace nacre {

// The factor a_p of f = a_p f_m for each pixel of a block, up to one factor per channel of the whole material: the
// scale of the pixel's own model, coloured as its explained observations are. 0 where there is no normal.
std::vector<glm::vec3> albedoFactors(const Observations& block, const NormalBlock& normals,
                                     const std::vector<Light>& lights);

// Makes the mean over the pixels that have a factor 1 in each channel, and gives the table what was taken from them.
void normaliseAlbedo(Image& albedo, BrdfTable& table);

} // namespace nacre
