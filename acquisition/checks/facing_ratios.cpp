#include "acquisition/checks/facing_ratios.h"

#include <cmath>

#include <glm/geometric.hpp>

#include "engine/files/measures.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

// Pixels that a light grazes say little of its strength.
constexpr float kLeastRefinedCosine = 0.3f;
constexpr size_t kSummedPerTask = 512;

// Of the used observations I of a pixel: sums of n.l I and of the squares of n.l, which its albedos follow from.
struct UsedSums {
    glm::vec3 products{0};
    float squares = 0;
};

UsedSums usedSums(const Observations& sample, const NormalBlock& normals, const std::vector<Light>& lights,
                  size_t pixel)
{
    UsedSums sums;
    const auto radiance = sample.radianceOf(pixel);
    for (size_t i = 0; i < lights.size(); ++i) {
        const float nDotL = glm::dot(normals.pixels[pixel].normal, lights[i].direction);
        if (normals.verdicts[pixel * lights.size() + i] == Verdict::used && nDotL > 0) {
            sums.products += nDotL * radiance[i] / lights[i].irradiance;
            sums.squares += nDotL * nDotL;
        }
    }
    return sums;
}

FacingRatios facingRatios(const Observations& sample, const NormalBlock& normals, const std::vector<UsedSums>& sums,
                          const Light& light, size_t index)
{
    FacingRatios ratios;
    for (size_t p = 0; p < sample.pixels.size(); ++p) {
        const float nDotL = glm::dot(normals.pixels[p].normal, light.direction);
        const Verdict verdict = normals.verdicts[p * sample.lightCount + index];
        if (sums[p].squares > 0 && nDotL >= kLeastRefinedCosine && verdict != Verdict::saturated) {
            const glm::vec3 seen = sample.radianceOf(p)[index] / light.irradiance, &products = sums[p].products;
            (verdict == Verdict::shadow ? ratios.shadowed : ratios.lit)
                .add(seen * sums[p].squares / (products * nDotL),
                     greyOf(seen) * sums[p].squares / (greyOf(products) * nDotL));
        }
    }
    return ratios;
}

} // namespace

std::vector<FacingRatios> gatherRatios(const Observations& sample, const NormalBlock& normals,
                                       const std::vector<Light>& lights, int threads)
{
    std::vector<UsedSums> sums(sample.pixels.size());
    parallelFor(sums.size(), kSummedPerTask, threads, [&](size_t first, size_t last) {
        for (size_t p = first; p < last; ++p) {
            sums[p] = usedSums(sample, normals, lights, p);
        }
    });
    std::vector<FacingRatios> ratios(lights.size());
    parallelFor(lights.size(), 1, threads, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            ratios[i] = facingRatios(sample, normals, sums, lights[i], i);
        }
    });
    return ratios;
}

namespace {

// Robust relative standard deviation of one photograph's ratios.
PhotographScatter scatterOf(FacingRatios& ratios)
{
    PhotographScatter scatter;
    scatter.litShare = ratios.litShare();
    std::vector<float>& grey = ratios.lit.grey;
    if (grey.size() >= kFewestRatioPixels) {
        const float median = quantile(grey, 0.5);
        for (float& value : grey) {
            value = std::abs(value / median - 1);
        }
        scatter.spread = 1.4826f * quantile(grey, 0.5);
    }
    return scatter;
}

} // namespace

std::vector<PhotographScatter> scattersOf(std::vector<FacingRatios>& gathered, int threads)
{
    std::vector<PhotographScatter> scatters(gathered.size());
    parallelFor(gathered.size(), 1, threads, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            scatters[i] = scatterOf(gathered[i]);
        }
    });
    return scatters;
}

namespace {

// Of one photograph; grey is 0 where too few pixels tell.
struct MedianRatio {
    float grey = 0;
    glm::vec3 colour{1};
};

MedianRatio medianOf(FacingRatios& gathered)
{
    ChannelRatios& ratios = gathered.telling();
    MedianRatio median;
    if (ratios.grey.size() < kFewestRatioPixels) {
        return median;
    }
    median.grey = quantile(ratios.grey, 0.5);
    for (int c = 0; c < 3; ++c) {
        std::vector<float>& values = ratios.values[c];
        const float ratio = values.size() >= kFewestRatioPixels ? quantile(values, 0.5) : median.grey;
        median.colour[c] = ratio > 0 ? ratio / median.grey : 1.0f;
    }
    return median;
}

} // namespace

MedianRatios mediansOf(std::vector<FacingRatios>& gathered, const std::vector<bool>& isFree, int threads)
{
    std::vector<MedianRatio> all(gathered.size());
    parallelFor(gathered.size(), 1, threads, [&](size_t first, size_t last) {
        for (size_t i = first; i < last; ++i) {
            all[i] = isFree[i] ? medianOf(gathered[i]) : MedianRatio{};
        }
    });
    MedianRatios medians;
    std::vector<double> logs;
    for (size_t i = 0; i < all.size(); ++i) {
        if (all[i].grey > 0) {
            medians.photographs.push_back(static_cast<Eigen::Index>(i));
            medians.colours.push_back(all[i].colour);
            logs.push_back(std::log(all[i].grey));
        }
    }
    medians.logs = Eigen::Map<const Eigen::VectorXd>(logs.data(), static_cast<Eigen::Index>(logs.size()));
    return medians;
}

} // namespace nacre
