#include <cmath>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "acquisition/brdf/reciprocity.h"
#include "engine/files/hash_random.h"

namespace nacre {
namespace {

const glm::vec3 kCamera(0, 0, 1);

// Normals all over the ball under lights of growing polar angle; f = 0.3 (1 + asymmetry (n.l - n.v)), whose sign
// changes where l and v change places.
BrdfSamples samplesOf(int lights, float asymmetry)
{
    BrdfSamples samples;
    samples.domain = {kOneWay, kHalfPi / 2};
    for (int i = 0; i < lights; ++i) {
        const float polar = 0.2f + 1.2f * static_cast<float>(i) / static_cast<float>(lights),
                    azimuth = 2.4f * static_cast<float>(i);
        const glm::vec3 l(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar));
        for (uint64_t p = 0; p < 400; ++p) {
            const auto random = [&](uint64_t channel) { return static_cast<float>(unitFromHash(hashOf(p, channel))); };
            const float z = 0.2f + 0.8f * random(0), sine = std::sqrt(1 - z * z), phi = 2 * kPi * random(1);
            const glm::vec3 n(sine * std::cos(phi), sine * std::sin(phi), z);
            const float nDotL = glm::dot(n, l);
            if (nDotL > 0.1f) {
                samples.unit.push_back(unitFromDirections(samples.domain, n, l, kCamera));
                const float noise = 0.01f * (2 * random(2 + static_cast<uint64_t>(i)) - 1);
                samples.values.push_back(glm::vec3(0.3f * (1 + asymmetry * (nDotL - z) + noise)));
                samples.weights.push_back(nDotL);
            }
        }
    }
    return samples;
}

TEST(Reciprocity, FoldedSamplesAreThoseOfBothWays)
{
    const BrdfSamples oneWay = samplesOf(5, 0), folded = reciprocalSamples(oneWay);
    ASSERT_EQ(folded.domain.coordinates, kHalfDifference);
    for (size_t i = 0; i < oneWay.size(); ++i) {
        const LightView d = directionsFromUnit(oneWay.domain, oneWay.unit[i]);
        const glm::vec3 there = unitFromDirections(folded.domain, {0, 0, 1}, d.l, d.v),
                        back = unitFromDirections(folded.domain, {0, 0, 1}, d.v, d.l);
        // The azimuth is read off a vector of length sin(thetaH) sin(thetaD), 0.001 and more here.
        EXPECT_NEAR(folded.unit[i].z, there.z, 1e-3f);
        EXPECT_NEAR(folded.unit[i].z, back.z, 1e-3f);
    }
}

TEST(Reciprocity, TellsAsymmetryFromNoise)
{
    const std::optional<double> symmetric = errorRatioOneWay(samplesOf(24, 0), {}),
                                asymmetric = errorRatioOneWay(samplesOf(24, 0.2f), {});
    ASSERT_TRUE(symmetric && asymmetric);
    EXPECT_GT(*symmetric, kMostErrorRatioOneWay);
    EXPECT_LT(*asymmetric, 0.5) << "noise of 1 % is left of 20 % times the cosines' difference";
}

TEST(Reciprocity, FewLightsDoNotTell)
{
    EXPECT_FALSE(errorRatioOneWay(samplesOf(5, 0.2f), {}));
}

} // namespace
} // namespace nacre
