#pragma once
#include "engine/gpu/renderer.h"
#include "engine/viewer/scene_source.h"

namespace nacre {

// The pictures of a view state: with a window and without one they are the same.
class ViewPictures {
public:
    explicit ViewPictures(const Context& context) : context_(context), main_(context) {}

    // Uploads what differs from the last.
    void setScene(const LoadedScene& scene);
    // Lights, exposure (automatic where the state has none, which is then written into it), what is shown.
    void apply(ViewState& state, const glm::vec3& view, std::span<const CapturedLight> captured);

    // What has changed since; true where something was drawn.
    bool draw();
    const Texture& main() const { return main_.drawnPicture(); }
    const Texture* other() const { return other_ ? &other_->drawnPicture() : nullptr; } // right of the wipe's line
    int wipeColumn() const; // first column of the other; the width where there is none
    // Both in one, codes in [0,1].
    Image picture();
    // Of the main one, linear.
    Frame radiance() { return main_.radiance(); }

    const LoadedScene& scene() const { return scene_; }
    std::span<const Light> lights() const { return lights_; }
    const Display& display() const { return display_; }
    glm::ivec2 size() const;
    Renderer& renderer() { return main_; }

private:
    void applyTo(Renderer& renderer, const ViewState& state, const glm::vec3& view) const;

    const Context& context_;
    Renderer main_;
    std::unique_ptr<Renderer> other_;
    LoadedScene scene_;
    std::vector<Light> lights_;
    Display display_;
    float wipeAt_ = 1;
};

// The directional lights of a state, environment included.
std::vector<Light> lightsOfView(const ViewState& state, const Environment* environment,
                                std::span<const CapturedLight> captured);

} // namespace nacre
