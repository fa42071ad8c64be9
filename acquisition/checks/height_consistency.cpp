#include "acquisition/checks/height_consistency.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/trigonometric.hpp>

namespace nacre {

namespace {

// Slopes between pixels of a large map are noise: it is averaged to about so many pixels across.
constexpr int kAcross = 96;
// Steeper normals lie at rims and folds, where slopes are not those of a height.
constexpr float kLeastZ = 0.35f;
constexpr float kLeastConfidence = 0.3f;
constexpr size_t kFewestPlaces = 100;
constexpr int kReweightings = 10;

// Nearly all of the outline.
constexpr double kHollow = 0.8;

// Of the eight ways to lay x and y along the picture's sides integrability tells four pairs apart: each and the same
// with both axes reversed. These three are not the right one.
struct Axes {
    glm::dmat2 change;    // of what was given to what is right
    const char* text;     // what is wrong with the lights
    const char* reversed; // the same, both axes reversed
};
const std::array<Axes, 3> kAxes = {{
    {{1, 0, 0, -1}, "have y reversed: it has to point up", "have x reversed: it has to point right"},
    {{0, 1, 1, 0}, "have x and y exchanged", "have x and y exchanged and reversed"},
    {{0, 1, -1, 0}, "are turned a quarter clockwise", "are turned a quarter counter-clockwise"},
}};

// Real maps ask for some turn, which then explains little.
constexpr double kLargestTurn = 3; // degrees
constexpr double kTellingTurn = 0.75;

// Mean normals of boxes with a normal everywhere.
NormalMap averaged(const NormalMap& map, int box)
{
    NormalMap small(map.width / box, map.height / box);
    for (int y = 0; y < small.height; ++y) {
        for (int x = 0; x < small.width; ++x) {
            glm::vec3 sum(0);
            float least = 1;
            for (int k = 0; k < box * box; ++k) {
                const size_t i = map.index(x * box + k % box, y * box + k / box);
                sum += map.normals[i];
                least = std::min(least, map.confidence[i]);
            }
            const float length = glm::length(sum);
            small.normals[small.index(x, y)] = length > 0 ? sum / length : glm::vec3(0);
            small.confidence[small.index(x, y)] = length > 0 ? least : 0;
        }
    }
    return small;
}

// n.z (dp/dy - dq/dx) at a pixel, with the axes as they are and as kAxes has them, and how it grows with
// n.z + a n.x + b n.y.
struct Curl {
    double asIs = 0, withX = 0, withY = 0;
    std::array<double, 3> changed{};
};

glm::dvec3 changed(const glm::dmat2& axes, const glm::dvec3& v)
{
    return {axes * glm::dvec2(v), v.z};
}

// Of n = (x, y, z) with its derivatives by x and y: z^2 (dp/dy - dq/dx) is linear in z.
double curlOf(const glm::dvec3& n, const glm::dvec3& dx, const glm::dvec3& dy, double z, double zx, double zy)
{
    return (z * dy.x - n.x * zy - z * dx.y + n.y * zx) / (n.z * n.z);
}

std::vector<Curl> curlsOf(const NormalMap& map)
{
    std::vector<Curl> curls;
    for (int y = 1; y + 1 < map.height; ++y) {
        for (int x = 1; x + 1 < map.width; ++x) {
            const size_t i = map.index(x, y), up = i - map.width, down = i + map.width;
            const size_t all[] = {i, i - 1, i + 1, up, down};
            if (std::any_of(std::begin(all), std::end(all), [&](size_t k) {
                    return map.confidence[k] < kLeastConfidence || map.normals[k].z < kLeastZ;
                })) {
                continue;
            }
            const glm::dvec3 n(map.normals[i]), dx = 0.5 * glm::dvec3(map.normals[i + 1] - map.normals[i - 1]),
                                                dy = 0.5 * glm::dvec3(map.normals[up] - map.normals[down]);
            Curl curl{curlOf(n, dx, dy, n.z, dx.z, dy.z),
                      curlOf(n, dx, dy, n.x, dx.x, dy.x),
                      curlOf(n, dx, dy, n.y, dx.y, dy.y),
                      {}};
            std::transform(kAxes.begin(), kAxes.end(), curl.changed.begin(), [&](const Axes& a) {
                return curlOf(changed(a.change, n), changed(a.change, dx), changed(a.change, dy), n.z, dx.z, dy.z);
            });
            curls.push_back(curl);
        }
    }
    return curls;
}

// The least sum of absolute curls, by reweighted least squares.
Eigen::Vector2d bestTurn(const std::vector<Curl>& curls, double scale)
{
    Eigen::Vector2d turn(0, 0);
    for (int step = 0; step < kReweightings; ++step) {
        Eigen::Matrix2d products = Eigen::Matrix2d::Identity() * 1e-12;
        Eigen::Vector2d right(0, 0);
        for (const Curl& curl : curls) {
            const Eigen::Vector2d with(curl.withX, curl.withY);
            const double left = curl.asIs + turn.dot(with), weight = 1 / (std::abs(left) + 0.1 * scale);
            products += weight * with * with.transpose();
            right -= weight * curl.asIs * with;
        }
        turn = products.ldlt().solve(right);
    }
    return turn;
}

} // namespace

HeightConsistency heightConsistencyOf(const NormalMap& map)
{
    const int box = std::max(1, std::min(map.width, map.height) / kAcross);
    const std::vector<Curl> curls = curlsOf(box > 1 ? averaged(map, box) : map);
    HeightConsistency result;
    result.places = curls.size();
    double asIs = 0, turned = 0;
    std::array<double, 3> mixed{};
    for (const Curl& curl : curls) {
        asIs += std::abs(curl.asIs);
        for (size_t k = 0; k < mixed.size(); ++k) {
            mixed[k] += std::abs(curl.changed[k]);
        }
    }
    if (!(asIs > 0 && *std::min_element(mixed.begin(), mixed.end()) > 0)) {
        return result;
    }
    const Eigen::Vector2d turn = bestTurn(curls, asIs / static_cast<double>(curls.size()));
    for (const Curl& curl : curls) {
        turned += std::abs(curl.asIs + turn.dot(Eigen::Vector2d(curl.withX, curl.withY)));
    }
    std::transform(mixed.begin(), mixed.end(), result.axesRatios.begin(), [&](double other) { return asIs / other; });
    result.turnDegrees = {glm::degrees(std::atan(turn.x())), glm::degrees(std::atan(turn.y()))};
    result.turnedRatio = turned / asIs;
    return result;
}

namespace {

// How far normals where the map ends point out of it, on the whole: 1 out, as on what bulges, -1 into it, as in what is
// hollow.
double bulge(const NormalMap& map, const glm::dmat2& axes)
{
    double outward = 0, all = 0;
    for (int y = 1; y + 1 < map.height; ++y) {
        for (int x = 1; x + 1 < map.width; ++x) {
            const auto inside = [&](int dx, int dy) { return map.confidence[map.index(x + dx, y + dy)] > 0 ? 1 : 0; };
            const glm::dvec2 out(inside(-1, 0) - inside(1, 0), inside(0, 1) - inside(0, -1)); // y up
            const double share = inside(0, 0) * glm::dot(axes * glm::dvec2(map.normals[map.index(x, y)]), out);
            outward += share;
            all += std::abs(share);
        }
    }
    return all > 0 ? outward / all : 0;
}

} // namespace

SelfChecks checkHeight(const NormalMap& map)
{
    const HeightConsistency found = heightConsistencyOf(map);
    SelfChecks checks;
    if (found.places < kFewestPlaces) {
        return checks;
    }
    const auto best = std::max_element(found.axesRatios.begin(), found.axesRatios.end());
    const Axes& axes = kAxes[best - found.axesRatios.begin()];
    checks.judge(FindingCode::axesMixed, *best, kMixedAxes,
                 fmt::format("all lights probably {}; put right, normals fit a surface {:.1f} times better",
                             bulge(map, axes.change) >= 0 ? axes.text : axes.reversed, *best));
    const double turn = glm::length(found.turnDegrees);
    if (checks.findings.empty()) {
        checks.judge(FindingCode::lightsTurned, found.turnedRatio < kTellingTurn ? turn : 0, kLargestTurn,
                     fmt::format("all normals, and so all lights, seem turned by {:.0f} degrees: turned back, slopes "
                                 "disagree by {:.0f} % less; check the mirror sphere's outline, or the frame of the "
                                 "lights",
                                 turn, 100 * (1 - found.turnedRatio)));
    }
    if (checks.findings.empty() && bulge(map, glm::dmat2(1)) < -kHollow) {
        const Finding hollow{FindingCode::hollow, "by its outline the object is hollow; if it bulges, x and y of all "
                                                  "lights are reversed"};
        checks.findings.push_back(hollow);
    }
    return checks;
}

} // namespace nacre
