#include "engine/brdf/warped_grid.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace nacre {

ParameterisedGrid::ParameterisedGrid(int width, int height, std::vector<float> parameters, std::vector<float> values)
    : width_(width), height_(height), parameters_(std::move(parameters)), values_(std::move(values))
{
    assert(width >= 2 && height >= 2 && !parameters_.empty());
    assert(values_.size() == static_cast<size_t>(width) * height * parameters_.size());
}

ParameterisedGrid::Slices ParameterisedGrid::slicesAt(double parameter, size_t sliceSize) const
{
    const auto above = std::upper_bound(parameters_.begin(), parameters_.end(), parameter);
    const size_t second = std::min<size_t>(above - parameters_.begin(), parameters_.size() - 1);
    const size_t first = above == parameters_.begin() ? 0 : above - parameters_.begin() - 1;
    const double step = static_cast<double>(parameters_[second]) - parameters_[first];
    return {first * sliceSize, second * sliceSize, step > 0 ? (parameter - parameters_[first]) / step : 0};
}

ParameterisedGrid::Patch ParameterisedGrid::patchAt(const glm::dvec2& unit) const
{
    const double x = std::clamp(unit.x, 0.0, 1.0) * (width_ - 1), y = std::clamp(unit.y, 0.0, 1.0) * (height_ - 1);
    Patch patch{std::min(static_cast<int>(x), width_ - 2), std::min(static_cast<int>(y), height_ - 2), {}};
    patch.within = {x - patch.x, y - patch.y};
    return patch;
}

double ParameterisedGrid::evaluate(const glm::dvec2& unit, double parameter) const
{
    const Slices slices = slicesAt(parameter, static_cast<size_t>(width_) * height_);
    const Patch p = patchAt(unit);
    const auto bilinear = [&](size_t slice) {
        const float* row = &values_[slice + static_cast<size_t>(p.y) * width_ + p.x];
        const float* next = row + width_;
        return std::lerp(std::lerp<double>(row[0], row[1], p.within.x), std::lerp<double>(next[0], next[1], p.within.x),
                         p.within.y);
    };
    return std::lerp(bilinear(slices.first), bilinear(slices.second), slices.share);
}

WarpedGrid::WarpedGrid(int width, int height, std::vector<float> parameters, std::vector<float> values)
    : ParameterisedGrid(width, height, std::move(parameters), std::move(values)), rowSums_(values_.size(), 0.0f)
{
    for (size_t slice = 0; slice < parameters_.size(); ++slice) {
        float* density = &values_[slice * width_ * height_];
        float* rows = &rowSums_[slice * width_ * height_];
        std::vector<double> square(height_, 0.0), total(height_, 0.0);
        std::vector<double> sums(static_cast<size_t>(width_) * height_, 0.0);
        for (int y = 0; y < height_; ++y) {
            for (int x = 1; x < width_; ++x) {
                const size_t i = static_cast<size_t>(y) * width_ + x;
                total[y] += 0.5 * (static_cast<double>(density[i - 1]) + density[i]);
                sums[i] = total[y];
            }
            square[y] = y == 0 ? 0.0 : square[y - 1] + 0.5 * (total[y - 1] + total[y]);
        }
        const double scale = 1 / square.back();
        for (size_t i = 0; i < sums.size(); ++i) {
            rows[i] = static_cast<float>(sums[i] * scale);
            density[i] = static_cast<float>(density[i] * scale);
        }
        for (double s : square) {
            squareSums_.push_back(static_cast<float>(s * scale));
        }
    }
}

// Within a patch the density is bilinear, so its sums are quadratic: u d0 + u^2/2 (d1 - d0) from the patch's edge.
glm::dvec2 WarpedGrid::uniformFromUnit(const glm::dvec2& unit, double parameter) const
{
    const Slices slices = slicesAt(parameter, static_cast<size_t>(width_) * height_);
    const Slices columns = slicesAt(parameter, height_);
    const Patch p = patchAt(unit);
    const auto at = [](const std::vector<float>& values, const Slices& s, size_t index) {
        return std::lerp<double>(values[s.first + index], values[s.second + index], s.share);
    };
    const auto partial = [](double u, double d0, double d1) { return u * (d0 + 0.5 * u * (d1 - d0)); };

    const size_t row = static_cast<size_t>(p.y) * width_, next = row + width_;
    const double left = std::lerp(at(values_, slices, row + p.x), at(values_, slices, next + p.x), p.within.y);
    const double right = std::lerp(at(values_, slices, row + p.x + 1), at(values_, slices, next + p.x + 1), p.within.y);
    const double before = std::lerp(at(rowSums_, slices, row + p.x), at(rowSums_, slices, next + p.x), p.within.y);
    const double rowTotal = at(rowSums_, slices, row + width_ - 1), nextTotal = at(rowSums_, slices, next + width_ - 1);
    const double total = std::lerp(rowTotal, nextTotal, p.within.y);
    const double x = total > 0 ? (before + partial(p.within.x, left, right)) / total : 0.0;
    const double y = at(squareSums_, columns, p.y) + partial(p.within.y, rowTotal, nextTotal);
    return {x, y};
}

} // namespace nacre
