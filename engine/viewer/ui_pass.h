#pragma once
#include <span>

#include "engine/gpu/texture.h"
#include "engine/view_state/changed_tiles.h"
#include "engine/viewer/window.h"

namespace nacre {

// Dear ImGui drawn over what a picture of the window holds already. Its version 1.86 draws no textures but its font:
// pictures among the panels are copied below it (see placed_picture.h).
class UiPass {
public:
    // `scale` of sizes in pixels: 1 at 96 dots an inch.
    UiPass(const Context& context, const Window& window, const Swapchain& swapchain, float scale);
    ~UiPass();
    UiPass(const UiPass&) = delete;
    UiPass& operator=(const UiPass&) = delete;

    // Between these, ImGui's functions describe the next frame.
    void begin();
    void end();

    // What the frame draws, in pixels of the window.
    void addLooks(ChangedTiles& tiles) const;
    // The frame, where it lies in one of the boxes; once a frame. The target is in kDrawnTo.
    void record(VkCommandBuffer commands, const Texture& target, std::span<const PixelBox> boxes);

    float scale() const { return scale_; }

private:
    void makeFramebuffer(const Texture& target);

    const Context& context_;
    float scale_ = 1;
    Owned<VkRenderPass, vkDestroyRenderPass> renderPass_;
    Owned<VkDescriptorPool, vkDestroyDescriptorPool> descriptors_;
    Owned<VkFramebuffer, vkDestroyFramebuffer> framebuffer_; // of the last frame's target
};

} // namespace nacre
