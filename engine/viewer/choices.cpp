#include "engine/viewer/choices.h"

#include <algorithm>

namespace nacre {

std::optional<size_t> chosenMaterial(const ViewState& state, const Choices& choices)
{
    const auto found = std::find_if(choices.materials.begin(), choices.materials.end(),
                                    [&](const auto& choice) { return choice.specification == state.material; });
    return found == choices.materials.end() ? std::nullopt : std::optional<size_t>(found - choices.materials.begin());
}

std::optional<size_t> chosenTarget(const ViewState& state, const Choices& choices)
{
    // Another material on the surface's own shape names the surface as its target.
    const bool isOwn = state.onto.empty() || state.onto == choices.surface;
    const auto found = std::find_if(choices.targets.begin(), choices.targets.end(), [&](const auto& choice) {
        return isOwn ? choice.path.empty() : choice.path == state.onto;
    });
    return found == choices.targets.end() ? std::nullopt : std::optional<size_t>(found - choices.targets.begin());
}

ViewState withChoice(const ViewState& state, const Choices& choices, size_t material, size_t target)
{
    ViewState chosen = state;
    const std::string& specification = choices.materials[material].specification;
    const std::filesystem::path& path = choices.targets[target].path;
    chosen.material = specification;
    chosen.surface = specification.empty() ? choices.surface : "";
    chosen.onto = specification.empty() || !path.empty() ? path : choices.surface;
    if (chosen.surface.empty()) { // then captured lights have no number to be known by
        for (LightSource& light : chosen.lights) {
            light.captured = 0;
        }
    }
    if (chosen.onto != state.onto) {
        chosen.framing = {};
    }
    return chosen;
}

std::string specificationOf(const Choices& choices, size_t material)
{
    const std::string& specification = choices.materials[material].specification;
    return specification.empty() ? choices.surface.string() : specification;
}

} // namespace nacre
