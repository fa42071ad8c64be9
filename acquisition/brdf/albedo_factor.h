#pragma once
#include <span>

#include "acquisition/capture/observations.h"
#include "acquisition/near_field/local_lights.h"
#include "acquisition/normals/normals.h"
#include "engine/brdf/brdf_table.h"
#include "engine/files/image.h"
#include "engine/surface/normal_map.h"

namespace nacre {

// The factor a_p of f = a_p f_m for each pixel of a block, up to one factor per channel of the whole material: the
// scale of the pixel's own model, coloured as its explained observations are. 0 where there is no normal.
std::vector<glm::vec3> albedoFactors(const Observations& block, const NormalBlock& normals,
                                     const std::vector<Light>& lights);

// Fits each pixel's factor anew to what the material's own table predicts, channel by channel: reweighted least squares
// whose weights fall linearly to zero where the prediction misses by kRefitLimit (pixel_prediction.h) of the pixel's
// bright level, so that cast shadows and interreflections say nothing. `albedo` holds the factors to start from, over
// whole photographs; pixels without one, without a normal, or that the table does not explain keep what they have.
void refitAlbedo(const Observations& block, const NormalMap& normals, const LocalLights& lights, const BrdfTable& table,
                 int threads, Image& albedo);

// Makes the mean over the pixels that have a factor 1 in each channel, and gives the table what was taken from them.
// Where all pixels share one albedo it is the median: the factors of hollows, which light themselves, are too high, and
// coloured as light is that bounced twice. Answers what was taken.
glm::vec3 normaliseAlbedo(bool haveOneAlbedo, Image& albedo, BrdfTable& table);

} // namespace nacre
