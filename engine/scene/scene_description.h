#pragma once
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/lights/light_motion.h"
#include "engine/scene/false_colour.h"
#include "engine/scene/light_source.h"
#include "engine/scene/picture_size.h"
#include "engine/scene/turn.h"
#include "engine/surface/normal_map.h"
#include "engine/surface/residual_layer.h"

namespace nacre {

// How much of the picture a window shows, and where.
struct Framing {
    float zoom = 0;         // screen pixels a pixel of the picture; 0: fitted
    glm::vec2 centre{0, 0}; // of the window, in pixels of the picture; where it is not fitted
    bool operator==(const Framing&) const = default;
};

// Left of the line the material that is chosen, right of it another.
struct Wipe {
    std::string material; // its specification; empty: no wipe
    float at = 0.5f;      // the line, a share of the picture's width
    bool operator==(const Wipe&) const = default;
};

// What is drawn, from where, under which lights, and how it is shown: what a state file holds and a command line says.
struct SceneDescription {
    std::filesystem::path surface; // or
    std::string material;          // the specification of another, on `onto`
    std::filesystem::path onto;    // other normals, or a mesh
    Turn turn;                     // of the mesh, or of the surface by its height
    std::optional<NormalY> normalY;
    std::optional<PictureSize> size; // that the surface is fitted into
    std::optional<bool> shadows;     // cast by the surface's height

    std::vector<LightSource> lights;
    std::string rig; // further lights by name or file; not in state files
    std::filesystem::path environment;
    std::optional<int> environmentLights;
    float environmentTurn = 0; // degrees

    std::optional<glm::vec3> view; // towards the viewer, of any length; empty: from the front
    RenderPath path = RenderPath::automatic;
    std::optional<float> exposure; // stops; empty: automatic
    int toneCurve = kToneSrgb;
    Show show = Show::picture;
    ResidualUse residual = ResidualUse::on;
    int frames = 1;
    std::optional<LightMotion> motion; // over the frames; empty: a turntable where there are several

    // A window's alone.
    Framing framing;
    std::vector<std::string> materials; // further ones to choose from
    std::vector<std::filesystem::path> targets;
    std::vector<std::filesystem::path> environments;
    Wipe wipe;
    bool operator==(const SceneDescription&) const = default;
};

// Reads a state file (docs/formats.md). Paths in it are relative to it. Throws Error.
SceneDescription sceneFromFile(const std::filesystem::path& file);

// The state file's text; paths relative to `folder`, where it is to be written.
std::string textOf(const SceneDescription& scene, const std::filesystem::path& folder);

// "x,y,z" towards a viewer that sees the front of something. Throws Error (usage).
glm::vec3 viewFromText(const std::string& text);

// Unit, towards the viewer.
glm::vec3 viewDirectionOf(const SceneDescription& scene);

// Paths and files within specifications, so that they mean the same wherever a state file lies.
void makeAbsolute(SceneDescription& scene);

// make:SPECIFICATION, a shape that the program generates, in a path's place.
bool isGenerated(const std::filesystem::path& onto);

// Gives the lights the values of the captured ones that they name, so that they can be moved from there on; where
// nothing lights the scene, the default light.
void resolveCaptured(SceneDescription& scene, std::span<const CapturedLight> captured);

// The captured light that alone lights the surface on its own shape, counted from 0: what a photograph can be held
// against. Empty where anything else is shown.
std::optional<size_t> shownPhotograph(const SceneDescription& scene);

} // namespace nacre
