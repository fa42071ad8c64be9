// Intensities estimated from the object, on a sphere whose normals and lights are known.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include "acquisition/chain/chosen_method.h"
#include "acquisition/chain/reconciled_photographs.h"
#include "acquisition/checks/intensity_refinement.h"
#include "acquisition/lights/lights.h"
#include "engine/files/hash_random.h"
#include "engine/files/measures.h"
#include "evaluation/held_out/photographed_object.h"
#include "evaluation/stress/light_layouts.h"

namespace nacre {
namespace {

constexpr size_t kLights = 36;

// Glossy and metallic, so that Lambert's law is off as it is in life.
const char* const kGlossy = "ggx:diffuse=0.5,0.3,0.2;specular=0.04;alpha=0.2";
const char* const kMetal = "ggx:diffuse=0.05;specular=0.6;alpha=0.35";

PhotographedObject sphereUnder(const std::vector<Light>& lights, const char* material = kGlossy)
{
    SynthOptions options;
    options.shape = SynthShape::sphere;
    options.width = options.height = 32;
    options.material = material;
    SynthScene scene = makeSynthScene(options);
    scene.lights = lights;
    return photographedScene(scene);
}

// Lights from 0.7 to 1.3, drawn anew for each.
std::vector<Light> uneven(std::vector<Light> lights)
{
    for (size_t i = 0; i < lights.size(); ++i) {
        lights[i].irradiance *= static_cast<float>(0.7 + 0.6 * unitFromHash(hashOf(1, i)));
    }
    return lights;
}

std::vector<Light> equallyStrong(std::vector<Light> lights)
{
    for (Light& light : lights) {
        light.irradiance = glm::vec3(1);
    }
    return lights;
}

ReconciledPhotographs reconciled(const PhotographedObject& object, const std::vector<Light>& told, bool known)
{
    return reconcilePhotographs({object.seen, object.photographs, known, told}, {});
}

// Mean error of the normals in degrees, by consensus under such lights.
double errorUnder(const PhotographedObject& object, const std::vector<Light>& lights)
{
    const NormalBlock block = estimateBlock(makeConsensusEstimator(lights, {}), object.seen, lights);
    double sum = 0;
    for (size_t p = 0; p < block.pixels.size(); ++p) {
        sum += block.pixels[p].confidence > 0 ? degreesBetween(block.pixels[p].normal, object.truth.normals[p]) : 90;
    }
    return sum / static_cast<double>(block.pixels.size());
}

// Largest ratio of found to true irradiance over the smallest, less 1.
double unevenness(const std::vector<Light>& found, const std::vector<Light>& truth)
{
    std::vector<float> ratios;
    for (size_t i = 0; i < found.size(); ++i) {
        ratios.push_back(greyOf(found[i].irradiance) / greyOf(truth[i].irradiance));
    }
    const auto [least, largest] = std::minmax_element(ratios.begin(), ratios.end());
    return *largest / *least - 1;
}

std::string textOf(const std::vector<Finding>& findings, FindingCode code)
{
    const auto found = std::find_if(findings.begin(), findings.end(), [&](const auto& f) { return f.code == code; });
    return found == findings.end() ? "" : found->text;
}

std::vector<std::vector<Light>> illPlacedLights()
{
    const float side = glm::radians(40.0f);
    return {spreadLights(kLights, 15), spreadLights(kLights, 20, {std::sin(side), 0, std::cos(side)}),
            arcLights(kLights, 4)};
}

TEST(IntensityRefinement, TrueIntensitiesOfIllPlacedLightsStayAsTheyAre)
{
    for (const std::vector<Light>& lights : illPlacedLights()) {
        const std::vector<Light> truth = uneven(lights);
        ASSERT_GT(conditionOf(truth), 5);
        const ReconciledPhotographs found = reconciled(sphereUnder(truth), truth, true);
        ASSERT_TRUE(found.leftOut.empty());
        EXPECT_TRUE(found.findings.empty());
        EXPECT_EQ(unevenness(found.sample.lights, truth), 0);
    }
}

// An estimate that stops early leaves the slope of the intensities as it was, and so tilts the object.
TEST(IntensityRefinement, IllPlacedLightsOfUnknownIntensityTiltNoObjectThatTells)
{
    for (const std::vector<Light>& lights : illPlacedLights()) {
        const std::vector<Light> truth = uneven(lights);
        const PhotographedObject object = sphereUnder(truth);
        const ReconciledPhotographs found = reconciled(object, equallyStrong(truth), false);
        // 3 degrees: what the highlights leave undecided where a prior holds the slope back; 10 and more if it stays.
        EXPECT_LT(errorUnder(object, found.sample.lights), errorUnder(object, truth) + 3);
        const std::string said = textOf(found.findings, FindingCode::intensitiesUncertain);
        EXPECT_NE(said.find(fmt::format("condition {:.1f}", conditionOf(truth))), std::string::npos);
    }
}

// A metal's lobes look like a slope of the intensities.
TEST(IntensityRefinement, EqualLightsThatAreIllPlacedStayNearEqual)
{
    for (const std::vector<Light>& lights : illPlacedLights()) {
        const PhotographedObject object = sphereUnder(lights, kMetal);
        const ReconciledPhotographs found = reconciled(object, lights, false);
        // What a metal of such lobes (its pixels scatter by 20 % and more) may claim at most against equal lights.
        EXPECT_LT(unevenness(found.sample.lights, lights), 0.1);
    }
}

TEST(IntensityRefinement, WrongIntensitiesOfWellPlacedLightsAreCorrected)
{
    const std::vector<Light> truth = uneven(spreadLights(kLights, 55));
    const PhotographedObject object = sphereUnder(truth);
    std::vector<Light> told = truth;
    for (size_t i = 3; i < told.size(); i += 6) {
        told[i].irradiance *= i % 12 == 3 ? 1.3f : 1 / 1.3f;
    }
    const ReconciledPhotographs found = reconciled(object, told, true);
    EXPECT_TRUE(contains(found.findings, FindingCode::intensitiesCorrected));
    EXPECT_FALSE(contains(found.findings, FindingCode::intensitiesUncertain));
    EXPECT_LT(unevenness(found.sample.lights, truth), 0.01); // of 30 %; highlights move the medians by less
    const ReconciledPhotographs unknown = reconciled(object, equallyStrong(truth), false);
    EXPECT_LT(unevenness(unknown.sample.lights, truth), 0.05); // all at once: of 60 %
    EXPECT_FALSE(contains(unknown.findings, FindingCode::intensitiesUncertain));
}

// Exposures that drift differ photograph by photograph; what goes with the direction may be the reflectance's doing.
TEST(IntensityRefinement, MeasuredIntensitiesAreCorrectedWhereExposuresDrift)
{
    const std::vector<Light> lights = spreadLights(kLights, 55);
    const PhotographedObject object = sphereUnder(lights);
    std::vector<Light> drifted = lights, sloped = lights;
    for (size_t i = 0; i < lights.size(); ++i) {
        drifted[i].irradiance *= static_cast<float>(1 + 0.06 * (2 * unitFromHash(hashOf(5, i)) - 1));
        sloped[i].irradiance *= 0.9f + 0.2f * lights[i].direction.z;
    }
    const ReconciledPhotographs found = reconciled(object, drifted, true);
    EXPECT_TRUE(contains(found.findings, FindingCode::intensitiesCorrected));
    EXPECT_LT(unevenness(found.sample.lights, lights), 0.02); // of 12 %; highlights move the medians by less
    EXPECT_TRUE(reconciled(object, lights, true).findings.empty());
    EXPECT_TRUE(reconciled(object, sloped, true).findings.empty());
}

TEST(IntensityRefinement, WithinTooFewStepsTheIntensitiesGivenStay)
{
    const std::vector<Light> truth = uneven(spreadLights(kLights, 55));
    const PhotographedObject object = sphereUnder(truth);
    for (const bool known : {true, false}) {
        std::vector<Light> lights = equallyStrong(truth);
        const PhotographRatios found = estimateIntensityRatios(object.seen, lights, {}, 4);
        EXPECT_FALSE(found.settled);
        EXPECT_EQ(found.scatters.size(), lights.size());
        EXPECT_EQ(found.ratios, std::vector<glm::vec3>(lights.size(), glm::vec3(1)));
        const std::vector<Finding> said = correctIntensities(found, object.photographs, known, lights);
        EXPECT_EQ(unevenness(lights, equallyStrong(truth)), 0);
        const bool isSaid = textOf(said, FindingCode::intensitiesUncertain).find("in 4 steps") != std::string::npos;
        EXPECT_EQ(isSaid, !known) << "measured ones need no estimate";
    }
}

TEST(IntensityRefinement, APhotographThatIsMerelyBrighterOrDimmerIsKept)
{
    const std::vector<Light> truth = uneven(spreadLights(kLights, 55));
    const PhotographedObject object = sphereUnder(truth);
    for (const float factor : {0.05f, 0.5f, 2.0f, 20.0f}) {
        std::vector<Light> told = truth;
        told[10].irradiance *= factor;
        const ReconciledPhotographs found = reconciled(object, told, true);
        EXPECT_TRUE(found.leftOut.empty()) << factor;
        // 1 %: as above, where highlights move the medians by less.
        EXPECT_LT(unevenness(found.sample.lights, truth), 0.01) << factor;
    }
}

} // namespace
} // namespace nacre
