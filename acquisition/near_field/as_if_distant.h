#pragma once
#include "acquisition/capture/observations.h"
#include "acquisition/near_field/local_lights.h"
#include "engine/files/image.h"
#include "engine/surface/normal_map.h"

namespace nacre {

// What is known of a surface while it is estimated; both empty at first.
struct SurfaceGuess {
    NormalMap normals; // camera frame
    Image height;      // pixels above the plane of NearField
};

// Normals of the block's pixels in their own frames, 0 where there is none; none at all without a map.
std::vector<glm::vec3> localNormals(const Observations& block, const LocalLights& lights, const NormalMap& normals);

// What the block's pixels would show under the reference lights, seen along their own rays: an estimator for distant
// lights answers their normals in their local frames. The fall-off is taken out; where a normal n is known, so is what
// the pixel's own light l does to the shading, by the factor n.lr / n.l against the reference lr. An observation that
// grazes its own light (n.l below 0.05) and not the reference tells nothing, and is marked as clipped.
// `normals`: of each pixel in its own frame, 0 where it is not known; empty: none is.
Observations asIfDistant(Observations block, const LocalLights& lights, std::span<const glm::vec3> normals,
                         int threads);

// The next guess of the normals after those that were found by the last one. Before near lights it is half way between
// them: where light grazes, the shading factor n.lr / n.l goes further beyond the truth than the guess is off, and
// surfaces found by each other swing about it. A lens alone turns lights by less, and whole steps creep up to it.
NormalMap nextGuess(const NormalMap& guess, NormalMap found, const NearField& near);

// The height of a surface before near's camera from its normals in the camera frame: pixels above the plane of its
// outline, whose mean is 0; 0 where there is no normal.
Image heightBefore(const NormalMap& normals, const NearField& near, int threads);

// Its two parts: the normals whose orthographic integral q is, of an object before near's camera, and the height of q,
// which stands for any constant.
NormalMap withoutLens(NormalMap normals, const NearField& near);
Image heightOfIntegral(const NormalMap& normals, Image q, const NearField& near);

} // namespace nacre
