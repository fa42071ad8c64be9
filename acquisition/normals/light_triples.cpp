#include "acquisition/normals/light_triples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace nacre {

namespace {

// Triples of a smaller determinant (of unit vectors) lie in one plane as far as float can tell.
constexpr float kSmallestDeterminant = 1e-4f;
// Drawn for each triple that is kept: the median splits them.
constexpr size_t kDrawnPerKept = 2;

using Indices = std::array<int, 3>;

glm::mat3 matrixOf(const std::vector<Light>& lights, const Indices& t)
{
    // Rows are directions; glm is column-major.
    return glm::transpose(glm::mat3(lights[t[0]].direction, lights[t[1]].direction, lights[t[2]].direction));
}

float volume(const std::vector<Light>& lights, const Indices& t)
{
    return std::abs(glm::determinant(matrixOf(lights, t)));
}

// SplitMix64 (Steele, Lea, Flood, Fast Splittable Pseudorandom Number Generators, 2014).
uint64_t nextRandom(uint64_t& state)
{
    uint64_t z = (state += 0x9e3779b97f4a7c15ull);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
}

std::vector<Indices> allTriples(int n)
{
    std::vector<Indices> triples;
    for (int a = 0; a < n; ++a) {
        for (int b = a + 1; b < n; ++b) {
            for (int c = b + 1; c < n; ++c) {
                triples.push_back({a, b, c});
            }
        }
    }
    return triples;
}

std::vector<Indices> drawnTriples(const std::vector<Light>& lights, size_t most, uint64_t seed)
{
    std::set<Indices> drawn;
    while (drawn.size() < most * kDrawnPerKept) {
        Indices t;
        for (int& index : t) {
            index = static_cast<int>(nextRandom(seed) % lights.size());
        }
        std::sort(t.begin(), t.end());
        if (t[0] != t[1] && t[1] != t[2]) {
            drawn.insert(t);
        }
    }
    std::vector<Indices> triples(drawn.begin(), drawn.end());
    std::stable_sort(triples.begin(), triples.end(),
                     [&](const Indices& s, const Indices& t) { return volume(lights, s) > volume(lights, t); });
    triples.resize(most);
    return triples;
}

} // namespace

std::vector<glm::vec3> directionsOf(const std::vector<Light>& lights)
{
    std::vector<glm::vec3> directions;
    for (const Light& light : lights) {
        directions.push_back(light.direction);
    }
    return directions;
}

std::vector<LightTriple> makeLightTriples(const std::vector<Light>& lights, size_t most, uint64_t seed)
{
    const size_t n = lights.size();
    const size_t all = n * (n - 1) * (n - 2) / 6;
    // Twice as many draws must exist for the better half to be one.
    const bool draw = all > most * kDrawnPerKept * 2;
    std::vector<Indices> chosen = draw ? drawnTriples(lights, most, seed) : allTriples(static_cast<int>(n));
    if (!draw && chosen.size() > most) {
        std::stable_sort(chosen.begin(), chosen.end(),
                         [&](const Indices& s, const Indices& t) { return volume(lights, s) > volume(lights, t); });
        chosen.resize(most);
    }
    std::vector<LightTriple> triples;
    for (const Indices& t : chosen) {
        if (volume(lights, t) > kSmallestDeterminant) {
            triples.push_back({t[0], t[1], t[2], glm::inverse(matrixOf(lights, t))});
        }
    }
    return triples;
}

} // namespace nacre
