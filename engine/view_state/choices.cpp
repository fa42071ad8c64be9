#include "engine/view_state/choices.h"

#include <algorithm>

#include "engine/surface/surface_material.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

std::string nameOfSpecification(const std::string& text)
{
    return fs::exists(text) ? fs::path(text).stem().string() : text.substr(text.rfind('/') + 1);
}

void addMaterial(Choices& choices, const std::string& specification)
{
    const bool isThere = std::any_of(choices.materials.begin(), choices.materials.end(),
                                     [&](const MaterialChoice& m) { return m.specification == specification; });
    // The surface's own first material, named, is what is measured already.
    if (!specification.empty() && !isThere && specification != choices.surface) {
        choices.materials.push_back({nameOfSpecification(specification), specification});
    }
}

void addTarget(Choices& choices, const fs::path& path)
{
    const bool isThere = std::any_of(choices.targets.begin(), choices.targets.end(),
                                     [&](const TargetChoice& t) { return t.path == path; });
    if (!path.empty() && !isThere) {
        const std::string name =
            isGenerated(path) ? path.string().substr(path.string().find(':') + 1) : path.stem().string();
        choices.targets.push_back({name, path});
    }
}

void addEnvironment(Choices& choices, const fs::path& path)
{
    std::vector<fs::path>& known = choices.environments;
    if (!path.empty() && std::find(known.begin(), known.end(), path) == known.end()) {
        known.push_back(path);
    }
}

} // namespace

Choices choicesOfSurface(const fs::path& folder)
{
    const Surface surface = loadSurface(folder);
    const std::vector<Material>& materials = surface.materials;
    Choices choices;
    choices.surface = folder;
    choices.captured = surface.lights;
    choices.targets.push_back({.name = folder.stem().string(), .path = ""});
    choices.materials.push_back(
        {.name = materials.size() == 1 ? materials[0].name : "as measured", .specification = ""});
    for (size_t i = 0; materials.size() > 1 && i < materials.size(); ++i) {
        choices.materials.push_back({materials[i].name, specificationOf(folder.string(), surface, i)});
    }
    return choices;
}

void addTargets(Choices& choices, const std::vector<fs::path>& paths)
{
    for (const fs::path& path : paths) {
        addTarget(choices, path);
    }
}

Choices choicesOf(const ViewState& state)
{
    Choices choices = state.surface.empty() ? Choices{} : choicesOfSurface(state.surface);
    addMaterial(choices, state.material);
    addTarget(choices, state.onto);
    for (const std::string& material : state.materials) {
        addMaterial(choices, material);
    }
    addTargets(choices, state.targets);
    addEnvironment(choices, state.environment);
    for (const fs::path& environment : state.environments) {
        addEnvironment(choices, environment);
    }
    return choices;
}

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
