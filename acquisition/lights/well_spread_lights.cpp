#include "acquisition/lights/well_spread_lights.h"

#include <algorithm>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "engine/files/error.h"

namespace nacre {

namespace {

// Empty stays empty: lists that a capture does not have.
template <class Item> std::vector<Item> selected(const std::vector<Item>& items, const std::vector<size_t>& chosen)
{
    std::vector<Item> result;
    for (size_t i = 0; i < chosen.size() && !items.empty(); ++i) {
        result.push_back(items[chosen[i]]);
    }
    return result;
}

} // namespace

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
        throw Error("", fmt::format("--lights-given {} is not possible", choice.given),
                    fmt::format("{} to {}, the capture's lights{}", kFewestLightsGiven, candidates.size(),
                                choice.heldOutEvery ? " that are not held out" : ""),
                    Error::kUsage);
    }
    return farthestFirst(directions, candidates, choice.given);
}

Capture selectPhotographs(const Capture& capture, const std::vector<size_t>& chosen)
{
    Capture result = capture;
    result.photographs = selected(capture.photographs, chosen);
    result.lights = selected(capture.lights, chosen);
    for (std::optional<SpherePhotographs>* sphere : {&result.mirrorSphere, &result.diffuseSphere}) {
        if (*sphere) {
            (*sphere)->photographs = selected((*sphere)->photographs, chosen);
        }
    }
    return result;
}

std::vector<Light> selectLights(const std::vector<Light>& lights, const std::vector<size_t>& chosen)
{
    return selected(lights, chosen);
}

Rig selectLights(const Rig& rig, const std::vector<size_t>& chosen)
{
    Rig result = rig;
    result.lights = selectLights(rig.lights, chosen);
    result.shadingDisagreement = selected(rig.shadingDisagreement, chosen);
    result.condition = conditionOf(result.lights);
    return result;
}

} // namespace nacre
