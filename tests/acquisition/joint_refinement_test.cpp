#include "acquisition/exemplar/joint_refinement.h"

#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "acquisition/exemplar/reflectance_fit.h"
#include "acquisition/exemplar/reflectance_slopes.h"
#include "engine/files/measures.h"
#include "tests/acquisition/shaded_scene.h"

namespace nacre {

namespace {

float varnish(size_t, const glm::vec3& n, const glm::vec3& l)
{
    return 0.3f + 0.5f * gloss(n, l, 0.25f);
}

// A model of the scene from normals that stand as wrong as the reflectance lets them: slopes are multiplied, and the
// reflectance is then fitted to them.
struct Start {
    PixelLattice lattice;
    BallGrid grid;
    MatchModel model;
    std::vector<BallMatch> matches;
};

void startWith(const ShadedScene& scene, float slopes, bool additive, Start& start)
{
    start.lattice = makePixelLattice(scene.intensities, 1);
    start.grid = makeBallGrid(kBallSize, scene.lights, 1);
    start.model.ball = makeReflectanceBall(start.grid, start.model.reflectance, 1);
    for (const glm::vec3& normal : scene.normals) {
        const glm::vec3 wrong = glm::normalize(glm::vec3(slopes * normal.x, slopes * normal.y, normal.z));
        start.matches.push_back({ballTexelOf(wrong, start.grid.size), 1, 2, -1});
    }
    for (int round = 0; round < 3; ++round) {
        for (size_t p = 0; p < start.matches.size(); ++p) {
            BallMatch& match = start.matches[p];
            match = matchAtTexel(start.model, start.lattice, p, match.texel, match.scale);
        }
        refitModel(start.lattice, additive, 1, start.model, start.matches);
    }
}

// w of Reflectance that grows evenly along n.l, n.v and thetaD.
std::vector<float> straightCoupling()
{
    std::vector<float> coupling;
    for (int l = 0; l < kCouplingKnots; ++l) {
        for (int v = 0; v < kCouplingKnots; ++v) {
            for (int d = 0; d < kCouplingDifferences; ++d) {
                coupling.push_back(0.1f * static_cast<float>(l) - 0.06f * static_cast<float>(v) +
                                   0.05f * static_cast<float>(d));
            }
        }
    }
    return coupling;
}

void giveOneAlbedo(Start& start)
{
    std::vector<float> albedos;
    for (size_t p = 0; p < start.matches.size(); ++p) {
        albedos.push_back(start.matches[p].scale * start.lattice.bright[p]);
    }
    start.model.reflectance.oneAlbedo = quantile(albedos, 0.5);
}

double meanError(const ShadedScene& scene, const Start& start)
{
    double sum = 0;
    for (size_t p = 0; p < scene.normals.size(); ++p) {
        sum += degreesBetween(normalOfBallTexel(start.matches[p].texel, start.grid.size), scene.normals[p]);
    }
    return sum / static_cast<double>(scene.normals.size());
}

} // namespace

TEST(JointRefinement, SlopesAreThoseOfDifferences)
{
    const BallGrid grid = makeBallGrid(kBallSize, lightsAround(5), 1);
    const std::vector<LightPlace> lights = lightPlaces(grid);
    enum class Form { gloss, additiveGloss, oneAlbedo };
    for (const Form form : {Form::gloss, Form::additiveGloss, Form::oneAlbedo}) {
        Reflectance reflectance;
        reflectance.additive = form == Form::additiveGloss;
        reflectance.bounced = 0.05f;
        if (form == Form::oneAlbedo) {
            reflectance.oneAlbedo = 0.4f;
            reflectance.coupling = straightCoupling();
        }
        for (int k = 0; k < kShadeKnots; ++k) {
            reflectance.shade[k] = 0.03f * static_cast<float>(k); // straight, as the lobe is: no knots between
            reflectance.slant[k] = form == Form::oneAlbedo ? 0.05f * static_cast<float>(k) : 0.0f;
        }
        for (int k = 0; k < kLobeUnknowns; ++k) {
            reflectance.lobe[k] =
                0.5f + 0.02f * static_cast<float>(kHalfBins - k / kDifferenceBins + k % kDifferenceBins);
        }
        const float unit = 0.1f, bright = 0.7f;
        const Eigen::VectorXd unknowns = unknownsOf(reflectance, unit);
        const PixelGuess guess{0, glm::normalize(glm::vec3(0.3f, -0.2f, 0.8f)), -0.4f};
        const NormalBasis basis = basisOf(guess.normal);
        const auto rootAt = [&](const Eigen::VectorXd& at, const PixelGuess& where, const LightPlace& light) {
            return rootSlopes(reflectanceOf(at, unit, reflectance), where, basis, bright, light).root;
        };
        for (const LightPlace& light : lights) {
            const RootSlopes slopes =
                rootSlopes(reflectanceOf(unknowns, unit, reflectance), guess, basis, bright, light);
            constexpr float kStep = 2e-3f; // of floats: the difference has three digits
            const auto difference = [&](const auto& moved) { return (moved(kStep) - moved(-kStep)) / (2 * kStep); };
            EXPECT_NEAR(slopes.byPixel[0], difference([&](float t) {
                            return rootAt(unknowns, {0, glm::normalize(guess.normal + t * basis.across), -0.4f}, light);
                        }),
                        3e-3f);
            EXPECT_NEAR(slopes.byPixel[1], difference([&](float t) {
                            return rootAt(unknowns, {0, glm::normalize(guess.normal + t * basis.along), -0.4f}, light);
                        }),
                        3e-3f);
            EXPECT_NEAR(slopes.byPixel[2], difference([&](float t) {
                            return rootAt(unknowns, {0, guess.normal, -0.4f + t}, light);
                        }),
                        3e-3f);
            ASSERT_EQ(slopes.count, form == Form::oneAlbedo ? 16 : 6);
            for (int k = 0; k < slopes.count; ++k) {
                EXPECT_NEAR(slopes.byUnknown[k], difference([&](float t) {
                                Eigen::VectorXd at = unknowns;
                                at[slopes.unknowns[k]] += t;
                                return rootAt(at, guess, light);
                            }),
                            3e-3f)
                    << k;
            }
        }
    }
}

// Slopes that are a seventh too steep, and the reflectance that explains them best, are left for the true ones. Fitted
// in turn they stay: what is left of the error by then is in the reflectance's bins.
TEST(JointRefinement, FindsSlopesThatTheReflectanceHides)
{
    const ShadedScene scene = photograph(26, 26, sphere, varnish);
    for (const bool additive : {false, true}) {
        Start start;
        startWith(scene, 1.15f, additive, start);
        ASSERT_GT(meanError(scene, start), 3);
        refineJointly(start.lattice, 2, start.model, start.matches);
        EXPECT_LT(meanError(scene, start), 0.5) << additive;
    }
}

// Where all pixels have one albedo, brightness tells of slopes, even by a law that is not reciprocal.
TEST(JointRefinement, OneAlbedoFindsSlopesAndHowTheyDarkenFromAside)
{
    const ShadedScene scene = photograph(26, 26, sphere, [](size_t p, const glm::vec3& n, const glm::vec3& l) {
        return std::exp(0.8f * (n.z - 0.8f)) * varnish(p, n, l);
    });
    Start start;
    startWith(scene, 1.15f, false, start);
    giveOneAlbedo(start);
    refineJointly(start.lattice, 2, start.model, start.matches);
    EXPECT_LT(meanError(scene, start), 0.3);
    EXPECT_NEAR(start.model.reflectance.slantAt(0.95f) - start.model.reflectance.slantAt(0.55f), 0.8f * 0.4f, 0.03f);
}

// By a law that is no product of functions of one or two angles, slopes make up for what is missing, unless w does.
TEST(JointRefinement, CouplingHoldsWhatNoProductDoes)
{
    const ShadedScene scene = photograph(26, 26, sphere, [](size_t p, const glm::vec3& n, const glm::vec3& l) {
        const float aside = glm::dot(n, l) - 0.5f;
        return std::exp(4 * aside * aside * (n.z - 0.7f)) * varnish(p, n, l);
    });
    std::array<double, 2> errors{};
    for (const bool coupled : {false, true}) {
        Start start;
        startWith(scene, 1.0f, false, start);
        giveOneAlbedo(start);
        if (coupled) {
            start.model.reflectance.coupling.assign(straightCoupling().size(), 0.0f);
        }
        refineJointly(start.lattice, 2, start.model, start.matches);
        errors[coupled] = meanError(scene, start);
    }
    EXPECT_LT(errors[1], 0.7 * errors[0]) << errors[0];
}

// What steps are taken by is what matches are then sought on.
TEST(JointRefinement, PredictsWhatTheBallShows)
{
    const BallGrid grid = makeBallGrid(kBallSize, lightsAround(5), 1);
    const std::vector<LightPlace> lights = lightPlaces(grid);
    Reflectance reflectance;
    reflectance.bounced = 0.05f;
    reflectance.oneAlbedo = 1.0f;
    reflectance.coupling = straightCoupling();
    reflectance.slant = reflectance.shade = shadeOfPower(1.3f);
    const ReflectanceBall ball = makeReflectanceBall(grid, reflectance, 1);
    const SlopedReflectance sloped = reflectanceOf(unknownsOf(reflectance, 0.1f), 0.1f, reflectance);
    for (size_t row = 0; row < grid.normals.size(); row += 37) {
        for (size_t i = 0; i < lights.size(); ++i) {
            const float root = rootSlopes(sloped, {0, grid.normals[row], 0}, {}, 1, lights[i]).root;
            EXPECT_NEAR(root, ball.roots[row * grid.stride + i], 1e-4f) << row << ' ' << i;
        }
    }
}

TEST(JointRefinement, DoesNotDependOnThreads)
{
    const ShadedScene scene = photograph(24, 24, sphere, varnish);
    Start one, three;
    startWith(scene, 1.1f, false, one);
    startWith(scene, 1.1f, false, three);
    refineJointly(one.lattice, 1, one.model, one.matches);
    refineJointly(three.lattice, 3, three.model, three.matches);
    EXPECT_EQ(one.model.reflectance.lobe, three.model.reflectance.lobe);
    for (size_t p = 0; p < one.matches.size(); ++p) {
        EXPECT_EQ(one.matches[p].texel, three.matches[p].texel);
    }
}

// A room that sends back three hundredths of the light: known from the pixels that face away.
TEST(JointRefinement, KnowsLightThatBouncedFromTheRoom)
{
    ShadedScene scene = photograph(26, 26, sphere, varnish);
    for (size_t p = 0; p < scene.normals.size(); ++p) {
        for (size_t i = 0; i < scene.lights.size(); ++i) {
            scene.intensities.values[p * scene.intensities.stride + i] += 0.03f * 0.3f;
        }
    }
    Start start;
    startWith(scene, 1, true, start);
    EXPECT_NEAR(start.model.reflectance.bounced, 0.03f, 0.006f);
    refineJointly(start.lattice, 2, start.model, start.matches);
    EXPECT_LT(meanError(scene, start), 0.5);
}

} // namespace nacre
