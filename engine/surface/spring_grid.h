#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nacre {

// Springs between the four-neighbours of a grid: (L x)_i = sum over neighbours j of w_ij (x_i - x_j). A pixel without
// springs is not part of it. Every row and every piece of connected pixels sums to zero.
struct GridSprings {
    int width = 0;
    int height = 0;
    std::vector<double> right; // weight between pixel i and i + 1; 0 = none
    std::vector<double> down;  // weight between pixel i and i + width
    std::vector<double> links; // weight of all springs between a pixel and others that are no neighbours
    std::vector<double> diagonal;

    GridSprings(int w, int h);
    size_t size() const { return diagonal.size(); }
    void sumDiagonal(); // from right, down and links
    // L x at pixel i without the diagonal's part, negated, of neighbours alone: sum of w_ij x_j.
    double neighbours(const std::vector<double>& x, int column, int row) const;
    void apply(const std::vector<double>& x, std::vector<double>& result, int threads) const;
};

// A spring between any two pixels.
struct SpringLink {
    uint32_t first = 0;
    uint32_t second = 0;
    double weight = 0;
};

// Links by pixel: each is in the rows of both of its pixels, and all between the same two are one.
class LinkRows {
public:
    LinkRows(size_t pixels, std::vector<SpringLink> links);

    bool empty() const { return links_.empty(); }
    const std::vector<SpringLink>& rows() const { return links_; } // by their first pixel
    // Adds `factor` times the sum over a pixel's links of w_ij x_j.
    void addPull(double factor, const std::vector<double>& x, std::vector<double>& result) const;

private:
    std::vector<SpringLink> links_;
};

// Solves L x = b by conjugate gradients, preconditioned by one V-cycle over grids of half the size each, in which 2x2
// pixels move as one, with their links. x is the start and the result, up to a constant for each connected piece.
class SpringSolver {
public:
    // The grid's links and diagonal are filled in.
    SpringSolver(GridSprings grid, std::vector<SpringLink> links, int threads);

    struct Result {
        int iterations = 0;
        double residual = 0; // |b - L x| / |b|
    };
    Result solve(const std::vector<double>& b, std::vector<double>& x, double tolerance, int mostIterations);

private:
    struct Level {
        GridSprings grid;
        LinkRows links;
        std::vector<double> residual, error, scratch;
    };

    void addLevel(GridSprings grid, std::vector<SpringLink> links);
    void apply(const Level& level, const std::vector<double>& x, std::vector<double>& result) const;
    void cycle(size_t index); // the level's error from its residual
    void coarsest(Level& level);
    void smooth(Level& level, int firstColour);
    void sweep(Level& level, int firstColour, const std::vector<double>& b);

    int threads_;
    std::vector<Level> levels_;
};

} // namespace nacre
