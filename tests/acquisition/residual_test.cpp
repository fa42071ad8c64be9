#include <cmath>

#include <Eigen/Dense>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "acquisition/normals/light_triples.h"
#include "acquisition/residual/left_out.h"
#include "acquisition/residual/light_interpolation.h"
#include "acquisition/residual/residual_choice.h"
#include "acquisition/residual/residual_estimate.h"
#include "acquisition/residual/residual_rows.h"
#include "engine/lights/light_covariance.h"
#include "engine/scene/reference.h"
#include "engine/surface/residual_layer.h"
#include "tests/support/expect_error.h"
#include "tests/support/residual_surface.h"

namespace nacre {
namespace {

std::vector<glm::vec2> spiral(int count)
{
    std::vector<glm::vec2> nodes;
    for (int i = 0; i < count; ++i) {
        const float r = 0.8f * std::sqrt((static_cast<float>(i) + 0.5f) / static_cast<float>(count));
        nodes.push_back(r * glm::vec2(std::cos(2.4f * static_cast<float>(i)), std::sin(2.4f * static_cast<float>(i))));
    }
    return nodes;
}

std::vector<glm::vec3> directionsOf(const std::vector<glm::vec2>& points)
{
    std::vector<glm::vec3> directions;
    for (const glm::vec2& point : points) {
        directions.emplace_back(point, std::sqrt(1 - glm::dot(point, point)));
    }
    return directions;
}

// What some values under lights say of another.
double interpolated(const std::vector<glm::vec3>& nodes, const Eigen::VectorXd& values, const glm::vec3& asked)
{
    const Eigen::VectorXd factors = interpolationFactors(nodes) * values;
    double sum = 0;
    for (size_t i = 0; i < nodes.size(); ++i) {
        sum += factors(static_cast<Eigen::Index>(i)) * lightCovariance(asked, nodes[i]);
    }
    return sum;
}

TEST(LightInterpolation, KnowsLambertianShading)
{
    const std::vector<glm::vec3> nodes = directionsOf(spiral(12));
    const glm::vec3 normal = glm::normalize(glm::vec3(0.2f, -0.3f, 1)), between = glm::normalize(glm::vec3(1, 1, 3));
    Eigen::VectorXd values(12);
    for (int i = 0; i < 12; ++i) {
        values(i) = glm::dot(normal, nodes[i]);
    }
    // Kriging's shrinkage: the kernel that forgets explains a part of what the product would continue.
    EXPECT_NEAR(interpolated(nodes, values, between), glm::dot(normal, between), 0.01);
}

TEST(LightInterpolation, GoesThroughItsNodes)
{
    const std::vector<glm::vec3> nodes = directionsOf(spiral(20));
    Eigen::VectorXd values(20);
    for (int i = 0; i < 20; ++i) {
        values(i) = std::sin(3.0 * i);
    }
    for (int i = 0; i < 20; ++i) {
        EXPECT_NEAR(interpolated(nodes, values, nodes[i]), values(i), 0.02) << i; // the noise that it allows for
    }
}

TEST(LightInterpolation, AveragesEqualLights)
{
    std::vector<glm::vec3> nodes = directionsOf(spiral(6));
    nodes.push_back(nodes.back());
    Eigen::VectorXd values = Eigen::VectorXd::Constant(7, 0.5);
    values.tail<2>() << 0, 1;
    EXPECT_NEAR(interpolated(nodes, values, nodes.back()), 0.5, 0.01);
}

// The closed form is the same as interpolating the others from scratch.
TEST(LightInterpolation, LeavingOneOutIsTakingTheOthers)
{
    const std::vector<glm::vec3> nodes = directionsOf(spiral(14));
    const Eigen::MatrixXd weights = leaveOneOutWeights(nodes);
    Eigen::VectorXd values(14);
    for (int i = 0; i < 14; ++i) {
        values(i) = std::cos(2.0 * i);
    }
    for (int left = 0; left < 14; ++left) {
        std::vector<glm::vec3> others = nodes;
        others.erase(others.begin() + left);
        Eigen::VectorXd rest(13);
        rest << values.head(left), values.tail(13 - left);
        EXPECT_NEAR(weights.row(left).dot(values), interpolated(others, rest, nodes[left]), 1e-6) << left;
        EXPECT_EQ(weights(left, left), 0);
    }
}

TEST(PrincipalComponents, AreTheRightSingularVectors)
{
    Eigen::MatrixXf rows(200, 30);
    for (Eigen::Index i = 0; i < rows.size(); ++i) {
        rows(i) =
            static_cast<float>(std::sin(0.37 * static_cast<double>(i)) * std::exp(-0.1 * static_cast<double>(i / 200)));
    }
    const Eigen::MatrixXf found = principalComponents(rows, 5);
    const Eigen::JacobiSVD<Eigen::MatrixXf> svd(rows, Eigen::ComputeThinV);
    EXPECT_NEAR((found.transpose() * found - Eigen::MatrixXf::Identity(5, 5)).norm(), 0, 1e-4);
    // No five columns hold more energy.
    const float best = (rows * svd.matrixV().leftCols(5)).squaredNorm();
    EXPECT_NEAR((rows * found).squaredNorm(), best, 1e-3f * best);
}

std::vector<Light> lightsOf(const std::vector<glm::vec2>& nodes)
{
    std::vector<Light> lights;
    for (const glm::vec3& direction : directionsOf(nodes)) {
        lights.push_back({direction, {1, 1, 1}});
    }
    return lights;
}

// Observations that a BRDF explains but for a part that is smooth over lights, `amount` strong.
ResidualRows rowsOf(const std::vector<Light>& lights, float amount)
{
    ResidualRows rows;
    const auto n = static_cast<Eigen::Index>(lights.size());
    rows.observed.resize(300, n);
    rows.predicted.resize(300, n);
    for (Eigen::Index row = 0; row < 300; ++row) {
        for (Eigen::Index i = 0; i < n; ++i) {
            const glm::vec3& l = lights[i].direction;
            // A highlight that is too sharp for splines between so few lights.
            const float predicted =
                0.3f * l.z + 0.4f * std::exp(-40 * std::pow(l.x - 0.001f * static_cast<float>(row), 2.0f));
            rows.predicted(row, i) = predicted;
            rows.observed(row, i) =
                predicted + amount * (l.x * l.y + 0.3f * std::sin(static_cast<float>(row / 3)) * l.y);
        }
    }
    return rows;
}

// A BRDF that predicts the same whether it has seen a light or not.
UnseenRows seenOrNot(const ResidualRows& rows)
{
    UnseenRows unseen{{{}}, {rows.predicted}};
    for (Eigen::Index light = 0; light < rows.predicted.cols(); ++light) {
        unseen.folds[0].push_back(static_cast<size_t>(light));
    }
    return unseen;
}

ResidualFit fitOf(const ResidualRows& rows, const std::vector<Light>& lights, ResidualChoice choice)
{
    return chooseResidualFit(rows, seenOrNot(rows), directionsOf(lights), ResidualJudge(rows, lights, 1), choice);
}

TEST(ResidualChoice, KeepsNothingWhereTheBrdfIsRight)
{
    const std::vector<Light> lights = lightsOf(spiral(24));
    EXPECT_FALSE(fitOf(rowsOf(lights, 0), lights, ResidualChoice::automatic).isKept);
}

TEST(ResidualChoice, KeepsWhatIsSmoothOverLights)
{
    const std::vector<Light> lights = lightsOf(spiral(24));
    const ResidualFit fit = fitOf(rowsOf(lights, 0.3f), lights, ResidualChoice::automatic);
    EXPECT_TRUE(fit.isKept);
    EXPECT_EQ(fit.trust, 1); // the highlight is the BRDF's
    EXPECT_GT(fit.layerPsnr, fit.brdfPsnr + 6);
}

TEST(ResidualChoice, IsMadeWhereItIsInsistedOn)
{
    const std::vector<Light> lights = lightsOf(spiral(24));
    EXPECT_TRUE(fitOf(rowsOf(lights, 0), lights, ResidualChoice::difference).isKept);
}

// Shading without highlights is guessed as well between lights as by the BRDF.
TEST(ResidualChoice, TrustsHalfWhereLightsCannotTell)
{
    const std::vector<Light> lights = lightsOf(spiral(12));
    ResidualRows rows = rowsOf(lights, 0);
    for (Eigen::Index i = 0; i < rows.observed.cols(); ++i) {
        rows.predicted.col(i).setConstant(0.5f * lights[i].direction.z);
    }
    rows.observed = rows.predicted;
    rows.observed.col(3).array() += 0.3f;
    EXPECT_EQ(fitOf(rows, lights, ResidualChoice::difference).trust, 0.5f);
}

// The BRDF that has seen every light is right, those that have not are wrong everywhere: what is judged are those, and
// where they explain nothing the layer is the interpolation alone.
TEST(ResidualChoice, BelievesTheBrdfThatHasNotSeenTheLight)
{
    const std::vector<Light> lights = lightsOf(spiral(12));
    ResidualRows rows = rowsOf(lights, 0.3f);
    for (Eigen::Index i = 0; i < rows.observed.cols(); ++i) {
        const glm::vec3& l = lights[i].direction;
        rows.observed.col(i).setConstant(0.4f + 0.3f * l.x - 0.2f * l.y);
    }
    rows.predicted = rows.observed;
    UnseenRows unseen = seenOrNot(rows);
    for (Eigen::Index i = 0; i < 12; ++i) {
        unseen.predicted[0].col(i).array() += 0.1f * std::sin(5.0f * static_cast<float>(i));
    }
    const ResidualJudge judge(rows, lights, 1);
    const ResidualFit fit = chooseResidualFit(rows, unseen, directionsOf(lights), judge, ResidualChoice::automatic);
    EXPECT_NEAR(fit.brdfPsnr, meanDecibels(judge.errors(unseen.predicted[0])), 1e-6);
    EXPECT_TRUE(fit.isKept);
    EXPECT_EQ(fit.trust, 0);
    const Eigen::MatrixXf alone = rows.observed * leaveOneOutWeights(directionsOf(lights)).cast<float>().transpose();
    EXPECT_NEAR(fit.layerPsnr, meanDecibels(judge.errors(alone)), 1e-3);
}

TEST(ResidualComponents, LeaveOutNoMoreThanIsAllowed)
{
    const std::vector<Light> lights = lightsOf(spiral(24));
    const ResidualRows rows = rowsOf(lights, 0.3f);
    const ResidualJudge judge(rows, lights, 1);
    ResidualReport report;
    report.fit = chooseResidualFit(rows, seenOrNot(rows), directionsOf(lights), judge, ResidualChoice::automatic);
    const Eigen::MatrixXf few = chooseComponents(rows, judge, 0, 20, report);
    // rowsOf's residual is of rank two, and one of the two is not enough.
    EXPECT_EQ(few.cols(), 2);
    EXPECT_EQ(chooseComponents(rows, judge, 10, 20, report).cols(), 1);
    EXPECT_GT(report.capturedPsnr, 10);
}

TEST(LightBalls, SayWhatTheTablesSay)
{
    const Surface surface = residualSurface(16);
    const LightBalls tables(surface, 0, 1), balls(surface, 64, 2);
    const size_t lights = surface.lights.size();
    std::vector<float> exact(3 * lights), quick(3 * lights);
    for (size_t p = 0; p < surface.labels.size(); ++p) {
        tables.predict(p, exact);
        balls.predict(p, quick);
        for (size_t i = 0; i < lights; ++i) {
            const Light light{surface.lights[i].light.direction, glm::vec3(1)};
            const glm::vec3 radiance = brdfRadiance(surface, p, light, {0, 0, 1});
            for (size_t c = 0; c < 3; ++c) {
                EXPECT_EQ(exact[c * lights + i], radiance[static_cast<int>(c)]);
                // A cosine between texels 1/32 of the disc apart: at most its second derivative times 1/32^2 / 8.
                EXPECT_NEAR(quick[c * lights + i], exact[c * lights + i], 2e-4);
            }
        }
    }
}

// A block that shows residualSurface's BRDF and its layer under the captured lights.
Observations shownBy(const Surface& surface)
{
    Observations seen;
    seen.lightCount = surface.lights.size();
    const float c = 0.3f / 3.14159265f;
    for (size_t p = 0; p < surface.labels.size(); ++p) {
        seen.pixels.push_back(static_cast<uint32_t>(p));
        for (const CapturedLight& light : surface.lights) {
            const glm::vec3& l = light.light.direction;
            const float shading = std::max(glm::dot(surface.normals.normals[p], l), 0.0f);
            const auto position = static_cast<float>(p) / static_cast<float>(surface.labels.size());
            seen.radiance.push_back(glm::vec3(c * shading) +
                                    0.05f * glm::vec3(1, 0.5f, 0.2f) * (position * l.x + l.y * l.y));
        }
    }
    seen.saturated.assign(seen.radiance.size(), 0);
    return seen;
}

// Measuring the sample again finds the surface's own pixels.
Remeasure asBefore(const Surface& surface)
{
    return [&surface](const Observations& sample, std::span<const size_t>) {
        Surface row = surface;
        row.normals = NormalMap(static_cast<int>(sample.pixels.size()), 1);
        row.albedo = {};
        row.labels.clear();
        for (size_t p = 0; p < sample.pixels.size(); ++p) {
            row.normals.normals[p] = surface.normals.normals[sample.pixels[p]];
            row.normals.confidence[p] = surface.normals.confidence[sample.pixels[p]];
            row.labels.push_back(surface.labels[sample.pixels[p]]);
        }
        return row;
    };
}

EstimatedResidual estimatedFrom(const Surface& surface, const ResidualOptions& options, ObservationBlocks& blocks)
{
    return estimateResidual(surface, options, leaveOut(surface, blocks, asBefore(surface)), blocks);
}

TEST(ResidualEstimate, ShowsThePhotographsAgain)
{
    Surface surface = residualSurface(16);
    surface.residual = {};
    const Observations seen = shownBy(surface);
    ObservationBlocks blocks({seen});
    const ResidualOptions options{.choice = ResidualChoice::difference, .toleranceDecibels = 50, .threads = 1};
    EstimatedResidual estimated = estimatedFrom(surface, options, blocks);
    surface.residual = std::move(estimated.layer);
    ASSERT_FALSE(surface.residual.empty());
    EXPECT_GE(estimated.report.capturedPsnr, 50);
    for (size_t i = 0; i < surface.lights.size(); ++i) {
        const ResidualFrame frame = residualFrame(surface.residual, std::vector<Light>{surface.lights[i].light});
        for (size_t p = 0; p < seen.pixels.size(); ++p) {
            const float shading =
                std::max(glm::dot(surface.normals.normals[p], surface.lights[i].light.direction), 0.0f);
            const glm::vec3 brdf = frame.base[0].irradiance * (0.3f / 3.14159265f * shading);
            const glm::vec3 shown = brdf + residualOfPixel(surface.residual, frame.weights, p);
            // The penalty smooths, 8 bits round.
            EXPECT_NEAR(glm::length(shown - seen.radianceOf(p)[i]), 0, 0.01) << i << " " << p;
        }
    }
}

TEST(ResidualEstimate, SameBytesForOneAndTwoThreadsAndAnyBlocks)
{
    Surface surface = residualSurface(32);
    surface.residual = {};
    const Observations whole = shownBy(surface);
    const auto inBlocks = [&](size_t size) {
        std::vector<Observations> blocks;
        for (size_t first = 0; first < whole.pixels.size(); first += size) {
            const size_t last = std::min(first + size, whole.pixels.size()), n = whole.lightCount;
            const auto from = [&](const auto& values, size_t each) {
                return std::decay_t<decltype(values)>(values.begin() + static_cast<std::ptrdiff_t>(first * each),
                                                      values.begin() + static_cast<std::ptrdiff_t>(last * each));
            };
            blocks.push_back({n, from(whole.pixels, 1), from(whole.radiance, n), from(whole.saturated, n)});
        }
        return ObservationBlocks(std::move(blocks));
    };
    const auto layerOf = [&](int threads, size_t size) {
        ObservationBlocks blocks = inBlocks(size);
        return estimatedFrom(surface, {.choice = ResidualChoice::difference, .threads = threads}, blocks).layer;
    };
    const ResidualLayer one = layerOf(1, 1024), two = layerOf(2, 1024), small = layerOf(2, 100);
    EXPECT_EQ(one.codes, two.codes);
    EXPECT_EQ(one.weights, two.weights);
    EXPECT_EQ(one.codes, small.codes);
}

TEST(ResidualEstimate, BudgetsAreKept)
{
    Surface surface = residualSurface(16);
    surface.residual = {};
    const Observations seen = shownBy(surface);
    ObservationBlocks blocks({seen});
    const size_t budget = 2 * (16 * 16 + 12 * sizeof(glm::vec3));
    const auto reportOf = [&](size_t bytes) {
        return estimatedFrom(surface, {.choice = ResidualChoice::difference, .budgetBytes = bytes, .threads = 1},
                             blocks)
            .report;
    };
    const ResidualReport kept = reportOf(budget);
    EXPECT_LE(kept.bytes, budget);
    EXPECT_LE(kept.components, 2);
    const ResidualReport report = reportOf(10);
    EXPECT_EQ(report.components, 0);
    EXPECT_NE(report.whyNot.find("10 may be used"), std::string::npos) << report.whyNot;
}

// Six lights on a line, or five anywhere, leave nothing to judge by.
TEST(ResidualEstimate, LightsThatCannotTellAreNamed)
{
    Surface surface = residualSurface();
    surface.residual = {};
    surface.lights.resize(5);
    ObservationBlocks none(std::vector<Observations>{});
    EstimatedResidual estimated = estimatedFrom(surface, {.choice = ResidualChoice::automatic}, none);
    EXPECT_TRUE(estimated.layer.empty());
    EXPECT_NE(estimated.report.whyNot.find("5 lights"), std::string::npos) << estimated.report.whyNot;
    expectError([&] { estimatedFrom(surface, {.choice = ResidualChoice::difference}, none); }, {"5 lights"});
    surface.lights.clear();
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 l(0.1f * static_cast<float>(i) - 0.4f, 0, 1);
        surface.lights.push_back({std::to_string(i), {glm::normalize(l), {1, 1, 1}}});
    }
    estimated = estimatedFrom(surface, {.choice = ResidualChoice::automatic}, none);
    EXPECT_NE(estimated.report.whyNot.find("line"), std::string::npos) << estimated.report.whyNot;
}

// A photograph that is black, and two under the same light: what comes out stays finite and not brighter than all.
TEST(ResidualEstimate, BlackAndEqualPhotographsStayBounded)
{
    Surface surface = residualSurface(16);
    surface.residual = {};
    surface.lights[3].light.direction = surface.lights[2].light.direction;
    Observations seen = shownBy(surface);
    for (size_t p = 0; p < seen.pixels.size(); ++p) {
        seen.radiance[p * seen.lightCount + 5] = glm::vec3(0);
    }
    ObservationBlocks blocks({seen});
    surface.residual = estimatedFrom(surface, {.choice = ResidualChoice::difference, .threads = 1}, blocks).layer;
    for (const glm::vec3& direction : {glm::vec3(0, 0, 1), glm::vec3(1, 0, 0), glm::normalize(glm::vec3(1, 1, -1))}) {
        const ResidualFrame frame = residualFrame(surface.residual, std::vector<Light>{{direction, {1, 1, 1}}});
        for (size_t p = 0; p < seen.pixels.size(); ++p) {
            const glm::vec3 shown = residualOfPixel(surface.residual, frame.weights, p);
            ASSERT_LT(glm::length(shown), 1) << p; // NaN is not less
        }
    }
}

} // namespace
} // namespace nacre
