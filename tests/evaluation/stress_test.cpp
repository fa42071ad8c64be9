#include "evaluation/stress/stress.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "engine/files/whole_file.h"
#include "evaluation/stress/light_layouts.h"
#include "evaluation/stress/stress_page.h"
#include "evaluation/stress/stress_tables.h"
#include "tests/support/expect_error.h"
#include "tests/support/temp_folder.h"

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
    row.error = mean;
    return row;
}

TEST(Stress, TheSubjectIsExactBeforeItIsDegraded)
{
    const StressSubject subject = syntheticSubject(smallOptions());
    const StressRow row = measureNormals(subject.clean, NormalMethod::consensus, {});
    // Lambert without noise: what float leaves.
    EXPECT_LT(row.error, 0.1);
    EXPECT_EQ(row.angles.pixels, subject.clean.seen.pixels.size());
    EXPECT_EQ(row.said, Said::nothing);
    EXPECT_GT(row.meanConfidence, 0.99);
    EXPECT_EQ(row.wrongShare, 0);
}

TEST(Stress, LightsInOnePlaneAreRefused)
{
    const StressSubject subject = syntheticSubject(smallOptions());
    const StressRow row = measureNormals(subject.relit(arcLights(16, 0)), NormalMethod::leastSquares, {});
    EXPECT_EQ(row.said, Said::refusal);
    EXPECT_EQ(row.angles.missing, row.angles.pixels);
    EXPECT_FALSE(isSilentFailure(row));
}

TEST(Stress, LightsThatAllErrAlikeAreOverconfidentFromTheStart)
{
    const StressSubject subject = syntheticSubject(smallOptions());
    PhotographedObject turned = subject.clean;
    const float c = std::cos(0.35f), s = std::sin(0.35f); // 20 degrees about y
    for (Light& light : turned.lights) {
        const glm::vec3 d = light.direction;
        light.direction = {c * d.x + s * d.z, d.y, c * d.z - s * d.x};
    }
    std::vector<StressRow> rows{measureNormals(turned, NormalMethod::leastSquares, {})};
    EXPECT_GT(rows.front().error, 10);
    judgeRows(rows, floorsOf(turned.lights));
    EXPECT_FALSE(rows.front().broken) << "nothing to be compared with";
    rows.front().said = Said::nothing;
    EXPECT_TRUE(isOverconfident(rows.front()));
}

TEST(Stress, LightsThatAreFewOrNearlyCoplanarAreWarnedOf)
{
    const StressSubject subject = syntheticSubject(smallOptions());
    const auto said = [&](const std::vector<Light>& lights) {
        return measureNormals(subject.relit(lights), NormalMethod::leastSquares, {}).said;
    };
    EXPECT_EQ(said(arcLights(16, 1)), Said::warning);
    EXPECT_EQ(said(arcLights(16, 10)), Said::nothing);
    EXPECT_EQ(said(spreadLights(6, 55)), Said::warning) << "three observations explain anything";
    EXPECT_EQ(said(spreadLights(7, 55)), Said::nothing);
    EXPECT_EQ(said(spreadLights(16, 12)), Said::warning) << "all lights close together";
}

TEST(Stress, SweepsAreNamedAndGrowWorse)
{
    const StressSubject subject = syntheticSubject(smallOptions());
    EXPECT_EQ(normalSweeps(subject, {}).size(), normalSweepNames().size());
    const std::vector<Sweep> sweeps = normalSweeps(subject, {"direction"});
    ASSERT_EQ(sweeps.size(), 1u);
    const std::vector<StressRow> rows =
        runSweeps(subject, sweeps, {NormalMethod::leastSquares}, {}, [](const std::string&, double) {});
    ASSERT_EQ(rows.size(), sweeps.front().settings.size());
    EXPECT_GT(rows.back().error, rows.front().error + 1);
    expectError([&] { normalSweeps(subject, {"magic"}); }, {"magic", "noise, quantisation"}, Error::kUsage);
    expectError([&] { normalSweeps(captureSubject(subject.clean, 1), {"layout"}); }, {"layout"}, Error::kUsage);
}

// The sweep's settings of these numbers.
std::vector<StressRow> rowsAt(const std::string& sweep, const std::vector<size_t>& settings, NormalMethod method)
{
    SynthOptions options = smallOptions();
    options.width = options.height = 40;
    const StressSubject subject = syntheticSubject(options);
    Sweep part = normalSweeps(subject, {sweep}).front();
    std::vector<Sweep::Setting> chosen;
    for (const size_t setting : settings) {
        chosen.push_back(part.settings.at(setting));
    }
    part.settings = chosen;
    return runSweeps(subject, {part}, {method}, {}, [](const std::string&, double) {});
}

TEST(StressSlow, PlacesThatAreToldMakeNearLightsHarmless)
{
    constexpr auto kMethod = NormalMethod::consensus;
    const std::vector<StressRow> told = rowsAt("distance-told", {0, 3}, kMethod),
                                 sought = rowsAt("distance-sought", {3}, kMethod);
    EXPECT_LT(told[0].error, 0.5);
    EXPECT_LT(told[1].error, 2);
    EXPECT_GT(sought[0].error, 2 * told[1].error);
    EXPECT_EQ(told[1].setting, "5");
    EXPECT_EQ(told[1].capture, "synthetic");
    EXPECT_GT(told[1].angles.pixels, 600u);
}

