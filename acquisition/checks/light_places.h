#pragma once
#include "acquisition/near_field/as_if_distant.h"
#include "acquisition/normals/normals.h"

namespace nacre {

// What of the lights' places is to be found.
enum class PlaceSearch {
    depth,    // in front of or behind where they are said to be: a height does not tell which depth the middle has
    distance, // along their directions, and the depth
};

struct PlacedLights {
    NearField near;
    SurfaceGuess guess; // of the whole picture, coarse: each sampled pixel's for the square around it
};

// Places that leave the least scatter from Lambert's law (matte_scatter.h), each judged with the surface that follows
// from it: normals by consensus, their height, and both again, on the sample's grid. `seen` as photographed; `near`:
// the camera, and places to start from; `size`: of the picture.
PlacedLights placeLights(const Observations& seen, const std::vector<Light>& lights, const NearField& near,
                         PlaceSearch search, const glm::ivec2& size, const NormalOptions& options);

} // namespace nacre
