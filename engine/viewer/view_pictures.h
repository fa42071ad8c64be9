#pragma once
#include <optional>
#include <string>

#include "engine/gpu/renderer.h"
#include "engine/view_state/controls.h"
#include "engine/viewer/scene_source.h"

namespace nacre {

// The pictures of a view state: with a window and without one they are the same.
class ViewPictures {
public:
    explicit ViewPictures(const Context& context) : context_(context), main_(context) {}

    // Uploads what differs from the last; meshes are drawn as the state turns them.
    void setScene(const LoadedScene& scene, const ViewState& state);
    // Lights, exposure (automatic where the state has none, which is then written into it), what is shown.
    void apply(ViewState& state, const glm::vec3& view, std::span<const CapturedLight> captured);

    // While meshes are turned they cast no shadows, and are drawn by one sample a pixel, at the zoom's scale where
    // nothing but normals is needed of them: the scene's surfaces then are as they were last at rest.
    void setTurning(bool isTurning) { isTurning_ = isTurning; }
    bool isTurning() const { return isTurning_; }
    // Renderer::setLightsMove of all of them.
    void setLightsMove(bool move) { lightsMove_ = move; }
    bool doLightsMove() const { return lightsMove_; }
    bool isMoving() const { return isTurning_ || lightsMove_; }

    // Read ones, which verdicts are on; null: none are at hand, and the render stands in their place.
    void setPhotographs(const Photographs* photographs) { photographs_ = photographs; }

    // The part of the renders that is drawn from the next apply() on, and its scale; none: all of them as they are.
    void setZoom(const std::optional<Zoom>& zoom) { zoom_ = zoom; }
    // What has changed since; true where something was drawn.
    bool draw();
    const Texture& main() const { return verdicts_ ? verdicts_->texture : main_.drawnPicture(); }
    const Texture* other() const { return hasWipe() ? &other_->drawnPicture() : nullptr; } // right of the wipe's line
    int wipeColumn() const; // first column of the other; the width where there is none
    // Both in one as they are, codes in [0,1].
    Image picture();
    // Of the main one, linear.
    Frame radiance() { return main_.radiance(); }
    // Of the main one, drawn last, by a sample of its pixels (coverage.h).
    double uncertainShare();

    const LoadedScene& scene() const { return scene_; }
    std::span<const Light> lights() const { return lights_; }
    const Display& display() const { return display_; }
    // Of the photograph whose verdicts are shown; empty where none are.
    std::span<const uint8_t> verdicts() const { return verdicts_ ? verdicts_->ofPixels : std::span<const uint8_t>(); }
    glm::ivec2 size() const;
    Renderer& renderer() { return main_; }

private:
    struct Verdicts {
        size_t light; // of the captured ones
        std::vector<uint8_t> ofPixels;
        Image picture;
        Texture texture;
    };

    void turnTo(const ViewState& state);
    void drawTurned(DrawnSurface& drawn, Renderer& renderer, const ViewState& state) const;
    void applyTo(Renderer& renderer, const ViewState& state, const glm::vec3& view) const;
    void applyVerdicts(const ViewState& state);
    void zoomTo(const std::optional<Zoom>& zoom);
    bool hasWipe() const { return other_ && !verdicts_; }

    const Context& context_;
    Renderer main_;
    std::unique_ptr<Renderer> other_;
    LoadedScene scene_;
    struct Pose {
        Turn turn;
        bool isCoarse = false;
        bool onDevice = false;      // alone, where it is coarse
        std::optional<Zoom> zoom{}; // there
        bool operator==(const Pose&) const = default;
    };
    Pose pose_; // of its meshes, as they are drawn
    bool isTurning_ = false;
    bool lightsMove_ = false;
    const Photographs* photographs_ = nullptr;
    std::optional<Verdicts> verdicts_; // in place of the renders
    std::vector<Light> lights_;
    glm::vec3 view_{0, 0, 1};
    Display display_;
    float wipeAt_ = 1;
    std::optional<Zoom> zoom_;
    std::optional<std::pair<size_t, double>> uncertain_; // the main one's number, and its share
};

// A photograph or its difference to the render in the render's place, and figures of both.
class PhotographComparison {
public:
    explicit PhotographComparison(const Context& context) : context_(context) {}

    // Follows what the session asks for; `pictures` are drawn. Null photographs: none are at hand.
    void update(const Session& session, const Photographs* photographs, ViewPictures& pictures);
    const Texture* picture() const { return picture_ ? &*picture_ : nullptr; } // null: the render stays
    const std::string& figures() const { return figures_; }

private:
    const Context& context_;
    std::optional<Texture> picture_;
    std::optional<std::pair<size_t, size_t>> compared_; // its photograph, and the render's number
    Comparison by_ = Comparison::none;
    std::string figures_;
};

} // namespace nacre
