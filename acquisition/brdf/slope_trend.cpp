#include "acquisition/brdf/slope_trend.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include <glm/common.hpp>
#include <glm/exponential.hpp>

#include "engine/files/measures.h"

namespace nacre {

namespace {

constexpr size_t kFewestInBin = 20;
constexpr float kMostLeft = 0.5f; // of the spread

glm::vec3 medianOf(const std::vector<glm::vec3>& values)
{
    glm::vec3 median(0);
    std::vector<float> channel(values.size());
    for (int c = 0; c < 3; ++c) {
        std::transform(values.begin(), values.end(), channel.begin(), [c](const glm::vec3& v) { return v[c]; });
        median[c] = quantile(channel, 0.5);
    }
    return median;
}

// Sum over the channels of the squared median deviation.
float squareSpread(std::vector<glm::vec3> values)
{
    const glm::vec3 middle = medianOf(values);
    for (glm::vec3& value : values) {
        value = glm::abs(value - middle);
    }
    const glm::vec3 spread = medianOf(values);
    return spread.x * spread.x + spread.y * spread.y + spread.z * spread.z;
}

} // namespace

std::optional<SlopeTrend> SlopeTrend::of(std::span<const glm::vec3> factors, std::span<const float> cosines)
{
    std::array<std::vector<glm::vec3>, kBins> bins;
    std::vector<glm::vec3> all, left;
    for (size_t i = 0; i < factors.size(); ++i) {
        if (std::min({factors[i].x, factors[i].y, factors[i].z}) > 0) {
            const int bin = std::clamp(static_cast<int>(cosines[i] * kBins), 0, kBins - 1);
            bins[bin].push_back(glm::log(factors[i]));
            all.push_back(bins[bin].back());
        }
    }
    const glm::vec3 middle = all.empty() ? glm::vec3(0) : medianOf(all);
    SlopeTrend trend;
    std::vector<int> told;
    for (int bin = 0; bin < kBins; ++bin) {
        if (bins[bin].size() >= kFewestInBin) {
            told.push_back(bin);
            trend.logs_[bin] = medianOf(bins[bin]) - middle;
        }
    }
    if (told.empty()) {
        return {};
    }
    for (int bin = 0; bin < kBins; ++bin) {
        const auto nearer = [&](int x, int y) { return std::abs(x - bin) < std::abs(y - bin); };
        trend.logs_[bin] = trend.logs_[*std::min_element(told.begin(), told.end(), nearer)];
    }
    for (int bin = 0; bin < kBins; ++bin) {
        for (const glm::vec3& value : bins[bin]) {
            left.push_back(value - trend.logs_[bin]);
        }
    }
    if (!(squareSpread(left) < kMostLeft * kMostLeft * squareSpread(all))) {
        return {};
    }
    return trend;
}

glm::vec3 SlopeTrend::at(float cosine) const
{
    const float place = std::clamp(cosine * kBins - 0.5f, 0.0f, static_cast<float>(kBins - 1));
    const int bin = std::min(static_cast<int>(place), kBins - 2);
    return glm::exp(glm::mix(logs_[bin], logs_[bin + 1], place - static_cast<float>(bin)));
}

} // namespace nacre
