#include "acquisition/brdf/model_candidates.h"

#include <algorithm>
#include <cmath>

namespace nacre {

namespace {

// Sizes of tables tried, as shares of the full one's.
struct Shrink {
    float thetaH, thetaD, phiD;
};
constexpr Shrink kVolumes[] = {{1, 1, 1},           {1, 0.5f, 0.5f},     {1, 0.35f, 0.4f},    {0.7f, 0.5f, 0.5f},
                               {0.7f, 0.25f, 0.2f}, {0.5f, 0.25f, 0.2f}, {0.35f, 0.2f, 0.2f}, {0.25f, 0.15f, 0.13f}};
constexpr Shrink kPlanes[] = {{1, 1, 0}, {1, 0.5f, 0}, {1, 0.2f, 0}, {0.5f, 0.2f, 0}, {0.25f, 0.15f, 0}};

glm::ivec3 shrunk(const glm::ivec3& size, const Shrink& shrink)
{
    const auto axis = [](int texels, float share) {
        return share > 0 ? std::clamp(static_cast<int>(std::lround(texels * share)), 2, texels) : 1;
    };
    return {axis(size.x, shrink.thetaH), axis(size.y, shrink.thetaD), axis(size.z, shrink.phiD)};
}

// f(thetaH, thetaD): the mean over phiD of what is covered.
BrdfTable bivariateOf(const BrdfTable& full)
{
    BrdfTable plane({full.size.x, full.size.y, 1}, full.domain);
    for (int j = 0; j < full.size.y; ++j) {
        for (int i = 0; i < full.size.x; ++i) {
            glm::vec3 sum(0);
            float weights = 0, confidence = 0;
            for (int k = 0; k < full.size.z; ++k) {
                const size_t texel = full.index(i, j, k);
                const float weight = std::max(full.confidence[texel], 1e-3f);
                sum += weight * full.values[texel];
                weights += weight;
                confidence += full.confidence[texel];
            }
            plane.values[plane.index(i, j, 0)] = sum / weights;
            plane.confidence[plane.index(i, j, 0)] = confidence / static_cast<float>(full.size.z);
        }
    }
    return plane;
}

} // namespace

std::vector<CompactBrdf> candidateModels(const ModelJudge& judge)
{
    const BrdfTable& full = judge.table();
    const std::vector<BrdfMeasurement> fitted = judge.fittedPart();
    std::vector<CompactBrdf> candidates{FittedLobe{fitLambert(fitted)}, FittedLobe{fitLobe(fitted)}};
    const auto addTable = [&](const BrdfTable& from, const glm::ivec3& size) {
        const BrdfTable table = size == from.size ? from : resampledTable(from, size, from.domain);
        for (const auto format : {TexelFormat::rgba32f, TexelFormat::rgba16f, TexelFormat::e5b9g9r9}) {
            SmallTable small{table, format};
            for (glm::vec3& value : small.table.values) {
                value = quantised(value, format);
            }
            candidates.emplace_back(std::move(small));
        }
    };
    if (full.domain.coordinates == kHalfDifference) {
        const BrdfTable plane = bivariateOf(full);
        for (const Shrink& shrink : kPlanes) {
            addTable(plane, shrunk(full.size, shrink));
        }
    }
    for (const Shrink& shrink : kVolumes) {
        addTable(full, shrunk(full.size, shrink));
    }
    return candidates;
}

} // namespace nacre
