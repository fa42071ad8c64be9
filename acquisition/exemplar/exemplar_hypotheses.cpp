#include "acquisition/exemplar/exemplar_hypotheses.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "acquisition/exemplar/neighbour_search.h"
#include "acquisition/exemplar/reflectance_fit.h"
#include "engine/files/measures.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

constexpr int kSearchBallSize = 24; // 6.8 degrees
constexpr size_t kPixelsToRank = 60;
// So many of the known reflectances are ranked again with the albedos that they showed.
constexpr size_t kRankedAgain = 12;
constexpr int kSweeps = 4, kShadeSweeps = 2;
constexpr int kOwnRounds = 2;
// Known reflectances are first tried around the consensus normal, 44 degrees at most.
constexpr float kCosRankRadius = 0.72f;
// Exponents of n.l that diffuse parts may have. Lambert's stays unless another costs so much less.
constexpr float kDiffuseExponents[] = {0.7f, 0.8f, 0.9f, 1.1f, 1.2f, 1.3f, 1.45f};
constexpr double kExponentGain = 0.05;
constexpr double kRankWellExplained = 0.7;
constexpr float kRankMargin = 1.5f;
constexpr size_t kSearchedWidePerTask = 16;
// Residuals are truncated at so many times what the start leaves of them in the mean.
constexpr float kTruncationFactor = 3;
constexpr float kLargestTruncation = 0.16f;

const std::vector<int> kWideSteps{16, 8, 4, 2};

// What the hypotheses of one object share.
struct Bench {
    const BallGrid& grid;
    const BallGrid& searchGrid;
    const PixelLattice& lattice;
    std::vector<glm::vec3> consensus;
    std::vector<glm::vec2> starts; // the consensus, on the ball
    int threads;
};

MatchModel modelOf(const BallGrid& grid, Reflectance reflectance, int threads)
{
    MatchModel model{std::move(reflectance), {}, {}};
    model.ball = makeReflectanceBall(grid, model.reflectance, threads);
    return model;
}

void search(const Bench& bench, int sweeps, Hypothesis& hypothesis)
{
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        sweepMatches(hypothesis.model, bench.lattice, kWideSteps, bench.starts, bench.threads, hypothesis.matches);
    }
    polishMatches(hypothesis.model, bench.lattice, bench.threads, hypothesis.matches);
    hypothesis.cost = meanCost(hypothesis.matches);
}

std::vector<BallMatch> matchesAt(const std::vector<glm::vec2>& texels)
{
    std::vector<BallMatch> matches;
    for (const glm::vec2& texel : texels) {
        matches.push_back({texel, 1, 2, -1});
    }
    return matches;
}

// The object's own reflectance and its normals, in turn.
Hypothesis withOwnReflectance(const Bench& bench, Hypothesis hypothesis, bool additive, const std::string& name)
{
    hypothesis.name = name;
    for (int round = 0; round < kOwnRounds; ++round) {
        refitModel(bench.lattice, additive, bench.threads, hypothesis.model, hypothesis.matches);
        search(bench, kSweeps, hypothesis);
    }
    return hypothesis;
}

// Of diffuse parts Lambert's, or that of n.l to the power that costs clearly less. A reflectance of one free number
// tells slants from shading better than one that is free altogether.
std::array<float, kShadeKnots> diffuseShade(const Bench& bench)
{
    const auto costOf = [&](const std::array<float, kShadeKnots>& shade) {
        Reflectance reflectance;
        reflectance.shade = shade;
        Hypothesis hypothesis{"", modelOf(bench.grid, reflectance, bench.threads), matchesAt(bench.starts), 0};
        search(bench, kShadeSweeps, hypothesis);
        return hypothesis.cost;
    };
    std::array<float, kShadeKnots> best{};
    double least = (1 - kExponentGain) * costOf(best);
    for (const float exponent : kDiffuseExponents) {
        const std::array<float, kShadeKnots> shade = shadeOfPower(exponent);
        const double cost = costOf(shade);
        if (cost < least) {
            least = cost;
            best = shade;
        }
    }
    return best;
}

// The best row of a whole ball, or of what lies around a normal.
BallMatch bestOfBall(const MatchModel& model, const PixelLattice& lattice, size_t pixel, const glm::vec3& around,
                     float cosRadius)
{
    const BallGrid& grid = *model.ball.grid;
    BallMatch best;
    for (size_t row = 0; row < grid.normals.size(); ++row) {
        if (glm::dot(grid.normals[row], around) > cosRadius) {
            const BallMatch match = matchAtRow(model, lattice, pixel, static_cast<int>(row), 1);
            best = match.cost < best.cost ? match : best;
        }
    }
    return best;
}

// The mean cost of a few pixels; the albedos of those that are well explained.
double rankCost(const Bench& bench, const MatchModel& model, AlbedoRange& albedos)
{
    std::vector<std::pair<float, float>> found;
    double sum = 0;
    const std::vector<size_t> pixels = spreadPixels(bench.lattice.pixelCount(), kPixelsToRank);
    for (const size_t p : pixels) {
        const BallMatch match = bestOfBall(model, bench.lattice, p, bench.consensus[p], kCosRankRadius);
        sum += std::min(1.0f, match.cost);
        found.push_back({match.cost, match.scale * bench.lattice.bright[p]});
    }
    std::sort(found.begin(), found.end());
    std::vector<float> values;
    for (size_t j = 0;
         j < std::max<size_t>(1, static_cast<size_t>(kRankWellExplained * static_cast<double>(found.size()))); ++j) {
        values.push_back(found[j].second);
    }
    albedos = {quantile(values, 0.02) / kRankMargin, quantile(values, 0.98) * kRankMargin};
    return sum / static_cast<double>(pixels.size());
}

