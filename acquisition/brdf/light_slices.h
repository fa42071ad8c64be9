#pragma once
#include <span>
#include <vector>

#include "engine/brdf/brdf_table.h"
#include "engine/lights/light.h"

namespace nacre {

// A table in half-difference coordinates under distant lights, seen from v = (0,0,1). Each light has one thetaD then,
// and what is left of the table is a slice of (thetaH, phiD), which is read for all lights at once.
class LightSlices {
public:
    LightSlices(const BrdfTable& table, std::span<const Light> lights);

    // evaluateTable(table, normal, l, v).value of every light, for one that the normal and the camera face.
    void evaluate(const glm::vec3& normal, std::span<glm::vec3> values) const;

private:
    glm::ivec2 size_; // of a slice
    bool isOneWay_;
    size_t lightCount_;
    std::vector<glm::vec3> slices_; // [(light * size.y + k) * size.x + i]
    // Axes of d = (t, b, h) with l = cos(thetaD) h + sin(thetaD) t: component by component, light by light.
    std::vector<float> axes_[9];
};

} // namespace nacre
