#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/viewer/view_state.h"

namespace nacre {

struct MaterialChoice {
    std::string name;
    std::string specification; // as --material has it; empty: the surface's own, as measured
};

struct TargetChoice {
    std::string name;
    std::filesystem::path path; // as --onto has it; empty: the surface's own shape
};

// What can be chosen from while a window is open, in the order of its lists.
struct Choices {
    std::filesystem::path surface; // that the window shows; empty: a material alone
    std::vector<MaterialChoice> materials;
    std::vector<TargetChoice> targets;
    std::vector<std::filesystem::path> environments;
    std::vector<CapturedLight> captured;
};

// Indices into the lists; none where what the state shows is not in them.
std::optional<size_t> chosenMaterial(const ViewState& state, const Choices& choices);
std::optional<size_t> chosenTarget(const ViewState& state, const Choices& choices);

// The state with this material on this shape. Indices must be in range.
ViewState withChoice(const ViewState& state, const Choices& choices, size_t material, size_t target);

// What --material would be given to get the same material; the surface's own has the surface's name.
std::string specificationOf(const Choices& choices, size_t material);

} // namespace nacre
