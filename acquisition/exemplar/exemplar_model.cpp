#include "acquisition/exemplar/exemplar_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "acquisition/exemplar/reflectance_fit.h"
#include "engine/files/measures.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

constexpr int kBallSize = 64;       // texels across: 2.5 degrees; polishing does the rest
constexpr int kSearchBallSize = 24; // 6.8 degrees
constexpr size_t kMostInLattice = 4000;
constexpr size_t kMostCoarsest = 700;
constexpr size_t kPixelsToRank = 60;
constexpr int kSweeps = 4;
// Passes on a finer level go on while the cost falls by so much.
constexpr int kMostPasses = 4;
constexpr double kLeastGain = 0.005;
constexpr int kOwnRounds = 3, kAdditiveRounds = 2;
// Known reflectances are first tried around the consensus normal, 44 degrees at most.
constexpr float kCosRankRadius = 0.72f;
// Exponents of n.l that diffuse parts may have. Lambert's stays unless another costs so much less.
constexpr float kDiffuseExponents[] = {0.7f, 0.8f, 0.9f, 1.1f, 1.2f, 1.3f, 1.45f};
constexpr double kExponentGain = 0.05;
constexpr double kRankWellExplained = 0.7;
constexpr float kRankMargin = 1.5f;

const std::vector<int> kWideSteps{16, 8, 4, 2};
const std::vector<int> kNarrowSteps{4, 2, 1};
const std::vector<int> kFineSteps{16, 8, 4, 2, 1};

// A pixel's own square of the lattice and those around it.
constexpr std::array<glm::ivec2, 9> kSquares{glm::ivec2(0, 0), {1, 0},  {-1, 0}, {0, 1},  {0, -1},
                                             {1, 1},           {-1, 1}, {1, -1}, {-1, -1}};
constexpr size_t kMatchedPerTask = 256;

struct Hypothesis {
    std::string name;
    MatchModel model;
    std::vector<BallMatch> matches;
    double cost = 0;
};

