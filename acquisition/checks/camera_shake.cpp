#include "acquisition/checks/camera_shake.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>
#include <fmt/format.h>

#include "engine/files/measures.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

constexpr int kSide = ShakeTiles::kSide;
constexpr int kMargin = 7; // of a tile, which shifts, blur and slopes look into
constexpr float kLargestShift = kMargin - 2;
constexpr size_t kMostTiles = 32, kFewestTiles = 4;
constexpr double kLeastCover = 0.25; // of a tile, by the mask
constexpr int kShakeSteps = 8, kShakeReweightings = 3;
constexpr double kLeastStep = 0.02; // pixels, of any photograph
constexpr size_t kFewestShaken = 6; // three numbers an axis are set aside

constexpr double kLeastScale = 0.02; // of outliers, in what is bright

constexpr double kLargestShake = 1; // pixels

using Plane = std::vector<float>; // kSide x kSide

// One tile as each photograph shows it, over its light's irradiance.
using Tile = std::vector<Plane>;

void blur(Plane& plane)
{
    const auto along = [&](int stride, int other) {
        Plane before = plane;
        for (int a = 0; a < kSide; ++a) {
            for (int b = 1; b + 1 < kSide; ++b) {
                const int i = a * other + b * stride;
                plane[i] = 0.25f * before[i - stride] + 0.5f * before[i] + 0.25f * before[i + stride];
            }
        }
    };
    for (int pass = 0; pass < 2; ++pass) {
        along(1, kSide);
        along(kSide, 1);
    }
}

float at(const Plane& plane, float x, float y)
{
    const int ix = static_cast<int>(std::floor(x)), iy = static_cast<int>(std::floor(y));
    const float u = x - static_cast<float>(ix), v = y - static_cast<float>(iy);
    const float* p = &plane[iy * kSide + ix];
    return (1 - v) * ((1 - u) * p[0] + u * p[1]) + v * ((1 - u) * p[kSide] + u * p[kSide + 1]);
}

std::vector<Tile> tilesOf(const Observations& seen, const ShakeTiles& tiles, const std::vector<Light>& lights)
{
    std::vector<Tile> result;
    for (const glm::ivec2& corner : tiles.corners) {
        Tile& tile = result.emplace_back(lights.size(), Plane(kSide * kSide));
        for (int y = 0; y < kSide; ++y) {
            const auto first = static_cast<uint32_t>((corner.y + y) * seen.width + corner.x);
            const size_t row = std::lower_bound(seen.pixels.begin(), seen.pixels.end(), first) - seen.pixels.begin();
            for (int x = 0; x < kSide; ++x) {
                for (size_t i = 0; i < lights.size(); ++i) {
                    tile[i][y * kSide + x] = greyOf(seen.radianceOf(row + x)[i] / lights[i].irradiance);
                }
            }
        }
        for (Plane& plane : tile) {
            blur(plane);
        }
    }
    return result;
}

using Directions = Eigen::Matrix<double, Eigen::Dynamic, 3>;

// What Lambert's law makes of a pixel's values, outliers counting little.
Eigen::VectorXd lambertian(const Directions& directions, const Eigen::VectorXd& values)
{
    Eigen::VectorXd weights = Eigen::VectorXd::Ones(values.size()), fit = values;
    for (int k = 0; k < kShakeReweightings; ++k) {
        const Eigen::Vector3d b = (directions.transpose() * weights.asDiagonal() * directions)
                                      .ldlt()
                                      .solve(directions.transpose() * (weights.asDiagonal() * values));
        fit = (directions * b).cwiseMax(0);
        const Eigen::VectorXd off = (values - fit).cwiseAbs();
        std::vector<float> sorted(off.data(), off.data() + off.size());
        const double scale = std::max(1e-9, 2.0 * quantile(sorted, 0.5));
        weights = (1 + (off / scale).array().square()).inverse();
    }
    return fit;
}

// Normal equations of a photograph's shift.
struct ShiftSums {
    Eigen::Matrix2d squares = Eigen::Matrix2d::Zero();
    Eigen::Vector2d products = Eigen::Vector2d::Zero();
};

using Shifts = std::vector<Eigen::Vector2d>; // per light, pixels

// Of one tile, photographs moved back by `shifts`.
void addTile(const Tile& tile, const Directions& directions, const Shifts& shifts, std::vector<ShiftSums>& sums)
{
    const auto n = static_cast<Eigen::Index>(tile.size());
    constexpr int kInner = kSide - 2 * kMargin + 2; // with a border for slopes
    Eigen::MatrixXd moved(n, kInner * kInner), fits(n, kInner * kInner);
    for (int y = 0; y < kInner; ++y) {
        for (int x = 0; x < kInner; ++x) {
            for (Eigen::Index i = 0; i < n; ++i) {
                const float px = static_cast<float>(x + kMargin - 1 + shifts[i].x()),
                            py = static_cast<float>(y + kMargin - 1 + shifts[i].y());
                moved(i, y * kInner + x) = at(tile[i], px, py);
            }
            fits.col(y * kInner + x) = lambertian(directions, moved.col(y * kInner + x));
        }
    }
    const Eigen::MatrixXd off = moved - fits;
    std::vector<float> sizes(off.cols()), values(off.cols());
    for (Eigen::Index i = 0; i < n; ++i) {
        for (Eigen::Index k = 0; k < off.cols(); ++k) {
            sizes[k] = static_cast<float>(std::abs(off(i, k)));
            values[k] = static_cast<float>(fits(i, k));
        }
        // Beside a black background half of a tile may fit exactly.
        const double scale = std::max({1e-9, 3.0 * quantile(sizes, 0.5), kLeastScale * quantile(values, 0.95)});
        for (int y = 1; y + 1 < kInner; ++y) {
            for (int x = 1; x + 1 < kInner; ++x) {
                const int k = y * kInner + x;
                const Eigen::Vector2d slope(fits(i, k + 1) - fits(i, k - 1), fits(i, k + kInner) - fits(i, k - kInner));
                const double r = off(i, k) / scale, weight = 1 / (1 + r * r) / (scale * scale);
                sums[i].squares += weight * slope * slope.transpose() / 4;
                sums[i].products += weight * off(i, k) * slope / 2;
            }
        }
    }
}

