#pragma once
#include <optional>
#include <vector>

#include <glm/mat3x3.hpp>

#include "acquisition/normals/normals.h"
#include "acquisition/self_light/patches.h"

namespace nacre {

// The light that a matt object throws on itself, seen by a distant camera. A surface of albedo a (I / E = a n.l) that
// sees the radiance I of the rest of the object shows
//   I = D + s a K I,
// D what the light alone makes it show, K the form factors, s a the reflectance in [0,1]: s is pi where a is in 1/sr,
// and not known where the photographs are in units of their own. So D = I - s a K I comes from the photographs as they
// are, with every bounce, and no equations are to be solved. K needs the shape, which comes from normals that the light
// between the patches has bent: shallower than it is (Nayar, Ikeuchi, Kanade, Shape from Interreflections, 1991, who
// therefore alternate). Here s is fitted to what sides show that no light reaches, and makes up for that, too.
struct SelfLight {
    NormalMap normals; // of a lattice
    int spacing = 1;   // of the lattice, in pixels of the capture
    PatchGrid grid;    // of the lattice
    size_t lightCount = 0;
    // [patch * lights + light] K I / E before the receiver's cosine: n * arriving is that of red, green and blue.
    std::vector<glm::mat3> arriving;
    float strength = 0; // s
    // Found on the way: the share of what unlit sides show that it explains, and the largest share of a pixel's
    // brightness, over all lights, that it makes up (but for a hundredth of the pixels).
    double explained = 0;
    double largestShare = 0;
};

// From pixels spread evenly over the object, and their normals as yet. None where unlit sides do not tell of it:
// convex objects, mirrors, light from elsewhere.
std::optional<SelfLight> findSelfLight(const Observations& sample, const std::vector<PixelNormal>& normals,
                                       const std::vector<Light>& lights, int threads);

// Never more than this share of an observation is taken away.
constexpr float kMostSelfLight = 0.95f;

// What the pixels would show if the lights alone lit them.
Observations withoutSelfLight(const SelfLight& self, Observations block, const std::vector<Light>& lights, int threads);

} // namespace nacre
