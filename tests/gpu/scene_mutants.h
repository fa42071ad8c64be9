#pragma once
#include <vector>

#include "engine/scene/scene.h"

namespace nacre::test {

// Mistakes of a renderer, made in its inputs: the right renderer draws of the altered scene what the mistaken one would
// draw of the right scene (the dropped cosine and the half texel up to the table's interpolation).
struct SceneMutant {
    const char* name;
    bool (*alter)(Scene& scene); // false where the scene has nothing to alter
};

const std::vector<SceneMutant>& sceneMutants();

// Mistakes that are made on the picture.
struct PictureMutant {
    const char* name;
    Image (*alter)(const Image& picture);
};

const std::vector<PictureMutant>& pictureMutants();

} // namespace nacre::test
