#pragma once
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace nacre {

// How far what a pixel shows under one light tells what it shows under another, whose directions they are. A sum of
// three independent parts: one that loses what it knows in proportion to the chord, as pictures of borders do that pass
// a pixel at any place, which cast shadows have (Matheron, The Theory of Regionalized Variables, 1971, the exponential
// scheme); one that is smooth over a radian; and Lambertian shading. Any one of them alone predicts photographs worse,
// a free plane in place of the last as well (docs/notes.md).
inline double lightCovariance(const glm::vec3& a, const glm::vec3& b)
{
    const glm::vec3 chord = a - b;
    const double square = glm::dot(chord, chord);
    return 0.5 * std::exp(-0.5 * std::sqrt(square)) + 0.5 * std::exp(-square) + double{glm::dot(a, b)};
}

} // namespace nacre
