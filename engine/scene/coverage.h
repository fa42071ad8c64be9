#pragma once
#include "engine/scene/scene.h"
#include "shared/coverage.h"

namespace nacre {

// False where no texel is covered: such a table says nothing about what was measured.
bool knowsCoverage(const BrdfTable& table);

// Whether f(n, l, v) is a guess of the table.
bool asksUnmeasured(const BrdfTable& table, const glm::vec3& n, const glm::vec3& l, const glm::vec3& v);

// What a scene asks of its materials beyond what was measured, under its lights as the object's middle meets them.
// Materials without coverage ask for nothing.
struct UnmeasuredShare {
    double pixels = 0; // of those that a light reaches, the share with any light that asks for it
    double light = 0;  // of all pairs of a pixel and a light that reaches it, weighted by n.l
};

// Of all pixels, or of an even sample of them where pixels times lights are many.
UnmeasuredShare unmeasuredShare(const Scene& scene, int threads = 0);

} // namespace nacre
