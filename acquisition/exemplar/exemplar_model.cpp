#include "acquisition/exemplar/exemplar_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "acquisition/exemplar/exemplar_hypotheses.h"
#include "acquisition/exemplar/joint_refinement.h"
#include "acquisition/exemplar/reflectance_fit.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

constexpr size_t kMostCoarsest = 700;
// At most so many passes on a finer level, while the cost falls by so much.
constexpr int kMostPasses = 2;
constexpr double kLeastGain = 0.005;

const std::vector<int> kNarrowSteps{4, 2, 1};
const std::vector<int> kFineSteps{16, 8, 4, 8, 4, 2, 1};

// A pixel's own square of the lattice and those around it.
constexpr std::array<glm::ivec2, 9> kSquares{glm::ivec2(0, 0), {1, 0},  {-1, 0}, {0, 1},  {0, -1},
                                             {1, 1},           {-1, 1}, {1, -1}, {-1, -1}};
constexpr size_t kMatchedPerTask = 256;
// A match that costs so many times the typical one is sought again from texels so far apart all over the ball.
constexpr float kFarCost = 3;
constexpr int kFarStep = 8;
// Grazing light by n.l, of so many pixels. Where half of it shows less than this share of what is predicted, the
// horizon says nothing of slopes.
constexpr float kLeastGrazing = 0.03f, kMostGrazing = 0.12f;
constexpr size_t kMostGrazed = 1000, kFewestGrazed = 100;
constexpr float kUnlitShare = 0.5f;
// Of one albedo: objects whose pixels differ by more in the median are painted.
constexpr size_t kFewestOfOneAlbedo = 6, kMostCompared = 600;
constexpr float kMostAlbedoSpread = 0.2f;
constexpr double kOneAlbedoMargin = 1.05;

struct CoarserLevel {
    PixelLattice lattice;
    std::vector<int> parents; // for each pixel of the finer level its square here
};

std::vector<CoarserLevel> coarserLevels(const PixelLattice& finest, int threads)
{
    std::vector<CoarserLevel> levels;
    const PixelLattice* finer = &finest;
    levels.reserve(32); // so that `finer` stays in its place
    while (finer->pixelCount() > kMostCoarsest) {
        CoarserLevel level;
        level.lattice = thinnedLattice(*finer, 2, threads, level.parents);
        levels.push_back(std::move(level));
        finer = &levels.back().lattice;
    }
    return levels;
}

std::vector<BallMatch> inherited(const PixelLattice& fine, const CoarserLevel& coarse,
                                 const std::vector<BallMatch>& matches)
{
    std::vector<BallMatch> result;
    for (size_t p = 0; p < fine.pixelCount(); ++p) {
        const int square = coarse.parents[p];
        const BallMatch& parent = matches[square];
        result.push_back({parent.texel, parent.scale * coarse.lattice.bright[square] / fine.bright[p], 2, parent.row});
    }
    return result;
}

// Normals and the object's reflectance in turn, from where they are. Answers the matches' median cost.
float improve(const PixelLattice& lattice, int threads, MatchModel& model, std::vector<BallMatch>& matches)
{
    float typical = 1;
    const bool additive = model.reflectance.additive;
    double cost = 1;
    for (int pass = 0; pass < kMostPasses; ++pass) {
        sweepMatches(model, lattice, kNarrowSteps, {}, threads, matches);
        polishMatches(model, lattice, threads, matches);
        const double next = meanCost(matches);
        typical = medianCost(matches);
        refitModel(lattice, additive, threads, model, matches);
        if (next > (1 - kLeastGain) * cost) {
            break;
        }
        cost = next;
    }
    return typical;
}

// Whether most of what lights graze is dark: then light ends before the horizon does, by values that were taken off
// the photographs or a curve that crushes shadows, or lies below the noise.
bool endsBeforeTheHorizon(const PixelLattice& lattice, const MatchModel& model, const std::vector<BallMatch>& matches)
{
    const BallGrid& grid = *model.ball.grid;
    std::vector<float> shares, predicted(lattice.lightCount);
    for (const size_t p : spreadPixels(matches.size(), kMostGrazed)) {
        const glm::vec3 normal = normalOfBallTexel(matches[p].texel, grid.size);
        predictMatch(model, matches[p], lattice.bright[p], predicted.data());
        for (size_t i = 0; i < lattice.lightCount; ++i) {
            const float value = lattice.intensities.ofPixel(p)[i], cosine = glm::dot(normal, grid.directions[i]);
            if (!isClipped(value) && cosine > kLeastGrazing && cosine < kMostGrazing && predicted[i] > 0) {
                shares.push_back(value / predicted[i]);
            }
        }
    }
    return shares.size() >= kFewestGrazed && quantile(shares, 0.5) < kUnlitShare;
}

