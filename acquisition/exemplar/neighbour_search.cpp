#include "acquisition/exemplar/neighbour_search.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>

#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

constexpr size_t kSearchedPerTask = 512;
constexpr std::array<glm::ivec2, 4> kBeside{glm::ivec2(1, 0), {-1, 0}, {0, 1}, {0, -1}};

struct PixelSearch {
    const MatchModel& model;
    const PixelLattice& lattice;
    size_t pixel;
    BallMatch best{};
    bool triesOnce = false; // no row twice, whatever the scale that it would be tried from
    std::vector<int> tried{};

    void start(const BallMatch& match)
    {
        const BallGrid& grid = *model.ball.grid;
        best = match;
        best.row = grid.rowAt(match.texel);
        if (best.row < 0) {
            best.texel = glm::vec2(static_cast<float>(grid.size - 1) / 2);
            best.row = grid.rowAt(best.texel);
        }
        if (match.cost > 1 || match.row != best.row) {
            const BallMatch there = matchAtRow(model, lattice, pixel, best.row, match.scale);
            best.cost = there.cost;
            best.scale = there.scale;
        }
    }

    void step(const std::vector<int>& steps)
    {
        for (const int step : steps) {
            const BallMatch from = best;
            for (const glm::ivec2& beside : kBeside) {
                consider(glm::round(from.texel + static_cast<float>(step) * glm::vec2(beside)), from.scale);
            }
        }
    }

    void consider(const glm::vec2& texel, float scale)
    {
        const int row = model.ball.grid->rowAt(texel);
        if (row < 0 || row == best.row || std::find(tried.begin(), tried.end(), row) != tried.end()) {
            return;
        }
        if (triesOnce) {
            tried.push_back(row);
        }
        BallMatch match = matchAtRow(model, lattice, pixel, row, scale);
        if (match.cost < best.cost) {
            match.texel = texel;
            best = match;
        }
    }
};

void searchPixel(PixelSearch& search, const std::vector<BallMatch>& matches, const std::vector<int>& steps,
                 std::span<const glm::vec2> extra)
{
    const PixelLattice& lattice = search.lattice;
    const int place = static_cast<int>(lattice.places[search.pixel]), x = place % lattice.width,
              y = place / lattice.width;
    for (const glm::ivec2& beside : kBeside) {
        const int u = x + beside.x, v = y + beside.y;
        const bool isInside = u >= 0 && v >= 0 && u < lattice.width && v < lattice.height;
        const int other = isInside ? lattice.index[static_cast<size_t>(v) * lattice.width + u] : -1;
        if (other >= 0) {
            search.consider(matches[other].texel,
                            matches[other].scale * lattice.bright[other] / lattice.bright[search.pixel]);
        }
    }
    if (!extra.empty()) {
        search.consider(extra[search.pixel], search.best.scale);
    }
    search.step(steps);
}

} // namespace

void sweepMatches(const MatchModel& model, const PixelLattice& lattice, const std::vector<int>& steps,
                  std::span<const glm::vec2> extra, int threads, std::vector<BallMatch>& matches)
{
    const uint32_t width = static_cast<uint32_t>(lattice.width);
    for (const uint32_t colour : {0u, 1u}) {
        parallelFor(lattice.pixelCount(), kSearchedPerTask, threads, [&](size_t first, size_t last) {
            for (size_t p = first; p < last; ++p) {
                const uint32_t place = lattice.places[p];
                if ((place % width + place / width) % 2 == colour) {
                    PixelSearch search{model, lattice, p};
                    search.start(matches[p]);
                    searchPixel(search, matches, steps, extra);
                    matches[p] = search.best;
                }
            }
        });
    }
}

BallMatch bestMatch(const MatchModel& model, const PixelLattice& lattice, size_t pixel,
                    std::span<const BallMatch> candidates, const std::vector<int>& steps)
{
    PixelSearch search{model, lattice, pixel};
    search.triesOnce = true;
    search.tried.reserve(candidates.size() + kBeside.size() * steps.size());
    search.start(candidates.front());
    for (const BallMatch& candidate : candidates.subspan(1)) {
        search.consider(candidate.texel, candidate.scale);
    }
    search.step(steps);
    return polishedMatch(model, lattice, pixel, search.best);
}

void polishMatches(const MatchModel& model, const PixelLattice& lattice, int threads, std::vector<BallMatch>& matches)
{
    parallelFor(lattice.pixelCount(), kSearchedPerTask, threads, [&](size_t first, size_t last) {
        for (size_t p = first; p < last; ++p) {
            matches[p] = polishedMatch(model, lattice, p, matches[p]);
        }
    });
}

} // namespace nacre
