#include "engine/surface/height_from_normals.h"

#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include "engine/files/parallel_for.h"

namespace nacre {
namespace {

// Springs between the four-neighbours of a grid: (L x)_i = sum over neighbours j of w_ij (x_i - x_j). A pixel without
// springs is not part of it. Every row and every piece of connected pixels sums to zero.
struct GridLaplacian {
    int width = 0;
    int height = 0;
    std::vector<double> right; // weight between pixel i and i + 1; 0 = none
    std::vector<double> down;  // weight between pixel i and i + width
    std::vector<double> diagonal;

    GridLaplacian(int w, int h);
    size_t size() const { return diagonal.size(); }
    void sumDiagonal(); // from right and down
    // L x at pixel i without the diagonal's part, negated: sum of w_ij x_j.
    double neighbours(const std::vector<double>& x, int column, int row) const;
    void apply(const std::vector<double>& x, std::vector<double>& result, int threads) const;
};

// Solves L x = b by conjugate gradients, preconditioned by one V-cycle over grids of half the size each, in which 2x2
// pixels move as one. x is the start and the result, up to a constant for each connected piece.
class GridSolver {
public:
    GridSolver(GridLaplacian finest, int threads);

    struct Result {
        int iterations = 0;
        double residual = 0; // |b - L x| / |b|
    };
    Result solve(const std::vector<double>& b, std::vector<double>& x, double tolerance, int mostIterations);

private:
    void cycle(size_t level); // error_[level] from residual_[level]
    void smooth(size_t level, int firstColour);

