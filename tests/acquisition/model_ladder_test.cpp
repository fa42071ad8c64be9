#include <cmath>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "acquisition/brdf/model_ladder.h"
#include "engine/brdf/brdf_tabulation.h"

namespace nacre {
namespace {

constexpr TableDomain kDomain{kHalfDifference, 0.44f};

BrdfTable fullTableOf(const BrdfModel& model)
{
    BrdfTable table = tabulatedBrdf(model, {90, 26, 45}, kDomain, 1);
    return table;
}

BrdfInterpolant truthOf(const BrdfModel& model)
{
    return [model](const glm::vec3& unit) {
        const LightView d = directionsFromUnit(kDomain, unit);
        return InterpolatedValue{evaluate(model, {0, 0, 1}, d.l, d.v), 0};
    };
}

ModelLadder ladderOf(const BrdfModel& model, const LadderOptions& options)
{
    const BrdfTable full = fullTableOf(model);
    return climbLadder({truthOf(model), full, 1}, options);
}

const BrdfModel kLambert = LambertGgx{{0.5f, 0.3f, 0.2f}, glm::vec3(0), 0.5f};
const BrdfModel kRoughPlastic = LambertGgx{{0.4f, 0.3f, 0.2f}, glm::vec3(0.05f), 0.3f};
const BrdfModel kMirrorLike = LambertGgx{glm::vec3(0.02f), {0.6f, 0.5f, 0.4f}, 0.03f};

TEST(ModelLadder, TakesTheSmallestThatIsGoodEnough)
{
    // One lobe explains GGX's highlight to 45 dB, but not to 55.
    const LadderOptions options{.toleranceDecibels = 45, .threads = 1}, strict{.toleranceDecibels = 55, .threads = 1};
    const ModelLadder lambert = ladderOf(kLambert, options), plastic = ladderOf(kRoughPlastic, options),
                      mirror = ladderOf(kMirrorLike, strict);
    ASSERT_TRUE(lambert.taken && plastic.taken && mirror.taken);
    EXPECT_EQ(lambert.steps[*lambert.taken].description, "Lambert");
    EXPECT_LT(plastic.steps[*plastic.taken].bytes, 100u << 10);
    EXPECT_GT(mirror.steps[*mirror.taken].bytes, plastic.steps[*plastic.taken].bytes);
    for (const auto& [ladder, tolerance] : {std::pair(&lambert, 45), std::pair(&plastic, 45), std::pair(&mirror, 55)}) {
        for (size_t i = 0; i < ladder->steps.size(); ++i) {
            EXPECT_TRUE(i == 0 || ladder->steps[i - 1].bytes <= ladder->steps[i].bytes);
            EXPECT_TRUE(i >= *ladder->taken || ladder->steps[i].psnr < tolerance) << ladder->steps[i].description;
        }
        EXPECT_GE(ladder->steps[*ladder->taken].psnr, tolerance);
    }
}

TEST(ModelLadder, TakesTheBestWithinABudget)
{
    const ModelLadder ladder = ladderOf(kMirrorLike, {.budgetBytes = 8192, .threads = 1});
    ASSERT_TRUE(ladder.taken);
    for (const LadderStep& step : ladder.steps) {
        EXPECT_TRUE(step.bytes > 8192 || step.psnr <= ladder.steps[*ladder.taken].psnr) << step.description;
    }
    EXPECT_FALSE(ladderOf(kMirrorLike, {.budgetBytes = 4, .threads = 1}).taken);
    EXPECT_FALSE(ladderOf(kMirrorLike, {.toleranceDecibels = 150, .threads = 1}).taken);
}

TEST(ModelLadder, SaysNothingWhereNothingIsCovered)
{
    BrdfTable table = fullTableOf(kLambert);
    std::fill(table.confidence.begin(), table.confidence.end(), 0.0f);
    const ModelLadder ladder = climbLadder({truthOf(kLambert), table, 1}, {.toleranceDecibels = 45, .threads = 1});
    EXPECT_TRUE(ladder.steps.empty());
    EXPECT_FALSE(ladder.taken);
}

TEST(LobeFitSlow, FindsTheLobeThatMadeTheData)
{
    AbcModel truth;
    truth.kD = {0.4f, 0.3f, 0.1f};
    truth.A = {5, 4, 3};
    truth.B = 300;
    truth.C = 1.2f;
    truth.ior = 1.5f; // as the fit assumes
    std::vector<BrdfMeasurement> measurements;
    for (int i = 0; i < 800; ++i) {
        const float thetaH = 0.001f * i, thetaD = 0.3f * ((i * 7) % 11) / 10.0f;
        const LightView d = directionsFromHalfDifference({thetaH, thetaD, 0.4f});
        measurements.push_back({{0, 0, 1}, d.l, d.v, evaluate(truth, {0, 0, 1}, d.l, d.v), d.l.z});
    }
    const AbcModel found = fitLobe(measurements);
    // B and C trade against each other: what counts is the shape.
    for (const BrdfMeasurement& m : measurements) {
        const glm::vec3 f = evaluate(found, m.n, m.l, m.v);
        EXPECT_LT(glm::length(f - m.f), 0.02f * glm::length(m.f) + 0.005f);
    }
    EXPECT_EQ(fitLambert(measurements).A, glm::vec3(0));
    EXPECT_GT(fitLambert(measurements).kD.x, truth.kD.x);
}

} // namespace
} // namespace nacre
