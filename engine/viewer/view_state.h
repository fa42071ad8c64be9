#pragma once
#include <span>
#include <string>
#include <vector>

#include "engine/scene/false_colour.h"
#include "engine/scene/light_source.h"
#include "engine/scene/scene_file.h"
#include "engine/surface/residual_layer.h"

namespace nacre {

// How much of the picture the window shows, and where.
struct Framing {
    float zoom = 0;         // screen pixels a pixel of the picture; 0: fitted
    glm::vec2 centre{0, 0}; // of the window, in pixels of the picture; where it is not fitted
    bool operator==(const Framing&) const = default;
};

// Left of the line the material that is chosen, right of it another.
struct Wipe {
    std::string material; // as --material has it; empty: no wipe
    float at = 0.5f;      // the line, a share of the picture's width
    bool operator==(const Wipe&) const = default;
};

// All that decides what a window shows, and that its state file holds.
struct ViewState {
    std::filesystem::path surface; // or
    std::string material;          // of one's own, on `onto`
    std::filesystem::path onto;
    std::string normalY;
    std::string size;
    std::vector<LightSource> lights;
    std::filesystem::path environment;
    std::optional<int> environmentLights;
    float environmentTurn = 0;     // degrees
    std::optional<float> exposure; // stops; empty: automatic
    int toneCurve = kToneSrgb;
    std::string view; // x,y,z towards the viewer; empty: from the front
    std::string path; // as --path has it
    Show show = Show::picture;
    Framing framing;
    std::optional<bool> shadows; // cast by the surface's height
    ResidualUse residual = ResidualUse::on;
    std::vector<std::string> materials; // further ones to choose from
    std::vector<std::filesystem::path> targets;
    std::vector<std::filesystem::path> environments;
    Wipe wipe;
    bool operator==(const ViewState&) const = default;
};

// Throws Error (usage) about a light, a tone curve, a thing to show or a use of the residual layer that is
// not known.
ViewState viewStateOf(const SceneFile& scene);
SceneFile sceneFileOf(const ViewState& state);

// The captured light that alone lights the surface on its own shape, counted from 0: what a photograph can be held
// against. Empty where anything else is shown.
std::optional<size_t> shownPhotograph(const ViewState& state);

// Gives the lights the values of the captured ones that they name, so that they can be moved from there on.
void resolveCaptured(ViewState& state, std::span<const CapturedLight> captured);

} // namespace nacre
