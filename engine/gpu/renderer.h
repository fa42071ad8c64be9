#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/gpu/canvas.h"
#include "engine/gpu/false_colour_frame.h"
#include "engine/gpu/lit_balls.h"
#include "engine/gpu/zoom_frame.h"
#include "engine/scene/scene.h"

namespace nacre {

// Draws a surface under lights, without a window. Whatever is set is uploaded once and stays; nothing is drawn
// twice. A picture depends on what is set alone, not on what was set before. The context must live longer.
class Renderer {
public:
    static constexpr VkDeviceSize kCacheBytes = 64 << 20;
    static constexpr size_t kExposurePixels = 1 << 14;

    explicit Renderer(const Context& context, VkDeviceSize cacheBytes = kCacheBytes);

    // `sizes`: measuredBallSize of each material, where they are known already; they take a while to measure.
    void setSurface(Surface surface, std::vector<BallSize> sizes = {});
    // Other pixels of the same materials, with albedo factors where the surface has them: balls stay, unless a residual
    // layer comes or goes.
    void setPixels(const Surface& pixels);
    // Pixels that are on the device already, of all the picture or of the zoom's part of it, to be shown one for one:
    // pictures are of them until pixels, surface or zoom are set again. Only of what drawsFromDevice().
    void setDevicePixels(std::shared_ptr<const PixelTextures> pixels);
    // Whether all that is drawn of a pixel is its normal, under these lights.
    bool drawsFromDevice(std::span<const Light> lights) const;
    void setLights(std::span<const Light> lights);
    // While lights move, what those that stay add to pictures is kept, and balls have at most LitBalls::kMovingSize
    // texels: pictures are near to those at rest, and quick.
    void setLightsMove(bool move);
    void setView(const glm::vec3& view); // unit, towards the viewer
    void setPath(RenderPath path);
    void setDisplay(const Display& display);
    void setShow(Show show);           // the picture by default
    void setResidual(ResidualUse use); // of a surface that has a layer; on by default
    // Pictures and radiance of a part at another scale; none: as they are. Magnified, what pixels have is filtered and
    // then shaded; reduced, what is shaded is averaged.
    void setZoom(const std::optional<Zoom>& zoom);

    // Linear radiance by the direct path in 32-bit floats, whatever the path that is set.
    Frame radiance();
    // Stops as automaticExposure has them for that radiance: of all pixels, or of an even sample of kExposurePixels.
    float automaticExposure();
    // Codes of the display in [0,1], n/255, by the path that is set; 3 channels.
    Image picture();
    // The same without reading it back.
    void drawPicture();
    // What it has drawn: codes, to be copied from (kCopiedFrom).
    const Texture& drawnPicture() const
    {
        return hasDevicePixels_ ? device_.codes() : zoom_ ? zoomFrame_.codes() : own_.codes();
    }
    // A ball of one of the materials under the lights of the picture, `size` pixels across, from the balls that the
    // picture is drawn from: one lookup a pixel. Null where pictures are drawn directly, or of a residual layer alone.
    const Texture* drawMaterialBall(size_t material, int size);
    // The part of it that does not depend on the pixels; nothing on the direct path.
    void updateBalls();
    // Draws the next picture again though nothing changed: for measurement.
    void forgetPicture() { pictureHasChanged(); }

    // The one that a picture takes. Error (usage) where ball was set and cannot be.
    RenderPath pathTaken();
    // Why it is not the ball; empty where it is.
    std::string whyDirect();
    // One a material, of the ball path.
    const std::vector<BallSize>& ballSizes();
    // The same as pictures are drawn from them: coarser while lights move; else, where pictures are magnified and the
    // cache has room, of more texels, so that these are not seen.
    std::vector<BallSize> drawnBallSizes();
    // Whether balls are coarser than these, since lights move.
    bool isCoarse();

    // Scene with everything in it, at once; radiance by the direct path.
    Frame render(const Scene& scene);
    Frame render(std::span<const Light> lights, const glm::vec3& view = {0, 0, 1});

    VkDeviceSize deviceBytes() const;
    VkDeviceSize cachedBytes() const { return balls_.bytes(); }
    const Context& context() const { return context_; }
    size_t drawnPictures() const { return drawnPictures_; }
    size_t drawnBallLights() const { return balls_.drawnLights(); }

private:
    struct MaterialBall {
        size_t material;
        int size;
        Surface pixels; // with labels where those of the surface have them
        Canvas canvas;
    };
    struct Shaded {
        Canvas& canvas;
        const Surface& pixels;
    };

    void makeMaterialBall(size_t material, int size);
    // What is drawn: the surface's own pixels, those that the zoom wants, or those that are on the device.
    Shaded shaded();
    Shaded shadedSurface(); // without the latter
    void uploadLights();
    void placePixels();
    void dropPixels();
    void pictureHasChanged();
    void lightsHaveChanged();
    void materialBallHasChanged();
    bool hasResidual() const;
    bool ballsAreCodes() const;
    // With the weights of the frame's lights, `gain` times, uploaded.
    DirectFrame::Inputs inputs(float gain);
    const BallCache& updatedBalls();
    void dropDevicePixels();
    void drawDirectly(const Shaded& shaded);
    void drawFromBalls(const Shaded& shaded, bool withResidual);
    void drawFalseColours(const Shaded& shaded);
    void shade(const Shaded& shaded);
    void drawZoomed(const Canvas& shaded);

    const Context& context_;
    DirectPass direct_;
    ResidualPass residualPass_;
    LitBalls balls_;
    VkDeviceSize cacheBytes_;
    Canvas own_;    // of the surface
    Canvas device_; // of pixels that are on the device, in place of all others
    bool hasDevicePixels_ = false;
    DirectFrame exposureFrame_; // of exposurePixels_
    FalseColourFrame falseColours_;

    Surface surface_;
    bool plain_ = false;
    std::vector<TableTexture> tables_;
    std::vector<BallSize> ballSizes_;
    std::optional<Surface> exposurePixels_;
    std::vector<Light> lights_;
    LightGroups groups_;
    ResidualUse residual_ = ResidualUse::on;
    ResidualFrame residualFrame_; // of the lights, where they are not stale
    bool lightsMove_ = false;
    MovingLights movingLights_;
    MovingLights::Order order_; // of the lights, where they are not stale
    glm::vec3 view_{0, 0, 1};
    RenderPath path_ = RenderPath::automatic;
    Display display_;
    Show show_ = Show::picture;

    bool lightsAreStale_ = true;
    std::optional<Frame> radiance_; // where it is not stale

    std::optional<Zoom> zoom_;
    std::optional<MagnifiedSurface> magnified_; // by zoom_, once it is drawn
    Canvas nearer_;                             // of magnified_
    ZoomFrame zoomFrame_;
    bool zoomIsStale_ = true;

    std::optional<MaterialBall> materialBall_;
    size_t drawnPictures_ = 0;
};

} // namespace nacre