// What the hypotheses of one object share.
struct Bench {
    const BallGrid& grid;
    const BallGrid& searchGrid;
    const PixelLattice& lattice; // the coarsest
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

void refit(const PixelLattice& lattice, bool additive, int threads, MatchModel& model, std::vector<BallMatch>& matches)
{
    const BallGrid& grid = *model.ball.grid;
    fitReflectance(lattice, additive, model, matches);
    model.ball = makeReflectanceBall(grid, model.reflectance, threads);
    forgetCosts(matches);
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
Hypothesis withOwnReflectance(const Bench& bench, Hypothesis hypothesis, bool additive, int rounds,
                              const std::string& name)
{
    hypothesis.name = name;
    for (int round = 0; round < rounds; ++round) {
        refit(bench.lattice, additive, bench.threads, hypothesis.model, hypothesis.matches);
        search(bench, kSweeps, hypothesis);
    }
    return hypothesis;
}

// Lambert's law, or n.l to the power that costs clearly less. A reflectance of one free number tells slants from
// shading better than one that is free altogether.
Hypothesis diffuseStart(const Bench& bench, std::array<float, kShadeKnots>& shade)
{
    const auto tryShade = [&](const std::array<float, kShadeKnots>& tried) {
        Reflectance reflectance;
        reflectance.shade = tried;
        Hypothesis hypothesis{"", modelOf(bench.grid, reflectance, bench.threads), matchesAt(bench.starts), 0};
        search(bench, kSweeps / 2, hypothesis);
        return hypothesis;
    };
    Hypothesis best = tryShade({});
    double least = (1 - kExponentGain) * best.cost;
    for (const float exponent : kDiffuseExponents) {
        Hypothesis hypothesis = tryShade(shadeOfPower(exponent));
        if (hypothesis.cost < least) {
            least = hypothesis.cost;
            best = std::move(hypothesis);
        }
    }
    shade = best.model.reflectance.shade;
    search(bench, kSweeps / 2, best);
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

// The known reflectance that explains a few pixels best: free albedos first, then again with those that they showed.
Hypothesis dictionaryStart(const Bench& bench, const std::array<float, kShadeKnots>& shade,
                           const NormalOptions& options, double& rankedCost, size_t& dictionarySize)
{
    std::vector<NamedReflectance> dictionary =
        reflectanceDictionary(options.fitsFolder, options.excludedReflectances, bench.grid.largestThetaD);
    std::vector<double> costs(dictionary.size());
    std::vector<AlbedoRange> albedos(dictionary.size());
    parallelFor(dictionary.size(), 1, bench.threads, [&](size_t r, size_t) {
        dictionary[r].reflectance.shade = shade;
        MatchModel model = modelOf(bench.searchGrid, dictionary[r].reflectance, 1);
        rankCost(bench, model, model.albedos);
        albedos[r] = model.albedos;
        AlbedoRange again;
        costs[r] = rankCost(bench, model, again);
    });
    const size_t best = static_cast<size_t>(std::min_element(costs.begin(), costs.end()) - costs.begin());
    rankedCost = costs[best];
    dictionarySize = dictionary.size();
    MatchModel wide = modelOf(bench.searchGrid, dictionary[best].reflectance, bench.threads);
    wide.albedos = albedos[best];
    std::vector<glm::vec2> texels(bench.lattice.pixelCount());
    parallelFor(texels.size(), 16, bench.threads, [&](size_t first, size_t last) {
        for (size_t p = first; p < last; ++p) {
            const BallMatch match = bestOfBall(wide, bench.lattice, p, {0, 0, 1}, -1);
            texels[p] =
                ballTexelOf(match.row < 0 ? glm::vec3(0, 0, 1) : bench.searchGrid.normals[match.row], bench.grid.size);
        }
    });
    Hypothesis hypothesis{dictionary[best].name, modelOf(bench.grid, dictionary[best].reflectance, bench.threads),
                          matchesAt(texels), 0};
    hypothesis.model.albedos = wide.albedos;
    search(bench, kSweeps, hypothesis);
    return hypothesis;
}

Hypothesis bestHypothesis(const Bench& bench, const NormalOptions& options, std::vector<Finding>& findings)
{
    std::array<float, kShadeKnots> shade{};
    const Hypothesis diffuse = diffuseStart(bench, shade);
    double rankedCost = 0;
    size_t dictionarySize = 0;
    const Hypothesis known = dictionaryStart(bench, shade, options, rankedCost, dictionarySize);
    std::vector<Hypothesis> all;
    all.push_back(withOwnReflectance(bench, diffuse, false, kOwnRounds, "a diffuse start, gloss scaled by the albedo"));
    all.push_back(withOwnReflectance(bench, diffuse, true, kOwnRounds, "a diffuse start, gloss whatever the albedo"));
    all.push_back(withOwnReflectance(bench, known, false, kOwnRounds, known.name + ", gloss scaled by the albedo"));
    all.push_back(
        withOwnReflectance(bench, all.back(), true, kAdditiveRounds, known.name + ", gloss whatever the albedo"));
    const auto best = std::min_element(all.begin(), all.end(),
                                       [](const Hypothesis& a, const Hypothesis& b) { return a.cost < b.cost; });
    findings.push_back(
        {FindingCode::reflectanceChosen,
         fmt::format("exemplar: the object's own reflectance from {} (cost {:.3f}); of {} known ones {} explains it "
                     "best (cost {:.3f})",
                     best->name, best->cost, dictionarySize, known.name, rankedCost)});
    return std::move(*best);
}

std::vector<BallMatch> inherited(const PixelLattice& fine, const PixelLattice& coarse,
                                 const std::vector<BallMatch>& matches, const std::vector<int>& parents)
{
    std::vector<BallMatch> result;
    for (size_t p = 0; p < parents.size(); ++p) {
        const BallMatch& parent = matches[parents[p]];
        result.push_back({parent.texel, parent.scale * coarse.bright[parents[p]] / fine.bright[p], 2, parent.row});
    }
    return result;
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

struct Level {
    PixelLattice lattice;
    std::vector<int> parents; // its pixels' places in the next coarser level
};

// From the thin lattice to the coarsest.
std::vector<Level> makeLevels(const Intensities& sample, int& spacing, int threads)
{
    std::vector<Level> levels{{makePixelLattice(sample, threads), {}}};
    const double crowd = static_cast<double>(sample.pixelCount()) / static_cast<double>(kMostInLattice);
    spacing = static_cast<int>(std::ceil(sample.spacing * std::sqrt(std::max(1.0, crowd))));
    if (spacing > 1) {
        std::vector<int> parents;
        levels.front().lattice = thinnedLattice(levels.front().lattice, spacing, threads, parents);
    }
    while (levels.back().lattice.pixelCount() > kMostCoarsest) {
        PixelLattice coarse = thinnedLattice(levels.back().lattice, 2, threads, levels.back().parents);
        levels.push_back({std::move(coarse), {}});
    }
    return levels;
}

} // namespace

ExemplarModel makeExemplarModel(const Intensities& sample, const std::vector<Light>& lights,
                                const NormalOptions& options, std::vector<Finding>& findings)
{
    ExemplarModel model;
    std::vector<Level> levels = makeLevels(sample, model.spacing, options.threads);
    model.grid = std::make_unique<const BallGrid>(makeBallGrid(kBallSize, lights, options.threads));
    const BallGrid searchGrid = makeBallGrid(kSearchBallSize, lights, options.threads);
    const PixelLattice& coarsest = levels.back().lattice;
    Bench bench{*model.grid, searchGrid, coarsest, consensusNormals(coarsest, lights, options), {}, options.threads};
    for (const glm::vec3& normal : bench.consensus) {
        bench.starts.push_back(ballTexelOf(normal, kBallSize));
    }
    Hypothesis best = bestHypothesis(bench, options, findings);
    const bool additive = best.model.reflectance.additive;
    for (size_t level = levels.size() - 1; level-- > 0;) {
        const Level& fine = levels[level];
        best.matches = inherited(fine.lattice, levels[level + 1].lattice, best.matches, fine.parents);
        double cost = 1;
        for (int pass = 0; pass < kMostPasses; ++pass) {
            sweepMatches(best.model, fine.lattice, kNarrowSteps, {}, options.threads, best.matches);
            polishMatches(best.model, fine.lattice, options.threads, best.matches);
            const double next = meanCost(best.matches);
            refit(fine.lattice, additive, options.threads, best.model, best.matches);
            if (next > (1 - kLeastGain) * cost) {
                break;
            }
            cost = next;
        }
    }
    model.match = std::move(best.model);
    model.matches = std::move(best.matches);
    model.lattice = std::move(levels.front().lattice);
    return model;
}

namespace {

// The lattice's pixel for a place in the picture's squares; -1 where there is none.
int latticePixel(const PixelLattice& lattice, int x, int y)
{
    const bool isInside = x >= 0 && y >= 0 && x < lattice.width && y < lattice.height;
    return isInside ? lattice.index[static_cast<size_t>(y) * lattice.width + x] : -1;
}

} // namespace

std::vector<BallMatch> matchPixels(const ExemplarModel& model, const PixelLattice& pixels, int threads)
{
    const PixelLattice& lattice = model.lattice;
    std::vector<BallMatch> matches(pixels.pixelCount());
    parallelFor(matches.size(), kMatchedPerTask, threads, [&](size_t first, size_t last) {
        std::vector<BallMatch> candidates;
        for (size_t p = first; p < last; ++p) {
            const int x = static_cast<int>(pixels.places[p]) % pixels.width / model.spacing,
                      y = static_cast<int>(pixels.places[p]) / pixels.width / model.spacing;
            candidates.assign(1, {ballTexelOf({0, 0, 1}, model.grid->size), 1, 2, -1});
            for (const glm::ivec2& square : kSquares) {
                const int near = latticePixel(lattice, x + square.x, y + square.y);
                if (near >= 0) {
                    candidates.push_back(model.matches[near]);
                    candidates.back().scale *= lattice.bright[near] / pixels.bright[p];
                }
            }
            matches[p] = bestMatch(model.match, pixels, p, candidates, kFineSteps);
        }
    });
    return matches;
}

} // namespace nacre
