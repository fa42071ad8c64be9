#pragma once
#include <functional>
#include <span>

#include <glm/geometric.hpp>

#include "engine/brdf/brdf_models.h"
#include "engine/files/image.h"
#include "engine/lights/light.h"
#include "shared/shading.h"

namespace nacre {

// What a point that faces n sends to v = (0,0,1); f(l) is its BRDF's value for a light.
template <class Brdf> glm::vec3 radianceUnder(std::span<const Light> lights, const glm::vec3& n, const Brdf& f)
{
    glm::vec3 sum(0);
    for (const Light& light : lights) {
        const float nDotL = glm::dot(n, light.direction);
        if (nDotL > 0) {
            sum += radianceFromBrdf(f(light.direction), light.irradiance, nDotL);
        }
    }
    return sum;
}

// Linear radiance of a ball of the material that fills a square picture, seen from the front, black around it. The
// model is asked itself, so that a small picture needs no table.
Image materialBall(const BrdfModel& model, std::span<const Light> lights, int size, int threads = 0);
// The same of any f at the normal, the light's direction and the view.
using LitAndSeen = std::function<glm::vec3(const glm::vec3& n, const glm::vec3& l, const glm::vec3& v)>;
Image materialBall(const LitAndSeen& f, std::span<const Light> lights, int size, int threads = 0);

// How lists show a material: under the key light in dim even surroundings, which come as the directional albedo, so
// that the highlights of mirrors are not those of single lights.
Image materialThumbnail(const BrdfModel& model, int size);

// The reference ball: a material under distant lights, seen from v = (0,0,1), as radiance over the disc of normals on
// the grid of shaders/shared/ball.h. With the view fixed, it answers every pixel of any surface of that material.
struct Ball {
    Image radiance; // size x size, RGB; beyond the rim the rim's values, so that filtering reads no black
};

// All lights collapsed, size x size texels (size >= 2).
Ball makeBall(const BrdfTable& table, std::span<const Light> lights, int size, int threads = 0);

// Bilinear, for a unit normal with z >= 0.
glm::vec3 sampleBall(const Ball& ball, const glm::vec3& normal);

// A ball with the mean of f over the lights (shareInMean) in place of radiance, as pages have it, and the radiance by
// it.
Ball makeMeanBall(const BrdfTable& table, std::span<const Light> lights, int size, int threads = 0);
glm::vec3 sampleMeanBall(const Ball& ball, std::span<const Light> lights, const glm::vec3& normal);

// What the ball path of the renderer has for the normal: the nearest texel of the ball stretched (bilinearly) to
// `displaySize` texels across.
glm::vec3 sampleStretchedBall(const Ball& ball, int displaySize, const glm::vec3& normal);

} // namespace nacre
