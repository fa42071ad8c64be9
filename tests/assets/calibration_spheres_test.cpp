#include "assets/synth/calibration_spheres.h"

#include <cmath>

#include <gtest/gtest.h>

#include "engine/files/measures.h"
#include "shared/glsl.h"

namespace nacre {
namespace {

// The light that the mirror's bright region tells of: its centroid's normal, halfway between view and light.
vec3 lightFromHighlight(const Image& mirror)
{
    double x = 0, y = 0, count = 0;
    for (int row = 0; row < mirror.height; ++row) {
        for (int column = 0; column < mirror.width; ++column) {
            if (mirror.at(column, row, 1) > 1.0f) {
                x += column + 0.5;
                y += row + 0.5;
                ++count;
            }
        }
    }
    double radius = 0.5 * kSphereShare * mirror.width;
    double nx = (x / count - 0.5 * mirror.width) / radius;
    double ny = (0.5 * mirror.height - y / count) / radius;
    vec3 n(nx, ny, std::sqrt(1.0 - nx * nx - ny * ny));
    return 2.0f * n.z * n - vec3(0, 0, 1);
}

TEST(CalibrationSpheres, MirrorShowsTheLightWhereItIs)
{
    double sum = 0;
    constexpr int kLights = 24;
    for (int i = 0; i < kLights; ++i) {
        double theta = (2.0 + 2.0 * i) * M_PI / 180.0;
        double phi = 2.4 * i;
        Light light{{std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)}, vec3(1)};
        double error = degreesBetween(lightFromHighlight(mirrorSphereRadiance(256, light, 0.01)), light.direction);
        // A pixel is 0.95 degrees of light direction, the highlight some four pixels wide, told to a third of one.
        EXPECT_LT(error, 0.3) << "at " << 2 + 2 * i << " degrees";
        sum += error;
    }
    EXPECT_LT(sum / kLights, 0.15);
}

TEST(CalibrationSpheres, MirrorIsDimBesideTheHighlightAndBlackBesideTheSphere)
{
    Image mirror = mirrorSphereRadiance(64, Light{vec3(0, 0, 1), vec3(1)}, 0.01);
    EXPECT_FLOAT_EQ(mirror.at(10, 32, 0), 0.01f);
    EXPECT_EQ(mirror.at(0, 0, 0), 0.0f);
}

TEST(CalibrationSpheres, TheMirroredDiscsLightIsItsIrradiance)
{
    Image mirror = mirrorSphereRadiance(1024, Light{vec3(0, 0, 1), vec3(0.8f, 1.0f, 1.2f)}, 0.0);
    double radius = 0.5 * kSphereShare * 1024;
    double irradiance = 0;
    for (size_t i = 0; i < mirror.pixelCount(); ++i) {
        // Seen at the sphere's middle, a pixel's cone of mirrored directions is four times its cone of normals.
        irradiance += mirror.values[3 * i] * 4.0 / (radius * radius);
    }
    // Some 3500 samples lie in the disc; those at its rim are in or out.
    EXPECT_NEAR(irradiance, 0.8, 0.008);
}

TEST(CalibrationSpheres, DiffuseObeysTheReflectanceEquation)
{
    Light light{normalize(vec3(0.3f, 0.4f, 1.0f)), vec3(0.8f, 1.0f, 1.2f)};
    Image sphere = diffuseSphereRadiance(64, vec3(0.5f, 0.4f, 0.3f), light);
    double radius = 0.5 * kSphereShare * 64;
    for (auto [x, y] : {std::pair{40, 20}, {32, 32}, {15, 50}}) {
        double nx = (x + 0.5 - 32) / radius;
        double ny = (32 - y - 0.5) / radius;
        float cosine = dot(vec3(nx, ny, std::sqrt(1 - nx * nx - ny * ny)), light.direction);
        EXPECT_NEAR(sphere.at(x, y, 0), 0.5f / kPi * 0.8f * max(cosine, 0.0f), 1e-6f);
        EXPECT_NEAR(sphere.at(x, y, 2), 0.3f / kPi * 1.2f * max(cosine, 0.0f), 1e-6f);
    }
}

TEST(CalibrationSpheres, MaskIsTheDisc)
{
    std::vector<uint8_t> mask = calibrationSphereMask(100);
    double area = 0;
    for (uint8_t inside : mask) {
        area += inside;
    }
    EXPECT_NEAR(area, M_PI * 47 * 47, 0.01 * area);
    EXPECT_TRUE(mask[50 * 100 + 50]);
    EXPECT_FALSE(mask[50 * 100 + 2]);
}

} // namespace
} // namespace nacre