// Without the part that is common, or goes with the light's direction.
void setAside(const Directions& directions, Shifts& shifts)
{
    const auto n = static_cast<Eigen::Index>(shifts.size());
    Eigen::MatrixXd basis(n, 3), values(n, 2);
    for (Eigen::Index i = 0; i < n; ++i) {
        basis.row(i) << 1, directions(i, 0), directions(i, 1);
        values.row(i) = shifts[i].transpose();
    }
    const Eigen::MatrixXd left = values - basis * basis.colPivHouseholderQr().solve(values);
    for (Eigen::Index i = 0; i < n; ++i) {
        shifts[i] = left.row(i).transpose();
    }
}

// By Gauss and Newton's steps.
Shifts shiftsBy(const std::vector<const Tile*>& tiles, const Directions& directions, int threads)
{
    const auto n = static_cast<size_t>(directions.rows());
    Shifts shifts(n, Eigen::Vector2d::Zero());
    double moved = kLargestShift;
    for (int step = 0; step < kShakeSteps && moved > kLeastStep; ++step) {
        const Shifts before = shifts;
        std::vector<std::vector<ShiftSums>> parts(tiles.size(), std::vector<ShiftSums>(n));
        parallelFor(tiles.size(), 1, threads, [&](size_t first, size_t last) {
            for (size_t t = first; t < last; ++t) {
                addTile(*tiles[t], directions, shifts, parts[t]);
            }
        });
        for (size_t i = 0; i < n; ++i) {
            ShiftSums sum;
            for (const std::vector<ShiftSums>& part : parts) {
                sum.squares += part[i].squares;
                sum.products += part[i].products;
            }
            sum.squares += 1e-6 * (sum.squares.trace() + 1e-12) * Eigen::Matrix2d::Identity();
            // The photograph is off by -slope . step where it lies further on by step.
            shifts[i] -= sum.squares.inverse() * sum.products;
        }
        setAside(directions, shifts);
        moved = 0;
        for (size_t i = 0; i < n; ++i) {
            shifts[i] = shifts[i].cwiseMax(-kLargestShift).cwiseMin(kLargestShift);
            moved = std::max(moved, (shifts[i] - before[i]).cwiseAbs().maxCoeff());
        }
    }
    return shifts;
}

} // namespace

std::vector<uint8_t> ShakeTiles::mask(int width, int height) const
{
    std::vector<uint8_t> inside(static_cast<size_t>(width) * height);
    for (const glm::ivec2& corner : corners) {
        for (int y = corner.y; y < corner.y + kSide; ++y) {
            std::fill_n(inside.begin() + static_cast<ptrdiff_t>(y) * width + corner.x, kSide, uint8_t{1});
        }
    }
    return inside;
}

ShakeTiles shakeTiles(const std::vector<uint8_t>& mask, int width, int height)
{
    std::vector<glm::ivec2> all;
    for (int y = 0; y + kSide <= height; y += kSide) {
        for (int x = 0; x + kSide <= width; x += kSide) {
            size_t covered = 0;
            for (int row = y; row < y + kSide; ++row) {
                const auto first = mask.begin() + static_cast<ptrdiff_t>(row) * width + x;
                covered += std::count_if(first, first + kSide, [](uint8_t m) { return m != 0; });
            }
            if (static_cast<double>(covered) >= kLeastCover * kSide * kSide) {
                all.emplace_back(x, y);
            }
        }
    }
    ShakeTiles tiles;
    const size_t count = std::min(all.size(), kMostTiles);
    for (size_t k = 0; k < count && count >= kFewestTiles; ++k) {
        tiles.corners.push_back(all[k * all.size() / count]);
    }
    return tiles;
}

SelfChecks checkShake(const Observations& seen, const ShakeTiles& tiles, const std::vector<Light>& lights, int threads)
{
    SelfChecks checks;
    if (tiles.corners.empty() || lights.size() < kFewestShaken) {
        return checks;
    }
    Directions directions(static_cast<Eigen::Index>(lights.size()), 3);
    for (size_t i = 0; i < lights.size(); ++i) {
        const glm::vec3& l = lights[i].direction;
        directions.row(static_cast<Eigen::Index>(i)) << l.x, l.y, l.z;
    }
    const std::vector<Tile> all = tilesOf(seen, tiles, lights);
    std::vector<const Tile*> halves[2];
    for (size_t t = 0; t < all.size(); ++t) {
        halves[t % 2].push_back(&all[t]);
    }
    const Shifts a = shiftsBy(halves[0], directions, threads), b = shiftsBy(halves[1], directions, threads);
    double agreed = 0;
    for (size_t i = 0; i < lights.size(); ++i) {
        agreed += a[i].dot(b[i]);
    }
    const double shake = std::sqrt(std::max(0.0, agreed / static_cast<double>(lights.size() - 3)));
    checks.judge(
        FindingCode::cameraShake, shake, kLargestShake,
        fmt::format("the photographs are shifted against each other, by some {:.1f} pixels: the camera or the "
                    "object moved; align them by another program, or take them anew from a stand, without touching it",
                    shake));
    return checks;
}

} // namespace nacre
