#pragma once
#include <span>
#include <vector>

#include <glm/vec2.hpp>

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

} // namespace nacre
