#include <cmath>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "acquisition/brdf/shared_basis.h"
#include "acquisition/brdf/shared_ladder.h"
#include "engine/brdf/brdf_tabulation.h"

namespace nacre {
namespace {

constexpr TableDomain kDomain{kHalfDifference, 0.44f};
constexpr glm::ivec3 kSize{40, 12, 10};

BrdfTable tabulated(const BrdfModel& model)
{
    return tabulatedBrdf(model, kSize, kDomain, 1);
}

// The same gloss on paints of other colours: three channels each, of two functions in all.
std::vector<BrdfTable> glossyPaints()
{
    std::vector<BrdfTable> tables;
    for (const glm::vec3& colour :
         {glm::vec3(0.5f, 0.2f, 0.1f), glm::vec3(0.05f, 0.3f, 0.2f), glm::vec3(0.02f, 0.02f, 0.6f)}) {
        tables.push_back(tabulated(LambertGgx{colour, glm::vec3(0.05f), 0.2f}));
    }
    return tables;
}

std::vector<BasisMember> membersOf(const std::vector<BrdfTable>& tables)
{
    std::vector<BasisMember> members;
    for (const BrdfTable& table : tables) {
        members.push_back({&table, 0.5});
    }
    return members;
}

double relativeError(const BasisBrdf& model, const BrdfTable& truth)
{
    const BrdfTable table = expandedTable(model, truth);
    double error = 0, size = 0;
    for (size_t texel = 0; texel < truth.values.size(); ++texel) {
        const glm::vec3 miss = table.values[texel] - truth.values[texel];
        error += glm::dot(miss, miss);
        size += glm::dot(truth.values[texel], truth.values[texel]);
    }
    return std::sqrt(error / size);
}

TEST(SharedBasis, FindsTheFewFunctionsThatMaterialsAreMadeOf)
{
    const std::vector<BrdfTable> tables = glossyPaints();
    const std::vector<BasisBrdf> models = fitBasis(membersOf(tables), 9);
    // Lambert's part is not quite one function of GGX's tables' rounding; the rest is below 16-bit floats.
    EXPECT_LE(models.front().basis->rank, 4);
    const std::vector<BasisBrdf> two = truncated(models, 2);
    EXPECT_EQ(two.front().basis->rank, 2);
    for (size_t m = 0; m < tables.size(); ++m) {
        EXPECT_EQ(two[m].basis, two.front().basis);
        EXPECT_LT(relativeError(two[m], tables[m]), 1e-3); // 11 bits
        EXPECT_GT(relativeError(truncated(models, 1)[m], tables[m]), 0.01);
    }
}

TEST(SharedBasis, CountsErrorsAgainstAMaterialsOwnPeak)
{
    // A dark material beside a bright one is served as well once its peak is given.
    std::vector<BrdfTable> tables{tabulated(LambertGgx{glm::vec3(0.8f), glm::vec3(0.05f), 0.4f}),
                                  tabulated(LambertGgx{glm::vec3(0.001f), glm::vec3(0.0005f), 0.15f})};
    const std::vector<BasisMember> fair{{&tables[0], 0.3}, {&tables[1], 0.001}},
        unfair{{&tables[0], 0.3}, {&tables[1], 0.3}};
    EXPECT_LT(relativeError(fitBasis(fair, 1)[1], tables[1]), relativeError(fitBasis(unfair, 1)[1], tables[1]));
}

TEST(SharedBasis, HardlyMindsWhatWasNotMeasured)
{
    std::vector<BrdfTable> tables = glossyPaints();
    for (size_t texel = 0; texel < tables[0].values.size(); texel += 7) {
        for (BrdfTable& table : tables) {
            table.values[texel] = glm::vec3(static_cast<float>(texel % 13));
            table.confidence[texel] = 0;
        }
    }
    const std::vector<BasisBrdf> models = fitBasis(membersOf(tables), 3);
    const BrdfTable truth = glossyPaints()[0], table = expandedTable(models[0], tables[0]);
    for (size_t texel = 0; texel < truth.values.size(); ++texel) {
        if (texel % 7 != 0) {
            EXPECT_LT(glm::length(table.values[texel] - truth.values[texel]), 0.02f * glm::length(truth.values[texel]));
        }
    }
}

TEST(SharedBasis, BlackStaysBlack)
{
    const std::vector<BrdfTable> tables{tabulated(LambertGgx{glm::vec3(0), glm::vec3(0), 0.4f}), glossyPaints()[0]};
    for (const glm::vec3& f : expandedTable(fitBasis(membersOf(tables), 2)[0], tables[0]).values) {
        EXPECT_EQ(f, glm::vec3(0));
    }
    const std::vector<BrdfTable> black{tables[0]};
    EXPECT_EQ(expandedTable(fitBasis(membersOf(black), 1)[0], tables[0]).values.front(), glm::vec3(0));
}

class SharedLadderTest : public testing::Test {
protected:
    void add(const BrdfModel& model)
    {
        tables_.push_back(tabulatedBrdf(model, {60, 16, 16}, kDomain, 1));
        models_.push_back(model);
    }
    SharedLadder climb(const LadderOptions& options, size_t bytesApart, double leastApart = 45)
    {
        std::vector<ModelJudge> judges;
        for (size_t i = 0; i < tables_.size(); ++i) {
            judges.emplace_back(
                [&](const glm::vec3& unit) {
                    const LightView d = directionsFromUnit(kDomain, unit);
                    return InterpolatedValue{evaluate(models_[i], {0, 0, 1}, d.l, d.v), 0};
                },
                tables_[i], 1);
        }
        return climbSharedLadder(judges, {"apart", bytesApart, leastApart}, options);
    }
    std::vector<BrdfTable> tables_;
    std::vector<BrdfModel> models_;
};

TEST_F(SharedLadderTest, SharesWhereThatIsSmaller)
{
    for (int i = 0; i < 6; ++i) {
        add(LambertGgx{{0.1f * i, 0.4f, 0.5f - 0.08f * i}, glm::vec3(0.05f), 0.2f});
    }
    const LadderOptions options{.toleranceDecibels = 45, .threads = 1};
    const SharedLadder ladder = climb(options, 6 * 8000);
    ASSERT_TRUE(ladder.taken);
    const SharedStep& taken = ladder.steps[*ladder.taken];
    EXPECT_LT(taken.bytes, 6u * 8000);
    EXPECT_GE(taken.leastPsnr, 45);
    ASSERT_EQ(ladder.models.size(), 6u);
    EXPECT_EQ(taken.bytes, bytesOf(*ladder.models[0].basis) + 6 * sizeof(float) * ladder.models[0].coefficients.size());
    EXPECT_FALSE(climb(options, taken.bytes - 1).taken); // better off apart
}

TEST_F(SharedLadderTest, ServesTheWorstAsWellAsABudgetAllows)
{
    add(LambertGgx{glm::vec3(0.4f), glm::vec3(0.05f), 0.2f});
    add(LambertGgx{{0.1f, 0.2f, 0.3f}, glm::vec3(0.3f), 0.1f});
    const SharedLadder ladder = climb({.budgetBytes = 4000, .threads = 1}, 2 * 4000, 20);
    ASSERT_TRUE(ladder.taken);
    for (const SharedStep& step : ladder.steps) {
        EXPECT_LE(step.bytes, 8000u);
        EXPECT_LE(step.leastPsnr, ladder.steps[*ladder.taken].leastPsnr);
    }
    EXPECT_FALSE(climb({.budgetBytes = 4000, .threads = 1}, 2 * 4000, 100).taken);
}

TEST_F(SharedLadderTest, SaysNothingWhereThereIsNothingToShare)
{
    add(LambertGgx{});
    EXPECT_TRUE(climb({.toleranceDecibels = 45, .threads = 1}, 1 << 20).steps.empty());
    add(LambertGgx{});
    std::fill(tables_[1].confidence.begin(), tables_[1].confidence.end(), 0.0f);
    EXPECT_TRUE(climb({.toleranceDecibels = 45, .threads = 1}, 1 << 20).steps.empty());
}

} // namespace
} // namespace nacre
