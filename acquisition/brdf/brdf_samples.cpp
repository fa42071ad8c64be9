#include "acquisition/brdf/brdf_samples.h"

#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "acquisition/brdf/pixel_prediction.h"
#include "engine/files/error.h"
#include "engine/files/measures.h"
#include "shared/shading.h"

namespace nacre {
namespace {

const glm::vec3 kView(0, 0, 1);

// A fixed scattering of pixels over [0, 1): Fibonacci hashing (Knuth, The Art of Computer Programming 3, 6.4).
double scattered(uint32_t pixel)
{
    return static_cast<double>(pixel * 2654435769u) / 4294967296.0;
}

} // namespace

int phiDTexels(const TableDomain& domain)
{
    return domain.coordinates == kOneWay ? 45 : 23;
}

BrdfSamples usableSamples(const BrdfSamples& samples)
{
    BrdfSamples usable;
    usable.domain = samples.domain;
    for (size_t i = 0; i < samples.size(); ++i) {
        const glm::vec3 sum = samples.unit[i] + samples.values[i];
        if (samples.weights[i] > 0 && std::isfinite(sum.x + sum.y + sum.z + samples.weights[i])) {
            usable.unit.push_back(samples.unit[i]);
            usable.values.push_back(samples.values[i]);
            usable.weights.push_back(samples.weights[i]);
        }
    }
    if (usable.size() == 0) {
        throw Error("", "no observation is left to measure a BRDF from", "lit, unsaturated pixels with normals");
    }
    return usable;
}

void gatherSamples(const Observations& block, const NormalBlock& normals, std::span<const glm::vec3> albedo,
                   const LocalLights& lights, double share, const SampleOptions& options, BrdfSamples& samples,
                   SampleCounts& counts)
{
    const size_t n = block.lightCount;
    std::vector<Light> own;
    for (size_t p = 0; p < block.pixels.size(); ++p) {
        const PixelNormal& pixel = normals.pixels[p];
        // A channel that is black everywhere says nothing of the others' material.
        const bool black = !(glm::min(albedo[p].x, glm::min(albedo[p].y, albedo[p].z)) > 0);
        if (pixel.confidence <= 0 || black) {
            counts.withoutNormal += n;
            continue;
        }
        if (scattered(block.pixels[p]) >= share) {
            counts.thinned += n;
            continue;
        }
        const auto radiance = block.radianceOf(p);
        const Verdict* verdicts = &normals.verdicts[p * n];
        const std::span<const Light> met = lights.of(block.pixels[p], own);
        const glm::vec3 normal = lights.toLocal(block.pixels[p], pixel.normal);
        for (size_t i = 0; i < n; ++i) {
            const float nDotL = glm::dot(normal, met[i].direction);
            if (verdicts[i] == Verdict::saturated) {
                ++counts.saturated;
            } else if (nDotL < options.leastCosine || verdicts[i] == Verdict::shadow) {
                ++counts.shadowed;
            } else {
                samples.unit.push_back(unitFromDirections(samples.domain, normal, met[i].direction, kView));
                samples.values.push_back(brdfFromRadiance(radiance[i], albedo[p] * met[i].irradiance, nDotL));
                samples.weights.push_back(pixel.confidence * nDotL * greyOf(albedo[p]));
                ++counts.used;
            }
        }
    }
}

void gatherJudgedSamples(const Observations& block, const NormalMap& normals, const Image& albedo,
                         const LocalLights& lights, const BrdfTable& table, double share, const SampleOptions& options,
                         BrdfSamples& samples)
{
    const TableUnderLights under = tableUnder(lights, table);
    PixelPrediction pixel;
    std::vector<Light> own;
    for (size_t p = 0; p < block.pixels.size(); ++p) {
        const uint32_t at = block.pixels[p];
        const glm::vec3 factor = albedo.rgb(static_cast<int>(at % albedo.width), static_cast<int>(at / albedo.width));
        const bool black = !(glm::min(factor.x, glm::min(factor.y, factor.z)) > 0);
        const glm::vec3 normal = lights.toLocal(at, normals.normals[at]);
        const std::span<const Light> met = lights.of(at, own);
        if (normals.confidence[at] <= 0 || black || scattered(at) >= share ||
            !predictPixel(block, p, normal, met, under, pixel)) {
            continue;
        }
        for (size_t j = 0; j < pixel.lights.size(); ++j) {
            const Light& light = met[pixel.lights[j]];
            const float nDotL = glm::dot(normal, light.direction);
            if (nDotL >= options.leastCosine) {
                const glm::vec3 predicted = factor * pixel.predicted[j];
                const float miss =
                    greyOf(pixel.observed[j] - predicted) / std::max(pixel.limit, kRefitLimit * greyOf(predicted));
                samples.unit.push_back(unitFromDirections(samples.domain, normal, light.direction, kView));
                samples.values.push_back(brdfFromRadiance(pixel.observed[j], factor, nDotL));
                samples.weights.push_back(normals.confidence[at] * nDotL * greyOf(factor) /
                                          std::sqrt(1 + 4 * miss * miss));
            }
        }
    }
}

glm::vec4 embeddedConfiguration(const TableDomain& domain, const glm::vec3& unit)
{
    if (domain.coordinates == kNatural) {
        const Natural c = naturalFromUnit(unit);
        const float g = std::sin(c.thetaI) * std::sin(c.thetaO);
        return {g * std::cos(c.phi), g * std::sin(c.phi), unit.x, c.thetaO};
    }
    const HalfDifference c = halfDifferenceFromUnit(unit, domain);
    const float rg = unit.x * std::sin(c.thetaD);
    const float turn = kPi / largestPhiD(domain.coordinates) * c.phiD; // equal configurations meet
    return {rg * std::cos(turn), rg * std::sin(turn), unit.x, c.thetaD};
}

float angularDistance(const TableDomain& domain, const glm::vec3& a, const glm::vec3& b)
{
    if (domain.coordinates == kNatural) {
        const Natural p = naturalFromUnit(a), q = naturalFromUnit(b);
        const float arc = (p.phi - q.phi) * std::sqrt(std::sin(p.thetaI) * std::sin(q.thetaI));
        return glm::length(glm::vec3(p.thetaI - q.thetaI, p.thetaO - q.thetaO, arc));
    }
    const HalfDifference p = halfDifferenceFromUnit(a, domain), q = halfDifferenceFromUnit(b, domain);
    // An azimuth is an arc on the sphere of h and on that of d: the shorter one counts.
    const float sine = std::min(std::sin(p.thetaH) * std::sin(q.thetaH), std::sin(p.thetaD) * std::sin(q.thetaD));
    return glm::length(glm::vec3(p.thetaH - q.thetaH, p.thetaD - q.thetaD, (p.phiD - q.phiD) * std::sqrt(sine)));
}

} // namespace nacre
