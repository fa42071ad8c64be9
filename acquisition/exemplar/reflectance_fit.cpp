#include "acquisition/exemplar/reflectance_fit.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "acquisition/exemplar/value_groups.h"
#include "engine/files/measures.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

constexpr int kLobeTexels = kHalfBins * kDifferenceBins;
constexpr size_t kMostFitted = 60000; // observations
// Grazing light: f = I / (n.l) multiplies errors of the normal.
constexpr float kLeastFitCosine = 0.15f;
// Observations below this share of what is predicted are in shadow, and the worst pixels have no say.
constexpr float kLitFitShare = 0.5f;
constexpr double kPixelsWithSay = 0.8;
// Additive gloss is measured against what is diffuse, which counts from here on.
constexpr float kDiffuseThetaH = 40; // degrees
constexpr float kAnchorFrom = 40, kAnchorTo = 70;
// n.l of pixels that face away from a light by six degrees or more, whatever their normals' errors are.
constexpr float kFacingAway = -0.1f;
constexpr size_t kFewestFacingAway = 100;
constexpr double kLeastBounced = 0.25;
// A bin of so many observations counts half against its neighbours.
constexpr double kHalfCounted = 10, kHalfCountedShade = 30;
// Curvature of u costs much, since n.l and the normal's slant are easily taken for each other.
constexpr double kShadeStiffness = 30;
constexpr double kLobeStiffness = 0.3;
constexpr int kShadeRounds = 4;
constexpr int kFewestInAnchor = 3;
constexpr float kLeastValue = 1e-6f;
constexpr size_t kFittedPerTask = 64;
// The unit of asinh, which is linear below and logarithmic beyond: this share of the median albedo.
constexpr float kGlossUnit = 0.1f;
// Albedos of the well explained pixels, and what is added to them.
constexpr double kWellExplained = 0.7, kLowAlbedo = 0.02, kHighAlbedo = 0.98;
constexpr float kAlbedoMargin = 1.5f;

// An observation, over its cosine and over the pixel's bright level.
struct FitSample {
    int bin;
    float value;
    float logOverAlbedo; // of value / scale
    float scale;
    float bright;
    float cosine; // and weight
};

void addSamples(const PixelLattice& lattice, const MatchModel& model, const BallMatch& match, size_t pixel,
                std::vector<FitSample>& samples)
{
    const BallGrid& grid = *model.ball.grid;
    const glm::vec3 normal = normalOfBallTexel(match.texel, grid.size);
    const float bright = lattice.bright[pixel];
    std::vector<float> predicted(lattice.lightCount);
    predictMatch(model, match, bright, predicted.data());
    for (size_t i = 0; i < lattice.lightCount; ++i) {
        const float cosine = glm::dot(normal, grid.directions[i]), root = lattice.rootsOf(pixel)[i],
                    observed = root * root;
        if (isClipped(observed) || cosine < kLeastFitCosine || observed * bright < kLitFitShare * predicted[i]) {
            continue;
        }
        const int half = std::min(static_cast<int>(halfBinOf(glm::dot(normal, grid.halves[i]))), kHalfBins - 1),
                  difference = std::min(static_cast<int>(differenceBinOf(grid.halves[i].z, grid.largestThetaD)),
                                        kDifferenceBins - 1);
        const float value = std::max(0.0f, observed - match.scale * model.reflectance.bounced) / cosine;
        samples.push_back({half * kDifferenceBins + difference, value,
                           std::log(std::max(kLeastValue, value / match.scale)), match.scale, bright, cosine});
    }
}

