#include "acquisition/checks/intensity_refinement.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Dense>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include "acquisition/lights/lights.h"
#include "engine/files/measures.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

// Alternation comes close from afar, though slowly: its steps in log ratio are lengthened. Newton's steps are exact
// close by, where it creeps.
constexpr double kOverRelaxation = 1.5;
constexpr float kClose = 0.02f; // alternation that moves ratios by less is close
constexpr float kRest = 0.002f; // ratios that move by less are at rest
// So are ratios that miss their medians by less (root mean square) and came no closer in so many steps: medians of few
// pixels jump.
constexpr double kJumps = 0.01;
constexpr int kIdleSteps = 5;
// Medians over thousands of pixels do not need each pixel's best triple.
constexpr size_t kTriples = 100;
// Pixels that a light grazes say little of its strength.
constexpr float kLeastRefinedCosine = 0.3f;
constexpr size_t kFewestPixels = 20;
constexpr size_t kSummedPerTask = 512;
// Pixels, evenly spread, that tell how ratios answer to errors.
constexpr size_t kMostInResponse = 1000;
// Pixels whose lights left lie in one plane tell nothing: least over largest squared singular value.
constexpr double kLeastGramShare = 1e-4;
// With fewer lights a pixel's normal follows whatever a photograph claims.
constexpr size_t kFewestLights = 6;
// Of ratios, as an estimate of how far equal lights differ: 1 %, which few photographs are better than.
constexpr double kLeastSpread = 0.01;
// Lights whose condition is larger tell a tilt of the object from a slope of their intensities by their curvature
// alone.
constexpr double kWorstTellingCondition = 5;
// A photograph disagrees when its log ratio is beyond this and beyond so many of the photographs' own spreads: what is
// not Lambert makes ratios scatter, too.
constexpr float kLeastDeviation = 0.095f; // 10 %
constexpr float kDeviationSigmas = 5;

// Observation over prediction per channel: the prediction is the pixel's own albedo in the channel times n.l.
struct ChannelRatios {
    std::vector<float> values[3];
    std::vector<float> grey;

    void add(const glm::vec3& ratio, float greyRatio)
    {
        for (int c = 0; c < 3; ++c) {
            if (std::isfinite(ratio[c])) {
                values[c].push_back(ratio[c]);
            }
        }
        if (std::isfinite(greyRatio)) {
            grey.push_back(greyRatio);
        }
    }
};

// Of the pixels that face one photograph's light.
struct FacingRatios {
    ChannelRatios lit, shadowed;

    float litShare() const
    {
        return static_cast<float>(lit.grey.size()) / std::max<size_t>(1, lit.grey.size() + shadowed.grey.size());
    }
    // A photograph that is dark nearly everywhere may be merely dim: its dark pixels then agree on a ratio.
    ChannelRatios& telling() { return litShare() < kLeastLitShare ? shadowed : lit; }
};

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

// One factor for all lights is not known: the median light keeps its irradiance.
void fixScale(std::vector<glm::vec3>& ratios)
{
    for (int c = 0; c < 3; ++c) {
        std::vector<float> values;
        for (const glm::vec3& ratio : ratios) {
            values.push_back(ratio[c]);
        }
        const float median = quantile(values, 0.5);
        for (glm::vec3& ratio : ratios) {
            ratio[c] /= median;
        }
    }
}

float leastGrey(const std::vector<glm::vec3>& ratios)
{
    float least = greyOf(ratios.front());
    for (const glm::vec3& ratio : ratios) {
        least = std::min(least, greyOf(ratio));
    }
    return least;
}

float largestGrey(const std::vector<glm::vec3>& ratios)
{
    float largest = greyOf(ratios.front());
    for (const glm::vec3& ratio : ratios) {
        largest = std::max(largest, greyOf(ratio));
    }
    return largest;
}

// Robust relative standard deviation of one photograph's ratios.
PhotographScatter scatterOf(FacingRatios& ratios)
{
    PhotographScatter scatter;
    scatter.litShare = ratios.litShare();
    std::vector<float>& grey = ratios.lit.grey;
    if (grey.size() >= kFewestPixels) {
        const float median = quantile(grey, 0.5);
        for (float& value : grey) {
            value = std::abs(value / median - 1);
        }
        scatter.spread = 1.4826f * quantile(grey, 0.5);
    }
    return scatter;
}

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

