#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "acquisition/exemplar/exemplar_estimator.h"
#include "acquisition/exemplar/neighbour_search.h"
#include "acquisition/exemplar/reflectance_fit.h"
#include "engine/files/hash_random.h"
#include "engine/files/measures.h"
#include "tests/acquisition/shaded_scene.h"

namespace nacre {

namespace {

NormalBlock estimated(const ShadedScene& scene, const NormalOptions& options = {})
{
    std::vector<Finding> findings;
    return makeExemplarEstimator(scene.intensities, scene.lights, options, findings)(scene.intensities);
}

double meanError(const ShadedScene& scene, const NormalBlock& block)
{
    double sum = 0;
    for (size_t p = 0; p < scene.normals.size(); ++p) {
        sum += degreesBetween(block.pixels[p].normal, scene.normals[p]);
    }
    return sum / static_cast<double>(scene.normals.size());
}

double consensusError(const ShadedScene& scene)
{
    return meanError(scene, makeConsensusEstimator(scene.lights, {})(scene.intensities));
}

} // namespace

TEST(Exemplar, BallTexelsAndNormalsAreEachOther)
{
    for (const glm::vec3& n :
         {glm::vec3(0, 0, 1), glm::normalize(glm::vec3(1, 2, 3)), glm::normalize(glm::vec3(-3, 1, 0.1f))}) {
        const glm::vec3 back = normalOfBallTexel(ballTexelOf(n, 64), 64);
        EXPECT_LT(degreesBetween(n, back), 0.05);
    }
    // Equal areas: a step of a texel turns the normal as far at the rim as in the middle, to a factor of sqrt(2).
    const double middle = degreesBetween(normalOfBallTexel({31.5f, 31.5f}, 64), normalOfBallTexel({32.5f, 31.5f}, 64));
    const double rim = degreesBetween(normalOfBallTexel({62, 31.5f}, 64), normalOfBallTexel({63, 31.5f}, 64));
    EXPECT_NEAR(rim / middle, std::sqrt(2.0), 0.1);
}

TEST(Exemplar, FollowsADiffuseLawThatIsNotLamberts)
{
    const ShadedScene scene = photograph(
        48, 48, sphere, [](size_t, const glm::vec3& n, const glm::vec3& l) { return std::pow(glm::dot(n, l), 0.3f); });
    // What is left is where n.l and the slant of the normal are told apart by few lights.
    EXPECT_GT(consensusError(scene), 3);
    EXPECT_LT(meanError(scene, estimated(scene)), 1.5);
}

// Paint of two albedos, six times apart, under one coat of varnish: albedo must not scale its gloss.
TEST(Exemplar, GlossNeedNotFollowTheAlbedo)
{
    const ShadedScene scene = photograph(64, 64, sphere, [](size_t p, const glm::vec3& n, const glm::vec3& l) {
        return (p / 7 % 2 == 0 ? 0.1f : 0.6f) + 1.5f * gloss(n, l, 0.25f);
    });
    EXPECT_GT(consensusError(scene), 2);
    EXPECT_LT(meanError(scene, estimated(scene)), 1);
}

// One albedo for all pixels is kept where there is no paint, and a third more of it on every other stripe is seen. Two
// percent of noise hide what the bins of the reflectance cannot follow.
TEST(ExemplarSlow, PixelsShareAnAlbedoWhereThereIsNoPaint)
{
    for (const float paint : {0.0f, 0.3f}) {
        ShadedScene scene = photograph(48, 48, sphere, [&](size_t p, const glm::vec3& n, const glm::vec3& l) {
            return (p / 5 % 2 == 0 ? 1.0f : 1.0f + paint) * (0.05f + gloss(n, l, 0.4f));
        });
        uint64_t random = 1;
        for (float& value : scene.intensities.values) {
            value *= 0.98f + 0.04f * static_cast<float>(static_cast<double>(nextRandom(random) >> 11) * 0x1p-53);
        }
        std::vector<Finding> findings;
        const ExemplarModel model = makeExemplarModel(scene.intensities, scene.lights, {}, nullptr, findings);
        EXPECT_EQ(model.match.reflectance.oneAlbedo.has_value(), paint == 0);
        const NormalBlock block =
            makeExemplarEstimator(scene.intensities, scene.lights, {}, findings)(scene.intensities);
        EXPECT_LT(meanError(scene, block), 1);
        EXPECT_EQ(block.pixels[100].albedo == block.pixels[1000].albedo, paint == 0);
    }
}

// What the same reflectance finds for every pixel alone, by trying the whole ball.
std::vector<BallMatch> matchesAlone(const ExemplarModel& model, const PixelLattice& pixels)
{
    std::vector<BallMatch> matches(pixels.pixelCount());
    for (size_t p = 0; p < matches.size(); ++p) {
        for (size_t row = 0; row < model.grid->normals.size(); ++row) {
            const BallMatch match = matchAtRow(model.match, pixels, p, static_cast<int>(row), 1);
            matches[p] = match.cost < matches[p].cost ? match : matches[p];
        }
        matches[p].texel = ballTexelOf(model.grid->normals[matches[p].row], model.grid->size);
        matches[p] = polishedMatch(model.match, pixels, p, matches[p]);
    }
    return matches;
}

double meanMatchError(const ShadedScene& scene, const std::vector<BallMatch>& matches,
                      const std::function<bool(int x)>& counts)
{
    double sum = 0, count = 0;
    for (size_t p = 0; p < matches.size(); ++p) {
        if (counts(static_cast<int>(scene.intensities.places[p]) % scene.intensities.width)) {
            sum += degreesBetween(normalOfBallTexel(matches[p].texel, kBallSize), scene.normals[p]);
            ++count;
        }
    }
    return sum / count;
}

void expectNothingLost(const ShadedScene& scene, const std::function<bool(int x)>& counts)
{
    std::vector<Finding> findings;
    const ExemplarModel model = makeExemplarModel(scene.intensities, scene.lights, {}, nullptr, findings);
    const PixelLattice pixels = makePixelLattice(scene.intensities, 0);
    const double alone = meanMatchError(scene, matchesAlone(model, pixels), counts),
                 together = meanMatchError(scene, matchPixels(model, pixels, 0), counts);
    EXPECT_LT(together, 1.03 * alone + 0.1); // 0.1: polishing from two texels ends so far apart
}

// Neighbours propose and do not pull: at a crease of 90 degrees, and on bumps of a pixel's height and a period of 4 to
// 8 pixels, nothing is lost against every pixel by itself.
TEST(ExemplarSlow, SmoothsNeitherEdgesNorTexture)
{
    const auto shading = [](size_t, const glm::vec3& n, const glm::vec3& l) { return 0.5f + gloss(n, l, 0.3f); };
    constexpr int kSide = 48;
    const ShadedScene roof = photograph(
        kSide, kSide,
        [](float x, float y) {
            const float slope = 1.0f + 0.4f * (std::abs(x) - 0.5f); // 45 degrees where the two sides meet, on the whole
            return glm::normalize(glm::vec3(x < 0 ? -slope : slope, 0.5f * y, 1));
        },
        shading);
    expectNothingLost(roof, [](int x) { return x == kSide / 2 - 1 || x == kSide / 2; });
    for (const float period : {4.0f, 6.0f, 8.0f}) {
        const float turn = 2 * 3.14159265f / period, steepest = turn / 2; // of a sine one pixel from top to bottom
        const ShadedScene bumps = photograph(
            kSide, kSide,
            [&](float x, float y) {
                return glm::normalize(
                    glm::vec3(steepest * std::sin(turn * x * kSide / 2), steepest * std::cos(turn * y * kSide / 2), 1));
            },
            shading);
        expectNothingLost(bumps, [](int) { return true; });
    }
}

TEST(Exemplar, PixelsThatNobodyPlacedAreEstimatedToo)
{
    ShadedScene scene = photograph(
        48, 48, sphere, [](size_t, const glm::vec3& n, const glm::vec3& l) { return 0.4f + gloss(n, l, 0.3f); });
    scene.intensities.width = 0;
    scene.intensities.places.clear();
    EXPECT_LT(meanError(scene, estimated(scene)), 1);
}

// What a block of rows is estimated to be depends on the others through the reflectance and the start alone.
TEST(Exemplar, BlocksOfRowsGiveWhatTheWholeGives)
{
    const ShadedScene scene = photograph(
        96, 96, sphere, [](size_t, const glm::vec3& n, const glm::vec3& l) { return 0.4f + gloss(n, l, 0.3f); });
    std::vector<Finding> findings;
    const NormalEstimator estimator = makeExemplarEstimator(scene.intensities, scene.lights, {}, findings);
    const NormalBlock whole = estimator(scene.intensities);
    std::vector<size_t> upper;
    for (size_t p = 0; p < scene.normals.size() / 2; ++p) {
        upper.push_back(p);
    }
    const NormalBlock part = estimator(selectPixels(scene.intensities, upper));
    double sum = 0;
    for (const size_t p : upper) {
        sum += degreesBetween(part.pixels[p].normal, whole.pixels[p].normal);
    }
    EXPECT_LT(sum / static_cast<double>(upper.size()), 0.02);
}

TEST(Exemplar, FitRecoversTheReflectanceThatItWasMadeOf)
{
    const ShadedScene scene = photograph(
        64, 64, sphere, [](size_t, const glm::vec3& n, const glm::vec3& l) { return 0.5f + 0.5f * gloss(n, l, 0.3f); });
    const BallGrid grid = makeBallGrid(64, scene.lights, 1);
    const PixelLattice lattice = makePixelLattice(scene.intensities, 1);
    MatchModel model;
    model.ball = makeReflectanceBall(grid, model.reflectance, 1);
    std::vector<BallMatch> matches;
    for (size_t p = 0; p < lattice.pixelCount(); ++p) {
        matches.push_back(matchAtTexel(model, lattice, p, ballTexelOf(scene.normals[p], 64), 1));
    }
    for (int round = 0; round < 3; ++round) {
        fitReflectance(lattice, true, 1, model, matches);
        model.ball = makeReflectanceBall(grid, model.reflectance, 1);
        for (size_t p = 0; p < lattice.pixelCount(); ++p) {
            matches[p] = matchAtTexel(model, lattice, p, matches[p].texel, matches[p].scale);
        }
    }
    EXPECT_LT(meanCost(matches), 0.05);
    std::vector<float> predicted(scene.lights.size());
    double worst = 0;
    for (size_t p = 0; p < lattice.pixelCount(); ++p) {
        if (scene.normals[p].z < 0.5f) {
            continue;
        }
        predictMatch(model, matches[p], lattice.bright[p], predicted.data());
        for (size_t i = 0; i < predicted.size(); ++i) {
            worst = std::max<double>(worst, std::abs(predicted[i] - scene.intensities.ofPixel(p)[i]));
        }
    }
    EXPECT_LT(worst, 0.06); // of 1: bins of thetaH are a few degrees wide
}

} // namespace nacre
