#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace nacre {

// A function on the unit square given at the points of a regular grid, for each of several values of a parameter:
// bilinear in the square, linear in the parameter. values[(slice * height + y) * width + x]; x is the first coordinate.
class ParameterisedGrid {
public:
    ParameterisedGrid() = default;
    // parameters ascend, one a slice; width and height are at least 2.
    ParameterisedGrid(int width, int height, std::vector<float> parameters, std::vector<float> values);

    // `unit` in [0,1]^2; a parameter beyond the first or the last is clamped to it.
    double evaluate(const glm::dvec2& unit, double parameter) const;

    int width() const { return width_; }
    int height() const { return height_; }

protected:
    // The two slices about a parameter and the share of the second.
    struct Slices {
        size_t first = 0, second = 0; // offsets in values
        double share = 0;
    };
    // A point's patch and its place in it.
    struct Patch {
        int x = 0, y = 0;
        glm::dvec2 within{0};
    };
    Slices slicesAt(double parameter, size_t sliceSize) const;
    Patch patchAt(const glm::dvec2& unit) const;

    int width_ = 0;
    int height_ = 0;
    std::vector<float> parameters_;
    std::vector<float> values_;
};

// A density on the unit square as a warp: (x, y) to (the share of its row left of x, the share of the square above y).
// Dupuy and Jakob 2018, section 5: densities of different parameters are interpolated with their cumulative sums.
class WarpedGrid : public ParameterisedGrid {
public:
    WarpedGrid() = default;
    // Values >= 0, each slice with a positive sum; they are normalised.
    WarpedGrid(int width, int height, std::vector<float> parameters, std::vector<float> values);

    // The uniform variate in [0,1]^2 that the warp would take to `unit`.
    glm::dvec2 uniformFromUnit(const glm::dvec2& unit, double parameter) const;

private:
    std::vector<float> rowSums_;    // trapezoids of each row from its left end, like values_
    std::vector<float> squareSums_; // trapezoids of the rows' totals from the top, height a slice
};

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