std::vector<FitSample> fitSamples(const PixelLattice& lattice, const MatchModel& model,
                                  const std::vector<BallMatch>& matches, int threads)
{
    std::vector<float> costs;
    for (const BallMatch& match : matches) {
        costs.push_back(match.cost);
    }
    const float worst = quantile(costs, kPixelsWithSay);
    const size_t step = std::max<size_t>(1, matches.size() * lattice.lightCount / kMostFitted);
    const size_t count = (matches.size() + step - 1) / step, tasks = (count + kFittedPerTask - 1) / kFittedPerTask;
    std::vector<std::vector<FitSample>> parts(tasks);
    parallelFor(count, kFittedPerTask, threads, [&](size_t first, size_t last) {
        for (size_t k = first; k < last; ++k) {
            const size_t p = k * step;
            if (matches[p].cost <= worst && matches[p].row >= 0 && matches[p].scale > 0) {
                addSamples(lattice, model, matches[p], p, parts[first / kFittedPerTask]);
            }
        }
    });
    std::vector<FitSample> samples;
    for (const std::vector<FitSample>& part : parts) {
        samples.insert(samples.end(), part.begin(), part.end());
    }
    return samples;
}

// Bins with their values and weights, holes and noise bridged: second differences along thetaH, first along thetaD.
std::vector<float> smoothLobe(const std::vector<float>& values, const std::vector<double>& weights)
{
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd right(kLobeTexels);
    const auto penalise = [&](std::initializer_list<std::pair<int, double>> row) {
        for (const auto& [a, p] : row) {
            for (const auto& [b, q] : row) {
                entries.emplace_back(a, b, kLobeStiffness * p * q);
            }
        }
    };
    for (int bin = 0; bin < kLobeTexels; ++bin) {
        entries.emplace_back(bin, bin, weights[bin] + kLeastValue);
        right[bin] = weights[bin] * values[bin];
        const int half = bin / kDifferenceBins;
        if (half > 0 && half + 1 < kHalfBins) {
            penalise({{bin - kDifferenceBins, 1}, {bin, -2}, {bin + kDifferenceBins, 1}});
        }
        if (bin % kDifferenceBins + 1 < kDifferenceBins) {
            penalise({{bin, 1}, {bin + 1, -1}});
        }
    }
    Eigen::SparseMatrix<double> matrix(kLobeTexels, kLobeTexels);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::VectorXd solved = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(right);
    std::vector<float> result(kLobeTexels);
    std::transform(solved.begin(), solved.end(), result.begin(), [](double v) { return static_cast<float>(v); });
    return result;
}

std::vector<double> weightsOf(const ValueGroups& bins)
{
    std::vector<double> weights;
    for (size_t bin = 0; bin < bins.groupCount(); ++bin) {
        const double count = static_cast<double>(bins.count(bin));
        weights.push_back(count / (count + kHalfCounted));
    }
    return weights;
}

bool isDiffuse(int bin)
{
    return glm::degrees(thetaHOfBin(bin / kDifferenceBins)) >= kDiffuseThetaH;
}

// u from the residuals of its knots, 0 at n.l = 0.8; answers what was there.
float fitShade(const ValueGroups& knots, const std::vector<float>& levels, Reflectance& reflectance)
{
    Eigen::Matrix<double, kShadeKnots, kShadeKnots> matrix = Eigen::Matrix<double, kShadeKnots, kShadeKnots>::Zero();
    Eigen::Matrix<double, kShadeKnots, 1> right = Eigen::Matrix<double, kShadeKnots, 1>::Zero();
    for (int k = 0; k < kShadeKnots; ++k) {
        const double count = static_cast<double>(knots.count(k));
        const double weight = count / (count + kHalfCountedShade) + 1e-4;
        matrix(k, k) += weight;
        right[k] += weight * levels[k];
    }
    for (int k = 1; k + 1 < kShadeKnots; ++k) {
        Eigen::Matrix<double, kShadeKnots, 1> curvature = Eigen::Matrix<double, kShadeKnots, 1>::Zero();
        curvature.segment<3>(k - 1) << 1, -2, 1;
        matrix += kShadeStiffness * curvature * curvature.transpose();
    }
    const Eigen::Matrix<double, kShadeKnots, 1> solved = matrix.ldlt().solve(right);
    for (int k = 0; k < kShadeKnots; ++k) {
        reflectance.shade[k] = static_cast<float>(solved[k]);
    }
    const float anchor = reflectance.shadeAt(0.8f);
    for (float& value : reflectance.shade) {
        value -= anchor;
    }
    return anchor;
}