// Over e^u(n.v), which belongs to the reflectance.
std::vector<float> albedosOf(const PixelLattice& lattice, const MatchModel& model,
                             const std::vector<BallMatch>& matches)
{
    std::vector<float> albedos;
    for (size_t p = 0; p < matches.size(); ++p) {
        const float nDotV = normalOfBallTexel(matches[p].texel, model.ball.grid->size).z;
        albedos.push_back(matches[p].scale * lattice.bright[p] / std::exp(model.reflectance.shadeAt(nDotV)));
    }
    return albedos;
}

// The median share by which albedos depart from their median.
float spreadOf(std::vector<float> albedos)
{
    const float middle = quantile(albedos, 0.5);
    for (float& albedo : albedos) {
        albedo = std::abs(albedo / middle - 1);
    }
    return quantile(albedos, 0.5);
}

// What some pixels' matches cost under a model, over what they cost before.
double costRatio(const PixelLattice& lattice, const MatchModel& model, const std::vector<BallMatch>& matches,
                 const std::vector<BallMatch>& before)
{
    double cost = 0, costBefore = 0;
    for (const size_t p : spreadPixels(matches.size(), kMostCompared)) {
        cost += std::min(1.0f, polishedMatch(model, lattice, p, matches[p]).cost);
        costBefore += std::min(1.0f, before[p].cost);
    }
    return cost / costBefore;
}

// Normals and reflectance at once where all pixels have one albedo, and slopes explain what brightness they differ by.
// A factor a pixel has one unknown more to n lights, so that residuals are smaller by sqrt((n - 3) / (n - 2)) even if
// there is no paint; what costs no more than that and a margin is kept. Answers the matches' median cost.
float refineWithOneAlbedo(const PixelLattice& lattice, int threads, MatchModel& model, std::vector<BallMatch>& matches)
{
    MatchModel tried = model;
    std::vector<BallMatch> moved = matches;
    if (model.reflectance.additive) {
        refitModel(lattice, false, threads, tried, moved);
    }
    std::vector<float> albedos = albedosOf(lattice, tried, moved);
    const float albedo = quantile(albedos, 0.5);
    if (lattice.lightCount < kFewestOfOneAlbedo || !(albedo > 0) || spreadOf(albedos) > kMostAlbedoSpread) {
        return medianCost(matches);
    }
    tried.reflectance.oneAlbedo = albedo;
    tried.reflectance.slant = tried.reflectance.shade; // as if reciprocal
    tried.albedos = {albedo, albedo};
    refineJointly(lattice, threads, tried, moved);
    for (size_t p = 0; p < moved.size(); ++p) {
        moved[p].scale = albedo / lattice.bright[p];
    }
    const double lights = static_cast<double>(lattice.lightCount);
    if (costRatio(lattice, tried, moved, matches) < kOneAlbedoMargin * std::sqrt((lights - 2) / (lights - 3))) {
        tried.reflectance.coupling.assign(kCouplingKnots * kCouplingKnots * kCouplingDifferences, 0);
        refineJointly(lattice, threads, tried, moved);
        sweepMatches(tried, lattice, kNarrowSteps, {}, threads, moved);
        polishMatches(tried, lattice, threads, moved);
        model = std::move(tried);
        matches = std::move(moved);
    }
    return medianCost(matches);
}

// Normals and reflectance at once, gloss scaled by the albedo and not: of both, and of what is there, what explains the
// observations best. Slopes hang on where light ends, at n.l = 0: all stays as it is where that cannot be seen. Answers
// the matches' median cost.
float refineBothForms(const PixelLattice& lattice, int threads, MatchModel& model, std::vector<BallMatch>& matches)
{
    if (endsBeforeTheHorizon(lattice, model, matches)) {
        return medianCost(matches);
    }
    const bool isAdditive = model.reflectance.additive;
    MatchModel best = model;
    std::vector<BallMatch> bestMatches = matches;
    polishMatches(best, lattice, threads, bestMatches);
    for (const bool additive : {isAdditive, !isAdditive}) {
        MatchModel tried = model;
        std::vector<BallMatch> moved = matches;
        if (additive != isAdditive) {
            refitModel(lattice, additive, threads, tried, moved);
        }
        refineJointly(lattice, threads, tried, moved);
        sweepMatches(tried, lattice, kNarrowSteps, {}, threads, moved);
        polishMatches(tried, lattice, threads, moved);
        if (meanCost(moved) < meanCost(bestMatches)) {
            best = std::move(tried);
            bestMatches = std::move(moved);
        }
    }
    model = std::move(best);
    matches = std::move(bestMatches);
    return refineWithOneAlbedo(lattice, threads, model, matches);
}

// The hypothesis that predicts held-out lights best; without a jury the one of least cost.
Hypothesis bestHypothesis(std::vector<Hypothesis> all, const PixelLattice& lattice, const Jury* jury, int threads,
                          std::vector<Finding>& findings)
{
    std::vector<double> errors;
    for (const Hypothesis& hypothesis : all) {
        errors.push_back(jury ? meanOf(heldOutErrors(*jury, hypothesis.model, lattice, hypothesis.matches, threads))
                              : hypothesis.cost);
    }
    const size_t best = static_cast<size_t>(std::min_element(errors.begin(), errors.end()) - errors.begin());
    findings.push_back({FindingCode::reflectanceChosen,
                        fmt::format("exemplar: the object's own reflectance from {} ({} {:.3f})", all[best].name,
                                    jury ? "error on held-out lights" : "cost", errors[best])});
    return std::move(all[best]);
}

} // namespace

