#include "app/materials/view_choices.h"

#include <algorithm>
#include <array>

#include "engine/surface/surface_material.h"

namespace nacre {
namespace fs = std::filesystem;

namespace {

fs::path absolutePath(const fs::path& path)
{
    fs::path whole = path.empty() ? path : fs::absolute(path).lexically_normal();
    return whole.has_filename() || whole.empty() ? whole : whole.parent_path(); // without a slash at the end
}

// FILE, KIND:FILE, NAME.nacre and NAME.nacre#MATERIAL; formulas stay as they are.
std::string absoluteSpecification(const std::string& text)
{
    if (text.empty() || fs::exists(text)) {
        return absolutePath(text).string();
    }
    for (const std::string_view kind : {"merl:", "rgl:", "table:"}) {
        if (text.starts_with(kind)) {
            return std::string(kind) + absolutePath(text.substr(kind.size())).string();
        }
    }
    const size_t mark = text.rfind('#');
    const bool isOfSurface = mark != std::string::npos && fs::is_directory(text.substr(0, mark));
    return isOfSurface ? absolutePath(text.substr(0, mark)).string() + text.substr(mark) : text;
}

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
        choices.targets.push_back({path.stem().string(), path});
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

void makeAbsolute(SceneFile& scene)
{
    for (fs::path* path : {&scene.surface, &scene.onto, &scene.environment}) {
        *path = absolutePath(*path);
    }
    for (std::vector<fs::path>* paths : {&scene.window.targets, &scene.window.environments}) {
        for (fs::path& path : *paths) {
            path = absolutePath(path);
        }
    }
    scene.material = absoluteSpecification(scene.material);
    scene.window.wipeMaterial = absoluteSpecification(scene.window.wipeMaterial);
    for (std::string& material : scene.window.materials) {
        material = absoluteSpecification(material);
    }
}

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

Choices choicesOf(const ViewState& state)
{
    Choices choices = state.surface.empty() ? Choices{} : choicesOfSurface(state.surface);
    addMaterial(choices, state.material);
    addTarget(choices, state.onto);
    for (const std::string& material : state.materials) {
        addMaterial(choices, material);
    }
    for (const fs::path& target : state.targets) {
        addTarget(choices, target);
    }
    addEnvironment(choices, state.environment);
    for (const fs::path& environment : state.environments) {
        addEnvironment(choices, environment);
    }
    return choices;
}

} // namespace nacre
