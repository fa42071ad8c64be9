#include "acquisition/brdf/sample_cells.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "acquisition/normals/intensities.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

// Cells along each axis of the embedded space but thetaD: thetaH is resolved to 0.02 degrees at the highlight's heart
// and to 3 degrees at grazing.
constexpr float kCellsPerUnit = 64;
// thetaD, radians: finer than any two lights' planes need, so that no cell mixes photographs.
constexpr float kThetaDCell = 0.001f;
// Huber's limit in robust standard deviations: 95 % efficient where the noise is Gaussian.
constexpr float kHuberLimit = 1.345f;
constexpr float kDeviationsPerMad = 1.4826f;
// Fewer samples do not tell which of them is wrong.
constexpr size_t kFewestForRobust = 5;

// The cell's number above, the sample's below: sorting brings a cell together in the samples' order.
uint64_t cellAndSample(const BrdfSamples& samples, uint32_t i)
{
    const glm::vec4 p = embeddedConfiguration(samples.domain, samples.unit[i]);
    const auto axis = [](float x, float cells) { return static_cast<uint64_t>(std::max(0.0f, x * cells)); };
    const uint64_t cell = (axis(p.w + kThetaDCell / 2, 1 / kThetaDCell) << 21) | (axis(p.z, kCellsPerUnit) << 14) |
                          (std::min<uint64_t>(axis(1 + p.x, kCellsPerUnit), 127) << 7) | axis(p.y, kCellsPerUnit);
    return (cell << 32) | i;
}

float medianOf(std::vector<float>& values)
{
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

class CellMean {
public:
    // Adds the cell of `members` (cellAndSample) to `cells`.
    void add(const BrdfSamples& samples, std::span<const uint64_t> members, BrdfSamples& cells)
    {
        limitGreys(samples, members);
        glm::vec3 unit(0), value(0);
        float sum = 0, squares = 0;
        for (size_t j = 0; j < members.size(); ++j) {
            const auto i = static_cast<uint32_t>(members[j]);
            // The variance of f = I / (a E n.l) falls with the square of the weight, which is a n.l times trust.
            const float square = samples.weights[i] * samples.weights[i];
            const float weight = square * huberWeight(j);
            unit += weight * samples.unit[i];
            value += weight * samples.values[i];
            sum += weight;
            squares += square;
        }
        cells.unit.push_back(unit / sum);
        cells.values.push_back(value / sum);
        cells.weights.push_back(std::sqrt(squares));
    }

private:
    void limitGreys(const BrdfSamples& samples, std::span<const uint64_t> members)
    {
        isRobust_ = members.size() >= kFewestForRobust;
        if (!isRobust_) {
            return;
        }
        greys_.clear();
        for (const uint64_t member : members) {
            greys_.push_back(greyOf(samples.values[static_cast<uint32_t>(member)]));
        }
        sorted_ = greys_;
        median_ = medianOf(sorted_);
        std::transform(greys_.begin(), greys_.end(), sorted_.begin(), [&](float g) { return std::abs(g - median_); });
        limit_ = kHuberLimit * kDeviationsPerMad * medianOf(sorted_);
    }

    float huberWeight(size_t j) const
    {
        const float deviation = isRobust_ ? std::abs(greys_[j] - median_) : 0.0f;
        return deviation > limit_ && deviation > 0 ? std::max(limit_, 1e-3f * deviation) / deviation : 1.0f;
    }

    bool isRobust_ = false;
    float median_ = 0, limit_ = 0;
    std::vector<float> greys_, sorted_;
};

} // namespace

BrdfSamples condensedSamples(const BrdfSamples& samples, int threads)
{
    std::vector<uint64_t> order(samples.size());
    parallelFor(samples.size(), 4096, threads, [&](size_t first, size_t end) {
        for (size_t i = first; i < end; ++i) {
            order[i] = cellAndSample(samples, static_cast<uint32_t>(i));
        }
    });
    std::sort(order.begin(), order.end());
    BrdfSamples cells;
    cells.domain = samples.domain;
    CellMean mean;
    for (size_t first = 0, last = 0; first < order.size(); first = last) {
        while (last < order.size() && order[last] >> 32 == order[first] >> 32) {
            ++last;
        }
        mean.add(samples, std::span(order).subspan(first, last - first), cells);
    }
    return cells;
}

} // namespace nacre