TEST(StressSlow, PlacesAtTwentyWidthsCount)
{
    const std::vector<StressRow> told = rowsAt("distance-told", {1}, NormalMethod::consensus);
    EXPECT_LT(told[0].error, 0.5);
    EXPECT_EQ(told[0].said, Said::nothing) << told[0].warnings;
}

TEST(StressSlow, MattObjectsThatReflectMoreAreSeenWorse)
{
    const std::vector<StressRow> rows = rowsAt("interreflection", {0, 4}, NormalMethod::consensus);
    EXPECT_LT(rows[0].error, 0.5);
    EXPECT_GT(rows[1].error, 2 * rows[0].error);
}

TEST(StressSlow, ALensThatIsToldIsKnownToTheChain)
{
    const std::vector<StressRow> told = rowsAt("lens-told", {2}, NormalMethod::consensus),
                                 untold = rowsAt("lens-untold", {2}, NormalMethod::consensus);
    EXPECT_NE(told[0].error, untold[0].error);
    EXPECT_LT(told[0].error, 1);
}

std::vector<StressRow> judged(std::vector<StressRow> rows)
{
    judgeRows(rows, {1, 5});
    return rows;
}

TEST(Stress, CurvesBreakWhereTheyDouble)
{
    EXPECT_EQ(breakingPoint(judged({rowOf("0", 2), rowOf("1", 3.9), rowOf("2", 4.0)})), 2u);
    EXPECT_FALSE(breakingPoint(judged({rowOf("0", 2), rowOf("1", 3.9)})).has_value());
    EXPECT_EQ(breakingPoint(judged({rowOf("0", 0.01), rowOf("1", 1.9), rowOf("2", 2)})), 2u) << "the floor is 1 degree";
    StressRow brdf = rowOf("1", 9.9), worse = rowOf("2", 10);
    StressRow mildest = rowOf("0", 1);
    mildest.isBrdf = brdf.isBrdf = worse.isBrdf = true;
    EXPECT_EQ(breakingPoint(judged({mildest, brdf, worse})), 2u) << "its floor is 5 %";
}

TEST(Stress, CountsTellSilentFromSaidAndAlarmsFromFailures)
{
    std::vector<StressRow> rows{rowOf("0", 2), rowOf("1", 2), rowOf("2", 9), rowOf("3", 9), rowOf("4", 9)};
    rows[0].said = rows[1].said = rows[3].said = Said::warning;
    rows[4].said = Said::refusal;
    const StressCounts counts = countsOf(judged(rows));
    EXPECT_EQ(counts.runs, 5u);
    EXPECT_EQ(counts.broken, 3u);
    EXPECT_EQ(counts.silent, 1u);
    EXPECT_EQ(counts.said, 2u);
    EXPECT_EQ(counts.falseAlarms, 2u);
    EXPECT_EQ(counts.mildestAlarms, 1u);
}

TEST(Stress, PlotsMarkSilentFailuresAndLeaveRefusalsOut)
{
    const TempFolder folder;
    std::vector<StressRow> rows{rowOf("0", 2), rowOf("1", 9), rowOf("2", 9.5)};
    rows[2].said = Said::refusal;
    rows = judged(rows);
    writeTextFile(folder / kStressTable, csvOf(rows));
    const std::vector<Plot> plots = stressPlotsOf(rows);
    ASSERT_EQ(plots.size(), 1u);
    ASSERT_EQ(drawPlots(folder.path(), plots), "");
    const std::string svg = readTextFile(folder / "s-normals.svg");
    EXPECT_NE(svg.find("rgb(208,   0,   0)"), std::string::npos) << svg;
    EXPECT_NE(stressPageOf(rows, "a remark", folder.path()).find("src=\"data:image/svg+xml"), std::string::npos);
    EXPECT_TRUE(stressPlotsOf({rows[2]}).empty());
}

TEST(Stress, ABrdfIsMeasuredBesideAutoAndSuffersFromItsNormals)
{
    SynthOptions options = smallOptions();
    options.lights = 8; // too few for `auto` to try its methods, which takes long
    const StressSubject subject = syntheticSubject(options);
    Sweep sweep = normalSweeps(subject, {"direction"}).front();
    sweep.settings = {sweep.settings.front(), sweep.settings.back()};
    const std::vector<StressRow> rows =
        runSweeps(subject, {sweep}, {NormalMethod::automatic}, {}, [](const std::string&, double) {});
    ASSERT_EQ(rows.size(), 6u);
    EXPECT_EQ(rows[1].method, "brdf-local-linear");
    EXPECT_EQ(rows[2].method, "brdf-paper");
    // Lambert is flat: what noiseless normals and a table of it leave.
    EXPECT_LT(rows[1].error, 1);
    EXPECT_GT(rows[4].error, 3 * rows[1].error);
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
        EXPECT_EQ(std::count(csv.begin() + at, csv.begin() + end, ','), 18);
        at = end + 1;
    }
    EXPECT_EQ(lines, 3u);
}

} // namespace
} // namespace nacre
