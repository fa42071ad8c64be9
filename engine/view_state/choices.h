#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/scene/scene_description.h"

namespace nacre {

// The scene that a window shows.
using ViewState = SceneDescription;

struct MaterialChoice {
    std::string name;
    std::string specification; // of the material; empty: the surface's own, as measured
};

struct TargetChoice {
    std::string name;
    std::filesystem::path path; // of other normals; empty: the surface's own shape
};

// What can be chosen from while a window is open, in the order of its lists.
struct Choices {
    std::filesystem::path surface; // that the window shows; empty: a material alone
    std::vector<MaterialChoice> materials;
    std::vector<TargetChoice> targets;
    std::vector<std::filesystem::path> environments;
    std::vector<CapturedLight> captured;
};

// A surface as measured and, of several materials, each alone; on its own shape.
Choices choicesOfSurface(const std::filesystem::path& surface);

// The same with what the state shows and lists beside it.
Choices choicesOf(const ViewState& state);

// Further shapes, named by their files or what makes them.
void addTargets(Choices& choices, const std::vector<std::filesystem::path>& paths);

// Indices into the lists; none where what the state shows is not in them.
std::optional<size_t> chosenMaterial(const ViewState& state, const Choices& choices);
std::optional<size_t> chosenTarget(const ViewState& state, const Choices& choices);

// The state with this material on this shape. Indices must be in range.
ViewState withChoice(const ViewState& state, const Choices& choices, size_t material, size_t target);

// The specification of the same material; the surface's own has the surface's name.
std::string specificationOf(const Choices& choices, size_t material);

} // namespace nacre
