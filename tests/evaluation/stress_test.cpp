#include "evaluation/stress.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "evaluation/light_layouts.h"
#include "evaluation/stress_tables.h"
#include "tests/support/expect_error.h"

namespace nacre {
namespace {

SynthOptions smallOptions()
{
    SynthOptions options;
    options.width = options.height = 20;
    options.lights = 16;
    options.material = "lambert:0.5";
    options.shadows = false;
    options.noise = 0;
    return options;
}

StressRow rowOf(const std::string& setting, double mean)
{
    StressRow row;
    row.capture = "c";
    row.sweep = "s";
    row.method = "m";
    row.setting = setting;
    row.error.mean = mean;
    return row;
}

TEST(Stress, TheSubjectIsExactBeforeItIsDegraded)
{
    const StressSubject subject = syntheticSubject(smallOptions());
    const StressRow row = measureNormals(subject.clean, NormalMethod::consensus, {});
    // Lambert without noise: what float leaves.
    EXPECT_LT(row.error.mean, 0.1);
    EXPECT_EQ(row.error.pixels, subject.clean.seen.pixels.size());
    EXPECT_EQ(row.said, Said::nothing);
    EXPECT_GT(row.meanConfidence, 0.99);
    EXPECT_EQ(row.silentShare, 0);
}

TEST(Stress, LightsInOnePlaneAreRefused)
{
    const StressSubject subject = syntheticSubject(smallOptions());
    const StressRow row = measureNormals(subject.relit(arcLights(16, 0)), NormalMethod::leastSquares, {});
    EXPECT_EQ(row.said, Said::refusal);
    EXPECT_EQ(row.error.missing, row.error.pixels);
    EXPECT_FALSE(isSilentFailure(row));
}

TEST(Stress, LightsThatAllErrAlikeAreASilentFailure)
{
    const StressSubject subject = syntheticSubject(smallOptions());
    PhotographedObject turned = subject.clean;
    const float c = std::cos(0.35f), s = std::sin(0.35f); // 20 degrees about y
    for (Light& light : turned.lights) {
        const glm::vec3 d = light.direction;
        light.direction = {c * d.x + s * d.z, d.y, c * d.z - s * d.x};
    }
    const StressRow row = measureNormals(turned, NormalMethod::leastSquares, {});
    EXPECT_GT(row.error.mean, 10);
    EXPECT_TRUE(isSilentFailure(row)) << "the photographs agree with each other: nobody can know";
}

TEST(Stress, LightsThatAreFewOrNearlyCoplanarAreWarnedOf)
{
    const StressSubject subject = syntheticSubject(smallOptions());
    const auto said = [&](const std::vector<Light>& lights) {
        return measureNormals(subject.relit(lights), NormalMethod::leastSquares, {}).said;
    };
    EXPECT_EQ(said(arcLights(16, 1)), Said::warning);
    EXPECT_EQ(said(arcLights(16, 10)), Said::nothing);
    EXPECT_EQ(said(spreadLights(4, 55)), Said::warning) << "three observations explain anything";
    EXPECT_EQ(said(spreadLights(5, 55)), Said::nothing);
}

TEST(Stress, SweepsAreNamedAndGrowWorse)
{
    const StressSubject subject = syntheticSubject(smallOptions());
    EXPECT_EQ(normalSweeps(subject, {}).size(), normalSweepNames().size());
    const std::vector<Sweep> sweeps = normalSweeps(subject, {"direction"});
    ASSERT_EQ(sweeps.size(), 1u);
    const std::vector<StressRow> rows =
        runSweeps("synthetic", sweeps, {NormalMethod::leastSquares}, {}, [](const std::string&, double) {});
    ASSERT_EQ(rows.size(), sweeps.front().settings.size());
    EXPECT_GT(rows.back().error.mean, rows.front().error.mean + 1);
    expectError([&] { normalSweeps(subject, {"magic"}); }, {"magic", "noise, quantisation"}, Error::kUsage);
    expectError([&] { normalSweeps(captureSubject(subject.clean, 1), {"layout"}); }, {"layout"}, Error::kUsage);
}

TEST(Stress, CurvesBreakWhereTheyDoubleOrPassFiveDegrees)
{
    EXPECT_EQ(breakingPoint({rowOf("0", 1), rowOf("1", 1.9), rowOf("2", 2.0)}), 2u);
    EXPECT_EQ(breakingPoint({rowOf("0", 4), rowOf("1", 5.1), rowOf("2", 9)}), 1u);
    EXPECT_EQ(breakingPoint({rowOf("0", 6), rowOf("1", 7), rowOf("2", 12)}), 2u) << "it was bad from the start";
    EXPECT_FALSE(breakingPoint({rowOf("0", 1), rowOf("1", 1.5)}).has_value());
}

TEST(Stress, TheCsvQuotesNamesThatWouldBreakItsLines)
{
    StressRow row = rowOf("0", 1);
    row.capture = "a, \"b\"";
    EXPECT_NE(csvOf({row}).find("\n\"a, \"\"b\"\"\",s,0,"), std::string::npos) << csvOf({row});
}

TEST(Stress, TheCsvHasAsManyFieldsInEveryLine)
{
    const std::string csv = csvOf({rowOf("0", 1), rowOf("1", 2)});
    size_t lines = 0;
    for (size_t at = 0; at < csv.size(); ++lines) {
        const size_t end = csv.find('\n', at);
        ASSERT_NE(end, std::string::npos);
        EXPECT_EQ(std::count(csv.begin() + at, csv.begin() + end, ','), 13);
        at = end + 1;
    }
    EXPECT_EQ(lines, 3u);
}

} // namespace
} // namespace nacre
