#include "acquisition/checks/self_checks.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "acquisition/lights/lights.h"
#include "engine/files/measures.h"
#include "evaluation/stress/degradations.h"
#include "evaluation/stress/normal_sweeps.h"

namespace nacre {
namespace {

// Gloss, shadows and a little noise, as the photographs of an ordinary object.
const StressSubject& subject()
{
    static const StressSubject made = [] {
        SynthOptions options;
        options.width = options.height = 24;
        options.lights = 24;
        options.material = "ggx:diffuse=0.4,0.3,0.2;specular=0.05;alpha=0.2";
        return syntheticSubject(options);
    }();
    return made;
}

std::vector<Finding> warningsAfter(const Degradation& degradation)
{
    const PhotographedObject object = degraded(subject().clean, degradation);
    return checkCapture(object.seen, object.lights, {}).checks.findings;
}

TEST(SelfChecks, NothingIsFoundInAGoodCapture)
{
    Degradation little;
    little.noise = 0.005;
    little.bits = 8;
    little.directionErrorDegrees = 0.5;
    little.irradianceError = 0.01;
    const std::vector<Finding> warnings = warningsAfter(little);
    EXPECT_TRUE(warnings.empty()) << warnings.front().text;
}

TEST(SelfChecks, EachDefectIsNamed)
{
    const auto expectSaid = [](auto member, double value, FindingCode code) {
        Degradation degradation;
        degradation.noise = 0.002;
        degradation.*member = value;
        const std::vector<Finding> warnings = warningsAfter(degradation);
        EXPECT_TRUE(contains(warnings, code))
            << nameOf(code) << ", but: " << (warnings.empty() ? "" : warnings.front().text);
    };
    expectSaid(&Degradation::transferExponent, 2.2, FindingCode::transferCurveLeft);
    expectSaid(&Degradation::transferExponent, 1 / 2.2, FindingCode::transferCurveTaken);
    expectSaid(&Degradation::nearWidths, 4, FindingCode::lightsNear);
    expectSaid(&Degradation::directionErrorDegrees, 6, FindingCode::directionsContradicted);
    expectSaid(&Degradation::overexposedShare, 0.35, FindingCode::clipped);
    expectSaid(&Degradation::shadowShare, 0.3, FindingCode::shadowed);
}

// It bends the shading as a transfer curve does, which is not what has to be undone.
TEST(SelfChecks, LightThatStaysOnIsToldFromACurve)
{
    PhotographedObject object = subject().clean;
    float brightest = 0;
    for (const glm::vec3& value : object.seen.radiance) {
        brightest = std::max(brightest, channelMean(value));
    }
    for (glm::vec3& value : object.seen.radiance) {
        value += 0.05f * brightest;
    }
    const std::vector<Finding> warnings = checkCapture(object.seen, object.lights, {}).checks.findings;
    EXPECT_TRUE(contains(warnings, FindingCode::offsetLeft));
    EXPECT_FALSE(contains(warnings, FindingCode::transferCurveLeft));
}

TEST(SelfChecks, LambertsMethodsAreDoubtedWhereGlossOrNoiseRules)
{
    Degradation noisy;
    noisy.noise = 0.1;
    const PhotographedObject object = degraded(subject().clean, noisy);
    const CheckedSample sample = checkCapture(object.seen, object.lights, {});
    const std::vector<Finding> said =
        checkMethod(sample, NormalMethod::leastSquares, makeLeastSquaresEstimator(object.lights, {})).findings;
    EXPECT_TRUE(contains(said, FindingCode::notLambertian)) << said.size();
}

TEST(SelfChecks, TooFewPixelsOrLightsAreNotJudged)
{
    const CheckedSample sample = checkCapture(Observations{}, subject().clean.lights, {});
    EXPECT_TRUE(sample.checks.findings.empty());
    EXPECT_TRUE(checkMethod(sample, NormalMethod::leastSquares, {}).findings.empty());
}

TEST(SphereAgreement, AMisplacedMirrorSphereIsSaidAndScatterIsNot)
{
    std::vector<glm::vec3> truth;
    std::vector<Light> shifted = subject().clean.lights, scattered = subject().clean.lights;
    for (const Light& light : shifted) {
        truth.push_back(light.direction);
    }
    misplaceSphere(shifted, 0.05);
    turnDirections(scattered, 3, 1);
    const auto directions = [](const std::vector<Light>& lights) {
        std::vector<glm::vec3> result;
        for (const Light& light : lights) {
            result.push_back(light.direction);
        }
        return result;
    };
    // Twice 5 % of the radius in the middle of the sphere, up to a quarter more at 55 degrees.
    EXPECT_NEAR(commonTurn(directions(shifted), truth).degrees, 6.2, 0.5);
    EXPECT_TRUE(sphereWarning(directions(shifted), truth).has_value());
    EXPECT_FALSE(sphereWarning(directions(scattered), truth).has_value());
    EXPECT_FALSE(sphereWarning(directions(shifted), {}).has_value()) << "no diffuse sphere";
}

} // namespace
} // namespace nacre
