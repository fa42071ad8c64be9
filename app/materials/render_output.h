#pragma once
#include <functional>

#include "engine/gpu/renderer.h"
#include "engine/scene/scene_description.h"

namespace nacre {

constexpr int kMostFrames = 10000; // of a sequence

// What is written, from the file's extension and the frames: .exr holds linear radiance, .png is exposed for the
// eye, and so is .webp. Several frames make numbered pictures (NAME_0001.png), or one .webp that moves.
struct RenderOutput {
    std::filesystem::path file;
    int frames = 1;
    LightMotion motion = LightMotion::none;
    RenderPath path = RenderPath::automatic;
    std::optional<float> exposure; // stops; empty: automatic
    int toneCurve = kToneSrgb;
    Show show = Show::picture;
    ResidualUse residual = ResidualUse::on;
    float scale = 1; // of pixels, see Renderer::setZoom
    bool hasScaleBar = false;
    bool isRadiance = false;
    bool isAnimation = false;

    // Falls with exposure and tone curve: false colours have none.
    bool isExposed() const { return !isRadiance && (show == Show::picture || show == Show::coverage); }
};

// Throws Error (usage) where options contradict each other, Error (data) where the output cannot be written.
RenderOutput checkedOutput(const SceneDescription& scene, const std::filesystem::path& file, float scale,
                           bool hasScaleBar, bool force);

struct RenderedOutput {
    std::filesystem::path first; // file
    float stops = 0;             // of pictures for the eye
};

// Draws and writes all frames of the scene, whose surface and view the renderer has. `turnTo` gives the renderer the
// pixels of a frame, where the object turns.
RenderedOutput renderFrames(Renderer& renderer, const RenderOutput& output, const Scene& scene,
                            const std::function<void(int frame)>& turnTo = {});

} // namespace nacre
