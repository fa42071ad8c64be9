#pragma once
#include <array>
#include <filesystem>
#include <string>

#include <glm/vec3.hpp>

#include "engine/brdf/warped_grid.h"

namespace nacre {

// An isotropic material of the RGL database in linear Rec. 709, evaluated as it was stored (Dupuy and Jakob, An
// Adaptive Parameterization for Efficient Material Acquisition and Rendering, 2018, eq. 11): f n.v = s D / (4 sigma),
// where s is looked up at the uniform variate that the density of visible normals would take to the half vector.
class RglBrdf {
public:
    // Throws Error where the file is damaged, anisotropic or spectral.
    explicit RglBrdf(const std::filesystem::path& file);

    // f in 1/sr without the cosine; l and v unit in the tangent frame, above the horizon. As stored: the database's
    // incident direction is `l`, and exchanging l and v changes the value by the measurement's error.
    glm::vec3 evaluate(const glm::vec3& l, const glm::vec3& v) const;

    const std::string& description() const { return description_; }

private:
    std::string description_;
    bool hasJacobian_ = true;
    ParameterisedGrid normals_;       // D over (theta, phi) of the half vector
    ParameterisedGrid projectedArea_; // sigma over (theta, phi) of l
    WarpedGrid visibleNormals_;       // by the polar angle of l
    std::array<ParameterisedGrid, 3> colour_;
};

} // namespace nacre