int knotOf(float cosine)
{
    return static_cast<int>(std::lround(std::clamp(cosine, 0.0f, 1.0f) * (kShadeKnots - 1)));
}

// The samples by what is asked of each: its group, -1 for none, or its value.
ValueGroups grouped(const std::vector<FitSample>& samples, size_t groupCount,
                    const std::function<int(const FitSample&)>& groupOf)
{
    std::vector<int> groups;
    std::vector<float> weights;
    for (const FitSample& sample : samples) {
        groups.push_back(groupOf(sample));
        weights.push_back(sample.cosine);
    }
    return {groups, weights, groupCount};
}

ValueGroups binned(const std::vector<FitSample>& samples)
{
    return grouped(samples, kLobeTexels, [](const FitSample& sample) { return sample.bin; });
}

template <class ValueOf> std::vector<float> valuesOf(const std::vector<FitSample>& samples, const ValueOf& valueOf)
{
    std::vector<float> values;
    for (const FitSample& sample : samples) {
        values.push_back(valueOf(sample));
    }
    return values;
}

// log of what the diffuse part of albedo 1 is at n.l = 0.8.
float fitDiffuse(const std::vector<FitSample>& samples, int threads, Reflectance& reflectance)
{
    const ValueGroups knots = grouped(samples, kShadeKnots, [](const FitSample& sample) {
        return isDiffuse(sample.bin) ? knotOf(sample.cosine) : -1;
    });
    const std::vector<float> logs = valuesOf(samples, [](const FitSample& sample) { return sample.logOverAlbedo; });
    return fitShade(knots, knots.medians(logs, threads), reflectance);
}

// T and u in turn; answers log of what T was at its anchor.
float fitMultiplicative(const std::vector<FitSample>& samples, int threads, Reflectance& reflectance)
{
    const ValueGroups bins = binned(samples);
    const ValueGroups knots = grouped(samples, kShadeKnots, [&](const FitSample& sample) {
        return bins.count(sample.bin) >= static_cast<size_t>(kHalfCounted) ? knotOf(sample.cosine) : -1;
    });
    const auto lobeNow = [&] {
        return bins.medians(valuesOf(samples,
                                     [&](const FitSample& sample) {
                                         return sample.logOverAlbedo - reflectance.shadeAt(sample.cosine);
                                     }),
                            threads);
    };
    for (int round = 0; round < kShadeRounds; ++round) {
        const std::vector<float> lobe = lobeNow();
        const std::vector<float> shades =
            valuesOf(samples, [&](const FitSample& sample) { return sample.logOverAlbedo - lobe[sample.bin]; });
        fitShade(knots, knots.medians(shades, threads), reflectance);
    }
    const std::vector<float> lobe = smoothLobe(lobeNow(), weightsOf(bins));
    std::vector<float> inAnchor, everywhere;
    for (int bin = 0; bin < kLobeTexels; ++bin) {
        const float thetaH = glm::degrees(thetaHOfBin(bin / kDifferenceBins));
        if (bins.count(bin) >= kFewestInAnchor) {
            everywhere.push_back(lobe[bin]);
            if (thetaH >= kAnchorFrom && thetaH <= kAnchorTo) {
                inAnchor.push_back(lobe[bin]);
            }
        }
    }
    std::vector<float>& chosen = inAnchor.empty() ? everywhere : inAnchor;
    const float anchor = chosen.empty() ? 0.0f : quantile(chosen, 0.5);
    for (int bin = 0; bin < kLobeTexels; ++bin) {
        reflectance.lobe[bin] = std::exp(lobe[bin] - anchor);
    }
    return anchor;
}

