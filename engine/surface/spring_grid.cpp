#include "engine/surface/spring_grid.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/files/parallel_for.h"

namespace nacre {
namespace {

constexpr int kSmallestSide = 4;     // pixels of the coarsest grid
constexpr int kCoarsestSweeps = 8;   // of both colours, there and back
constexpr size_t kRowsPerChunk = 64; // of work for one thread
// Blocks that move as one are stiffer than the smooth shapes that they stand for, by about 2 in two dimensions (Braess,
// "Towards Algebraic Multigrid for Elliptic Problems of Second Order", 1995).
constexpr double kBlockStiffness = 0.5;

// One row is too little to share among threads.
int threadsFor(const GridSprings& grid, int threads)
{
    return static_cast<size_t>(grid.height) > kRowsPerChunk ? threads : 1;
}

GridSprings coarsened(const GridSprings& fine)
{
    GridSprings coarse((fine.width + 1) / 2, (fine.height + 1) / 2);
    for (int y = 0; y < fine.height; ++y) {
        for (int x = 0; x < fine.width; ++x) {
            const size_t i = static_cast<size_t>(y) * fine.width + x;
            const size_t to = static_cast<size_t>(y / 2) * coarse.width + x / 2;
            if (x % 2 == 1) {
                coarse.right[to] += kBlockStiffness * fine.right[i];
            }
            if (y % 2 == 1) {
                coarse.down[to] += kBlockStiffness * fine.down[i];
            }
            coarse.links[to] += fine.links[i];
        }
    }
    coarse.sumDiagonal();
    return coarse;
}

// In chunks, so that the sum does not depend on the number of threads.
double dot(const std::vector<double>& a, const std::vector<double>& b, int threads)
{
    constexpr size_t kGrain = 1 << 16;
    std::vector<double> sums(a.size() / kGrain + 1, 0.0);
    parallelFor(a.size(), kGrain, threads, [&](size_t first, size_t last) {
        sums[first / kGrain] = std::inner_product(a.begin() + first, a.begin() + last, b.begin() + first, 0.0);
    });
    return std::accumulate(sums.begin(), sums.end(), 0.0);
}

// y = a x + b y
void combine(double a, const std::vector<double>& x, double b, std::vector<double>& y)
{
    for (size_t i = 0; i < y.size(); ++i) {
        y[i] = a * x[i] + b * y[i];
    }
}

} // namespace

GridSprings::GridSprings(int w, int h)
    : width(w), height(h), right(static_cast<size_t>(w) * h, 0.0), down(right.size(), 0.0), links(right.size(), 0.0),
      diagonal(right.size(), 0.0)
{
}

void GridSprings::sumDiagonal()
{
    for (size_t i = 0; i < size(); ++i) {
        const bool first = i % width == 0, top = i < static_cast<size_t>(width);
        diagonal[i] = right[i] + down[i] + links[i] + (first ? 0 : right[i - 1]) + (top ? 0 : down[i - width]);
    }
}

double GridSprings::neighbours(const std::vector<double>& x, int column, int row) const
{
    const size_t i = static_cast<size_t>(row) * width + column;
    double sum = 0;
    sum += column > 0 ? right[i - 1] * x[i - 1] : 0;
    sum += column + 1 < width ? right[i] * x[i + 1] : 0;
    sum += row > 0 ? down[i - width] * x[i - width] : 0;
    sum += row + 1 < height ? down[i] * x[i + width] : 0;
    return sum;
}

void GridSprings::apply(const std::vector<double>& x, std::vector<double>& result, int threads) const
{
    parallelFor(height, kRowsPerChunk, threadsFor(*this, threads), [&](size_t first, size_t last) {
        for (int row = static_cast<int>(first); row < static_cast<int>(last); ++row) {
            for (int column = 0; column < width; ++column) {
                const size_t i = static_cast<size_t>(row) * width + column;
                result[i] = diagonal[i] * x[i] - neighbours(x, column, row);
            }
        }
    });
}

SpringSolver::SpringSolver(GridSprings grid, std::vector<SpringLink> links, int threads)
    : threads_(threads), links_(std::move(links))
{
    for (const SpringLink& link : links_) {
        grid.links[link.first] += link.weight;
        grid.links[link.second] += link.weight;
    }
    grid.sumDiagonal();
    levels_.push_back(std::move(grid));
    while (levels_.back().width > kSmallestSide || levels_.back().height > kSmallestSide) {
        levels_.push_back(coarsened(levels_.back()));
    }
    for (const GridSprings& level : levels_) {
        residual_.emplace_back(level.size());
        error_.emplace_back(level.size());
        scratch_.emplace_back(level.size());
    }
}

// What links hold a pixel by is in its diagonal.
void SpringSolver::applyAll(const std::vector<double>& x, std::vector<double>& result) const
{
    levels_.front().apply(x, result, threads_);
    for (const SpringLink& link : links_) {
        result[link.first] -= link.weight * x[link.second];
        result[link.second] -= link.weight * x[link.first];
    }
}

// Gauss-Seidel over one colour of a chessboard, then over the other: neighbours never wait for each other.
void SpringSolver::smooth(size_t level, int firstColour)
{
    const GridSprings& grid = levels_[level];
    const std::vector<double>& b = residual_[level];
    std::vector<double>& x = error_[level];
    for (const int colour : {firstColour, 1 - firstColour}) {
        parallelFor(grid.height, kRowsPerChunk, threadsFor(grid, threads_), [&](size_t first, size_t last) {
            for (int row = static_cast<int>(first); row < static_cast<int>(last); ++row) {
                for (int column = (row + colour) % 2; column < grid.width; column += 2) {
                    const size_t i = static_cast<size_t>(row) * grid.width + column;
                    if (grid.diagonal[i] > 0) {
                        x[i] = (b[i] + grid.neighbours(x, column, row)) / grid.diagonal[i];
                    }
                }
            }
        });
    }
}

// Symmetric: the sweeps after the coarser grid are those before it, backwards.
void SpringSolver::cycle(size_t level)
{
    std::fill(error_[level].begin(), error_[level].end(), 0.0);
    if (level + 1 == levels_.size()) {
        for (int sweep = 0; sweep < kCoarsestSweeps; ++sweep) {
            smooth(level, 0);
        }
        for (int sweep = 0; sweep < kCoarsestSweeps; ++sweep) {
            smooth(level, 1);
        }
        return;
    }
    const GridSprings &fine = levels_[level], &coarse = levels_[level + 1];
    smooth(level, 0);
    fine.apply(error_[level], scratch_[level], threads_);
    std::fill(residual_[level + 1].begin(), residual_[level + 1].end(), 0.0);
    const auto blockOf = [&](int x, int y) { return static_cast<size_t>(y / 2) * coarse.width + x / 2; };
    for (int y = 0; y < fine.height; ++y) {
        for (int x = 0; x < fine.width; ++x) {
            const size_t i = static_cast<size_t>(y) * fine.width + x;
            residual_[level + 1][blockOf(x, y)] += residual_[level][i] - scratch_[level][i];
        }
    }
    cycle(level + 1);
    for (int y = 0; y < fine.height; ++y) {
        for (int x = 0; x < fine.width; ++x) {
            error_[level][static_cast<size_t>(y) * fine.width + x] += error_[level + 1][blockOf(x, y)];
        }
    }
    smooth(level, 1);
}

// Shewchuk, "An Introduction to the Conjugate Gradient Method Without the Agonizing Pain", 1994, B3.
SpringSolver::Result SpringSolver::solve(const std::vector<double>& b, std::vector<double>& x, double tolerance,
                                         int mostIterations)
{
    const GridSprings& grid = levels_.front();
    std::vector<double> direction(grid.size(), 0.0), product(grid.size());
    std::vector<double> r(grid.size());
    applyAll(x, r);
    combine(1, b, -1, r);
    const double scale = std::sqrt(dot(b, b, threads_));
    Result result;
    double before = 0;
    for (;; ++result.iterations) {
        result.residual = scale > 0 ? std::sqrt(dot(r, r, threads_)) / scale : 0;
        if (result.residual <= tolerance || result.iterations == mostIterations) {
            return result;
        }
        residual_.front() = r;
        cycle(0);
        const double now = dot(r, error_.front(), threads_);
        combine(1, error_.front(), before > 0 ? now / before : 0, direction);
        before = now;
        applyAll(direction, product);
        const double length = dot(direction, product, threads_);
        if (!(length > 0)) {
            return result;
        }
        combine(now / length, direction, 1, x);
        combine(-now / length, product, 1, r);
    }
}

} // namespace nacre
