#include "acquisition/lights/well_spread_lights.h"

#include <algorithm>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "engine/files/error.h"

namespace nacre {

std::vector<size_t> farthestFirst(const std::vector<glm::vec3>& directions, const std::vector<size_t>& candidates,
                                  size_t count)
{
    std::vector<size_t> chosen;
    // Of each candidate: the largest cosine to a chosen one, which falls as the smallest angle grows.
    std::vector<float> nearness(candidates.size(), -2.0f);
    std::vector<bool> taken(candidates.size(), false);
    while (chosen.size() < count) {
        size_t next = candidates.size();
        for (size_t j = 0; j < candidates.size(); ++j) {
            if (!taken[j] && (next == candidates.size() || nearness[j] < nearness[next])) {
                next = j;
            }
        }
        taken[next] = true;
        chosen.push_back(candidates[next]);
        for (size_t j = 0; j < candidates.size(); ++j) {
            nearness[j] = std::max(nearness[j], glm::dot(directions[candidates[j]], directions[candidates[next]]));
        }
    }
    std::sort(chosen.begin(), chosen.end());
    return chosen;
}

std::vector<size_t> chosenLights(const std::vector<Light>& lights, const LightChoice& choice)
{
    std::vector<size_t> candidates;
    std::vector<glm::vec3> directions;
    for (size_t i = 0; i < lights.size(); ++i) {
        directions.push_back(lights[i].direction);
        if (!isHeldOutOfEvery(i, choice.heldOutEvery, choice.heldOutFirst)) {
            candidates.push_back(i);
        }
    }
    if (choice.given == 0) {
        return candidates;
    }
    if (choice.given < kFewestLightsGiven || choice.given > candidates.size()) {
        throw Error("", fmt::format("{} lights given are not possible", choice.given),
                    fmt::format("{} to {}, the capture's lights{}", kFewestLightsGiven, candidates.size(),
                                choice.heldOutEvery ? " that are not held out" : ""),
                    Error::kUsage);
    }
    return farthestFirst(directions, candidates, choice.given);
}

std::vector<Light> selectLights(const std::vector<Light>& lights, const std::vector<size_t>& chosen)
{
    return selectItems(lights, chosen);
}

Rig selectLights(const Rig& rig, const std::vector<size_t>& chosen)
{
    Rig result = rig;
    result.lights = selectLights(rig.lights, chosen);
    result.shadingDisagreement = selectItems(rig.shadingDisagreement, chosen);
    result.condition = conditionOf(result.lights);
    return result;
}

} // namespace nacre
