#include "acquisition/checks/height_consistency.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>
#include <fmt/format.h>
#include <glm/geometric.hpp>
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
// Between maps that agree (up to 0.7, noisy ones 0.85) and the same turned around (from 1.4).
constexpr double kFlipped = 1.33;
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

// n.z (dp/dy - dq/dx) at a pixel, with y as it is and turned around, and how it grows with n.z + a n.x + b n.y.
struct Curl {
    double asIs = 0, flipped = 0, withX = 0, withY = 0;
};

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
            const glm::dvec3 turned(n.x, -n.y, n.z), turnedX(dx.x, -dx.y, dx.z), turnedY(dy.x, -dy.y, dy.z);
            curls.push_back({curlOf(n, dx, dy, n.z, dx.z, dy.z), curlOf(turned, turnedX, turnedY, n.z, dx.z, dy.z),
                             curlOf(n, dx, dy, n.x, dx.x, dy.x), curlOf(n, dx, dy, n.y, dx.y, dy.y)});
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
    double asIs = 0, flipped = 0, turned = 0;
    for (const Curl& curl : curls) {
        asIs += std::abs(curl.asIs);
        flipped += std::abs(curl.flipped);
    }
    if (!(asIs > 0 && flipped > 0)) {
        return result;
    }
    const Eigen::Vector2d turn = bestTurn(curls, asIs / static_cast<double>(curls.size()));
    for (const Curl& curl : curls) {
        turned += std::abs(curl.asIs + turn.dot(Eigen::Vector2d(curl.withX, curl.withY)));
    }
    result.flippedRatio = asIs / flipped;
    result.turnDegrees = {glm::degrees(std::atan(turn.x())), glm::degrees(std::atan(turn.y()))};
    result.turnedRatio = turned / asIs;
    return result;
}

std::vector<Finding> heightWarnings(const NormalMap& map)
{
    const HeightConsistency found = heightConsistencyOf(map);
    const double turn = glm::length(found.turnDegrees);
    if (found.places < kFewestPlaces) {
        return {};
    }
    if (found.flippedRatio > kFlipped) {
        return {{FindingCode::yFlipped,
                 fmt::format("the normals fit a surface {:.1f} times better with y reversed: the y of the lights "
                             "probably points down; it has to point up",
                             found.flippedRatio)}};
    }
    if (turn > kLargestTurn && found.turnedRatio < kTellingTurn) {
        return {
            {FindingCode::lightsTurned,
             fmt::format("all normals, and so all lights, seem turned by {:.0f} degrees: turned back, slopes disagree "
                         "by {:.0f} % less; check the mirror sphere's outline, or the frame of the lights",
                         turn, 100 * (1 - found.turnedRatio))}};
    }
    return {};
}

} // namespace nacre