float spreadOf(const std::vector<glm::vec3>& ratios)
{
    std::vector<float> deviations;
    for (const glm::vec3& ratio : ratios) {
        deviations.push_back(std::abs(std::log(greyOf(ratio))));
    }
    return 1.4826f * quantile(deviations, 0.5);
}

bool disagrees(const PhotographRatios& found, size_t photograph)
{
    const float limit = std::max(kLeastDeviation, kDeviationSigmas * found.spread);
    return std::abs(std::log(greyOf(found.ratios[photograph]))) > limit;
}

float steepestStep(const std::vector<glm::vec3>& from, const std::vector<glm::vec3>& to)
{
    float steepest = 0;
    for (size_t i = 0; i < from.size(); ++i) {
        const glm::vec3 step = glm::abs(glm::log(to[i] / from[i]));
        steepest = std::max({steepest, step.x, step.y, step.z});
    }
    return steepest;
}

// How the median ratios answer to small logarithmic errors x of the irradiances: log ratios = M x. Each pixel's normal
// takes up what of x is linear in its lights, so M is the mean over the pixels of I - P, P the projector onto their
// directions, weighted by squared cosines.
Eigen::MatrixXd responseOf(const NormalBlock& normals, const std::vector<Light>& lights)
{
    const Eigen::Index n = static_cast<Eigen::Index>(lights.size());
    const std::vector<size_t> pixels = spreadPixels(normals.pixels.size(), kMostInResponse);
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(n);
    // P = taken * taken^T
    Eigen::MatrixXd taken = Eigen::MatrixXd::Zero(n, 3 * static_cast<Eigen::Index>(pixels.size()));
    Eigen::MatrixX3d rows(n, 3);
    for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(pixels.size()); ++k) {
        const size_t p = pixels[k];
        Eigen::Matrix3d gram = Eigen::Matrix3d::Zero();
        rows.setZero();
        for (Eigen::Index i = 0; i < n; ++i) {
            const glm::vec3& l = lights[i].direction;
            const double cosine = glm::dot(normals.pixels[p].normal, l);
            const Verdict verdict = normals.verdicts[p * lights.size() + i];
            if (cosine > 0 && verdict != Verdict::shadow && verdict != Verdict::saturated) {
                weights(i) += cosine * cosine;
            }
            if (cosine > 0 && verdict == Verdict::used) {
                const Eigen::RowVector3d direction(l.x, l.y, l.z);
                gram += direction.transpose() * direction;
                rows.row(i) = cosine * direction;
            }
        }
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(gram);
        if (solver.eigenvalues()(0) > kLeastGramShare * solver.eigenvalues()(2)) {
            taken.middleCols<3>(3 * k) = rows * solver.operatorInverseSqrt();
        }
    }
    Eigen::MatrixXd response = -taken * taken.transpose();
    response.diagonal() += weights;
    for (Eigen::Index i = 0; i < n; ++i) {
        if (weights(i) > 0) {
            response.row(i) /= weights(i);
        } else {
            response(i, i) = 1; // it turns no normal
        }
    }
    return response;
}

// Of the free photographs that show enough: median ratios, logarithms of grey and the colour beside it.
struct MedianRatios {
    std::vector<Eigen::Index> photographs;
    Eigen::VectorXd logs;
    std::vector<glm::vec3> colours;
};

// Of one photograph; grey is 0 where too few pixels tell.
struct MedianRatio {
    float grey = 0;
    glm::vec3 colour{1};
};

MedianRatio medianOf(FacingRatios& gathered)
{
    ChannelRatios& ratios = gathered.telling();
    MedianRatio median;
    if (ratios.grey.size() < kFewestPixels) {
        return median;
    }
    median.grey = quantile(ratios.grey, 0.5);
    for (int c = 0; c < 3; ++c) {
        std::vector<float>& values = ratios.values[c];
        const float ratio = values.size() >= kFewestPixels ? quantile(values, 0.5) : median.grey;
        median.colour[c] = ratio > 0 ? ratio / median.grey : 1.0f;
    }
    return median;
}

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

