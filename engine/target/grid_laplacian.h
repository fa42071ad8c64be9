#pragma once
#include <cstddef>
#include <vector>

namespace nacre {

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

} // namespace nacre
