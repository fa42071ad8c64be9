#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "acquisition/capture/capture_maps.h"
#include "acquisition/capture/observations.h"
#include "assets/synth/interreflection.h"
#include "engine/files/measures.h"
#include "tests/support/data_folder.h"

namespace nacre {
namespace {

using glm::dvec3;

// What the inside of a bowl shows of each light, in units of E / pi.
struct BowlShades {
    std::vector<float> dark;   // by light: where it faces the light and lies in the shadow of the rim; below 0: nowhere
    std::vector<float> albedo; // by light: by how much brighter it is where the light reaches, over n.l
};

// A median of at least twelve values; -1 of fewer.
float medianOf(std::vector<float>& values)
{
    return values.size() < 12 ? -1.0f : quantile(values, 0.5);
}

BowlShades shadesOf(const Capture& capture)
{
    constexpr int kInside = 38; // pixels about the picture's middle
    const NormalMap truth = windowedNormals(loadTrueNormals(capture.truthNormals), capture, capture.truthNormals);
    std::vector<std::vector<float>> direct(capture.lights.size()), shown(capture.lights.size());
    ObservationReader reader(capture);
    for (Observations block; reader.next(block);) {
        for (size_t p = 0; p < block.pixels.size(); ++p) {
            const int x = static_cast<int>(block.pixels[p]) % capture.width,
                      y = static_cast<int>(block.pixels[p]) / capture.width;
            for (size_t j = 0; j < shown.size(); ++j) {
                const Light& light = capture.lights[j];
                const float cosine = glm::dot(truth.normals[block.pixels[p]], light.direction);
                if (std::hypot(x - capture.width / 2, y - capture.height / 2) < kInside && cosine > 0.3f) {
                    direct[j].push_back(cosine);
                    shown[j].push_back(block.radianceOf(p)[j].x / (light.irradiance.x / std::numbers::pi_v<float>));
                }
            }
        }
    }
    BowlShades shades;
    for (size_t j = 0; j < shown.size(); ++j) {
        std::vector<float> dark, albedo;
        for (size_t k = 0; k < shown[j].size(); ++k) {
            if (shown[j][k] < 0.5f * direct[j][k]) {
                dark.push_back(shown[j][k]);
            }
        }
        shades.dark.push_back(medianOf(dark));
        for (size_t k = 0; k < shown[j].size(); ++k) {
            if (shown[j][k] > shades.dark[j] + 0.6f * direct[j][k]) {
                albedo.push_back((shown[j][k] - shades.dark[j]) / direct[j][k]);
            }
        }
        shades.albedo.push_back(medianOf(albedo));
    }
    return shades;
}

// The inside of a sphere's part as far as `degrees` from -axis, and what lights it through its opening.
class OpenSphere {
public:
    OpenSphere(const dvec3& axis, double degrees, int count)
        : axis_(glm::normalize(axis)), edge_(std::cos(degrees * std::numbers::pi / 180))
    {
        const dvec3 u = glm::normalize(glm::cross(axis_, dvec3(1, 0, 0))), v = glm::cross(axis_, u);
        for (int i = 0; i < count; ++i) {
            const double z = 1 - (1 - edge_) * (i + 0.5) / count, s = std::sqrt(1 - z * z),
                         phi = 2.39996322972865332 * i;
            const dvec3 place = s * std::cos(phi) * u + s * std::sin(phi) * v - z * axis_;
            nodes_.push_back({place, -place, 2 * std::numbers::pi * (1 - edge_) / count});
        }
        for (const SurfaceNode& node : nodes_) {
            factors_.push_back(
                formFactorsAt(node.place, node.normal, nodes_, [](const dvec3&, const dvec3&) { return true; }));
        }
    }

    // What its shadows show, as BowlShades does.
    double darkUnder(const dvec3& light, double albedo, int bounces) const
    {
        std::vector<dvec3> lit;
        for (const SurfaceNode& node : nodes_) {
            const double cosine = glm::dot(node.normal, light);
            const dvec3 entry = node.place + 2 * cosine * light; // the ray's other end on the sphere
            lit.push_back(dvec3(cosine > 0 && -glm::dot(entry, axis_) < edge_ ? cosine : 0.0));
        }
        const std::vector<dvec3> albedos(nodes_.size(), dvec3(albedo));
        return albedo * arriving(factors_.front(), sentAfter(bounces, factors_, albedos, lit)).x;
    }

private:
    dvec3 axis_;
    double edge_;
    std::vector<SurfaceNode> nodes_;
    std::vector<FormFactors> factors_;
};

// The renderer that made the photographs knows nothing of ours: it traces paths of eight bounces. The bowl is nearly a
// sphere's part; how much of the sphere it is and where it opens is fitted to the shadows (three numbers), how white it
// is comes from the sides that the light reaches.
TEST(RenderedBowl, ShowsInItsShadowsWhatBouncesThere)
{
    NACRE_REQUIRE_DATA("rendered/bowl_white");
    const Capture capture = loadCapture(dataFolder() / "rendered/bowl_white");
    BowlShades shades = shadesOf(capture);
    const double albedo = medianOf(shades.albedo);
    EXPECT_NEAR(albedo, 0.875, 0.02);
    const OpenSphere bowl({0.16, -0.39, 0.91}, 104, 800);
    int compared = 0;
    for (size_t j = 0; j < capture.lights.size(); ++j) {
        if (shades.dark[j] >= 0) {
            ++compared;
            const dvec3 light(capture.lights[j].direction);
            const double expected = bowl.darkUnder(light, albedo, 8);
            EXPECT_NEAR(shades.dark[j], expected, 0.025) << j; // of 0.06 to 0.31: it is not quite a sphere
            EXPECT_LT(bowl.darkUnder(light, albedo, 1), 0.7 * expected) << "most came by more than one bounce";
        }
    }
    EXPECT_GE(compared, 15);
}

} // namespace
} // namespace nacre