// Newton's step of the log ratios x to where the medians equal prior * x, which they miss. It is held back while they
// are large, as M holds for small ones alone.
Eigen::VectorXd newtonStep(const MedianRatios& medians, const Eigen::VectorXd& missed, const Eigen::MatrixXd& all,
                           double prior, bool fixesScale)
{
    Eigen::MatrixXd response = all(medians.photographs, medians.photographs);
    const double count = static_cast<double>(medians.logs.size());
    response.diagonal().array() += prior + medians.logs.norm() / std::sqrt(count);
    if (fixesScale) {
        response.array() += 1 / count; // of the common factor, which no ratio tells
    }
    return response.partialPivLu().solve(missed);
}

Eigen::VectorXd logarithmsOf(const std::vector<glm::vec3>& ratios)
{
    Eigen::VectorXd logs(ratios.size());
    for (size_t i = 0; i < ratios.size(); ++i) {
        logs(static_cast<Eigen::Index>(i)) = std::log(greyOf(ratios[i]));
    }
    return logs;
}

// Noise over signal: the square of the pixels' usual scatter over how far the lights themselves differ.
double priorOf(const PhotographRatios& found)
{
    std::vector<float> scatters;
    for (const PhotographScatter& scatter : found.scatters) {
        scatters.push_back(scatter.spread);
    }
    const Eigen::VectorXd logs = logarithmsOf(found.ratios);
    const double spread = std::sqrt((logs.array() - logs.mean()).square().mean());
    return std::pow(quantile(scatters, 0.5) / std::max(kLeastSpread, spread), 2);
}

std::vector<Light> scaled(std::vector<Light> lights, const std::vector<glm::vec3>& ratios)
{
    for (size_t i = 0; i < lights.size(); ++i) {
        lights[i].irradiance *= ratios[i];
    }
    return lights;
}

// Where ratios start from. Those that are close to their end are improved by Newton's steps from the first on.
struct RatioStart {
    std::vector<glm::vec3> ratios;
    bool isClose = false;
};

// Ratios of the photographs that are free; the others' stay 1. Without a fixed one the scale is the median's, and
// what the photographs tell of the ratios is weighed against their being equal. All are 1 where they do not settle.
PhotographRatios refineRatios(const Observations& sample, const std::vector<Light>& lights,
                              const NormalOptions& options, const std::vector<bool>& isFree, const RatioStart& start,
                              int mostIterations)
{
    PhotographRatios result;
    result.ratios = start.ratios;
    const bool allFree = std::find(isFree.begin(), isFree.end(), false) == isFree.end();
    std::vector<Light> current = scaled(lights, result.ratios);
    NormalOptions quick = options;
    quick.triples = std::min(options.triples, kTriples);
    const NormalEstimator consensus = makeConsensusEstimator(lights, quick); // knows directions alone
    bool isClose = start.isClose;
    double prior = 0, least = std::numeric_limits<double>::infinity();
    int idle = 0; // steps since the least miss
    for (; result.iterations < mostIterations && !result.settled; ++result.iterations) {
        const NormalBlock normals = consensus(intensitiesOf(sample, current));
        std::vector<FacingRatios> gathered = gatherRatios(sample, normals, current, options.threads);
        const MedianRatios medians = mediansOf(gathered, isFree, options.threads);
        const Eigen::VectorXd missed = medians.logs - prior * logarithmsOf(result.ratios)(medians.photographs);
        const double miss = missed.norm() / std::sqrt(std::max<double>(1, static_cast<double>(missed.size())));
        idle = miss < least ? 0 : idle + 1;
        least = std::min(least, miss);
        Eigen::VectorXd step = kOverRelaxation * medians.logs;
        if (isClose && !medians.photographs.empty()) {
            step = newtonStep(medians, missed, responseOf(normals, lights), prior, allFree);
        }
        std::vector<glm::vec3> next = result.ratios;
        for (size_t k = 0; k < medians.photographs.size(); ++k) {
            next[medians.photographs[k]] *= medians.colours[k] * static_cast<float>(std::exp(step(k)));
        }
        if (allFree) {
            fixScale(next);
        }
        const float change = steepestStep(result.ratios, next);
        current = scaled(lights, next);
        result.ratios = next;
        result.settled = isClose && (change < kRest || (idle >= kIdleSteps && miss < kJumps));
        const bool becomesClose = !isClose && change < kClose;
        if (result.settled || becomesClose) {
            result.scatters = scattersOf(gathered, options.threads);
        }
        if (becomesClose) {
            isClose = true;
            least = std::numeric_limits<double>::infinity();
            prior = allFree ? priorOf(result) : 0;
        }
    }
    if (!result.settled) {
        const RatioStart allOnes{std::vector<glm::vec3>(lights.size(), glm::vec3(1))};
        // With none free it settles at once.
        PhotographRatios asGiven =
            refineRatios(sample, lights, options, std::vector<bool>(lights.size(), false), allOnes, kMostIterations);
        asGiven.settled = false;
        asGiven.iterations = result.iterations;
        return asGiven;
    }
    result.spread = spreadOf(result.ratios);
    return result;
}

} // namespace

