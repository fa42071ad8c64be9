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
        }
    }
    return coarse;
}

std::vector<SpringLink> coarsened(const LinkRows& fine, int width, int coarseWidth)
{
    const auto blockOf = [&](uint32_t pixel) {
        const uint32_t x = pixel % static_cast<uint32_t>(width), y = pixel / static_cast<uint32_t>(width);
        return y / 2 * static_cast<uint32_t>(coarseWidth) + x / 2;
    };
    std::vector<SpringLink> coarse;
    for (const SpringLink& link : fine.rows()) {
        if (link.first < link.second) { // once, and not from its other row
            coarse.push_back({blockOf(link.first), blockOf(link.second), link.weight});
        }
    }
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

LinkRows::LinkRows(size_t pixels, std::vector<SpringLink> links)
{
    std::erase_if(links, [](const SpringLink& link) { return link.first == link.second; });
    std::vector<uint32_t> starts(pixels + 1, 0);
    for (const SpringLink& link : links) {
        ++starts[link.first + 1];
        ++starts[link.second + 1];
    }
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    std::vector<SpringLink> rows(2 * links.size());
    std::vector<uint32_t> ends(starts.begin(), starts.end() - 1);
    for (const SpringLink& link : links) {
        rows[ends[link.first]++] = link;
        rows[ends[link.second]++] = {link.second, link.first, link.weight};
    }
    for (size_t pixel = 0; pixel < pixels; ++pixel) {
        const auto first = rows.begin() + starts[pixel], end = rows.begin() + starts[pixel + 1];
        std::stable_sort(first, end, [](const SpringLink& a, const SpringLink& b) { return a.second < b.second; });
        for (auto link = first; link != end; ++link) {
            const bool isSame = link != first && links_.back().second == link->second;
            isSame ? void(links_.back().weight += link->weight) : links_.push_back(*link);
        }
    }
}

void LinkRows::addPull(double factor, const std::vector<double>& x, std::vector<double>& result) const
{
    for (const SpringLink& link : links_) {
        result[link.first] += factor * link.weight * x[link.second];
    }
}

SpringSolver::SpringSolver(GridSprings grid, std::vector<SpringLink> links, int threads) : threads_(threads)
{
    addLevel(std::move(grid), std::move(links));
    while (levels_.back().grid.width > kSmallestSide || levels_.back().grid.height > kSmallestSide) {
        const Level& fine = levels_.back();
        GridSprings coarse = coarsened(fine.grid);
        std::vector<SpringLink> coarseLinks = coarsened(fine.links, fine.grid.width, coarse.width);
        addLevel(std::move(coarse), std::move(coarseLinks));
    }
}

void SpringSolver::addLevel(GridSprings grid, std::vector<SpringLink> links)
{
    const size_t size = grid.size();
    LinkRows rows(size, std::move(links));
    std::fill(grid.links.begin(), grid.links.end(), 0.0);
    for (const SpringLink& link : rows.rows()) {
        grid.links[link.first] += link.weight;
    }
    grid.sumDiagonal();
    levels_.push_back({std::move(grid), std::move(rows), std::vector<double>(size), std::vector<double>(size),
                       std::vector<double>(size)});
}

// What links hold a pixel by is in its diagonal.
void SpringSolver::apply(const Level& level, const std::vector<double>& x, std::vector<double>& result) const
{
    level.grid.apply(x, result, threads_);
    level.links.addPull(-1, x, result);
}

// Gauss-Seidel over one colour of a chessboard, then over the other: neighbours never wait for each other.
void SpringSolver::sweep(Level& level, int firstColour, const std::vector<double>& b)
{
    const GridSprings& grid = level.grid;
    std::vector<double>& x = level.error;
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

// Links pull with what was there before the sweep.
void SpringSolver::smooth(Level& level, int firstColour)
{
    if (level.links.empty()) {
        sweep(level, firstColour, level.residual);
        return;
    }
    level.scratch = level.residual;
    level.links.addPull(1, level.error, level.scratch);
    sweep(level, firstColour, level.scratch);
}

void SpringSolver::coarsest(Level& level)
{
    for (const int firstColour : {0, 1}) {
        for (int i = 0; i < kCoarsestSweeps; ++i) {
            smooth(level, firstColour);
        }
    }
}

// Symmetric: the sweep after the coarser grid is that before it, backwards.
void SpringSolver::cycle(size_t index)
{
    Level& fine = levels_[index];
    std::fill(fine.error.begin(), fine.error.end(), 0.0);
    if (index + 1 == levels_.size()) {
        coarsest(fine);
        return;
    }
    Level& coarse = levels_[index + 1];
    sweep(fine, 0, fine.residual); // from 0, where links do not pull
    apply(fine, fine.error, fine.scratch);
    std::fill(coarse.residual.begin(), coarse.residual.end(), 0.0);
    const auto blockOf = [&](int x, int y) { return static_cast<size_t>(y / 2) * coarse.grid.width + x / 2; };
    for (int y = 0; y < fine.grid.height; ++y) {
        for (int x = 0; x < fine.grid.width; ++x) {
            const size_t i = static_cast<size_t>(y) * fine.grid.width + x;
            coarse.residual[blockOf(x, y)] += fine.residual[i] - fine.scratch[i];
        }
    }
    cycle(index + 1);
    for (int y = 0; y < fine.grid.height; ++y) {
        for (int x = 0; x < fine.grid.width; ++x) {
            fine.error[static_cast<size_t>(y) * fine.grid.width + x] += coarse.error[blockOf(x, y)];
        }
    }
    smooth(fine, 1);
}

// Shewchuk, "An Introduction to the Conjugate Gradient Method Without the Agonizing Pain", 1994, B3.
SpringSolver::Result SpringSolver::solve(const std::vector<double>& b, std::vector<double>& x, double tolerance,
                                         int mostIterations)
{
    Level& fine = levels_.front();
    std::vector<double> direction(fine.grid.size(), 0.0), product(fine.grid.size());
    std::vector<double> r(fine.grid.size());
    apply(fine, x, r);
    combine(1, b, -1, r);
    const double scale = std::sqrt(dot(b, b, threads_));
    Result result;
    double before = 0;
    for (;; ++result.iterations) {
        result.residual = scale > 0 ? std::sqrt(dot(r, r, threads_)) / scale : 0;
        if (result.residual <= tolerance || result.iterations == mostIterations) {
            return result;
        }
        fine.residual = r;
        cycle(0);
        const double now = dot(r, fine.error, threads_);
        combine(1, fine.error, before > 0 ? now / before : 0, direction);
        before = now;
        apply(fine, direction, product);
        const double length = dot(direction, product, threads_);
        if (!(length > 0)) {
            return result;
        }
        combine(now / length, direction, 1, x);
        combine(-now / length, product, 1, r);
    }
}

} // namespace nacre
