#include "assets/synth/interreflection.h"

#include <numbers>

#include <glm/geometric.hpp>

namespace nacre {

FormFactors formFactorsAt(const glm::dvec3& place, const glm::dvec3& normal, const std::vector<SurfaceNode>& nodes,
                          const Sees& sees)
{
    FormFactors factors;
    for (size_t i = 0; i < nodes.size(); ++i) {
        const SurfaceNode& node = nodes[i];
        const glm::dvec3 way = node.place - place;
        // Cosines times the distance.
        const double here = glm::dot(normal, way), there = -glm::dot(node.normal, way);
        if (here > 0 && there > 0 && sees(place, node.place)) {
            const double squared = glm::dot(way, way);
            factors.push_back({static_cast<uint32_t>(i),
                               static_cast<float>(here * there * node.area / (std::numbers::pi * squared * squared))});
        }
    }
    return factors;
}

glm::dvec3 arriving(const FormFactors& factors, const std::vector<glm::dvec3>& sent)
{
    glm::dvec3 sum(0);
    for (const FormFactor& factor : factors) {
        sum += static_cast<double>(factor.share) * sent[factor.node];
    }
    return sum;
}

std::vector<glm::dvec3> sentAfter(int bounces, const std::vector<FormFactors>& factors,
                                  const std::vector<glm::dvec3>& albedos, const std::vector<glm::dvec3>& lit)
{
    std::vector<glm::dvec3> sent(lit.size(), glm::dvec3(0));
    for (int bounce = 0; bounce < bounces; ++bounce) {
        std::vector<glm::dvec3> next(lit.size());
        for (size_t i = 0; i < lit.size(); ++i) {
            next[i] = albedos[i] * (lit[i] + arriving(factors[i], sent));
        }
        sent = std::move(next);
    }
    return sent;
}

} // namespace nacre