bool canCompare(const Observations& sample)
{
    return sample.lightCount >= kFewestLights && sample.pixels.size() >= kFewestPixels;
}

std::vector<Finding> correctIntensities(const PhotographRatios& found, const std::vector<std::string>& names,
                                        bool known, std::vector<Light>& lights)
{
    std::vector<Finding> remarks;
    const double condition = conditionOf(lights);
    const bool illPlaced = condition > kWorstTellingCondition;
    if (!found.settled) {
        return {{FindingCode::intensitiesUncertain,
                 fmt::format("the intensities do not settle in {} steps: {}", found.iterations,
                             known ? "they stay as given" : "the lights are taken to be equally strong")}};
    }
    if (!known) {
        remarks.push_back(
            {FindingCode::intensitiesEstimated,
             fmt::format("intensities estimated from the photographs themselves in {} steps: {:.2f} to {:.2f}",
                         found.iterations, leastGrey(found.ratios), largestGrey(found.ratios))});
        if (illPlaced) {
            remarks.push_back(
                {FindingCode::intensitiesUncertain,
                 fmt::format("the lights are ill placed (condition {:.1f}; up to {:.0f} is good): their intensities "
                             "hardly differ from a tilt of the object, and stay near equal where the photographs do "
                             "not tell; measure them",
                             condition, kWorstTellingCondition)});
        }
    }
    std::vector<glm::vec3> corrected;
    std::string corrections;
    for (size_t i = 0; i < lights.size(); ++i) {
        if (!known || disagrees(found, i)) {
            lights[i].irradiance *= found.ratios[i];
        }
        if (known && disagrees(found, i)) {
            corrected.push_back(found.ratios[i]);
            corrections += (corrections.empty() ? "" : ", ") + names[i];
        }
    }
    if (!corrected.empty()) {
        remarks.push_back(
            {FindingCode::intensitiesCorrected,
             fmt::format(
                 "{} photograph(s) are {:.2f} to {:.2f} times as bright as the others predict; their intensities "
                 "were corrected: {}{}",
                 corrected.size(), leastGrey(corrected), largestGrey(corrected), corrections,
                 illPlaced
                     ? fmt::format("; the others stay as given, since the lights are ill placed (condition {:.1f})",
                                   condition)
                     : "")});
    }
    return remarks;
}

PhotographRatios estimateIntensityRatios(const Observations& sample, const std::vector<Light>& lights,
                                         const NormalOptions& options, int mostIterations)
{
    const RatioStart allOnes{std::vector<glm::vec3>(lights.size(), glm::vec3(1))};
    return refineRatios(sample, lights, options, std::vector<bool>(lights.size(), true), allOnes, mostIterations);
}

PhotographRatios confirmedRatios(const PhotographRatios& found, const Observations& sample,
                                 const std::vector<Light>& lights, const NormalOptions& options)
{
    std::vector<bool> isDoubted;
    RatioStart start{{}, true};
    for (size_t i = 0; i < lights.size(); ++i) {
        isDoubted.push_back(disagrees(found, i));
        start.ratios.push_back(isDoubted[i] ? found.ratios[i] : glm::vec3(1));
    }
    if (std::find(isDoubted.begin(), isDoubted.end(), true) == isDoubted.end()) {
        return found;
    }
    PhotographRatios confirmed = refineRatios(sample, lights, options, isDoubted, start, kMostIterations);
    confirmed.spread = found.spread; // the photographs' own scatter, which fixed ratios do not show
    return confirmed;
}

} // namespace nacre
