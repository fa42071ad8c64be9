#include "acquisition/exemplar/pixel_lattice.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include <glm/vec2.hpp>

#include "engine/files/measures.h"
#include "engine/files/parallel_for.h"

namespace nacre {

namespace {

constexpr size_t kPreparedPerTask = 1024;
constexpr size_t kMostInThinLattice = 4000;
constexpr float kLeastBright = 1e-12f; // its inverse, and the square of that, are floats

void prepareRoots(PixelLattice& lattice, int threads)
{
    const Intensities& given = lattice.intensities;
    lattice.lightCount = given.lightCount;
    lattice.stride = given.stride;
    lattice.roots.resize(given.values.size());
    lattice.bright.resize(given.pixelCount());
    lattice.middling.resize(given.pixelCount());
    parallelFor(given.pixelCount(), kPreparedPerTask, threads, [&](size_t first, size_t last) {
        std::vector<float> lit;
        for (size_t p = first; p < last; ++p) {
            const float bright = std::max(brightLevel(given.ofPixel(p)), kLeastBright);
            const float* values = given.padded(p);
            lattice.bright[p] = bright;
            for (size_t i = 0; i < given.stride; ++i) {
                lattice.roots[p * given.stride + i] = std::sqrt(std::max(values[i] / bright, 0.0f));
            }
            lit.clear();
            std::copy_if(values, values + given.lightCount, std::back_inserter(lit),
                         [](float v) { return !isClipped(v); });
            lattice.middling[p] = lit.empty() ? 0.0f : quantile(lit, kMiddling) / bright;
        }
    });
}

// The squares of the lattice that hold a pixel, in reading order; `parents` as promised.
PixelLattice squaresOf(const PixelLattice& lattice, int spacing, std::vector<int>& parents)
{
    PixelLattice coarse;
    coarse.width = (lattice.width + spacing - 1) / spacing;
    coarse.height = (lattice.height + spacing - 1) / spacing;
    coarse.index.assign(static_cast<size_t>(coarse.width) * coarse.height, -1);
    const auto squareOf = [&](uint32_t place) {
        const uint32_t width = static_cast<uint32_t>(lattice.width), step = static_cast<uint32_t>(spacing);
        return place / width / step * static_cast<uint32_t>(coarse.width) + place % width / step;
    };
    for (const uint32_t place : lattice.places) {
        coarse.index[squareOf(place)] = 0;
    }
    for (size_t square = 0; square < coarse.index.size(); ++square) {
        if (coarse.index[square] == 0) {
            coarse.index[square] = static_cast<int>(coarse.places.size());
            coarse.places.push_back(static_cast<uint32_t>(square));
        }
    }
    parents.clear();
    for (const uint32_t place : lattice.places) {
        parents.push_back(coarse.index[squareOf(place)]);
    }
    return coarse;
}

} // namespace

PixelLattice makePixelLattice(Intensities intensities, int threads)
{
    PixelLattice lattice;
    const size_t count = intensities.pixelCount();
    if (intensities.width > 0) {
        lattice.width = intensities.width;
        lattice.places = intensities.places;
        const uint32_t last = lattice.places.empty() ? 0 : lattice.places.back();
        lattice.height = static_cast<int>(last) / lattice.width + 1;
    } else {
        lattice.width = std::max<int>(1, static_cast<int>(count));
        lattice.height = 1;
        for (size_t p = 0; p < count; ++p) {
            lattice.places.push_back(static_cast<uint32_t>(p));
        }
    }
    lattice.index.assign(static_cast<size_t>(lattice.width) * lattice.height, -1);
    for (size_t p = 0; p < count; ++p) {
        lattice.index[lattice.places[p]] = static_cast<int>(p);
        lattice.rows.push_back(p);
    }
    lattice.intensities = std::move(intensities);
    prepareRoots(lattice, threads);
    return lattice;
}

PixelLattice makeThinLattice(const Intensities& intensities, int threads)
{
    PixelLattice lattice = makePixelLattice(intensities, threads);
    const double crowd = static_cast<double>(lattice.pixelCount()) / static_cast<double>(kMostInThinLattice);
    const int spacing = static_cast<int>(std::ceil(intensities.spacing * std::sqrt(std::max(1.0, crowd))));
    std::vector<int> parents;
    return spacing > 1 ? thinnedLattice(lattice, spacing, threads, parents) : lattice;
}

PixelLattice thinnedLattice(const PixelLattice& lattice, int spacing, int threads, std::vector<int>& parents)
{
    PixelLattice thin = squaresOf(lattice, spacing, parents);
    std::vector<size_t> chosen(thin.pixelCount());
    std::vector<int> distances(thin.pixelCount(), std::numeric_limits<int>::max());
    for (size_t p = 0; p < lattice.pixelCount(); ++p) {
        const int x = static_cast<int>(lattice.places[p]) % lattice.width % spacing,
                  y = static_cast<int>(lattice.places[p]) / lattice.width % spacing;
        const int dx = 2 * x + 1 - spacing, dy = 2 * y + 1 - spacing, distance = dx * dx + dy * dy;
        if (distance < distances[parents[p]]) {
            distances[parents[p]] = distance;
            chosen[parents[p]] = p;
        }
    }
    for (const size_t p : chosen) {
        thin.rows.push_back(lattice.rows[p]);
    }
    thin.intensities = selectPixels(lattice.intensities, chosen);
    thin.spacing = lattice.spacing * spacing;
    prepareRoots(thin, threads);
    return thin;
}

// From all pixels at once, a step outwards at a time.
std::vector<int> nearestPixels(const PixelLattice& lattice)
{
    std::vector<int> nearest = lattice.index;
    std::vector<uint32_t> reached = lattice.places;
    for (size_t next = 0; next < reached.size(); ++next) {
        const int x = static_cast<int>(reached[next]) % lattice.width,
                  y = static_cast<int>(reached[next]) / lattice.width;
        for (const glm::ivec2& step : {glm::ivec2(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
            const int u = x + step.x, v = y + step.y;
            const bool isInside = u >= 0 && v >= 0 && u < lattice.width && v < lattice.height;
            if (isInside && nearest[static_cast<size_t>(v) * lattice.width + u] < 0) {
                nearest[static_cast<size_t>(v) * lattice.width + u] = nearest[reached[next]];
                reached.push_back(static_cast<uint32_t>(v * lattice.width + u));
            }
        }
    }
    return nearest;
}

} // namespace nacre