ExemplarModel makeExemplarModel(const Intensities& sample, const std::vector<Light>& lights,
                                const NormalOptions& options, const Jury* jury, std::vector<Finding>& findings)
{
    ExemplarModel model;
    model.lattice = makeThinLattice(sample, options.threads);
    BallGrid grid = makeBallGrid(kBallSize, lights, options.threads);
    if (jury) {
        grid.largestThetaD = jury->grid.largestThetaD; // so that the bins of both are the same
    }
    model.grid = std::make_unique<const BallGrid>(std::move(grid));
    const PixelLattice& seen = jury ? jury->kept : model.lattice;
    const std::vector<CoarserLevel> levels = coarserLevels(seen, options.threads);
    const PixelLattice& coarsest = levels.empty() ? seen : levels.back().lattice;
    Hypothesis best = bestHypothesis(
        makeHypotheses(jury ? jury->grid : *model.grid, coarsest, jury ? jury->split.keptLights : lights, options),
        coarsest, jury, options.threads, findings);
    model.typicalCost = medianCost(best.matches);
    for (size_t level = levels.size(); level-- > 0;) {
        const PixelLattice& fine = level > 0 ? levels[level - 1].lattice : seen;
        best.matches = inherited(fine, levels[level], best.matches);
        model.typicalCost = improve(fine, options.threads, best.model, best.matches);
    }
    if (jury) {
        model.heldOutErrors = heldOutErrors(*jury, best.model, seen, best.matches, options.threads);
        best.model.ball = makeReflectanceBall(*model.grid, best.model.reflectance, options.threads);
        forgetCosts(best.matches);
        for (size_t p = 0; p < best.matches.size(); ++p) {
            best.matches[p].scale *= seen.bright[p] / model.lattice.bright[p];
        }
        model.typicalCost = improve(model.lattice, options.threads, best.model, best.matches);
    }
    model.typicalCost = refineBothForms(model.lattice, options.threads, best.model, best.matches);
    if (best.model.reflectance.oneAlbedo) {
        findings.push_back({FindingCode::oneAlbedo,
                            "exemplar: all pixels have one albedo, since one for each explains them no better"});
    }
    model.match = std::move(best.model);
    model.matches = std::move(best.matches);
    model.nearest = nearestPixels(model.lattice);
    return model;
}

namespace {

// The lattice's pixel in, or nearest to, a square that may lie outside it.
int latticePixel(const ExemplarModel& model, int x, int y)
{
    const PixelLattice& lattice = model.lattice;
    const int u = std::clamp(x, 0, lattice.width - 1), v = std::clamp(y, 0, lattice.height - 1);
    return model.nearest[static_cast<size_t>(v) * lattice.width + u];
}

std::vector<glm::vec2> texelsEverywhere(int size)
{
    std::vector<glm::vec2> texels;
    for (int y = kFarStep / 2; y < size; y += kFarStep) {
        for (int x = kFarStep / 2; x < size; x += kFarStep) {
            texels.emplace_back(x, y);
        }
    }
    return texels;
}

} // namespace

std::vector<BallMatch> matchPixels(const ExemplarModel& model, const PixelLattice& pixels, int threads)
{
    const PixelLattice& lattice = model.lattice;
    const std::vector<glm::vec2> everywhere = texelsEverywhere(model.grid->size);
    std::vector<BallMatch> matches(pixels.pixelCount());
    parallelFor(matches.size(), kMatchedPerTask, threads, [&](size_t first, size_t last) {
        std::vector<BallMatch> candidates;
        for (size_t p = first; p < last; ++p) {
            const int x = static_cast<int>(pixels.places[p]) % pixels.width / model.lattice.spacing,
                      y = static_cast<int>(pixels.places[p]) / pixels.width / model.lattice.spacing;
            candidates.assign(1, {ballTexelOf({0, 0, 1}, model.grid->size), 1, 2, -1});
            for (const glm::ivec2& square : kSquares) {
                const int near = latticePixel(model, x + square.x, y + square.y);
                candidates.push_back(model.matches[near]);
                candidates.back().scale *= lattice.bright[near] / pixels.bright[p];
            }
            matches[p] = bestMatch(model.match, pixels, p, candidates, kFineSteps);
            if (matches[p].cost > kFarCost * model.typicalCost) {
                candidates.assign(1, matches[p]);
                for (const glm::vec2& texel : everywhere) {
                    candidates.push_back({texel, matches[p].scale, 2, -1});
                }
                const BallMatch far = bestMatch(model.match, pixels, p, candidates, kFineSteps);
                matches[p] = far.cost < matches[p].cost ? far : matches[p];
            }
        }
    });
    return matches;
}

} // namespace nacre