void fitGloss(const std::vector<FitSample>& samples, float albedo, float unit, int threads, Reflectance& reflectance)
{
    const ValueGroups bins = binned(samples);
    const std::vector<float> rest = valuesOf(samples, [&](const FitSample& sample) {
        const float matte = sample.scale * albedo * std::exp(reflectance.shadeAt(sample.cosine));
        return std::asinh((sample.value - matte) * sample.bright / unit);
    });
    const std::vector<float> gloss = smoothLobe(bins.medians(rest, threads), weightsOf(bins));
    for (int bin = 0; bin < kLobeTexels; ++bin) {
        reflectance.lobe[bin] = std::sinh(gloss[bin]) * unit;
    }
}

// b, from lights that the pixels face away from: what three quarters of these observations show at least, since shade
// is not lit alike and noise alone shows nothing.
float bouncedLight(const PixelLattice& lattice, const BallGrid& grid, const std::vector<BallMatch>& matches)
{
    std::vector<float> shares;
    for (const size_t p : spreadPixels(matches.size(), kMostFitted / lattice.lightCount + 1)) {
        const glm::vec3 normal = normalOfBallTexel(matches[p].texel, grid.size);
        for (size_t i = 0; i < lattice.lightCount && matches[p].scale > 0; ++i) {
            const float value = lattice.intensities.ofPixel(p)[i];
            if (!isClipped(value) && glm::dot(normal, grid.directions[i]) < kFacingAway) {
                shares.push_back(value / (lattice.bright[p] * matches[p].scale));
            }
        }
    }
    return shares.size() < kFewestFacingAway ? 0.0f : std::max(0.0f, quantile(shares, kLeastBounced));
}

float medianAlbedo(const PixelLattice& lattice, const std::vector<BallMatch>& matches)
{
    std::vector<float> albedos;
    for (size_t p = 0; p < matches.size(); ++p) {
        albedos.push_back(matches[p].scale * lattice.bright[p]);
    }
    return quantile(albedos, 0.5);
}

AlbedoRange albedosOf(const PixelLattice& lattice, const std::vector<BallMatch>& matches)
{
    std::vector<std::pair<float, float>> byCost;
    for (size_t p = 0; p < matches.size(); ++p) {
        byCost.push_back({matches[p].cost, matches[p].scale * lattice.bright[p]});
    }
    std::sort(byCost.begin(), byCost.end());
    std::vector<float> albedos;
    for (size_t p = 0;
         p < std::max<size_t>(1, static_cast<size_t>(kWellExplained * static_cast<double>(byCost.size()))); ++p) {
        albedos.push_back(byCost[p].second);
    }
    return {quantile(albedos, kLowAlbedo) / kAlbedoMargin, quantile(albedos, kHighAlbedo) * kAlbedoMargin};
}

} // namespace

void fitReflectance(const PixelLattice& lattice, bool additive, int threads, MatchModel& model,
                    std::vector<BallMatch>& matches)
{
    const std::vector<FitSample> samples = fitSamples(lattice, model, matches, threads);
    if (samples.empty()) {
        return;
    }
    Reflectance& reflectance = model.reflectance;
    reflectance.additive = additive;
    const float anchor = std::exp(additive ? fitDiffuse(samples, threads, reflectance)
                                           : fitMultiplicative(samples, threads, reflectance));
    for (BallMatch& match : matches) {
        match.scale *= anchor;
    }
    reflectance.bounced = bouncedLight(lattice, *model.ball.grid, matches);
    if (additive) {
        fitGloss(samples, anchor, kGlossUnit * medianAlbedo(lattice, matches), threads, reflectance);
    }
    model.albedos = albedosOf(lattice, matches);
}

void refitModel(const PixelLattice& lattice, bool additive, int threads, MatchModel& model,
                std::vector<BallMatch>& matches)
{
    const BallGrid& grid = *model.ball.grid;
    fitReflectance(lattice, additive, threads, model, matches);
    model.ball = makeReflectanceBall(grid, model.reflectance, threads);
    forgetCosts(matches);
}

} // namespace nacre