    int threads_;
    std::vector<GridLaplacian> levels_;
    std::vector<std::vector<double>> residual_, error_, scratch_; // one a level
};

constexpr int kSmallestSide = 4;     // pixels of the coarsest grid
constexpr int kCoarsestSweeps = 8;   // of both colours, there and back
constexpr size_t kRowsPerChunk = 64; // of work for one thread
// Blocks that move as one are stiffer than the smooth shapes that they stand for, by about 2 in two dimensions (Braess,
// "Towards Algebraic Multigrid for Elliptic Problems of Second Order", 1995).
constexpr double kBlockStiffness = 0.5;

// One row is too little to share among threads.
int threadsFor(const GridLaplacian& grid, int threads)
{
    return static_cast<size_t>(grid.height) > kRowsPerChunk ? threads : 1;
}

GridLaplacian coarsened(const GridLaplacian& fine)
{
    GridLaplacian coarse((fine.width + 1) / 2, (fine.height + 1) / 2);
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

GridLaplacian::GridLaplacian(int w, int h)
    : width(w), height(h), right(static_cast<size_t>(w) * h, 0.0), down(right.size(), 0.0), diagonal(right.size(), 0.0)
{
}

void GridLaplacian::sumDiagonal()
{
    for (size_t i = 0; i < size(); ++i) {
        const bool first = i % width == 0, top = i < static_cast<size_t>(width);
        diagonal[i] = right[i] + down[i] + (first ? 0 : right[i - 1]) + (top ? 0 : down[i - width]);
    }
}

double GridLaplacian::neighbours(const std::vector<double>& x, int column, int row) const
{
    const size_t i = static_cast<size_t>(row) * width + column;
    double sum = 0;
    sum += column > 0 ? right[i - 1] * x[i - 1] : 0;
    sum += column + 1 < width ? right[i] * x[i + 1] : 0;
    sum += row > 0 ? down[i - width] * x[i - width] : 0;
    sum += row + 1 < height ? down[i] * x[i + width] : 0;
    return sum;
}

void GridLaplacian::apply(const std::vector<double>& x, std::vector<double>& result, int threads) const
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

GridSolver::GridSolver(GridLaplacian finest, int threads) : threads_(threads)
{
    levels_.push_back(std::move(finest));
    while (levels_.back().width > kSmallestSide || levels_.back().height > kSmallestSide) {
        levels_.push_back(coarsened(levels_.back()));
    }
    for (const GridLaplacian& level : levels_) {
        residual_.emplace_back(level.size());
        error_.emplace_back(level.size());
        scratch_.emplace_back(level.size());
    }
}

// Gauss-Seidel over one colour of a chessboard, then over the other: neighbours never wait for each other.
void GridSolver::smooth(size_t level, int firstColour)
{
    const GridLaplacian& grid = levels_[level];
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
void GridSolver::cycle(size_t level)
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
    const GridLaplacian &fine = levels_[level], &coarse = levels_[level + 1];
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
GridSolver::Result GridSolver::solve(const std::vector<double>& b, std::vector<double>& x, double tolerance,
                                     int mostIterations)
{
    const GridLaplacian& grid = levels_.front();
    std::vector<double> direction(grid.size(), 0.0), product(grid.size());
    std::vector<double> r(grid.size());
    grid.apply(x, r, threads_);
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
        grid.apply(direction, product, threads_);
        const double length = dot(direction, product, threads_);
        if (!(length > 0)) {
            return result;
        }
        combine(now / length, direction, 1, x);
        combine(-now / length, product, 1, r);
    }
}

// 84 degrees: a wall that is steeper is drawn so steep.
constexpr float kLeastZ = 0.1f;

// An error of the normal's angle moves its slope by 1 / nz^2 of it, hence the inverse variance nz^4, here shared by the
// pair.
double weightOf(const NormalMap& map, size_t a, size_t b)
{
    const double za = std::max(map.normals[a].z, kLeastZ), zb = std::max(map.normals[b].z, kLeastZ);
    const float confidence = std::min(map.confidence[a], map.confidence[b]);
    return confidence > 0 ? confidence * za * za * zb * zb : 0.0;
}

struct Equations {
    GridLaplacian springs;
    std::vector<double> pull; // right side
};

// Minimum of sum w (z_j - z_i - rise)^2, the rise between two pixels by the trapezoidal rule.
Equations equationsOf(const NormalMap& map)
{
    Equations equations{GridLaplacian(map.width, map.height), std::vector<double>(map.normals.size(), 0.0)};
    const auto join = [&](size_t from, size_t to, double& spring, bool vertical) {
        const double weight = weightOf(map, from, to);
        if (weight == 0) {
            return;
        }
        const glm::vec2 slope =
            0.5f * (slopeOfNormal(map.normals[from], kLeastZ) + slopeOfNormal(map.normals[to], kLeastZ));
        const double rise = vertical ? -slope.y : slope.x; // rows go down
        spring = weight;
        equations.pull[to] += weight * rise;
        equations.pull[from] -= weight * rise;
    };
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            const size_t i = map.index(x, y);
            if (x + 1 < map.width) {
                join(i, i + 1, equations.springs.right[i], false);
            }
            if (y + 1 < map.height) {
                join(i, i + map.width, equations.springs.down[i], true);
            }
        }
    }
    equations.springs.sumDiagonal();
    return equations;
}

// For each pixel with data, the first pixel of its piece; elsewhere itself.
std::vector<size_t> pieceRoots(const GridLaplacian& springs)
{
    std::vector<size_t> parent(springs.size());
    std::iota(parent.begin(), parent.end(), size_t{0});
    const auto rootOf = [&](size_t i) {
        while (parent[i] != i) {
            i = parent[i] = parent[parent[i]];
        }
        return i;
    };
    const auto unite = [&](size_t a, size_t b) {
        const size_t rootA = rootOf(a), rootB = rootOf(b);
        parent[std::max(rootA, rootB)] = std::min(rootA, rootB);
    };
    for (size_t i = 0; i < parent.size(); ++i) {
        if (springs.right[i] > 0) {
            unite(i, i + 1);
        }
        if (springs.down[i] > 0) {
            unite(i, i + springs.width);
        }
    }
    for (size_t i = 0; i < parent.size(); ++i) {
        parent[i] = rootOf(i);
    }
    return parent;
}

// Takes each piece's mean away and returns how many pieces there are.
size_t centrePieces(const NormalMap& map, const std::vector<size_t>& roots, std::vector<double>& height)
{
    std::vector<double> sums(height.size(), 0.0);
    std::vector<size_t> counts(height.size(), 0);
    size_t pieces = 0;
    for (size_t i = 0; i < height.size(); ++i) {
        if (map.confidence[i] > 0) {
            pieces += roots[i] == i;
            sums[roots[i]] += height[i];
            ++counts[roots[i]];
        }
    }
    for (size_t i = 0; i < height.size(); ++i) {
        height[i] = map.confidence[i] > 0 ? height[i] - sums[roots[i]] / static_cast<double>(counts[roots[i]]) : 0.0;
    }
    return pieces;
}

} // namespace

IntegratedHeight heightFromNormals(const NormalMap& normals, const IntegrationOptions& options)
{
    Equations equations = equationsOf(normals);
    const std::vector<size_t> roots = pieceRoots(equations.springs);
    std::vector<double> height(normals.normals.size(), 0.0);
    GridSolver solver(std::move(equations.springs), options.threads);
    const GridSolver::Result solved = solver.solve(equations.pull, height, options.tolerance, options.mostIterations);

    IntegratedHeight result;
    result.iterations = solved.iterations;
    result.residual = solved.residual;
    result.pieces = centrePieces(normals, roots, height);
    result.height = Image(normals.width, normals.height, 1);
    std::transform(height.begin(), height.end(), result.height.values.begin(),
                   [](double z) { return static_cast<float>(z); });
    return result;
}

} // namespace nacre
