#include "acquisition/checks/stability.h"

#include <cmath>

#include <glm/geometric.hpp>

#include "acquisition/lights/lights.h"
#include "acquisition/lights/well_spread_lights.h"
#include "engine/files/measures.h"

namespace nacre {

namespace {

constexpr size_t kGroups = 4;
constexpr double kUnknown = 90;
constexpr double kWorstTripleCondition = 100;

} // namespace

double instabilityDegrees(const Intensities& intensities, const std::vector<Light>& lights,
                          const NormalOptions& options)
{
    std::vector<NormalBlock> blocks;
    for (size_t group = 0; group < kGroups; ++group) {
        std::vector<size_t> kept;
        for (size_t i = 0; i < lights.size(); ++i) {
            if (i % kGroups != group) {
                kept.push_back(i);
            }
        }
        const std::vector<Light> left = selectLights(lights, kept);
        if (kept.size() < 3 || !(conditionOf(left) < kWorstTripleCondition)) {
            return kUnknown;
        }
        blocks.push_back(makeConsensusEstimator(left, options)(selectLights(intensities, kept)));
    }
    std::vector<float> errors;
    for (size_t p = 0; p < intensities.pixelCount(); ++p) {
        glm::vec3 sum(0);
        for (const NormalBlock& block : blocks) {
            sum += block.pixels[p].normal;
        }
        double squares = 0;
        for (const NormalBlock& block : blocks) {
            const bool found = block.pixels[p].confidence > 0 && glm::length(sum) > 0;
            const double degrees = found ? degreesBetween(block.pixels[p].normal, glm::normalize(sum)) : kUnknown;
            squares += degrees * degrees;
        }
        errors.push_back(static_cast<float>(std::sqrt(squares * (kGroups - 1) / kGroups)));
    }
    return errors.empty() ? kUnknown : quantile(errors, 0.5);
}

} // namespace nacre
