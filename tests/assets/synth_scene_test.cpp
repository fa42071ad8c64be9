#include "assets/synth/synth_scene.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "engine/files/error.h"
#include "engine/files/hash_random.h"
#include "engine/files/measures.h"
#include "shared/glsl.h"
#include "tests/support/expect_error.h"

namespace nacre {
namespace {

SynthOptions smallOptions()
{
    SynthOptions options;
    options.width = options.height = 48;
    options.sphereSize = 64;
    options.lights = 12;
    return options;
}

SynthOptions lambertSphere()
{
    SynthOptions options = smallOptions();
    options.shape = SynthShape::sphere;
    options.material = "lambert:0.6,0.5,0.4";
    options.noise = 0;
    return options;
}

TEST(SynthScene, ObeysTheReflectanceEquationOnALambertSphere)
{
    SynthScene scene = makeSynthScene(lambertSphere());
    for (const Light& light : scene.lights) {
        Image radiance = objectRadiance(scene, light, 1);
        for (int y = 0; y < 48; ++y) {
            for (int x = 0; x < 48; ++x) {
                // The sphere of radius 0.92, from the pixel's centre alone.
                double px = (x + 0.5 - 24) / 24 / 0.92;
                double py = (24 - y - 0.5) / 24 / 0.92;
                double rest = 1.0 - px * px - py * py;
                vec3 expected(0);
                if (rest > 0.0) {
                    float cosine = dot(vec3(px, py, std::sqrt(rest)), light.direction);
                    expected = vec3(0.6f, 0.5f, 0.4f) / kPi * light.irradiance * max(cosine, 0.0f);
                }
                // Normals are stored as floats: 1e-7 of the value, and 1e-7 absolute at the terminator.
                for (int c = 0; c < 3; ++c) {
                    ASSERT_NEAR(radiance.at(x, y, c), expected[c], 1e-6f) << x << "," << y;
                }
            }
        }
    }
}

TEST(SynthScene, LightsLieOnTheCapAndDiffer)
{
    SynthOptions options = smallOptions();
    options.lights = 36;
    options.capDegrees = 50;
    SynthScene scene = makeSynthScene(options);
    ASSERT_EQ(scene.lights.size(), 36u);
    double largestAngle = 0;
    for (size_t i = 0; i < 36; ++i) {
        const Light& light = scene.lights[i];
        EXPECT_NEAR(length(light.direction), 1.0f, 1e-6f);
        largestAngle = std::max(largestAngle, degreesBetween(light.direction, {0, 0, 1}));
        for (int c = 0; c < 3; ++c) {
            EXPECT_GE(light.irradiance[c], 0.7f);
            EXPECT_LE(light.irradiance[c], 1.3f);
        }
        for (size_t j = 0; j < i; ++j) {
            EXPECT_GT(degreesBetween(light.direction, scene.lights[j].direction), 5.0) << i << " and " << j;
        }
    }
    EXPECT_LE(largestAngle, 50.0);
    EXPECT_GT(largestAngle, 45.0);
}

TEST(SynthScene, MaskIsWhereNormalsAre)
{
    SynthScene scene = makeSynthScene(smallOptions());
    for (size_t i = 0; i < scene.view.mask.size(); ++i) {
        EXPECT_EQ(scene.view.mask[i] != 0, scene.view.normals.confidence[i] > 0.0f);
        EXPECT_NEAR(length(scene.view.normals.normals[i]), scene.view.mask[i] ? 1.0f : 0.0f, 1e-6f);
    }
}

TEST(SynthScene, ShadowsAreZeroAndCanBeLeftOut)
{
    SynthOptions options = smallOptions();
    SynthScene shadowing = makeSynthScene(options);
    options.shadows = false;
    SynthScene open = makeSynthScene(options);
    const Light& light = shadowing.lights.back(); // the rim of the cap
    std::vector<uint8_t> lit = litPixels(shadowing, light, 1);
    std::vector<uint8_t> attachedOnly = litPixels(open, light, 1);
    Image radiance = objectRadiance(shadowing, light, 1);
    size_t cast = 0;
    for (size_t i = 0; i < lit.size(); ++i) {
        EXPECT_LE(lit[i], attachedOnly[i]);
        EXPECT_EQ(radiance.values[3 * i + 1] > 0.0f, lit[i] != 0);
        cast += attachedOnly[i] && !lit[i];
    }
    EXPECT_GT(cast, 20u);
}

TEST(SynthScene, ExposesForTheObjectAndSparesTheDiffuseSphere)
{
    SynthScene scene = makeSynthScene(smallOptions());
    std::vector<float> brightest;
    for (const Light& light : scene.lights) {
        Image radiance = objectRadiance(scene, light, 0);
        for (uint32_t pixel : scene.view.seen) {
            const float* rgb = &radiance.values[3 * pixel];
            brightest.push_back(scene.sensor.gain * std::max({rgb[0], rgb[1], rgb[2]}));
        }
    }
    EXPECT_NEAR(quantile(brightest, 0.995), 0.7, 1e-5); // so few pixels that all of them were looked at

    SynthOptions dark = smallOptions();
    dark.material = "lambert:0.02";
    SynthScene darker = makeSynthScene(dark);
    for (const Light& light : darker.lights) {
        double sphere = std::max({light.irradiance.x, light.irradiance.y, light.irradiance.z}) * 0.5 / M_PI;
        EXPECT_LE(darker.sensor.gain * sphere, 0.9 + 1e-6) << "the sphere is brighter than the object";
    }
}

TEST(SynthScene, DoesNotDependOnThreadsButOnTheSeed)
{
    SynthOptions options = smallOptions();
    options.threads = 1;
    SynthScene one = makeSynthScene(options);
    options.threads = 2;
    SynthScene two = makeSynthScene(options);
    options.seed = 2;
    SynthScene other = makeSynthScene(options);
    EXPECT_EQ(objectRadiance(one, one.lights[5], 1).values, objectRadiance(two, two.lights[5], 2).values);
    EXPECT_EQ(one.sensor.gain, two.sensor.gain);
    EXPECT_NE(one.lights[5].direction, other.lights[5].direction);
    EXPECT_NE(one.lights[5].irradiance, other.lights[5].irradiance);
}

SynthOptions whiteBowl(int bounces)
{
    SynthOptions options = lambertSphere();
    options.shape = SynthShape::bowl;
    options.material = "lambert:0.9,0.5,0";
    options.bounces = bounces;
    return options;
}

TEST(SynthScene, BouncesAddLightInShadowsAndByTheAlbedo)
{
    const SynthScene none = makeSynthScene(whiteBowl(0)), one = makeSynthScene(whiteBowl(1)),
                     many = makeSynthScene(whiteBowl(12));
    EXPECT_FALSE(none.bouncing);
    const Light& light = none.lights.back();
    const Image direct = objectRadiance(none, light, 1), first = objectRadiance(one, light, 1),
                all = objectRadiance(many, light, 1);
    const std::vector<uint8_t> lit = litPixels(none, light, 1);
    double ratio = 0, darkest = 0, brightest = 0;
    for (const uint32_t pixel : none.view.seen) {
        const float* before = &direct.values[3 * pixel];
        const float* after = &first.values[3 * pixel];
        EXPECT_LE(before[0], after[0]);
        EXPECT_LE(after[0], all.values[3 * pixel]);
        EXPECT_EQ(all.values[3 * pixel + 2], 0) << "no blue leaves a yellow bowl";
        brightest = std::max<double>(brightest, before[0]);
        if (!lit[pixel]) {
            darkest = std::max<double>(darkest, all.values[3 * pixel]);
        }
        // One bounce on the way meets the albedo twice: the light's own radiance once.
        if (after[0] - before[0] > 1e-3f) {
            const double ofLights = light.irradiance.x / light.irradiance.y;
            ratio = (after[0] - before[0]) / (after[1] - before[1]) / ofLights;
            EXPECT_NEAR(ratio, 0.9 * 0.9 / (0.5 * 0.5), 0.02);
        }
    }
    EXPECT_GT(ratio, 0);
    EXPECT_GT(darkest, 0.1 * brightest);
    EXPECT_LT(many.sensor.gain, none.sensor.gain) << "exposed for what is there";
}

TEST(SynthScene, BouncesDoNotDependOnThreadsAndSpareConvexSolids)
{
    SynthOptions options = whiteBowl(3);
    options.threads = 1;
    const SynthScene one = makeSynthScene(options);
    options.threads = 3;
    const SynthScene three = makeSynthScene(options);
    EXPECT_EQ(objectRadiance(one, one.lights[5], 1).values, objectRadiance(three, three.lights[5], 3).values);
    EXPECT_EQ(one.sensor.gain, three.sensor.gain);
    options.shape = SynthShape::sphere;
    const SynthScene sphere = makeSynthScene(options);
    options.bounces = 0;
    const SynthScene plain = makeSynthScene(options);
    EXPECT_EQ(objectRadiance(sphere, sphere.lights[5], 1).values, objectRadiance(plain, plain.lights[5], 1).values);
}

TEST(SynthScene, RefusesOptionsThatMakeNoCapture)
{
    auto refused = [](auto change, const char* about) {
        SynthOptions options = smallOptions();
        change(options);
        expectError([&] { makeSynthScene(options); }, {about}, Error::kUsage);
    };
    refused([](SynthOptions& o) { o.width = 2; }, "side is too small");
    refused([](SynthOptions& o) { o.lights = 0; }, "no lights");
    refused([](SynthOptions& o) { o.capDegrees = 90; }, "cap of lights");
    refused([](SynthOptions& o) { o.noise = -1; }, "noise");
    refused([](SynthOptions& o) { o.bounces = -1; }, "bounces");
    refused(
        [](SynthOptions& o) {
            o.bounces = 1;
            o.width = 513;
        },
        "light that bounces");
    refused([](SynthOptions& o) { o.exposures = {1, 0}; }, "exposure time");
    refused([](SynthOptions& o) { o.material = "lambert:0"; }, "reflects no light");
    refused([](SynthOptions& o) { o.material = "tweed"; }, "tweed");
}

TEST(Sensor, BracketsAgreeWhereNothingClips)
{
    Image radiance(8, 8, 3);
    for (size_t i = 0; i < radiance.values.size(); ++i) {
        radiance.values[i] = 0.01f * static_cast<float>(i); // up to 1.91: beyond full scale at time 1
    }
    Sensor sensor;
    Image full = exposed(radiance, sensor, 1.0, 0);
    Image quarter = exposed(radiance, sensor, 0.25, 1);
    for (size_t i = 0; i < radiance.values.size(); ++i) {
        EXPECT_FLOAT_EQ(full.values[i], std::min(radiance.values[i], 1.0f));
        EXPECT_FLOAT_EQ(quarter.values[i] * 4.0f, radiance.values[i]);
    }
    sensor.clips = false;
    EXPECT_EQ(exposed(radiance, sensor, 1.0, 0).values, radiance.values);
}

TEST(Sensor, NoiseHasTheDeviationAskedForAndNoBias)
{
    Sensor sensor;
    sensor.clips = false;
    sensor.noise = 0.01;
    Image noise = exposed(Image(200, 200, 3), sensor, 1.0, 3);
    double sum = 0, squares = 0;
    for (float value : noise.values) {
        sum += value;
        squares += static_cast<double>(value) * value;
    }
    const double count = static_cast<double>(noise.values.size());
    // 120,000 draws: the mean's own deviation is 0.01 / sqrt(120000), the deviation's is 0.2 %; five of each.
    EXPECT_NEAR(sum / count, 0.0, 1.5e-4);
    EXPECT_NEAR(std::sqrt(squares / count), 0.01, 1e-4);
    EXPECT_NE(noise.values, exposed(Image(200, 200, 3), sensor, 1.0, 4).values) << "another photograph";
    sensor.seed = 2;
    EXPECT_NE(noise.values, exposed(Image(200, 200, 3), sensor, 1.0, 3).values) << "another seed";
}

} // namespace
} // namespace nacre
