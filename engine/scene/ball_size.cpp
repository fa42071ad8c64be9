#include "engine/scene/ball_size.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "engine/files/image.h"
#include "engine/files/measures.h"
#include "engine/scene/ball.h"
#include "shared/shading.h"

namespace nacre {
namespace {

constexpr std::array kRadianceSizes = {64, 128, 256, 512, 1024};
constexpr std::array kDisplaySizes = {320, 384, 512, 1024, 2048};
constexpr int kProbeSide = 160; // of the picture of a sphere that is compared
constexpr float kVisibleStep = 4.0f / 255;
constexpr float kFilteredStep = 1.5f / 255; // codes differ by 2 at most
constexpr int kMostFilteredSide = 512;

// Nanoseconds a texel on two cores with lavapipe, for a picture under four lights.
double rebuildCost(const BallSize& size)
{
    constexpr double kLights = 4, kRadianceTexel = 10, kDisplayTexel = 5;
    return kLights * kRadianceTexel * size.radiance * size.radiance + kDisplayTexel * size.display * size.display;
}

// From the front to grazing, every quarter turn: each lights another part of the table and meets the rim elsewhere.
std::vector<Light> probeLights()
{
    std::vector<Light> lights;
    for (int i = 0; i < 4; ++i) {
        const float polar = glm::radians(10.0f + 25.0f * i), azimuth = glm::radians(30.0f + 90.0f * i);
        lights.push_back({{std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)},
                          glm::vec3(1)});
    }
    return lights;
}

// Normals of a sphere's picture, off the centres of any ball's texels: the additive recurrence with the plastic number
// (Roberts, The Unreasonable Effectiveness of Quasirandom Sequences, 2018) fills the disc evenly.
std::vector<glm::vec3> probeNormals()
{
    std::vector<glm::vec3> normals;
    for (int i = 0; i < kProbeSide * kProbeSide; ++i) {
        const glm::dvec2 point(0.5 + 0.7548776662466927 * i, 0.5 + 0.5698402909980532 * i);
        const glm::vec2 disc(2.0 * glm::fract(point) - 1.0);
        const float square = glm::dot(disc, disc);
        if (square < 1) {
            normals.emplace_back(disc.x, disc.y, std::sqrt(1 - square));
        }
    }
    return normals;
}

bool isCloseEnough(const Image& picture, const Image& expected, float step)
{
    const std::vector<uint8_t> all(picture.pixelCount(), 1);
    size_t visible = 0;
    for (size_t i = 0; i < picture.pixelCount(); ++i) {
        const float* a = &picture.values[3 * i];
        const float* b = &expected.values[3 * i];
        const float worst = std::max({std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
        visible += worst > step * 1.001f;
    }
    return picturePsnr(picture, expected, all) >= kLeastPsnr &&
           static_cast<double>(visible) <= kLargestShare * static_cast<double>(picture.pixelCount());
}

Image pictureOf(const std::vector<glm::vec3>& radiance, float stops)
{
    Image row(static_cast<int>(radiance.size()), 1, 3);
    for (int x = 0; x < row.width; ++x) {
        row.setRgb(x, 0, radiance[x]);
    }
    return displayedImage(row, {.exposureStops = stops});
}

template <class Sample> std::vector<glm::vec3> sampled(const std::vector<glm::vec3>& normals, Sample&& sample)
{
    std::vector<glm::vec3> radiance(normals.size());
    std::transform(normals.begin(), normals.end(), radiance.begin(), sample);
    return radiance;
}

float exposureOf(const std::vector<glm::vec3>& radiance)
{
    Image row(static_cast<int>(radiance.size()), 1, 3);
    for (int x = 0; x < row.width; ++x) {
        row.setRgb(x, 0, radiance[x]);
    }
    return automaticExposure(row);
}

// The picture that a ball's is compared with.
struct Probe {
    std::vector<Light> lights = probeLights();
    std::vector<glm::vec3> normals = probeNormals();
    float stops = 0;
    Image expected;

    explicit Probe(const BrdfTable& table)
    {
        const std::vector<glm::vec3> truth = sampled(normals, [&](const glm::vec3& n) {
            return radianceUnder(lights, n, [&](const glm::vec3& l) {
                return evaluateTable(table, n, l, {0, 0, 1}).value;
            });
        });
        stops = exposureOf(truth);
        expected = pictureOf(truth, stops);
    }

    template <class Sample> bool accepts(Sample&& sample, float step) const
    {
        return isCloseEnough(pictureOf(sampled(normals, sample), stops), expected, step);
    }
};

} // namespace

BallSize measuredBallSize(const BrdfTable& table, int threads)
{
    const Probe probe(table);
    BallSize best;
    for (const int radiance : kRadianceSizes) {
        if (best.radiance != 0 && rebuildCost({radiance, kDisplaySizes.front()}) >= rebuildCost(best)) {
            break;
        }
        const Ball ball = makeBall(table, probe.lights, radiance, threads);
        for (const int display : kDisplaySizes) {
            const BallSize size{radiance, display};
            if (best.radiance != 0 && rebuildCost(size) >= rebuildCost(best)) {
                break;
            }
            if (probe.accepts([&](const glm::vec3& n) { return sampleStretchedBall(ball, display, n); },
                              kVisibleStep)) {
                best = size;
                break;
            }
        }
    }
    return best;
}

int measuredMeanBallSide(const BrdfTable& table, int threads)
{
    const Probe probe(table);
    for (int side = kRadianceSizes.front(); side <= kMostFilteredSide; side *= 2) {
        const Ball ball = makeMeanBall(table, probe.lights, side, threads);
        if (probe.accepts([&](const glm::vec3& n) { return sampleMeanBall(ball, probe.lights, n); }, kFilteredStep)) {
            return side;
        }
    }
    return 0;
}

} // namespace nacre