// A few pixels' cost of every known reflectance: free albedos first, then the best ones again with those that they
// showed. Answers the index of the cheapest.
size_t rankedBest(const Bench& bench, const std::vector<NamedReflectance>& dictionary, AlbedoRange& albedos)
{
    struct Ranked {
        double cost;
        size_t index;
        AlbedoRange albedos;
    };
    std::vector<Ranked> ranked(dictionary.size());
    // Known reflectances have one diffuse part.
    const std::vector<float> shades = shadesOf(bench.searchGrid, dictionary.front().reflectance, bench.threads);
    const auto rank = [&](Ranked& entry, const AlbedoRange& given) {
        MatchModel model{dictionary[entry.index].reflectance, {}, given};
        model.ball = makeReflectanceBall(bench.searchGrid, model.reflectance, shades, 1);
        entry.cost = rankCost(bench, model, entry.albedos);
    };
    const auto cheaper = [](const Ranked& a, const Ranked& b) {
        return a.cost < b.cost || (a.cost == b.cost && a.index < b.index);
    };
    parallelFor(ranked.size(), 1, bench.threads, [&](size_t r, size_t) {
        ranked[r].index = r;
        rank(ranked[r], {});
    });
    const size_t again = std::min(kRankedAgain, ranked.size());
    std::partial_sort(ranked.begin(), ranked.begin() + static_cast<long>(again), ranked.end(), cheaper);
    ranked.resize(again);
    std::vector<AlbedoRange> shown;
    for (const Ranked& entry : ranked) {
        shown.push_back(entry.albedos);
    }
    parallelFor(again, 1, bench.threads, [&](size_t r, size_t) { rank(ranked[r], shown[r]); });
    const auto best = std::min_element(ranked.begin(), ranked.end(), cheaper);
    albedos = shown[static_cast<size_t>(best - ranked.begin())];
    return best->index;
}

// The known reflectance that explains a few pixels best, tried over the whole ball.
Hypothesis knownStart(const Bench& bench, const NormalOptions& options)
{
    const std::array<float, kShadeKnots> shade = diffuseShade(bench);
    std::vector<NamedReflectance> dictionary =
        reflectanceDictionary(options.fitsFolder, options.excludedReflectances, bench.grid.largestThetaD);
    for (NamedReflectance& named : dictionary) {
        named.reflectance.shade = shade;
    }
    AlbedoRange albedos;
    const NamedReflectance& known = dictionary[rankedBest(bench, dictionary, albedos)];
    MatchModel wide = modelOf(bench.searchGrid, known.reflectance, bench.threads);
    wide.albedos = albedos;
    std::vector<glm::vec2> texels(bench.lattice.pixelCount());
    parallelFor(texels.size(), kSearchedWidePerTask, bench.threads, [&](size_t first, size_t last) {
        for (size_t p = first; p < last; ++p) {
            const BallMatch match = bestOfBall(wide, bench.lattice, p, {0, 0, 1}, -1);
            texels[p] =
                ballTexelOf(match.row < 0 ? glm::vec3(0, 0, 1) : bench.searchGrid.normals[match.row], bench.grid.size);
        }
    });
    Hypothesis hypothesis{known.name, modelOf(bench.grid, known.reflectance, bench.threads), matchesAt(texels), 0};
    hypothesis.model.albedos = albedos;
    search(bench, kSweeps, hypothesis);
    // Noise in dim pixels leaves residuals beyond the least truncation, where they would tell nothing any more.
    const float residual = static_cast<float>(hypothesis.cost) * hypothesis.model.truncation;
    hypothesis.model.truncation = std::clamp(kTruncationFactor * residual, kLeastTruncation, kLargestTruncation);
    forgetCosts(hypothesis.matches);
    return hypothesis;
}

std::vector<glm::vec3> consensusNormals(const PixelLattice& lattice, const std::vector<Light>& lights,
                                        const NormalOptions& options)
{
    std::vector<glm::vec3> normals;
    for (const PixelNormal& pixel : makeConsensusEstimator(lights, options)(lattice.intensities).pixels) {
        normals.push_back(pixel.albedo > 0 ? pixel.normal : glm::vec3(0, 0, 1));
    }
    return normals;
}

} // namespace

std::vector<Hypothesis> makeHypotheses(const BallGrid& grid, const PixelLattice& lattice,
                                       const std::vector<Light>& lights, const NormalOptions& options)
{
    const BallGrid searchGrid = makeBallGrid(kSearchBallSize, lights, options.threads);
    Bench bench{grid, searchGrid, lattice, consensusNormals(lattice, lights, options), {}, options.threads};
    for (const glm::vec3& normal : bench.consensus) {
        bench.starts.push_back(ballTexelOf(normal, grid.size));
    }
    const Hypothesis known = knownStart(bench, options);
    std::vector<Hypothesis> all;
    all.push_back(withOwnReflectance(bench, known, false, known.name + ", gloss scaled by the albedo"));
    all.push_back(withOwnReflectance(bench, all.back(), true, known.name + ", gloss whatever the albedo"));
    return all;
}

} // namespace nacre
