#pragma once
#include <span>
#include <string>

#include "engine/scene/pixel_lights.h"
#include "engine/scene/scene.h"
#include "shared/coverage.h"

namespace nacre {

// False where a table tells neither errors nor coverage: it says nothing about what is uncertain.
bool knowsCoverage(const BrdfTable& table);

// The expected relative error of f(n, l, v), also beyond the table's largest thetaD.
float expectedError(const BrdfTable& table, const glm::vec3& n, const glm::vec3& l, const glm::vec3& v);

// By the BRDF alone, whatever normals, shadows and a residual layer add: lit is what a light reaches from the front,
// uncertain what is expected to be off by more than kUncertainError of its radiance under all lights.
struct PixelCertainty {
    bool isLit = false, isUncertain = false;
};

// The CPU twin of shaders/direct.frag's alpha. Of a pixel that is shaded; materials without coverage are certain.
PixelCertainty certaintyOf(const Surface& surface, size_t pixel, const PixelLights& lights);

// Of the lit pixels, the share that is uncertain: of all, or of an even sample where pixels times lights are many.
double uncertainShare(const Surface& surface, std::span<const Light> lights, const glm::vec3& view, size_t mostPairs,
                      int threads = 0);
double uncertainShare(const Scene& scene, int threads = 0);

// "0.3 % of this picture is uncertain by more than 20 %"; empty where the share is 0.
std::string describeUncertainShare(double share);

} // namespace nacre
